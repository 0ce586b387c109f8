// expect: 0 0 0.232609 0.232609 0.371801
// expect: 1 0 0.442512 0.442512 0.089296
// expect: 2 0 0.136721 0.480339 0.126558
// expect: 3 0 0.387182 0.387182 0.083467
// expect: 4 0 0.162432 0.457832 0.123354
// expect: 5 0 0.442512 0.442512 0.089296
// expect: 6 0 0.174701 0.174701 0.446067
// expect: 7 0 0.442512 0.442512 0.089296
// expect: 8 0 0.130510 0.485771 0.127337
// expect: 9 0 0.387182 0.387182 0.083467
// expect: 10 0 0.174487 0.174487 0.360967
// expect: 11 0 0.442512 0.442512 0.089296
// expect: 12 0 0.358572 0.358572 0.190265
// expect: 13 0 0.442512 0.442512 0.089296
// expect: 14 0 0.179904 0.179904 0.352895
// expect: 15 0 0.387182 0.387182 0.083467
// expect: 0 1 0.087709 0.523217 0.132692
// expect: 1 1 0.442512 0.442512 0.089296
// expect: 2 1 0.146075 0.472160 0.125399
// expect: 3 1 0.387182 0.387182 0.083467
// expect: 4 1 0.119265 0.119265 0.427726
// expect: 5 1 0.442512 0.442512 0.089296
// expect: 6 1 0.220310 0.220310 0.381308
// expect: 7 1 0.442512 0.442512 0.089296
// expect: 8 1 0.162921 0.162921 0.372061
// expect: 9 1 0.387182 0.387182 0.083467
// expect: 10 1 0.148379 0.148379 0.392340
// expect: 11 1 0.442512 0.442512 0.089296
// expect: 12 1 0.121218 0.493904 0.128496
// expect: 13 1 0.442512 0.442512 0.089296
// expect: 14 1 0.243656 0.243656 0.269673
// expect: 15 1 0.387182 0.387182 0.083467
// expect: 0 2 0.676020 0.000000 0.000000
// expect: 1 2 0.598062 0.000000 0.077958
// expect: 2 2 0.303517 0.303517 0.303517
// expect: 3 2 0.532677 0.532677 0.532677
// expect: 4 2 0.408133 0.408133 0.408133
// expect: 5 2 0.481666 0.481666 0.481666
// expect: 6 2 0.132509 0.000000 0.334981
// expect: 7 2 0.213031 0.000000 0.431815
// expect: 8 2 0.000000 0.000000 0.510170
// expect: 9 2 0.000000 0.000000 0.602090
// expect: 10 2 0.322133 0.000000 0.188037
// expect: 11 2 0.380163 0.000000 0.221927
// expect: 12 2 0.256062 0.344915 0.104219
// expect: 13 2 0.526848 0.159335 0.082673
// expect: 14 2 0.510170 0.000000 0.000000
// expect: 15 2 0.602090 0.000000 0.000000
// expect: 0 3 0.676020 0.000000 0.000000
// expect: 1 3 0.676020 0.000000 0.000000
// expect: 2 3 0.233097 0.233097 0.233097
// expect: 3 3 0.290929 0.290929 0.290929
// expect: 4 3 0.285573 0.285573 0.285573
// expect: 5 3 0.359121 0.359121 0.359121
// expect: 6 3 0.286839 0.000000 0.131289
// expect: 7 3 0.259083 0.000000 0.142809
// expect: 8 3 0.285573 0.000000 0.071397
// expect: 9 3 0.359121 0.000000 0.089784
// expect: 10 3 0.226062 0.000000 0.130907
// expect: 11 3 0.283436 0.000000 0.165454
// expect: 12 3 0.044617 0.312398 0.078569
// expect: 13 3 0.173785 0.180102 0.316945
// expect: 14 3 0.000000 0.000000 0.356970
// expect: 15 3 0.000000 0.000000 0.448890
// expect: 0 4 0.126894 0.101518 0.038071
// expect: 1 4 0.037079 0.029664 0.011124
// expect: 2 4 0.000000 0.379049 0.736370
// expect: 3 4 0.000000 0.739117 0.192508
// expect: 4 4 0.198947 0.198947 0.198947
// expect: 5 4 0.016983 0.016983 0.016983
// expect: 6 4 0.030884 0.030884 0.030884
// expect: 7 4 0.118364 0.118364 0.118364
// expect: 8 4 0.225345 0.225345 0.225345
// expect: 9 4 0.240940 0.240940 0.240940
// expect: 10 4 0.540810 0.540810 0.540810
// expect: 11 4 0.270878 0.270878 0.270878
// expect: 12 4 0.154421 0.154421 0.154421
// expect: 13 4 0.262043 0.262043 0.262043
// expect: 14 4 0.123568 0.000000 0.386603
// expect: 15 4 0.235630 0.000000 0.366445
// expect: 0 5 0.199603 0.159670 0.059876
// expect: 1 5 0.289830 0.231861 0.086946
// expect: 2 5 0.000000 0.494759 0.620661
// expect: 3 5 0.000000 0.616144 0.499290
// expect: 4 5 0.216907 0.216907 0.216907
// expect: 5 5 0.123339 0.123339 0.123339
// expect: 6 5 0.015793 0.015793 0.015793
// expect: 7 5 0.013596 0.013596 0.013596
// expect: 8 5 0.225345 0.225345 0.225345
// expect: 9 5 0.225345 0.225345 0.225345
// expect: 10 5 0.540810 0.540810 0.540810
// expect: 11 5 0.540810 0.540810 0.540810
// expect: 12 5 0.078935 0.078935 0.078935
// expect: 13 5 0.046784 0.046784 0.046784
// expect: 14 5 0.234638 0.000000 0.122347
// expect: 15 5 0.128267 0.000000 0.320623
// size: 16 6
// tol: abs 0.0008 rel 0.002
// about: functions of pigments and patterns, and pigment_pattern as colours and normals.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -z*10 right 8*x up 3*y direction z }
light_source { <3, 5, -20>, rgb 1 parallel point_at <0, 0, 0> }
#declare F = finish { ambient .1 diffuse .6 };
#declare Ramp = color_map { [0 rgb <.9,.1,.1>] [.3 rgb <.1,.8,.2>] [.3 rgbt <.2,.2,.9,.3>] [.8 rgbf <.9,.9,.2,.4>] [1 rgb .5] };
#declare P1 = function { pigment { bozo color_map { Ramp } turbulence .4 scale .6 } }
#declare P2 = function { pigment { gradient x pigment_map { [.3 granite scale .3] [.7 rgb <.2, .8, .4>] } } }
#declare P3 = function { pigment { image_map { png "rgb16.png" once } translate .2 } }
#declare P4 = function { pigment { average pigment_map { [1 image_map { png "rgb16.png" once }] [2 rgbt <1, .5, .2, .5>] } } }
#declare Q = function { pattern { agate turbulence .3 scale .4 } }
#macro Put(I, J, T) object { box { <-.48, -.48, 0>, <.48, .48, .5> } texture { T } translate <I - 3.5, J - 1, 0> } #end
#macro Ball(I, J, T) object { sphere { 0, .47 } texture { T } translate <I - 3.5, J - 1, 0> } #end
Put(0, 0, texture { pigment { function { pow(P1(x, y, z).x, 1.7) } color_map { [0 rgb 0] [1 rgb <1, .8, .3>] } } finish { F } })
Put(1, 0, texture { pigment { average pigment_map { [function { P1(x, y, z).y } color_map { [0 rgb 0] [1 rgb 3*y] }] [function { P1(x, y, z).z } color_map { [0 rgb 0] [1 rgb 3*z] }] } } finish { F } })
Put(2, 0, texture { pigment { function { P1(x, y, z).transmit + P1(x*2, y, z).filter / 2 } } finish { F } })
Ball(3, 0, texture { pigment { function { P2(x, y, z).red * Q(x, y, z) } } finish { F } })
Put(4, 0, texture { pigment { function { P3(x, y, z).blue + P3(x, y, z).transmit / 3 } } finish { F } })
Put(5, 0, texture { pigment { function { P4(x, y, z).green + P4(x, y, z).transmit / 5 } } finish { F } })
Ball(6, 0, texture { pigment { function { Q(x, y, z) } } finish { F } })
Ball(7, 0, texture { pigment { pigment_pattern { wood color_map { Ramp } turbulence .2 scale .3 } color_map { [0 rgb x] [1 rgb z] } } finish { F } })
Put(0, 1, texture { pigment { pigment_pattern { image_map { png "rgb16.png" once } } color_map { [0 rgb x] [1 rgb z] } } finish { F } })
Ball(1, 1, texture { pigment { rgb .8 } normal { pigment_pattern { granite color_map { Ramp } scale .6 } .5 } finish { F phong .4 } })
Ball(2, 1, texture { pigment { rgb .8 } normal { pigment_pattern { slope y color_map { Ramp } } .5 } finish { F } })
Ball(3, 1, texture { pigment { pigment_pattern { slope { y } color_map { [0 rgb 0] [1 rgb 1] } } color_map { [0 rgb x] [1 rgb z] } } normal { bumps .5 scale .2 } finish { F } })
sphere { 0, .47 uv_mapping texture { pigment { pigment_pattern { uv_mapping checker rgb 1, rgb .2 scale .1 } color_map { [0 rgb x] [1 rgb z] } } finish { F } } translate <.5, 0, 0> }
Ball(5, 1, texture { pigment { pigment_pattern { pigment_pattern { bozo scale .2 } color_map { Ramp } } triangle_wave frequency 2 color_map { [0 rgb x] [1 rgb z] } } finish { F } })
Put(6, 1, texture { pigment { function { pow(P1(x, y, z).x, 1.7) } color_map { Ramp } } normal { function { Q(x, y, z) } .3 } finish { F } })
Ball(7, 1, texture { pigment_pattern { gradient y color_map { [0 rgb 0] [1 rgb 1] } } texture_map { [.4 pigment { rgb x } finish { F }] [.6 pigment { rgb z } finish { F phong .4 }] } })
plane { z, 1 texture { pigment { function { P2(x, y, z).green } color_map { Ramp } } finish { F } } }
plane { z, 2 pigment { checker rgb .2, rgb .7 scale .3 } finish { F } }
