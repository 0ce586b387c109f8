// expect: 0 0 0.456580 0.385595 0.930068
// expect: 1 0 0.499351 0.394110 0.934874
// expect: 2 0 0.537331 0.383124 0.931914
// expect: 3 0 0.577646 0.349142 0.918608
// expect: 0 1 0.456580 0.385595 0.930068
// expect: 1 1 0.499351 0.394110 0.934874
// expect: 2 1 0.537331 0.383124 0.931914
// expect: 3 1 0.577646 0.349142 0.918608
// expect: 0 2 0.625223 0.291951 0.885145
// expect: 1 2 0.676066 0.221515 0.818463
// expect: 2 2 0.717082 0.161410 0.719081
// expect: 3 2 0.741680 0.132143 0.612451
// expect: 0 3 0.755505 0.130663 0.526101
// expect: 1 3 0.765316 0.142107 0.466194
// expect: 2 3 0.774105 0.156909 0.426596
// expect: 3 3 0.782681 0.171450 0.400397
// size: 4 4
// tol: abs 2e-4 rel 6e-4
// about: mesh_camera, distribution 0: meshes that turn normals alike, each after the other, and in ways of their own.
#version 3.7;
global_settings { assumed_gamma 1.0 }
sky_sphere { pigment { average pigment_map {
    [1 function{(x+1)/2} color_map{[0 rgb 0][1 rgb <3,0,0>]}]
    [1 function{(y+1)/2} color_map{[0 rgb 0][1 rgb <0,3,0>]}]
    [1 function{(z+1)/2} color_map{[0 rgb 0][1 rgb <0,0,3>]}] } } }
#declare Faces = mesh { #for(i, 0, 15) triangle { <i, 0, .1*i>, <i + .2, 1, .03*i*i>, <i + 1, .1*i, .2> } #end }
#declare Turn = transform { rotate <10, 25, -40> scale <1, 1.3, .8> }
camera { mesh_camera { 5 0
  mesh { Faces }
  mesh { Faces translate 30*y }
  mesh { Faces transform { Turn } }
  mesh { Faces transform { Turn } translate <5, 60, 0> }
  mesh { Faces rotate 70*x } } location 0 }
