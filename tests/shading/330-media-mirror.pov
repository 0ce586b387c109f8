// expect: 0 0 0.339086 0.315175 0.291264
// expect: 1 0 0.146654 0.135988 0.125322
// expect: 2 0 0.389364 0.360418 0.331487
// expect: 3 0 0.399786 0.369802 0.339834
// expect: 4 0 0.157366 0.145617 0.133883
// expect: 0 1 0.334524 0.311070 0.287617
// expect: 1 1 0.144137 0.133730 0.123308
// expect: 2 1 0.722225 0.512291 0.370535
// expect: 3 1 0.390921 0.361822 0.332738
// expect: 4 1 0.154025 0.142626 0.131228
// expect: 0 2 0.129397 0.120455 0.111513
// expect: 1 2 0.345510 0.320958 0.296407
// expect: 2 2 0.486015 0.293706 0.169574
// expect: 3 2 0.148257 0.137438 0.126604
// expect: 4 2 0.365911 0.339330 0.312734
// expect: 0 3 0.142321 0.131899 0.121462
// expect: 1 3 0.302739 0.280461 0.258183
// expect: 2 3 0.247349 0.188983 0.147890
// expect: 3 3 0.165942 0.153155 0.140352
// expect: 4 3 0.326299 0.301671 0.277043
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A medium in a mirror and in the picture.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb <1,.9,.8> }
plane { y,-1.5 pigment { rgb .1 } finish { reflection .7 } }sphere { 0, 1.2 hollow pigment { rgbt 1 } interior { media { emission <.3,.2,.1> density { spherical color_map { [0 rgb 0][1 rgb <1,.7,.4>] } scale 1.8 } } } }
