// expect: 0 0 0.220340 0.220340 0.416938
// expect: 1 0 0.188846 0.188846 0.448417
// expect: 2 0 0.233677 0.233677 0.403586
// expect: 3 0 0.310002 0.310002 0.327260
// expect: 4 0 0.180514 0.180514 0.456748
// expect: 5 0 0.405371 0.405371 0.231891
// expect: 6 0 0.240192 0.240192 0.397086
// expect: 7 0 0.150546 0.401648 0.158618
// expect: 8 0 0.157336 0.395712 0.157763
// expect: 9 0 0.359503 0.359503 0.277760
// expect: 10 0 0.224628 0.224628 0.412650
// expect: 11 0 0.383993 0.383993 0.253285
// expect: 12 0 0.175555 0.175555 0.461707
// expect: 13 0 0.281804 0.286809 0.142214
// expect: 14 0 0.408743 0.408743 0.228534
// expect: 15 0 0.218570 0.342138 0.150118
// expect: 0 1 0.240787 0.240787 0.396490
// expect: 1 1 0.333700 0.241398 0.135729
// expect: 2 1 0.310063 0.262074 0.138674
// expect: 3 1 0.134203 0.415946 0.160662
// expect: 4 1 0.267781 0.267781 0.369482
// expect: 5 1 0.291432 0.291432 0.345830
// expect: 6 1 0.363043 0.215717 0.132052
// expect: 7 1 0.290105 0.290105 0.347158
// expect: 8 1 0.135256 0.415030 0.160525
// expect: 9 1 0.180392 0.375540 0.154879
// expect: 10 1 0.370397 0.370397 0.266880
// expect: 11 1 0.218494 0.218494 0.418784
// expect: 12 1 0.131380 0.418418 0.161013
// expect: 13 1 0.431098 0.431098 0.206165
// expect: 14 1 0.315145 0.315145 0.322118
// expect: 15 1 0.295827 0.295827 0.341436
// expect: 0 2 0.174411 0.174411 0.462852
// expect: 1 2 0.131151 0.418616 0.161044
// expect: 2 2 0.084962 0.327382 0.228489
// expect: 3 2 0.350820 0.230457 0.229877
// expect: 4 2 0.262623 0.276997 0.129656
// expect: 5 2 0.271031 0.285405 0.129274
// expect: 6 2 0.293629 0.293629 0.343633
// expect: 7 2 0.340566 0.340566 0.296696
// expect: 8 2 0.290532 0.290532 0.346731
// expect: 9 2 0.267811 0.267811 0.369467
// expect: 10 2 0.265843 0.300771 0.144198
// expect: 11 2 0.230213 0.230213 0.407050
// expect: 12 2 0.235691 0.235691 0.401572
// expect: 13 2 0.322728 0.322728 0.314534
// expect: 14 2 0.194568 0.194568 0.442695
// expect: 15 2 0.393713 0.393713 0.243549
// expect: 0 3 0.241779 0.321828 0.147204
// expect: 1 3 0.426047 0.426047 0.211231
// expect: 2 3 0.062455 0.000000 0.000000
// expect: 3 3 0.161105 0.181781 0.000000
// expect: 4 3 0.165850 0.180209 0.234470
// expect: 5 3 0.145708 0.160082 0.254597
// expect: 6 3 0.178607 0.178607 0.458671
// expect: 7 3 0.179797 0.179797 0.457465
// expect: 8 3 0.330205 0.330205 0.307073
// expect: 9 3 0.331807 0.331807 0.305455
// expect: 10 3 0.347036 0.347036 0.290242
// expect: 11 3 0.171313 0.171313 0.465949
// expect: 12 3 0.256275 0.256275 0.380987
// expect: 13 3 0.389517 0.389517 0.247745
// expect: 14 3 0.291814 0.291814 0.345449
// expect: 15 3 0.237629 0.237629 0.399634
// expect: 0 4 0.548516 0.459495 0.288777
// expect: 1 4 0.450858 0.356512 0.328588
// expect: 2 4 0.243656 0.097734 0.074220
// expect: 3 4 0.294133 0.127092 0.095903
// expect: 4 4 0.385473 0.385473 0.385473
// expect: 5 4 0.286610 0.286610 0.350668
// expect: 6 4 0.325307 0.226703 0.198291
// expect: 7 4 0.261646 0.261646 0.375616
// expect: 8 4 0.169497 0.171710 0.194217
// expect: 9 4 0.265476 0.316518 0.244129
// expect: 10 4 0.173739 0.089067 0.039033
// expect: 11 4 0.209506 0.110704 0.053742
// expect: 12 4 0.177127 0.177127 0.203662
// expect: 13 4 0.218357 0.218357 0.223682
// expect: 14 4 0.169207 0.109590 0.145693
// expect: 15 4 0.207370 0.183352 0.249210
// expect: 0 5 0.482185 0.308446 0.214618
// expect: 1 5 0.472755 0.344701 0.240284
// expect: 2 5 0.108644 0.080339 0.075120
// expect: 3 5 0.178088 0.099397 0.070527
// expect: 4 5 0.385473 0.385473 0.385473
// expect: 5 5 0.320546 0.252903 0.137362
// expect: 6 5 0.184070 0.184070 0.453193
// expect: 7 5 0.315541 0.229999 0.242298
// expect: 8 5 0.089204 0.158419 0.060060
// expect: 9 5 0.189532 0.222553 0.178912
// expect: 10 5 0.115999 0.060319 0.029892
// expect: 11 5 0.165911 0.085710 0.041215
// expect: 12 5 0.071504 0.163027 0.045075
// expect: 13 5 0.152682 0.152682 0.187610
// expect: 14 5 0.097871 0.152972 0.051926
// expect: 15 5 0.198474 0.101808 0.050629
// expect: 0 6 0.323949 0.283619 0.243290
// expect: 1 6 0.344152 0.301488 0.258824
// expect: 2 6 0.283543 0.248096 0.212665
// expect: 3 6 0.259403 0.226978 0.194553
// expect: 4 6 0.261006 0.228382 0.195758
// expect: 5 6 0.323171 0.282841 0.242512
// expect: 6 6 0.272755 0.238666 0.204578
// expect: 7 6 0.256733 0.224643 0.192554
// expect: 8 6 0.280415 0.245380 0.210330
// expect: 9 6 0.320684 0.280644 0.240589
// expect: 10 6 0.277165 0.242527 0.207889
// expect: 11 6 0.203235 0.177829 0.152422
// expect: 12 6 0.326513 0.285893 0.245274
// expect: 13 6 0.311040 0.272206 0.233371
// expect: 14 6 0.326268 0.285924 0.245579
// expect: 15 6 0.367071 0.322744 0.278416
// expect: 0 7 0.237598 0.207904 0.178210
// expect: 1 7 0.256336 0.224292 0.192264
// expect: 2 7 0.276478 0.241978 0.207492
// expect: 3 7 0.211246 0.184848 0.158434
// expect: 4 7 0.188937 0.165316 0.141695
// expect: 5 7 0.228168 0.199649 0.171130
// expect: 6 7 0.271412 0.237522 0.203616
// expect: 7 7 0.217655 0.190448 0.163241
// expect: 8 7 0.221302 0.193637 0.165972
// expect: 9 7 0.279561 0.244633 0.209705
// expect: 10 7 0.080003 0.069993 0.059998
// expect: 11 7 0.247089 0.216205 0.185321
// expect: 12 7 0.099962 0.087480 0.074983
// expect: 13 7 0.280751 0.245655 0.210575
// expect: 14 7 0.270054 0.236332 0.202625
// expect: 15 7 0.302983 0.265278 0.227588
// expect: 0 8 0.073548 0.330922 0.074907
// expect: 1 8 0.097856 0.141024 0.091752
// expect: 2 8 0.011475 0.318898 0.074708
// expect: 3 8 0.039445 0.033310 0.003754
// expect: 4 8 0.000275 0.133165 0.238483
// expect: 5 8 0.048905 0.048905 0.344656
// expect: 6 8 0.419181 0.419181 0.512276
// expect: 7 8 0.227939 0.186725 0.081392
// expect: 8 8 0.186023 0.186023 0.451240
// expect: 9 8 0.186023 0.186023 0.451240
// expect: 10 8 0.443412 0.443412 0.193866
// expect: 11 8 0.443412 0.443412 0.193866
// expect: 12 8 0.359823 0.359823 0.402731
// expect: 13 8 0.416358 0.416358 0.416342
// expect: 14 8 0.519158 0.073548 0.073548
// expect: 15 8 0.519158 0.073548 0.073548
// expect: 0 9 0.073548 0.330922 0.074907
// expect: 1 9 0.092638 0.145586 0.092409
// expect: 2 9 0.213138 0.129290 0.043549
// expect: 3 9 0.001740 0.002823 0.000946
// expect: 4 9 0.061784 0.061784 0.172549
// expect: 5 9 0.000000 0.038102 0.230396
// expect: 6 9 0.133440 0.133440 0.123659
// expect: 7 9 0.385733 0.385733 0.545724
// expect: 8 9 0.397375 0.397375 0.239902
// expect: 9 9 0.397375 0.397375 0.239902
// expect: 10 9 0.443412 0.443412 0.193866
// expect: 11 9 0.443412 0.443412 0.193866
// expect: 12 9 0.297673 0.297673 0.357305
// expect: 13 9 0.505592 0.505592 0.505592
// expect: 14 9 0.519158 0.073548 0.073548
// expect: 15 9 0.519158 0.073548 0.073548
// expect: 0 10 0.123598 0.469108 0.519158
// expect: 1 10 0.162158 0.330816 0.360632
// expect: 2 10 0.193042 0.193042 0.444236
// expect: 3 10 0.519158 0.073548 0.073548
// expect: 4 10 0.172366 0.317571 0.233143
// expect: 5 10 0.164340 0.309545 0.241184
// expect: 6 10 0.094285 0.498421 0.073548
// expect: 7 10 0.073548 0.073548 0.083146
// expect: 8 10 0.283558 0.174517 0.283558
// expect: 9 10 0.381125 0.132708 0.381125
// expect: 10 10 0.268437 0.268437 0.268437
// expect: 11 10 0.273503 0.319219 0.519158
// expect: 12 10 0.457786 0.132830 0.120211
// expect: 13 10 0.295354 0.274952 0.140520
// expect: 14 10 0.245563 0.158419 0.166613
// expect: 15 10 0.136309 0.250965 0.155535
// expect: 0 11 0.381277 0.394934 0.413138
// expect: 1 11 0.190051 0.338796 0.248554
// expect: 2 11 0.519158 0.073548 0.073548
// expect: 3 11 0.422034 0.164111 0.124681
// expect: 4 11 0.222583 0.367788 0.182940
// expect: 5 11 0.180026 0.325216 0.225498
// expect: 6 11 0.076692 0.516014 0.073548
// expect: 7 11 0.496162 0.073548 0.096544
// expect: 8 11 0.381125 0.132708 0.381125
// expect: 9 11 0.283558 0.174517 0.283558
// expect: 10 11 0.341634 0.341634 0.341634
// expect: 11 11 0.210468 0.205844 0.210468
// expect: 12 11 0.256657 0.308812 0.145357
// expect: 13 11 0.260502 0.305440 0.144869
// expect: 14 11 0.164874 0.209552 0.133516
// expect: 15 11 0.309712 0.238682 0.179217
// size: 16 12
// tol: abs 0.0008 rel 0.002
// about: pigment maps, averages, images, uv mapping and normals with maps: what tapes and lanes do.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -z*10 right 8*x up 6*y direction z }
light_source { <3, 5, -20>, rgb .45 parallel point_at <0, 0, 0> }
#declare F = finish { ambient .1 diffuse .8 specular .2 roughness .05 };
#declare Ramp = color_map { [0 rgb <.9,.1,.1>] [.3 rgb <.1,.8,.2>] [.3 rgb <.2,.2,.9>] [.8 rgb <.9,.9,.2>] [1 rgb .5] };
#declare Long = color_map { [0 rgb 0] [.1 rgb x] [.2 rgb y] [.3 rgb z] [.4 rgb 1] [.5 rgb .1] [.6 rgb .7] [.7 rgb x+y] [.8 rgb y+z] [.9 rgb x+z] [1 rgb .3] };
#macro Cell(I, J) translate <I - 3.5, J - 2.5, 0> #end
#macro Put(I, J, P) object { box { <-.48, -.48, 0>, <.48, .48, .5> } texture { pigment { P } finish { F } } Cell(I, J) } #end
#macro Bend(I, J, N) sphere { 0, .47 texture { pigment { rgb <.8, .7, .6> } normal { N } finish { F } } Cell(I, J) } #end
Put(0, 0, pigment { gradient x pigment_map { [0 granite color_map { Ramp } scale .5] [.5 rgb <.2, .5, .9>] [.7 wood turbulence .1 color_map { Long } scale .2] } rotate 20*z })
Put(1, 0, pigment { checker pigment { rgb x } pigment { marble turbulence .5 color_map { Ramp } scale .3 } scale .22 })
Put(2, 0, pigment { average pigment_map { [1 bozo color_map { Ramp } scale .3] [2 onion color_map { Long } scale .3] [.5 rgb z] } })
Put(3, 0, pigment { spiral1 3 pigment_map { [0 brick rgb 1, rgb x scale .06] [.4 brick rgb y, rgb z scale .08] [1 checker rgb 0, rgb 1 scale .3] } scale .5 warp { turbulence .2 } })
Put(4, 0, pigment { leopard color_map { Long } scale .06 frequency 3 phase .2 sine_wave })
Put(5, 0, pigment { agate color_map { Long } scale .4 scallop_wave frequency 1.5 })
Put(6, 0, pigment { crackle color_map { Ramp } scale .2 warp { repeat .3*x flip x } warp { black_hole <.1, .1, 0>, .4 strength .7 falloff 2 } })
Put(7, 0, pigment { image_map { png "rgb16.png" interpolate 2 } translate -.5 })
Put(0, 1, pigment { image_map { gif "palette.gif" } scale .6 translate -.3 })
sphere { 0, .47 uv_mapping texture { pigment { image_map { png "rgb16.png" } } finish { F } } Cell(1, 1) }
sphere { 0, .47 texture { pigment { uv_mapping gradient x pigment_map { [0 checker rgb 1, rgb y scale .05] [1 rgb z] } } normal { uv_mapping bumps .5 scale .05 } finish { F } } Cell(2, 1) }
object { box { <-.48, -.48, 0>, <.48, .48, .5> } texture { pigment { image_map { png "rgb16.png" once } scale .5 translate -.2 } finish { F } } Cell(3, 1) }
Put(4, 1, pigment { function { x*x + y } color_map { Ramp } scale .7 poly_wave 1.5 })
Put(5, 1, pigment { slope { x - z } color_map { Ramp } })
Put(6, 1, pigment { cells pigment_map { [0 radial color_map { Ramp } frequency 3] [1 rgb 1] } scale .2 })
Put(7, 1, pigment { object { sphere { 0, .3 } pigment { rgb x } pigment { granite color_map { Long } } } })
Bend(0, 2, normal { gradient x 1 slope_map { [0 <0, 1>] [.5 <1, 0>] [1 <0, -1>] } scale .2 })
Bend(1, 2, normal { gradient y normal_map { [0 bumps 1 scale .1] [.5 wrinkles 1 scale .2] [1 granite .3] } scale .8 })
Bend(2, 2, normal { average normal_map { [1 bumps 1 scale .1] [2 dents 1 scale .1] [1 gradient x 1 scale .3] } })
Bend(3, 2, normal { bump_map { png "rgb16.png" bump_size 3 } translate -.5 })
Bend(4, 2, normal { waves .5 scale .1 })
Bend(5, 2, normal { checker normal { bumps 1 scale .05 }, normal { ripples .4 scale .1 } scale .2 })
Bend(6, 2, normal { marble .6 turbulence .5 scale .2 rotate 30 no_bump_scale })
Bend(7, 2, normal { quilted 1 scale .2 accuracy .01 })
#declare Layer1 = texture { pigment { granite color_map { Ramp } scale .4 } finish { F } }
#declare Layer2 = texture { pigment { bozo color_map { [0 rgbt 1] [.5 rgbf <1, .5, .2, .6>] [1 rgb <.1, .2, .8>] } scale .2 } finish { F phong .5 } }
box { <-.48, -.48, 0>, <.48, .48, .5> texture { Layer1 } texture { Layer2 } Cell(0, 3) }
sphere { 0, .47 texture { Layer1 } texture { Layer2 normal { bumps 1 scale .1 } } texture { pigment { gradient y color_map { [0 rgbt 1] [1 rgbt <1, 0, 0, .5>] } scale .3 } } Cell(1, 3) }
box { <-.48, -.48, 0>, <.48, .48, .5> texture { gradient x texture_map { [.3 Layer1] [.7 pigment { rgb .7 } finish { F reflection .3 }] } } Cell(2, 3) }
box { <-.48, -.48, 0>, <.48, .48, .5> texture { checker texture { Layer1 }, texture { Layer2 } scale .2 } Cell(3, 3) }
sphere { 0, .47 texture { pigment { granite color_map { Ramp } scale .4 } normal { bumps 1 scale .1 } finish { F reflection .4 } } Cell(4, 3) }
sphere { 0, .47 texture { pigment { wood color_map { [0 rgbf <1, .6, .3, .7>] [1 rgb <.4, .2, .1>] } turbulence .1 scale .2 } finish { F } } interior { ior 1.2 } Cell(5, 3) }
sphere { 0, .47 texture { Layer1 } interior_texture { Layer2 } Cell(6, 3) }
sphere { 0, .47 uv_mapping texture { Layer1 scale .3 } texture { Layer2 scale .2 } Cell(7, 3) }
difference { sphere { 0, .47 } box { <-1, -1, -1>, <1, 1, -.2> } texture { Layer1 } Cell(0, 4) }
sphere { 0, .47 texture { pigment { agate color_map { Long } scale .3 } finish { F irid { .3 thickness .5 } } } Cell(1, 4) }
box { <-.48, -.48, 0>, <.48, .48, .5> texture { pigment { wrinkles color_map { Ramp } scale .1 } finish { F metallic } } texture { pigment { rgbt <.1, .2, .3, .6> } } Cell(2, 4) }
plane { z, 1 texture { Layer1 scale 2 } }
