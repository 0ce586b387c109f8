// expect: 0 0 0.238270 0.205051 0.138491
// expect: 1 0 0.094118 0.158480 0.265934
// expect: 2 0 0.254124 0.234104 0.243732
// expect: 3 0 0.250233 0.313649 0.171878
// expect: 4 0 0.331487 0.359289 0.278019
// expect: 5 0 0.272999 0.224567 0.189593
// expect: 6 0 0.176486 0.177005 0.132128
// expect: 7 0 0.133608 0.213977 0.319509
// expect: 8 0 0.169131 0.424018 0.248432
// expect: 9 0 0.294835 0.350835 0.274708
// expect: 10 0 0.232197 0.173877 0.120150
// expect: 11 0 0.117678 0.209903 0.485756
// expect: 12 0 0.163775 0.213382 0.140261
// expect: 13 0 0.197177 0.233265 0.262959
// expect: 14 0 0.244663 0.378347 0.241398
// expect: 15 0 0.332326 0.344381 0.261769
// expect: 0 1 0.198718 0.138643 0.138537
// expect: 1 1 0.115511 0.175341 0.284871
// expect: 2 1 0.289906 0.197864 0.159533
// expect: 3 1 0.053971 0.081422 0.154864
// expect: 4 1 0.332876 0.365988 0.261189
// expect: 5 1 0.293767 0.160998 0.108064
// expect: 6 1 0.225010 0.175647 0.116945
// expect: 7 1 0.222690 0.162020 0.108537
// expect: 8 1 0.301198 0.186801 0.131365
// expect: 9 1 0.276814 0.281071 0.395285
// expect: 10 1 0.242893 0.166522 0.139208
// expect: 11 1 0.103410 0.190188 0.237568
// expect: 12 1 0.194949 0.263401 0.252613
// expect: 13 1 0.210880 0.174762 0.170901
// expect: 14 1 0.271183 0.343847 0.226658
// expect: 15 1 0.214084 0.129152 0.130938
// expect: 0 2 0.215122 0.128786 0.109194
// expect: 1 2 0.119768 0.162707 0.268894
// expect: 2 2 0.297856 0.135805 0.076646
// expect: 3 2 0.233890 0.324910 0.203891
// expect: 4 2 0.349599 0.267567 0.208118
// expect: 5 2 0.285832 0.119387 0.057206
// expect: 6 2 0.192309 0.197101 0.132311
// expect: 7 2 0.200702 0.118608 0.075578
// expect: 8 2 0.259602 0.182818 0.160586
// expect: 9 2 0.283497 0.342092 0.402686
// expect: 10 2 0.204623 0.143511 0.117967
// expect: 11 2 0.129458 0.221515 0.462104
// expect: 12 2 0.208164 0.212253 0.151629
// expect: 13 2 0.206394 0.125490 0.087938
// expect: 14 2 0.284413 0.299580 0.411048
// expect: 15 2 0.162188 0.150607 0.107500
// expect: 0 3 0.188922 0.146929 0.093370
// expect: 1 3 0.115511 0.176410 0.280140
// expect: 2 3 0.192508 0.116136 0.066224
// expect: 3 3 0.069474 0.100832 0.047196
// expect: 4 3 0.372869 0.286687 0.096910
// expect: 5 3 0.168246 0.151980 0.131823
// expect: 6 3 0.159792 0.228580 0.223331
// expect: 7 3 0.141726 0.232120 0.371710
// expect: 8 3 0.056031 0.068635 0.134600
// expect: 9 3 0.314748 0.244297 0.325338
// expect: 10 3 0.206409 0.182315 0.157351
// expect: 11 3 0.078874 0.134264 0.276310
// expect: 12 3 0.228412 0.170001 0.115648
// expect: 13 3 0.126619 0.105989 0.092882
// expect: 14 3 0.295979 0.302098 0.407416
// expect: 15 3 0.231830 0.211353 0.308125
// expect: 0 4 0.240406 0.179355 0.120974
// expect: 1 4 0.235782 0.164599 0.132937
// expect: 2 4 0.202579 0.292561 0.084443
// expect: 3 4 0.144656 0.313252 0.099580
// expect: 4 4 0.262013 0.277317 0.214893
// expect: 5 4 0.218921 0.307042 0.221561
// expect: 6 4 0.222477 0.145327 0.112184
// expect: 7 4 0.215000 0.163897 0.163302
// expect: 8 4 0.349584 0.486442 0.407904
// expect: 9 4 0.131121 0.268238 0.524239
// expect: 10 4 0.320592 0.286061 0.158099
// expect: 11 4 0.281987 0.288167 0.173938
// expect: 12 4 0.259571 0.099062 0.039338
// expect: 13 4 0.149477 0.081239 0.032731
// expect: 14 4 0.322835 0.342962 0.243336
// expect: 15 4 0.197131 0.284627 0.259327
// expect: 0 5 0.210925 0.146014 0.097856
// expect: 1 5 0.177996 0.125261 0.083848
// expect: 2 5 0.216632 0.188571 0.123995
// expect: 3 5 0.202213 0.124849 0.051682
// expect: 4 5 0.173068 0.226062 0.158267
// expect: 5 5 0.153750 0.164218 0.082033
// expect: 6 5 0.176822 0.137423 0.153460
// expect: 7 5 0.182315 0.098222 0.065095
// expect: 8 5 0.308339 0.310323 0.399557
// expect: 9 5 0.237110 0.240803 0.327611
// expect: 10 5 0.289067 0.231266 0.255146
// expect: 11 5 0.242191 0.217151 0.294972
// expect: 12 5 0.155550 0.084154 0.045792
// expect: 13 5 0.080034 0.064363 0.047990
// expect: 14 5 0.046128 0.082231 0.035401
// expect: 15 5 0.264561 0.317372 0.170748
// expect: 0 6 0.441962 0.313344 0.166003
// expect: 1 6 0.375494 0.263020 0.225788
// expect: 2 6 0.317830 0.313039 0.191119
// expect: 3 6 0.250690 0.346853 0.297246
// expect: 4 6 0.490364 0.424811 0.213840
// expect: 5 6 0.413107 0.342916 0.297612
// expect: 6 6 0.307393 0.273548 0.225452
// expect: 7 6 0.291005 0.250263 0.254139
// expect: 8 6 0.230518 0.155032 0.127428
// expect: 9 6 0.228229 0.170153 0.123262
// expect: 10 6 0.205005 0.210330 0.308949
// expect: 11 6 0.121584 0.144045 0.256977
// expect: 12 6 0.246174 0.291279 0.150103
// expect: 13 6 0.128985 0.143191 0.231876
// expect: 14 6 0.503456 0.288685 0.176364
// expect: 15 6 0.209125 0.311345 0.410452
// expect: 0 7 0.370962 0.268330 0.166262
// expect: 1 7 0.369314 0.230213 0.137057
// expect: 2 7 0.276036 0.396567 0.280415
// expect: 3 7 0.327764 0.381170 0.190539
// expect: 4 7 0.193408 0.175036 0.135729
// expect: 5 7 0.199512 0.166369 0.112535
// expect: 6 7 0.444709 0.369223 0.296284
// expect: 7 7 0.321614 0.260914 0.218051
// expect: 8 7 0.179706 0.130205 0.096101
// expect: 9 7 0.174350 0.122026 0.089097
// expect: 10 7 0.158022 0.150011 0.186954
// expect: 11 7 0.085481 0.085603 0.135668
// expect: 12 7 0.111345 0.114488 0.164080
// expect: 13 7 0.161547 0.119234 0.043992
// expect: 14 7 0.275029 0.143389 0.074342
// expect: 15 7 0.146578 0.207309 0.255604
// size: 16 8
// tol: abs 0.0008 rel 0.002
// about: light on layers and maps of textures: several lamps, clear layers, mirrors, energy that is conserved, both sides.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 4 adc_bailout 0.02 }
camera { orthographic location -z*10 right 8*x up 4*y direction z }
background { rgb <.05, .08, .1> }
light_source { <3, 5, -20>, rgb .5 parallel point_at <0, 0, 0> }
light_source { <-6, 1, -8>, rgb <.5, .4, .3> spotlight point_at <-1, 0, 0> radius 14 falloff 25 tightness 2 fade_distance 9 fade_power 2 }
light_source { <0, 9, -3>, rgb <.2, .3, .5> shadowless }
light_source { <2, -3, 6>, rgb .6 }
#declare F = finish { ambient .1 diffuse .6 };
#declare Ramp = color_map { [0 rgb <.9,.1,.1>] [.3 rgb <.1,.8,.2>] [.3 rgb <.2,.2,.9>] [.8 rgb <.9,.9,.2>] [1 rgb .5] };
#declare Veil = color_map { [0 rgbt 1] [.4 rgbf <1, .5, .2, .8>] [.7 rgbft <.3, .6, .8, .2, .3>] [1 rgb <.1, .2, .8>] };
#macro Put(I, J, T) object { box { <-.48, -.48, 0>, <.48, .48, .5> } texture { T } translate <I - 3.5, J - 1.5, 0> } #end
#macro Ball(I, J, T) object { sphere { 0, .47 } texture { T } translate <I - 3.5, J - 1.5, 0> } #end
#declare A = texture { pigment { granite color_map { Ramp } scale .4 } finish { F phong .5 phong_size 17.5 brilliance 1.7 } }
#declare B = texture { pigment { rgb <.8, .6, .3> } normal { bumps 1 scale .1 } finish { F specular .6 roughness .03 metallic .7 } }
#declare C = texture { pigment { gradient x color_map { Veil } scale .5 } finish { F diffuse .5, .3 reflection { .1, .5 } conserve_energy } }
#declare M = texture { pigment { rgb <.3, .3, .4> } normal { wrinkles .7 scale .3 } finish { F reflection { .2, .6 metallic .8 falloff 2 } } }
#declare D = texture { pigment { rgb <.2, .8, .4> } finish { F } }
    texture { pigment { bozo color_map { Veil } scale .2 } normal { dents .7 scale .2 } finish { F phong .5 reflection .1 } }
    texture { pigment { marble color_map { Veil } turbulence .4 scale .5 } finish { F emission .1 conserve_energy reflection { .3 fresnel } } }
