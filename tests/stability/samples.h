#ifndef TESTS_STABILITY_SAMPLES_H
#define TESTS_STABILITY_SAMPLES_H

// Shapes without their closing brace. Lengths are multiples of K, so that parameters really get small and large.
static const char *const samples[] = {
    "sphere { <.1, .2, .3>*K, K",
    "sphere { 0, 1e-5*K",
    "box { <-1, -.5, -.2>*K, <.7, .8, .9>*K",
    "box { <-1, -1e-5, -1>*K, <1, 1e-5, 1>*K",
    "plane { <.1, 1, .2>, .3*K",
    "cylinder { <-.5, -.2, 0>*K, <.6, .7, .8>*K, .4*K",
    "cylinder { <0, -1, 0>*K, <0, 1, 0>*K, .5*K open",
    "cylinder { <0, -1, 0>*K, <0, 1, 0>*K, 1e-5*K",
    "cone { <0, -1, 0>*K, K, <.2, 1, .1>*K, .25*K",
    "cone { <0, -1, 0>*K, 0, <0, 1, 0>*K, K",
    "cone { <0, -1, 0>*K, .5*K, <0, 1, 0>*K, .50001*K",
    "disc { <.1, 0, 0>*K, <0, 1, .2>, K, .3*K",
    "torus { K, .25*K",
    "torus { .5*K, .5*K",
    "torus { K, 1e-5*K",
    "quadric { <1, 2, 3>, <.1, .2, .3>, <.4, .5, .6>*K, -K*K",
    "quadric { <1, 1, -1>, 0, 0, -.1*K*K",
    "quadric { <1, 0, 1>, 0, -y*K, 0",
    "triangle { <-1, 0, 0>*K, <1, 0, .2>*K, <0, 1, 0>*K",
    "smooth_triangle { <-1, 0, 0>*K, <-.2, 0, -1>, <1, 0, 0>*K, <.2, 0, -1>, <0, 1, "
    "0>*K, "
    "<0, .2, -1>",
    "poly { 2, <1, 0, 0, 0, 1, 0, 0, 1, 0, -K*K>",
    "cubic { <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, K, 0, 0, -.5*K*K*K>",
    "quartic { <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, "
    "0, "
    "0, 0, 0, 0, 0, 1, 0, 0, 0, -K*K*K*K>",
    "polynomial { 35, xyz(35, 0, 0): 1, xyz(0, 2, 0): -1, xyz(0, 0, 1): .3, xyz(0, 0, "
    "0): .1 "
    "scale K",
    "polynomial { 35, xyz(34, 0, 0): 1, xyz(0, 34, 0): 1, xyz(0, 0, 34): 1, xyz(1, 0, "
    "0): "
    "-.2, xyz(0, 0, 0): -1 scale K",
    "polynomial { 20, xyz(10, 10, 0): 1, xyz(0, 5, 10): -1, xyz(0, 0, 9): 2, xyz(1, 0, "
    "0): "
    "1, xyz(0, 0, 0): -.1 scale K",
    "polynomial { 3, xyz(2, 0, 0): K, xyz(0, 2, 0): K, xyz(0, 1, 2): .5, xyz(0, 0, 2): "
    "K, "
    "xyz(0, 0, 0): -K*K*K",
    "ovus { K, .5*K",
    "ovus { .8*K, 1.2*K",
    "superellipsoid { <.5, .5> scale K",
    "superellipsoid { <1.3, .4> scale K",
    "blob { threshold .5 sphere { <-.4, 0, 0>*K, K, 1 } sphere { <.4, 0, 0>*K, K, 1 } "
    "cylinder { <0, -1, 0>*K, <0, 1, .5>*K, .6*K, .8 }",
    "lathe { linear_spline 5, <0, -.5>*K, <.5, -.5>*K, <.7, .2>*K, <0, .5>*K, <0, -.5>*K",
    "lathe { cubic_spline 7, <0, -1.5>*K, <0, -1>*K, <1, -.6>*K, <.4, 0>*K, <.8, .7>*K, "
    "<0, 1>*K, <0, 2>*K",
    "sor { 6, <.2, -1>*K, <.5, -.5>*K, <.8, 0>*K, <.4, .5>*K, <.6, 1>*K, <.6, 1.5>*K",
    "prism { -K, K, 5, <-1, -1>*K, <1, -1>*K, <.5, .8>*K, <-.7, 1>*K, <-1, -1>*K",
    "prism { conic_sweep .5, 1, 5, <-1, -1>, <1, -1>, <.5, .8>, <-.7, 1>, <-1, -1> scale "
    "K",
    "prism { bezier_spline -.7*K, .9*K, 8, <-1, 0>*K, <-1, -1>*K, <1, -1>*K, <1, 0>*K, "
    "<1, 0>*K, <1, 1>*K, <-1, 1>*K, <-1, 0>*K",
    "mesh { triangle { <-1, 0, 0>*K, <1, 0, 0>*K, <0, 1, 0>*K } triangle { <-1, 0, 0>*K, "
    "<1, 0, 0>*K, <0, 0, 1>*K }",
    "mesh2 { vertex_vectors { 8, <-1,-1,-1>*K, <1,-1,-1>*K, <-1,1,-1>*K, <1,1,-1>*K, "
    "<-1,-1,1>*K, <1,-1,1>*K, <-1,1,1>*K, <1,1,1>*K } face_indices { 12, <0,1,2>, "
    "<1,3,2>, "
    "<4,6,5>, <5,6,7>, <0,4,1>, <1,4,5>, <2,3,6>, <3,7,6>, <0,2,4>, <2,6,4>, <1,5,3>, "
    "<3,5,7> } inside_vector <.3, 1, .2>",
    "polygon { 5, <-1, -1, 0>*K, <1, -1, 0>*K, <1, 1, 0>*K, <-1, 1, 0>*K, <-1, -1, 0>*K",
    "julia_fractal { <-.1, .1, .2, 0> quaternion sqr max_iteration 4 precision 60 scale "
    "K",
    "height_field { function 9, 7 { .5 + .4*sin(9*x)*cos(7*y) } scale K",
    "sphere_sweep { linear_spline 2, <-1, 0, 0>*K, .5*K, <1, 0, 0>*K, .25*K",
    "sphere_sweep { cubic_spline 5, <-1.5,-1,0>*K, .2*K, <-.6,-.6,0>*K, .3*K, "
    "<0,.6,0>*K, "
    ".2*K, <.7,-.6,0>*K, .1*K, <1.5,-1,0>*K, .2*K",
    "bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 <-1,-1,.2>*K, <-.3,-1,1>*K, "
    "<.3,-1,-1>*K, <1,-1,.1>*K, <-1,-.3,0>*K, <-.3,-.3,2>*K, <.3,-.3,-2>*K, "
    "<1,-.3,.3>*K, "
    "<-1,.3,-.5>*K, <-.3,.3,1>*K, <.3,.3,-1>*K, <1,.3,0>*K, <-1,1,0>*K, <-.3,1,1>*K, "
    "<.3,1,.5>*K, <1,1,.2>*K",
    "isosurface { function { x*x + y*y + z*z - .8 } scale K",
    "isosurface { function { pow(sqrt(x*x + z*z) - .7, 2) + y*y - .04 } contained_by { "
    "sphere { 0, 1 } } scale K",
    "parametric { function { cos(u)*cos(v) } function { sin(v) } function { "
    "sin(u)*cos(v) "
    "} <0, -1.57>, <6.28, 1.57> scale K",
    "text { ttf FONT \"a8\" .3, 0 scale K",
    // Thin by 1e-5.
    "cone { <0, -1, 0>*K, 1e-5*K, <0, 1, 0>*K, 0",
    "disc { 0, y, K, .99999*K",
    "quadric { <1, 1e10, 1>, 0, 0, -K*K",
    "quadric { <1, 0, 1>, 0, 0, -1e-10*K*K",
    "triangle { <-1, 0, 0>*K, <1, 0, 0>*K, <0, 1e-5, 0>*K",
    "poly { 2, <1, 0, 0, 0, 1e10, 0, 0, 1, 0, -K*K>",
    "quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -2.0000000002, 0, 0, 0, 0, 0, 0, 0, 0, 0, "
    "0, 1, 0, 0, 2, 0, 1.9999999998, 0, 0, 0, 0, 1, 0, -2.0000000002, 0, "
    ".9999999998> scale K",
    "ovus { 1e-5*K, K",
    "superellipsoid { <.5, .5> scale <1, 1e-5, 1>*K",
    "superellipsoid { <.1, .1> scale <1, 1, 1e-5>*K",
    "blob { threshold .5 cylinder { -K*y, K*y, 1e-5*K, 1 }",
    "blob { threshold .99999 sphere { 0, K, 1 }",
    "lathe { linear_spline 5, <.5, -1>*K, <.50001, -1>*K, <.50001, 1>*K, <.5, 1>*K, "
    "<.5, -1>*K",
    "lathe { linear_spline 4, <0, 0>*K, <1, 0>*K, <1, 1e-5>*K, <0, 1e-5>*K",
    "sor { 5, <1e-5, -1>*K, <1e-5, -.5>*K, <1e-5, 0>*K, <1e-5, .5>*K, <1e-5, 1>*K",
    "prism { 0, 1e-5*K, 5, <-1, -1>*K, <1, -1>*K, <.5, .8>*K, <-.7, 1>*K, <-1, -1>*K",
    "prism { -K, K, 5, <-1, 0>*K, <1, 0>*K, <1, 1e-5>*K, <-1, 1e-5>*K, <-1, 0>*K",
    "mesh2 { vertex_vectors { 4, <-1,0,0>*K, <1,0,0>*K, <0,1e-5,0>*K, <0,0,1>*K } "
    "face_indices { 4, <0,1,2>, <0,1,3>, <0,2,3>, <1,2,3> } inside_vector <.3, 1, .2>",
    "polygon { 5, <-1, 0, 0>*K, <1, 0, 0>*K, <1, 1e-5, 0>*K, <-1, 1e-5, 0>*K, <-1, "
    "0, 0>*K",
    "height_field { function 9, 9 { .5 + .4*sin(9*x) } scale <1, 1e-5, 1>*K",
    "height_field { function 9, 9 { .5 + .4*sin(9*x) } scale <1e-5, 1, 1>*K",
    "sphere_sweep { linear_spline 2, <-1, 0, 0>*K, 1e-5*K, <1, 0, 0>*K, 1e-5*K",
    "sphere_sweep { b_spline 5, <-1.5,-1,0>*K, 1e-5*K, <-.6,-.6,0>*K, 1e-5*K, "
    "<0,.6,0>*K, 1e-5*K, <.7,-.6,0>*K, 1e-5*K, <1.5,-1,0>*K, 1e-5*K",
    "bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 <-1,-1,.2>*K, "
    "<-.3,-1,1>*K, <.3,-1,-1>*K, <1,-1,.1>*K, <-1,-.99999,.2>*K, <-.3,-.99999,1>*K, "
    "<.3,-.99999,-1>*K, <1,-.99999,.1>*K, <-1,-.99998,.2>*K, <-.3,-.99998,1>*K, "
    "<.3,-.99998,-1>*K, <1,-.99998,.1>*K, <-1,-.99997,.2>*K, <-.3,-.99997,1>*K, "
    "<.3,-.99997,-1>*K, <1,-.99997,.1>*K",
    "isosurface { function { abs(x*x + y*y + z*z - .5) - 1e-5 } scale K",
    "isosurface { function { abs(y) - 1e-5 } scale K",
    "parametric { function { u } function { 1e-5*v } function { u*v } <-1, -1>, <1, "
    "1> scale K",
    "text { ttf FONT \"a8\" 1e-5, 0 scale K",
};

