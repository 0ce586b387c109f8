// expect: 0 0 0.203128 0.828122 0.968750
// expect: 1 0 0.234379 0.828122 0.968750
// expect: 2 0 0.265629 0.828122 0.968750
// expect: 3 0 0.296880 0.828122 0.968750
// expect: 0 1 0.203128 0.828122 0.968750
// expect: 1 1 0.234379 0.828122 0.968750
// expect: 2 1 0.265629 0.828122 0.968750
// expect: 3 1 0.296880 0.828122 0.968750
// expect: 0 2 0.328130 0.828122 0.968750
// expect: 1 2 0.300008 0.300008 0.300008
// expect: 2 2 0.203128 0.796872 0.968750
// expect: 3 2 0.234379 0.796872 0.968750
// expect: 0 3 0.265629 0.796872 0.968750
// expect: 1 3 0.296880 0.796872 0.968750
// expect: 2 3 0.328130 0.796872 0.968750
// expect: 3 3 0.300008 0.300008 0.300008
// size: 4 4
// tol: abs 2e-4 rel 6e-4
// about: mesh_camera with a largest distance, which holds for rays from the camera alone.
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare PosTex = texture {
  pigment { average pigment_map {
    [1 function{(x/3.2+1)/2} color_map{[0 rgb 0][1 rgb <3,0,0>]}]
    [1 function{(y/3.2+1)/2} color_map{[0 rgb 0][1 rgb <0,3,0>]}]
    [1 function{(z/3.2+1)/2} color_map{[0 rgb 0][1 rgb <0,0,3>]}] } }
  finish { ambient 0 diffuse 0 emission 1 } }
plane { z, 3 hollow texture { PosTex } }
#macro Faces(X, Y, N) mesh { #for(i, 0, N - 1) triangle { <X + .2*mod(i, 6), Y - .2*div(i, 6), 0>, <X + .2*mod(i, 6), Y + .3 - .2*div(i, 6), 0>, <X + .3 + .2*mod(i, 6), Y - .2*div(i, 6), 0> } #end } #end
camera { mesh_camera { 1 0 2.7 Faces(-2, 2, 16) } location 0 direction -z }
plane { -z, 2.5 clipped_by { plane { <1, .2, 0>, -.6 } } hollow pigment { rgb 2 } finish { ambient 0 diffuse 0 reflection 1 } }
plane { z, 4 pigment { rgb .9 } finish { emission 1 } }
plane { z, -4 pigment { rgb .7 } finish { emission 1 } }
background { rgb .3 }