#declare E = texture { A } texture { C }
#declare G = texture { pigment { rgbf <.9, .8, .7, .01> } finish { F } } texture { pigment { bozo color_map { Veil } scale .1 } finish { F diffuse .8, .4 } }
#declare H = texture { pigment { image_map { png "rgb16.png" once } scale .5 } finish { F reflection .2 } } texture { pigment { rgbt <1, 1, 1, .8> } finish { F } }
#declare K = texture { pigment { bozo color_map { Ramp } } finish { F reflection .4 reflection_exponent 1.5 } } texture { C }
Put(0, 0, texture { E })
Put(1, 0, texture { D })
Put(2, 0, texture { gradient y texture_map { [.1 A] [.4 B] [.7 C] [1 D] } })
Put(3, 0, texture { average texture_map { [1 A] [2 B] [3 M] } })
Ball(4, 0, texture { C })
Ball(5, 0, texture { M })
Ball(6, 0, texture { checker texture { D } texture { M } scale .15 })
Ball(7, 0, texture { G })
object { Ball(0, 1, texture { C }) double_illuminate }
sphere { 0, .47 uv_mapping texture { checker texture { A scale .1 } texture { D scale .2 } scale .1 } translate <-2.5, -.5, 0> }
sphere { <-1.5, -.5, 0>, .47 texture { D } interior { ior 1.4 } }
sphere { <-.5, -.5, 0>, .47 texture { pigment { onion color_map { Veil } scale .2 } finish { F } } texture { C } interior { ior 1.2 fade_distance .5 fade_power 2 fade_color rgb <.8,.4,.2> } }
Ball(4, 1, texture { H })
Ball(5, 1, texture { K })
light_group { light_source { <-2, 3, -9>, rgb <.9, .2, .2> } sphere { <2.5, -.5, 0>, .4 texture { D } } global_lights off }
union { sphere { <-.2, 0, 0>, .25 } box { <0, -.3, 0>, <.4, .3, .2> } texture { D } translate <3.5, -.5, 0> }
#declare I = 0;
#while (I < 40)
sphere { <mod(I, 10) * .8 - 3.6, .4 + floor(I / 10) * .4, 0>, .19 texture { C translate I } texture { pigment { bozo color_map { Veil } scale .1 translate I } finish { F } } }
#declare I = I + 1;
#end
plane { z, 1 texture { gradient x texture_map { [0 A] [.5 D] [1 C] } scale 3 } }
plane { z, 2 pigment { checker rgb .2, rgb .7 scale .3 } finish { F } }
