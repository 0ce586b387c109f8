// expect: 0 0 0.281849 0.523995 0.581247
// expect: 1 0 0.521660 0.925841 0.968750
// expect: 2 0 0.601785 0.419974 0.968750
// expect: 3 0 0.641474 0.071870 0.968750
// expect: 0 1 0.299153 0.495857 0.581247
// expect: 1 1 0.527092 0.850782 0.968750
// expect: 2 1 0.604410 0.734569 0.968750
// expect: 3 1 0.644450 0.582757 0.968750
// expect: 0 2 0.334340 0.439658 0.581247
// expect: 1 2 0.569177 0.736202 0.968750
// expect: 2 2 0.609140 0.771496 0.968750
// expect: 3 2 0.649134 0.812207 0.968750
// expect: 0 3 0.370748 0.383352 0.581247
// expect: 1 3 0.630228 0.640131 0.968750
// expect: 2 3 0.641581 0.643076 0.968750
// expect: 3 3 0.655070 0.653864 0.968750
// expect: 0 4 0.408820 0.326574 0.581247
// expect: 1 4 0.693492 0.543542 0.968750
// expect: 2 4 0.704280 0.543313 0.968750
// expect: 3 4 0.708156 0.543511 0.968750
// size: 4 5
// options: +A0.0 +AM1 +R2 -J
// tol: abs 2e-4 rel 6e-4
// about: mesh_camera, distribution 3: faces by uv, smooth, in a transformed mesh, with a camera normal and anti-aliasing.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare PosTex = texture {
  pigment { average pigment_map {
    [1 function{(x/3.2+1)/2} color_map{[0 rgb 0][1 rgb <3,0,0>]}]
    [1 function{(y/3.2+1)/2} color_map{[0 rgb 0][1 rgb <0,3,0>]}]
    [1 function{(z/3.2+1)/2} color_map{[0 rgb 0][1 rgb <0,0,3>]}] } }
  finish { ambient 0 diffuse 0 emission 1 } }
plane { z, 3 hollow texture { PosTex } }
camera { mesh_camera { 1 3 mesh {
  smooth_triangle { <-1,-1,0>, <.3,0,1>, <-1,1,0>, <0,.2,1>, <1,-1,0>, <0,0,1> uv_vectors <0,0>, <0,1>, <1,0> }
  smooth_triangle { <1,1,0>, <0,.4,1>, <1,-1,0>, <0,0,1>, <-1,1,0>, <0,.2,1>  uv_vectors <1,1>, <1,0>, <0,1> } rotate y*10 scale <1,.8,2> } smooth }
  location <0, 0, .1> normal { bumps .3 scale .2 } }
