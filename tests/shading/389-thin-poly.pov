// expect: 19 16 0.07471 0.14941 0.29883
// expect: 30 28 0.07056 0.14111 0.28223
// expect: 24 33 0.06976 0.13953 0.27905
// expect: 28 33 0.06946 0.13892 0.27783
// expect: 17 15 0.07526 0.15051 0.30103
// tol: abs 1e-5 rel 2e-3
// size: 40 40
// about: A body that is thin by 1e-5, part of a merge: its lit side, here that of a disc, lies in no shadow of its own.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <-1.17, 1.27, -9> right x look_at <.3, -.5, 0> angle 16 }
light_source { <4, 6, -5>, rgb 1 }
light_source { <-6, 3, -2>, rgb .4 }
background { rgb <.2, .3, .4> }
merge {
  sphere { 5, .01 }
  poly { 2, <1, 0, 0, 0, 1e10, 0, 0, 1, 0, -1> scale <1.098, .447, 1.105> rotate <303.8, 256, 179.6> translate <.64, -.195, -.431> }
  scale <1.063, .708, .642> rotate <153.2, 117.7, 273> translate <.044, -.976, .243>
  pigment { rgb <.25, .5, 1> } finish { ambient .1 diffuse .7 }
}
