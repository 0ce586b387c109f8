// expect: 0 0 0.000000 0.000000 0.000000
// expect: 1 0 0.592285 0.592285 0.592285
// expect: 2 0 0.494629 0.000000 0.000000
// expect: 3 0 0.000000 0.000000 0.000000
// expect: 4 0 0.000000 0.000000 0.000000
// expect: 5 0 0.584473 0.584473 0.584473
// expect: 6 0 0.498047 0.498047 0.498047
// expect: 7 0 0.000000 0.000000 0.000000
// expect: 0 1 0.526855 0.000000 0.000000
// expect: 1 1 0.690430 0.690430 0.690430
// expect: 2 1 0.590332 0.000000 0.000000
// expect: 3 1 0.246704 0.246704 0.246704
// expect: 4 1 0.602051 0.602051 0.602051
// expect: 5 1 0.692383 0.692383 0.692383
// expect: 6 1 0.573730 0.573730 0.573730
// expect: 7 1 0.151855 0.151855 0.151855
// expect: 0 2 0.368652 0.000000 0.000000
// expect: 1 2 0.525391 0.525391 0.525391
// expect: 2 2 0.429688 0.000000 0.000000
// expect: 3 2 0.099976 0.099976 0.099976
// expect: 4 2 0.442627 0.442627 0.442627
// expect: 5 2 0.538086 0.538086 0.538086
// expect: 6 2 0.423096 0.423096 0.423096
// expect: 7 2 0.099976 0.099976 0.099976
// expect: 0 3 0.000000 0.000000 0.000000
// expect: 1 3 0.128418 0.128418 0.128418
// expect: 2 3 0.099976 0.000000 0.000000
// expect: 3 3 0.000000 0.000000 0.000000
// expect: 4 3 0.000000 0.000000 0.000000
// expect: 5 3 0.149048 0.149048 0.149048
// expect: 6 3 0.099976 0.099976 0.099976
// expect: 7 3 0.000000 0.000000 0.000000
// expect: 0 4 0.000000 0.000000 0.000000
// expect: 1 4 0.351318 0.198120 0.042145
// expect: 2 4 0.334473 0.208862 0.083130
// expect: 3 4 0.000000 0.000000 0.000000
// expect: 4 4 0.000000 0.000000 0.000000
// expect: 5 4 0.000000 0.000000 0.000000
// expect: 6 4 0.000000 0.000000 0.000000
// expect: 7 4 0.000000 0.000000 0.000000
// expect: 0 5 0.608887 0.516602 0.403320
// expect: 1 5 0.138184 0.079895 0.020996
// expect: 2 5 0.163330 0.106445 0.048737
// expect: 3 5 0.467529 0.367432 0.248779
// expect: 4 5 0.000000 0.000000 0.000000
// expect: 5 5 0.000000 0.605957 0.121216
// expect: 6 5 0.000000 0.458008 0.091614
// expect: 7 5 0.000000 0.000000 0.000000
// expect: 0 6 0.509766 0.495117 0.476318
// expect: 1 6 0.094910 0.082703 0.068115
// expect: 2 6 0.093384 0.075562 0.053925
// expect: 3 6 0.062866 0.032898 0.002886
// expect: 4 6 0.000000 0.000000 0.000000
// expect: 5 6 0.000000 0.509277 0.101868
// expect: 6 6 0.000000 0.331299 0.066284
// expect: 7 6 0.000000 0.000000 0.000000
// expect: 0 7 0.000000 0.000000 0.000000
// expect: 1 7 0.094238 0.074341 0.050232
// expect: 2 7 0.074646 0.046844 0.018982
// expect: 3 7 0.000000 0.000000 0.000000
// expect: 4 7 0.000000 0.000000 0.000000
// expect: 5 7 0.000000 0.209106 0.041809
// expect: 6 7 0.000000 0.000000 0.000000
// expect: 7 7 0.000000 0.000000 0.000000
// size: 8 8
// tol: abs 0.0002 rel 0.0006
// about: images read and mapped as POV-Ray does (types, map_type, interpolate, once, offset, gamma).
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -z*5 right 2*x up 2*y direction z }
light_source { <-2,3,-5> 1 }
sphere { <-.5,.5,0>, .45 texture { material_map { gif "palette.gif" texture { pigment { rgb 1 } } texture { pigment { rgb x } } texture { pigment { checker } scale .1 } } scale .5 } }
sphere { <.5,.5,0>, .45 pigment { rgb 1 } normal { bump_map { function 20,20 { sin(x*10)*.5+.5 } interpolate 2 } scale .6 } }
sphere { <-.5,-.5,0>, .45 pigment { image_map { function 30,20 { pigment { agate scale .3 } } interpolate 4 } } normal { bump_map { png "palette8.png" use_index bump_size .7 } scale .6 } }
sphere { <.5,-.5,0>, .45 pigment { image_map { exr "photo.exr" } } normal { average normal_map { [ bump_map { png "palette8.png" use_color bump_size .7 } scale .6 ] [1 bumps scale .1] } } }
