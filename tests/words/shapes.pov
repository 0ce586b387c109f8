#version 3.7;
global_settings { assumed_gamma 1 }
bicubic_patch { type 1 flatness 0.01 u_steps 3 v_steps 3,
  <0,0,0>, x, 2*x, 3*x, y, x+y, 2*x+y, 3*x+y, 2*y, x+2*y, 2*x+2*y, 3*x+2*y, 3*y, x+3*y, 2*x+3*y, 3*x+3*y }
composite { sphere { 0, 1 } box { 0, 1 } }
cubic { <1,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,-1> sturm }
isosurface { function { x*x + y*y + z*z - 1 } contained_by { box { -2, 2 } } threshold 0 accuracy 0.01 max_gradient 4 max_trace 2 open }
isosurface { function { x + y } contained_by { sphere { 0, 2 } } all_intersections evaluate 1, 2, 0.7 }
julia_fractal { <-0.083, 0, -0.83, -0.025> quaternion sqr max_iteration 8 precision 15 slice <0, 0, 0, 1>, 0 }
julia_fractal { <-0.083, 0, -0.83, -0.025> hypercomplex cube max_iteration 4 }
julia_fractal { <-0.083, 0, -0.83, -0.025> hypercomplex reciprocal }
julia_fractal { <-0.083, 0, -0.83, -0.025> hypercomplex pwr (2, 0) }
lathe { linear_spline 3, <0, 0>, <1, 1>, <0, 2> }
lathe { quadratic_spline 4, <0, 0>, <1, 1>, <1, 2>, <0, 3> }
lathe { cubic_spline 5, <0, 0>, <1, 1>, <1, 2>, <1, 3>, <0, 4> }
lathe { bezier_spline 4, <0, 0>, <1, 1>, <1, 2>, <0, 3> sturm }
ovus { 2, 1 }
parametric { function { u }, function { v }, function { u * v } <0, 0>, <1, 1> contained_by { box { -1, 2 } } max_gradient 2 accuracy 0.01 precompute 5 x, y, z }
poly { 2, <1, 0, 0, 0, 1, 0, 0, 1, 0, -1> }
polygon { 4, <0, 0>, <1, 0>, <1, 1>, <0, 0> }
prism { linear_sweep linear_spline 0, 1, 4, <0, 0>, <1, 0>, <1, 1>, <0, 0> }
prism { bezier_spline 0, 1, 4, <0, 0>, <1, 0>, <1, 1>, <0, 0> open }
quadric { <1, 1, 1>, <0, 0, 0>, <0, 0, 0>, -1 }
quartic { <1,0,0,0,0, 0,0,0,0,0, 0,0,0,0,0, 0,0,0,0,0, 1,0,0,0,0, 0,0,0,0,0, 1,0,0,0,-1> }
smooth_triangle { 0, z, x, z, y, z }
sor { 4, <0.5, -1>, <0.5, 0>, <1, 1>, <0.5, 2> open }
sphere_sweep { linear_spline 2, 0, 1, x, 0.5 tolerance 0.001 }
sphere_sweep { cubic_spline 4, 0, 1, x, 0.5, 2*x, 1, 3*x, 1 }
sphere_sweep { b_spline 4, 0, 1, x, 0.5, 2*x, 1, 3*x, 1 }
superellipsoid { <0.5, 0.5> }
text { ttf "timrom.ttf" "A" 1, 0 }
text { internal 1 "A" 1, 0 }
torus { 2, 0.5 }
triangle { 0, x, y }
disc { 0, y, 1, 0.5 }
polynomial { 2, xyz(2, 0, 0): 1, xyz(0, 0, 0): -1 }
mesh { triangle { 0, x, y uv_vectors <0,0>, <1,0>, <0,1> } smooth_triangle { 0, z, x, z, y, z } inside_vector z hierarchy }
#declare T = texture { pigment { rgb 1 } }
mesh { triangle { 0, x, y texture_list { T, T, T } } }
mesh2 { vertex_vectors { 3, 0, x, y } normal_vectors { 3, z, z, z } uv_vectors { 3, <0,0>, <1,0>, <0,1> }
  texture_list { 1, texture { T } } face_indices { 1, <0, 1, 2>, 0 } uv_indices { 1, <0, 1, 2> } normal_indices { 1, <0, 1, 2> } inside_vector z }
height_field { function 8, 8 { x * y } water_level 0.1 smooth }