// Parameters at the end of their range: zero radii and lengths, equal points, collapsed edges,
// functions that touch zero or never cross it. What is left may be nothing.
static const char *const degenerate[] = {
    "sphere { 0, 0",
    "sphere { 0, -K",
    "box { 0, 0",
    "box { <-1, 0, -1>*K, <1, 0, 1>*K",
    "box { <-1, 0, 0>*K, <1, 0, 0>*K",
    "box { <1, 1, 1>*K, <-1, -1, -1>*K",
    "cylinder { -K*y, K*y, 0",
    "cylinder { -K*y, K*y, -K",
    "cone { -K*y, 0, K*y, 0",
    "cone { -K*y, K, K*y, K",
    "cone { -K*y, K, K*y, -K",
    "disc { 0, y, 0",
    "disc { 0, y, K, K",
    "torus { 0, K",
    "torus { K, 0",
    "torus { 0, 0",
    "torus { .3*K, K",
    "quadric { 0, 0, 0, 0",
    "quadric { 0, 0, 0, -1",
    "quadric { 0, 0, 0, 1",
    "quadric { <1, 0, 0>, 0, 0, -K*K",
    "quadric { <1, 0, 0>, 0, 0, 0",
    "quadric { 0, 0, <0, 1, 0>, 0",
    "quadric { <1, 1, 1>, 0, 0, 0",
    "quadric { <1, 1, 1>, 0, 0, K*K",
    "quadric { <1, -1, 0>, 0, 0, 0",
    "quadric { <-1, -1, -1>, 0, 0, K*K",
    "quadric { <1, 1, 1>, <2, 2, 2>, 0, -K*K",
    "triangle { 0, 0, 0",
    "triangle { -K*x, 0, K*x",
    "triangle { <-1, 0, 0>*K, <1, 0, 0>*K, <0, 1e-9, 0>*K",
    "smooth_triangle { 0, y, 0, y, 0, y",
    "smooth_triangle { <-1, 0, 0>*K, 0, <1, 0, 0>*K, 0, <0, 1, 0>*K, 0",
    "smooth_triangle { <-1, 0, 0>*K, z, <1, 0, 0>*K, -z, <0, 1, 0>*K, 0",
    "poly { 2, <0, 0, 0, 0, 0, 0, 0, 0, 0, 0>",
    "poly { 2, <0, 0, 0, 0, 0, 0, 0, 0, 0, -1>",
    "poly { 2, <0, 0, 0, 1, 0, 0, 0, 0, 0, 0>",
    "poly { 2, <1, 0, 0, 0, 0, 0, 0, 0, 0, 0>",
    "cubic { <0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1>",
    "cubic { <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0>",
    "quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, "
    "0, 2, 0, -2, 0, 0, 0, 0, 1, 0, -2, 0, 1> scale K",
    "quartic { <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, "
    "0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0>",
    "polynomial { 3, xyz(0, 0, 0): -1",
    "ovus { K, 0",
    "ovus { 0, K",
    "ovus { 0, 0",
    "ovus { K, 2*K",
    "ovus { K, K",
    "superellipsoid { <1e-3, 1e-3> scale K",
    "superellipsoid { <1, 1> scale K",
    "superellipsoid { <1e-2, 2> scale K",
    "superellipsoid { <2, 2> scale K",
    "blob { threshold .5 sphere { 0, K, 0 }",
    "blob { threshold 1 sphere { 0, K, .5 }",
    "blob { threshold .5 sphere { 0, K, .5 }",
    "blob { threshold .5 sphere { 0, 0, 1 }",
    "blob { threshold .5 sphere { 0, K, -1 }",
    "blob { threshold .5 sphere { 0, K, 1 } sphere { 0, K, -1 }",
    "blob { threshold .5 sphere { 0, K, 1 } sphere { 0, K, 1 }",
    "blob { threshold .5 sphere { 0, K, 1 } cylinder { -K*y, K*y, 1e-5*K, 1 }",
    "lathe { linear_spline 3, <0, -1>*K, <0, 0>*K, <0, 1>*K",
    "lathe { linear_spline 5, <0, -1>*K, <1, -1>*K, <1, -1>*K, <1, 1>*K, <0, 1>*K",
    "lathe { linear_spline 4, <.5, 0>*K, <1, 0>*K, <.5, 0>*K, <.5, 0>*K",
    "lathe { linear_spline 3, <0, 0>*K, <0, 0>*K, <0, 0>*K",
    "lathe { linear_spline 2, <1, 0>*K, <1, 0>*K",
    "lathe { cubic_spline 5, <1, 0>*K, <1, 0>*K, <1, 0>*K, <1, 0>*K, <1, 0>*K",
    "lathe { bezier_spline 4, <1, 0>*K, <1, 0>*K, <1, 1>*K, <1, 1>*K",
    "lathe { linear_spline 4, <1, -1>*K, <1, 1>*K, <1.00001, 1>*K, <1.00001, -1>*K",
    "lathe { linear_spline 3, <0, 0>*K, <1, 0>*K, <0, 1e-5>*K",
    "sor { 4, <.5, -1>*K, <.5, 0>*K, <.5, 1>*K, <.5, 2>*K",
    "sor { 4, <0, -1>*K, <0, 0>*K, <0, 1>*K, <0, 2>*K",
    "sor { 5, <.5, -1>*K, <0, 0>*K, <.5, 1>*K, <0, 2>*K, <.5, 3>*K",
    "sor { 4, <.5, -1>*K, <.5, 0>*K, <1e-5, 1>*K, <.5, 2>*K",
    "prism { K, K, 5, <-1, -1>*K, <1, -1>*K, <1, 1>*K, <-1, 1>*K, <-1, -1>*K",
    "prism { 0, 1e-5*K, 5, <-1, -1>*K, <1, -1>*K, <1, 1>*K, <-1, 1>*K, <-1, -1>*K",
    "prism { -K, K, 6, <-1, -1>*K, <1, -1>*K, <1, -1>*K, <1, 1>*K, <-1, 1>*K, <-1, "
    "-1>*K",
    "prism { -K, K, 4, <-1, 0>*K, <1, 0>*K, <0, 0>*K, <-1, 0>*K",
    "prism { -K, K, 4, <0, 0>*K, <0, 0>*K, <0, 0>*K, <0, 0>*K",
    "prism { -K, K, 5, <-1, -1>*K, <1, 1>*K, <1, -1>*K, <-1, 1>*K, <-1, -1>*K",
    "prism { -K, K, 5, <-1, 0>*K, <1, 0>*K, <1, 1e-5>*K, <-1, 1e-5>*K, <-1, 0>*K",
    "prism { conic_sweep 0, 1, 5, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1> scale "
    "K",
    "prism { conic_sweep -1, 1, 5, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1> "
    "scale K",
    "prism { bezier_spline -K, K, 4, <-1, 0>*K, <-1, 0>*K, <-1, 0>*K, <-1, 0>*K",
    "prism { cubic_spline -K, K, 8, <1, 0>*K, <1, 0>*K, <0, 1>*K, <0, 1>*K, <-1, "
    "0>*K, <0, -1>*K, <1, 0>*K, <1, 0>*K",
    "prism { linear_sweep linear_spline -K, K, 10, <-1, -1>*K, <1, -1>*K, <1, 1>*K, "
    "<-1, 1>*K, <-1, -1>*K, <-1, -1>*K, <1, -1>*K, <1, 1>*K, <-1, 1>*K, <-1, -1>*K",
    "mesh { triangle { 0, 0, 0 } triangle { <-1, 0, 0>*K, <1, 0, 0>*K, <0, 1, 0>*K }",
    "mesh { triangle { 0, 0, 0 }",
    "mesh2 { vertex_vectors { 3, <0,0,0>, <1,0,0>*K, <0,1,0>*K } face_indices { 2, "
    "<0,1,2>, <0,2,1> } inside_vector y",
    "polygon { 4, <0, 0, 0>, <1, 0, 0>*K, <.5, 0, 0>*K, <0, 0, 0>",
    "polygon { 3, <0, 0, 0>, <0, 0, 0>, <0, 0, 0>",
    "polygon { 6, <-1, -1, 0>*K, <1, -1, 0>*K, <1, -1, 0>*K, <1, 1, 0>*K, <-1, 1, "
    "0>*K, <-1, -1, 0>*K",
    "julia_fractal { <0, 0, 0, 0> quaternion sqr max_iteration 1 precision 20 scale K",
    "julia_fractal { <2, 2, 2, 2> quaternion sqr max_iteration 20 precision 20 scale "
    "K",
    "height_field { function 4, 4 { 0 } scale K",
    "height_field { function 4, 4 { .5 } scale K",
    "height_field { function 4, 4 { 1 } water_level 1 scale K",
    "height_field { function 2, 2 { x } scale K",
    "height_field { function 9, 9 { floor(3*x)/3 } scale <1, 1e-5, 1>*K",
    "sphere_sweep { linear_spline 2, 0, K, 0, K",
    "sphere_sweep { linear_spline 2, 0, K, <.1, 0, 0>*K, .5*K",
    "sphere_sweep { linear_spline 2, -K*x, 0, K*x, 0",
    "sphere_sweep { linear_spline 3, -K*x, .5*K, 0, 0, K*x, .5*K",
    "sphere_sweep { linear_spline 2, -K*x, 1e-5*K, K*x, 1e-5*K",
    "sphere_sweep { b_spline 4, 0, K, 0, K, 0, K, 0, K",
    "sphere_sweep { cubic_spline 4, 0, K, 0, K, <1, 0, 0>*K, K, <1, 0, 0>*K, K",
    "bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 <0,0,0>, <0,0,0>, "
    "<0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, "
    "<0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>",
    "bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 <0,0,0>, x*K, x*K, 2*x*K, "
    "<0,0,0>, x*K, x*K, 2*x*K, <0,0,0>, x*K, x*K, 2*x*K, <0,0,0>, x*K, x*K, 2*x*K",
    "bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3 <0,0,0>, <0,0,0>, "
    "<0,0,0>, <0,0,0>, <1,0,0>*K, <1,0,.3>*K, <1,0,.6>*K, <1,0,1>*K, <2,0,0>*K, "
    "<2,0,.6>*K, <2,0,1.2>*K, <2,0,2>*K, <3,0,0>*K, <3,0,1>*K, <3,0,2>*K, <3,0,3>*K",
    "bicubic_patch { type 0 flatness 0 u_steps 3 v_steps 3 <0,0,0>, <0,0,0>, "
    "<0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, <1,0,0>*K, <1,0,0>*K, "
    "<1,0,1>*K, <1,0,1>*K, <1,0,0>*K, <1,0,0>*K, <1,0,1>*K, <1,0,1>*K",
    "isosurface { function { 1 } scale K",
    "isosurface { function { -1 } scale K",
    "isosurface { function { 0 } scale K",
    "isosurface { function { x } scale K",
    "isosurface { function { x*x } scale K",
    "isosurface { function { x*x + y*y + z*z } scale K",
    "isosurface { function { -x*x } scale K",
    "isosurface { function { abs(x) - 1e-5 } scale K",
    "isosurface { function { x/y } scale K",
    "isosurface { function { sqrt(x) - .5 } scale K",
    "isosurface { function { x*x + y*y + z*z - 1 } contained_by { sphere { 0, 1 } } "
    "scale K",
    "isosurface { function { x - 1 } scale K",
    "isosurface { function { x + 1 } scale K",
    "parametric { function { 0 } function { 0 } function { 0 } <0, 0>, <1, 1> scale K",
    "parametric { function { u } function { 0 } function { 0 } <0, 0>, <1, 1> scale K",
    "parametric { function { u } function { v } function { 0 } <0, 0>, <0, 0> scale K",
    "parametric { function { u*cos(v) } function { u*sin(v) } function { 0 } <0, 0>, "
    "<1, 6.283185> scale K",
    "text { ttf FONT \"\" .3, 0 scale K",
    "text { ttf FONT \" \" .3, 0 scale K",
    "text { ttf FONT \"o\" 0, 0 scale K",
    "text { ttf FONT \"o\" 1e-5, 0 scale K",
};

enum {
    SAMPLES = sizeof samples / sizeof samples[0],
    DEGENERATE = sizeof degenerate / sizeof degenerate[0],
};

#endif
