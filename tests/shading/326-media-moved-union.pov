// expect: 0 0 0.339086 0.315175 0.291264
// expect: 1 0 0.146654 0.135988 0.125322
// expect: 3 0 0.399786 0.369802 0.339834
// expect: 4 0 0.157366 0.145617 0.133883
// expect: 0 1 0.334524 0.311070 0.287617
// expect: 1 1 0.144137 0.133730 0.123308
// expect: 2 1 0.746227 0.718090 0.689952
// expect: 3 1 0.485893 0.456809 0.427710
// expect: 4 1 0.154025 0.142626 0.131228
// expect: 0 2 0.129397 0.120455 0.111513
// expect: 1 2 0.345510 0.320958 0.296407
// expect: 2 2 0.322042 0.311528 0.301015
// expect: 3 2 0.158434 0.147601 0.136782
// expect: 4 2 0.365911 0.339330 0.312734
// expect: 0 3 0.123400 0.115053 0.106722
// expect: 1 3 0.100008 0.100008 0.100008
// expect: 2 3 0.135744 0.126177 0.116594
// expect: 4 3 0.341634 0.317479 0.293309
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A medium of a part of a union moves with the union.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb <1,.9,.8> }
union { sphere { 0, 1 hollow pigment { rgbt 1 } interior { media { emission .5 density { boxed color_map { [0 rgb 0][1 rgb 1] } } } } } cylinder { -y*2, y*2, .2 pigment { rgb x } } rotate z*30 scale <1,1.4,1> translate <.5,.2,0> }
