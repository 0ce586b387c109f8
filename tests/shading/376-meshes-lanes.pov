// Meshes whose points and normals are found eight at a time: flat, smooth, with faces of
// both kinds, moved, cut, few pixels of each and beside others.
// size: 8 6
// tol: abs 2e-4 rel 5e-4
// expect: 2 0 0.208087 0.415702 0.554116
// expect: 4 0 0.533303 0.380926 0.228550
// expect: 0 1 0.556146 0.397803 0.239445
// expect: 2 1 0.214878 0.429755 0.573007
// expect: 4 1 0.476493 0.340352 0.204211
// expect: 5 1 0.499443 0.356985 0.214527
// expect: 6 1 0.475364 0.475364 0.237675
// expect: 7 1 0.634882 0.634882 0.328634
// expect: 0 3 0.413153 0.295109 0.177066
// expect: 1 3 0.552056 0.394324 0.236606
// expect: 2 3 0.459586 0.328283 0.196963
// expect: 0 4 0.285115 0.203647 0.122194
// expect: 1 4 0.456352 0.325963 0.195575
// expect: 2 4 0.442618 0.316167 0.189700
// expect: 3 4 0.493080 0.352209 0.211322
// expect: 5 4 0.104295 0.208591 0.130373
// expect: 6 4 0.202075 0.144335 0.086595
// expect: 7 4 0.501015 0.357900 0.214786
// expect: 0 5 0.161425 0.115297 0.069184
// expect: 1 5 0.294804 0.210575 0.126345
// expect: 3 5 0.375784 0.268406 0.161044
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 0, -12> look_at 0 angle 40 right x*4/3 }
light_source { <5, 9, -12>, rgb 1 }
light_source { <-8, 3, -9>, rgb 0.4 shadowless }
background { rgb 0.2 }
#default { pigment { rgb <0.7, 0.5, 0.3> } finish { phong 0.4 phong_size 30 diffuse 0.6 } }
#declare Flat = mesh {
  triangle { <-1, -1, 0>, <1, -1, 0.4>, <0.2, 1, 0.3> }
  triangle { <-1, -1, 0>, <0.2, 1, 0.3>, <-1.1, 0.8, -0.5> }
}
#declare Both = mesh {
  smooth_triangle { <-1, -1, 0>, <-1, -1, -2>, <1, -1, 0>, <1, -1, -2>, <0, 1, 0>, <0, 1, -2> }
  triangle { <-1, -1, 0>, <0, 1, 0>, <-1.3, 1, -0.6> }
}
#declare Smooth = mesh2 {
  vertex_vectors { 4, <-1, -1, 0>, <1, -1, 0.2>, <1, 1, 0>, <-1, 1, -0.3> }
  normal_vectors { 4, <-1, -1, -1.5>, <1, -1, -1.5>, <1, 1, -1.5>, <-1, 1, -1.5> }
  face_indices { 2, <0, 1, 2>, <0, 2, 3> }
}
object { Flat translate <-3.6, 1.7, 0> }
object { Both translate <-1.2, 1.7, 0> pigment { rgb <0.3, 0.6, 0.8> } }
object { Smooth translate <1.2, 1.7, 0> }
object { Flat rotate 10*y translate <3.6, 1.7, 0> pigment { rgb <0.8, 0.8, 0.4> } }
object { Smooth scale <1, 1.2, 0.7> rotate <0, 25, 8> translate <-3.4, -1.6, 0> }
object { Both scale <1, 1.2, 0.7> rotate <0, 12, -10> translate <-0.9, -1.6, 0> }
difference {
  mesh {
    triangle { <-1, -1, 0>, <1, -1, 0>, <0, 1, 0> } triangle { <-1, -1, 0>, <1, -1, 0>, <0, 0, 1.5> }
    triangle { <1, -1, 0>, <0, 1, 0>, <0, 0, 1.5> } triangle { <0, 1, 0>, <-1, -1, 0>, <0, 0, 1.5> }
    inside_vector <0.2, 0.3, 1>
  }
  sphere { <0, -0.4, -0.2>, 0.7 }
  rotate 15*y translate <1.6, -1.5, 0> pigment { rgb <0.4, 0.8, 0.5> }
}
sphere { <3.6, -1.6, 0>, 0.9 }
