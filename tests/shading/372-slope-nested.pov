// expect: 0 0 0.297887 0.247120 0.092287
// expect: 3 0 0.316777 0.255879 0.102296
// expect: 6 0 0.302953 0.267201 0.094240
// expect: 9 0 0.328008 0.217060 0.108186
// expect: 12 0 0.335637 0.332387 0.134310
// expect: 15 0 0.348806 0.299794 0.136538
// expect: 2 1 0.317342 0.204303 0.090028
// expect: 5 1 0.348760 0.262272 0.125734
// expect: 8 1 0.293446 0.271153 0.074235
// expect: 11 1 0.406302 0.321630 0.174563
// expect: 14 1 0.339162 0.328374 0.118837
// expect: 1 2 0.234928 0.344930 0.077989
// expect: 4 2 0.261631 0.196170 0.096162
// expect: 7 2 0.193729 0.284428 0.034073
// expect: 10 2 0.361501 0.279088 0.143816
// expect: 13 2 0.303868 0.244556 0.062959
// expect: 0 3 0.358129 0.277195 0.155795
// expect: 3 3 0.299367 0.253635 0.099123
// expect: 6 3 0.395743 0.305898 0.171130
// expect: 9 3 0.331868 0.287984 0.112749
// expect: 12 3 0.360098 0.275883 0.149554
// expect: 15 3 0.330678 0.244434 0.109712
// expect: 2 4 0.313649 0.182910 0.088930
// expect: 5 4 0.446525 0.354940 0.217548
// expect: 8 4 0.281666 0.248585 0.085557
// expect: 11 4 0.369909 0.284489 0.156374
// expect: 14 4 0.240986 0.253056 0.097581
// expect: 1 5 0.350668 0.268559 0.145388
// expect: 4 5 0.352834 0.264820 0.140887
// expect: 7 5 0.291630 0.220020 0.112596
// expect: 10 5 0.420081 0.343267 0.196399
// expect: 13 5 0.428290 0.338842 0.204669
// expect: 0 6 0.377234 0.319219 0.166506
// expect: 3 6 0.279927 0.276387 0.119860
// expect: 6 6 0.373022 0.293202 0.154299
// expect: 9 6 0.336309 0.298085 0.140597
// expect: 12 6 0.382238 0.299626 0.160494
// expect: 15 6 0.258091 0.211444 0.077943
// expect: 2 7 0.280064 0.314076 0.089235
// expect: 5 7 0.354620 0.286564 0.145251
// expect: 8 7 0.292027 0.278798 0.079164
// expect: 11 7 0.390372 0.307088 0.162783
// expect: 14 7 0.270024 0.197009 0.093065
// expect: 1 8 0.175998 0.092851 0.029938
// expect: 4 8 0.295308 0.217197 0.130800
// expect: 7 8 0.190051 0.180224 0.064210
// expect: 10 8 0.391089 0.317082 0.169665
// expect: 13 8 0.288151 0.338247 0.093858
// expect: 0 9 0.222553 0.178042 0.082261
// expect: 3 9 0.192248 0.127871 0.057282
// expect: 6 9 0.117632 0.093675 0.038956
// expect: 9 9 0.156329 0.169757 0.062089
// expect: 12 9 0.301472 0.245563 0.086290
// expect: 15 9 0.306981 0.210452 0.095659
// expect: 2 10 0.206394 0.116548 0.059525
// expect: 5 10 0.144594 0.203220 0.042039
// expect: 8 10 0.207080 0.215213 0.034867
// expect: 11 10 0.206592 0.114733 0.057389
// expect: 14 10 0.305852 0.265690 0.081758
// expect: 1 11 0.202396 0.147814 0.071992
// expect: 4 11 0.142824 0.107164 0.039155
// expect: 7 11 0.209110 0.160327 0.071626
// expect: 10 11 0.143175 0.121065 0.030060
// expect: 13 11 0.362051 0.278584 0.153368
// size: 16 12
// tol: abs 0.0008 rel 0.002
// about: maps by slope in maps of textures, which see the normal that the texture before them perturbed.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -z*10 right 8*x up 6*y direction z }
light_source { <3, 5, -20>, rgb .45 }
#declare F = finish { ambient .1 diffuse .8 specular .2 roughness .05 };
#declare B = texture { pigment { rgb <.8, .6, .3> } normal { bumps 1 scale .1 } finish { F } }
#declare D = texture { pigment { wood scale .1 } finish { F } }
#declare M = texture { pigment { slope y color_map { [0 rgb x][1 rgb y] } } normal { dents 1 scale .1 no_bump_scale } finish { F reflection .3 conserve_energy } }
#declare L = texture { pigment { rgbt <1,.5,.2,.7> } normal { bumps 1 scale .2 } finish { F reflection .6 conserve_energy } }
#declare L2 = texture { L } texture { pigment { rgbt <.2,.5,1,.9> } normal { dents 1 scale .1 } finish { F reflection .8 conserve_energy } }
#declare L3 = texture { pigment { rgb .7 } finish { F } } texture { L }
#declare S = texture { slope y texture_map { [.3 B] [.5 M] [.7 D] } }
#declare S2 = texture { slope { x + y 0 .5 altitude y 0 1 } texture_map { [.3 M] [.6 B] } scale .5 }
#declare S3 = texture { slope y texture_map { [.3 L2] [.5 B] [.7 L3] } }
#declare S4 = texture { slope y texture_map { [.3 B] [.7 L3] } }
#macro Ball(I, J, T) sphere { 0, .47 texture { T } translate <I - 3.5, J - 2.5, 0> } #end
Ball(0, 0, texture { gradient x texture_map { [.2 S] [.8 S2] } })
Ball(1, 0, texture { gradient x texture_map { [.2 S] [.8 S] } scale .3 })
Ball(2, 0, texture { average texture_map { [1 S] [1 B] [2 S2] } })
Ball(3, 0, texture { gradient y texture_map { [0 S3] [1 S] } })
Ball(4, 0, texture { gradient y texture_map { [0 S4] [1 S2] } scale .3 })
Ball(5, 0, texture { bozo texture_map { [0 B] [.5 gradient x texture_map { [0 S] [1 S2] }] [1 M] } scale .2 })
Ball(0, 1, texture { checker texture { S } texture { S4 } scale .2 })
Ball(1, 1, texture { slope y texture_map { [0 S] [1 S2] } })
Ball(2, 1, texture { slope y texture_map { [0 S3] [1 S4] } })
sphere { 0, .47 uv_mapping texture { gradient x texture_map { [0 S] [1 S2] } } translate <-.5, -1.5, 0> }
Ball(4, 1, texture { average texture_map { [1 L2] [1 S] [1 S4] } })
plane { z, 1 texture { gradient x texture_map { [0 S] [.5 B] [1 S2] } scale 3 } }
