// expect: 0 0 0.203128 0.828122 0.968750
// expect: 1 0 0.234379 0.828122 0.968750
// expect: 2 0 0.265629 0.828122 0.968750
// expect: 3 0 0.296880 0.828122 0.968750
// expect: 0 1 0.203128 0.828122 0.968750
// expect: 1 1 0.234379 0.828122 0.968750
// expect: 2 1 0.265629 0.828122 0.968750
// expect: 3 1 0.296880 0.828122 0.968750
// expect: 0 2 0.328130 0.828122 0.968750
// expect: 1 2 0.359380 0.828122 0.968750
// expect: 2 2 0.515618 0.515618 0.968750
// expect: 3 2 0.546868 0.515618 0.968750
// expect: 0 3 0.578119 0.515618 0.968750
// expect: 1 3 0.609369 0.515618 0.968750
// expect: 2 3 0.640620 0.515618 0.968750
// expect: 3 3 0.671870 0.515618 0.968750
// size: 4 4
// tol: abs 2e-4 rel 6e-4
// about: mesh_camera, distribution 1: the faces of all meshes in one list.
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
camera { mesh_camera { 1 1 Faces(-2, 2, 6) Faces(0, 0, 8) } location 0 }
