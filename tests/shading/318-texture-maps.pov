// expect: 0 0 0.245487 0.317067 0.168200
// expect: 1 0 0.196872 0.368078 0.197833
// expect: 2 0 0.324239 0.309117 0.305638
// expect: 3 0 0.259709 0.218219 0.309773
// expect: 4 0 0.353765 0.331258 0.176211
// expect: 5 0 0.343023 0.305547 0.163912
// expect: 6 0 0.263813 0.332753 0.179934
// expect: 7 0 0.234516 0.404990 0.233661
// expect: 8 0 0.223697 0.210452 0.383505
// expect: 9 0 0.256947 0.217945 0.280980
// expect: 10 0 0.330266 0.260990 0.183017
// expect: 11 0 0.341985 0.308080 0.171832
// expect: 12 0 0.281971 0.349813 0.195361
// expect: 13 0 0.183185 0.357000 0.190661
// expect: 14 0 0.219532 0.366049 0.160906
// expect: 15 0 0.284504 0.241062 0.309224
// expect: 0 1 0.295064 0.361334 0.204517
// expect: 1 1 0.219638 0.390372 0.219394
// expect: 2 1 0.263767 0.250706 0.341360
// expect: 3 1 0.270100 0.228534 0.300938
// expect: 4 1 0.389471 0.315099 0.240391
// expect: 5 1 0.351614 0.314183 0.172610
// expect: 6 1 0.338064 0.403601 0.245670
// expect: 7 1 0.189624 0.362112 0.193790
// expect: 8 1 0.304158 0.291081 0.300816
// expect: 9 1 0.348440 0.302510 0.311025
// expect: 10 1 0.326162 0.259693 0.155703
// expect: 11 1 0.415427 0.376379 0.232410
// expect: 12 1 0.289998 0.355825 0.198337
// expect: 13 1 0.217121 0.387854 0.216892
// expect: 14 1 0.279805 0.340093 0.168750
// expect: 15 1 0.318364 0.273930 0.304738
// expect: 0 2 0.254017 0.324361 0.173648
// expect: 1 2 0.179660 0.354314 0.189258
// expect: 2 2 0.253132 0.241947 0.339574
// expect: 3 2 0.301884 0.333974 0.167193
// expect: 4 2 0.251514 0.198520 0.146273
// expect: 5 2 0.336736 0.299748 0.158846
// expect: 6 2 0.250599 0.321492 0.171603
// expect: 7 2 0.196841 0.368444 0.198810
// expect: 8 2 0.170932 0.396338 0.160266
// expect: 9 2 0.336156 0.307454 0.164858
// expect: 10 2 0.326757 0.258335 0.187457
// expect: 11 2 0.324666 0.290776 0.154513
// expect: 12 2 0.277333 0.343481 0.186465
// expect: 13 2 0.227115 0.397543 0.226123
// expect: 14 2 0.253590 0.342931 0.159274
// expect: 15 2 0.356954 0.279576 0.157107
// expect: 0 3 0.309346 0.376272 0.220417
// expect: 1 3 0.195987 0.367681 0.198184
// expect: 2 3 0.207752 0.377173 0.162676
// expect: 3 3 0.277607 0.234592 0.308537
// expect: 4 3 0.342596 0.270909 0.207126
// expect: 5 3 0.382132 0.345693 0.205615
// expect: 6 3 0.282475 0.349035 0.192645
// expect: 7 3 0.198749 0.370123 0.200153
// expect: 8 3 0.255802 0.240894 0.362966
// expect: 9 3 0.268605 0.226001 0.316594
// expect: 10 3 0.342306 0.276631 0.131502
// expect: 11 3 0.307698 0.276127 0.143359
// expect: 12 3 0.260624 0.330343 0.178698
// expect: 13 3 0.196277 0.367544 0.197391
// expect: 14 3 0.270893 0.304738 0.146044
// expect: 15 3 0.313054 0.275364 0.141268
// expect: 0 4 0.306630 0.373114 0.216617
// expect: 1 4 0.220096 0.390585 0.219242
// expect: 2 4 0.248707 0.235554 0.356527
// expect: 3 4 0.273045 0.318853 0.150210
// expect: 4 4 0.331792 0.262257 0.196033
// expect: 5 4 0.465644 0.426322 0.281926
// expect: 6 4 0.282246 0.349889 0.195102
// expect: 7 4 0.200793 0.371847 0.201373
// expect: 8 4 0.378790 0.365011 0.231693
// expect: 9 4 0.315602 0.270283 0.284596
// expect: 10 4 0.389212 0.314519 0.233890
// expect: 11 4 0.313085 0.282246 0.150576
// expect: 12 4 0.255756 0.325566 0.174060
// expect: 13 4 0.207187 0.377691 0.206409
// expect: 14 4 0.297902 0.282765 0.327611
// expect: 15 4 0.316579 0.274205 0.263783
// expect: 0 5 0.273747 0.342092 0.188357
// expect: 1 5 0.228702 0.399313 0.228183
// expect: 2 5 0.229908 0.214771 0.442222
// expect: 3 5 0.293065 0.354467 0.174884
// expect: 4 5 0.330831 0.300389 0.149279
// expect: 5 5 0.274891 0.250553 0.128634
// expect: 6 5 0.278935 0.346120 0.190661
// expect: 7 5 0.201129 0.371710 0.200519
// expect: 8 5 0.275502 0.262638 0.328191
// expect: 9 5 0.304143 0.259510 0.316854
// expect: 10 5 0.453986 0.391196 0.248112
// expect: 11 5 0.315694 0.283879 0.150744
// expect: 12 5 0.246693 0.318151 0.169116
// expect: 13 5 0.199207 0.370474 0.200336
// expect: 14 5 0.292546 0.278935 0.315480
// expect: 15 5 0.265034 0.223209 0.309499
// expect: 0 6 0.198138 0.226719 0.104494
// expect: 1 6 0.327779 0.255421 0.137942
// expect: 2 6 0.244297 0.150637 0.075593
// expect: 3 6 0.353201 0.276432 0.143130
// expect: 4 6 0.159747 0.223056 0.082277
// expect: 5 6 0.326558 0.245045 0.122805
// expect: 6 6 0.399008 0.318288 0.209308
// expect: 7 6 0.287434 0.287434 0.349828
// expect: 8 6 0.173144 0.384222 0.154604
// expect: 9 6 0.387961 0.323491 0.307774
// expect: 10 6 0.000031 0.346136 0.000031
// expect: 11 6 0.002090 0.131807 0.327214
// expect: 12 6 0.120729 0.308278 0.111223
// expect: 13 6 0.000916 0.311666 0.109285
// expect: 14 6 0.298299 0.285618 0.145022
// expect: 15 6 0.328527 0.284184 0.275883
// expect: 0 7 0.192584 0.200809 0.100771
// expect: 1 7 0.190372 0.199710 0.081514
// expect: 2 7 0.178943 0.128603 0.095308
// expect: 3 7 0.145342 0.104891 0.147280
// expect: 4 7 0.135317 0.107195 0.037095
// expect: 5 7 0.284764 0.213687 0.107073
// expect: 6 7 0.408911 0.239368 0.151537
// expect: 7 7 0.287434 0.287434 0.349828
// expect: 8 7 0.043519 0.040192 0.066484
// expect: 9 7 0.209247 0.209247 0.428031
// expect: 10 7 0.000000 0.254185 0.000000
// expect: 11 7 0.070039 0.061707 0.030045
// expect: 12 7 0.079988 0.225986 0.076997
// expect: 13 7 0.086397 0.256748 0.086397
// expect: 14 7 0.224552 0.320714 0.142199
// expect: 15 7 0.450782 0.405188 0.384939
// expect: 0 8 0.203006 0.174395 0.144747
// expect: 1 8 0.262181 0.223957 0.169268
// expect: 2 8 0.242145 0.168688 0.082963
// expect: 3 8 0.294972 0.212436 0.106813
// expect: 4 8 0.127794 0.195407 0.057618
// expect: 5 8 0.121935 0.250034 0.070390
// expect: 6 8 0.288655 0.239078 0.120989
// expect: 7 8 0.254673 0.196918 0.125689
// expect: 8 8 0.262669 0.164065 0.078538
// expect: 9 8 0.277897 0.185946 0.094377
// expect: 10 8 0.187427 0.140566 0.070283
// expect: 11 8 0.287556 0.216587 0.110140
// expect: 12 8 0.177127 0.177127 0.203662
// expect: 13 8 0.002090 0.131807 0.327214
// expect: 14 8 0.191485 0.131350 0.115846
// expect: 15 8 0.190173 0.146960 0.127382
// expect: 0 9 0.155474 0.231510 0.123247
// expect: 1 9 0.155200 0.259541 0.128130
// expect: 2 9 0.078019 0.160082 0.046220
// expect: 3 9 0.155245 0.151873 0.179232
// expect: 4 9 0.201419 0.151064 0.075532
// expect: 5 9 0.230121 0.172595 0.086290
// expect: 6 9 0.184756 0.201587 0.083284
// expect: 7 9 0.250538 0.191760 0.092500
// expect: 8 9 0.155627 0.095018 0.096162
// expect: 9 9 0.188876 0.137987 0.068818
// expect: 10 9 0.167483 0.131197 0.143938
// expect: 11 9 0.215915 0.210163 0.082795
// expect: 12 9 0.071504 0.163027 0.045075
// expect: 13 9 0.030045 0.068376 0.030045
// expect: 14 9 0.105684 0.147646 0.051041
// expect: 15 9 0.166140 0.148455 0.143771
// expect: 0 10 0.366506 0.328237 0.163561
// expect: 1 10 0.300206 0.261555 0.235615
// expect: 2 10 0.360372 0.349996 0.282918
// expect: 3 10 0.257130 0.310201 0.155993
// expect: 4 10 0.355901 0.289082 0.143404
// expect: 5 10 0.384115 0.307301 0.226001
// expect: 6 10 0.432212 0.269261 0.195132
// expect: 7 10 0.413931 0.359472 0.375692
// expect: 8 10 0.307118 0.230579 0.115755
// expect: 9 10 0.313802 0.236500 0.120562
// expect: 10 10 0.349004 0.265003 0.138994
// expect: 11 10 0.455497 0.366552 0.233143
// expect: 12 10 0.213382 0.213382 0.423896
// expect: 13 10 0.144228 0.407187 0.159411
// expect: 14 10 0.183719 0.183719 0.453544
// expect: 15 10 0.386770 0.296269 0.172198
// expect: 0 11 0.203708 0.361120 0.197955
// expect: 1 11 0.201312 0.371267 0.204211
// expect: 2 11 0.202884 0.356909 0.198962
// expect: 3 11 0.258122 0.351492 0.263096
// expect: 4 11 0.368048 0.324193 0.175631
// expect: 5 11 0.307607 0.330526 0.165576
// expect: 6 11 0.278294 0.214328 0.137575
// expect: 7 11 0.304631 0.190967 0.191684
// expect: 8 11 0.388464 0.388464 0.248798
// expect: 9 11 0.320546 0.252903 0.137362
// expect: 10 11 0.162676 0.385473 0.207233
// expect: 11 11 0.162676 0.385473 0.207233
// expect: 12 11 0.395239 0.307454 0.175769
// expect: 13 11 0.345632 0.260594 0.133028
// expect: 14 11 0.162676 0.385473 0.207233
// expect: 15 11 0.323522 0.218280 0.181796
// size: 16 12
// tol: abs 0.0008 rel 0.002
// about: maps of textures: nested, averaged, by slope, uv and image, over surfaces that let light through and turn.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -z*10 right 8*x up 6*y direction z }
light_source { <3, 5, -20>, rgb .45 parallel point_at <0, 0, 0> }
#declare F = finish { ambient .1 diffuse .8 specular .2 roughness .05 };
#declare Ramp = color_map { [0 rgb <.9,.1,.1>] [.3 rgb <.1,.8,.2>] [.3 rgb <.2,.2,.9>] [.8 rgb <.9,.9,.2>] [1 rgb .5] };
#macro Put(I, J, T) object { box { <-.48, -.48, 0>, <.48, .48, .5> } texture { T } translate <I - 3.5, J - 2.5, 0> } #end
#macro Ball(I, J, T) object { sphere { 0, .47 } texture { T } translate <I - 3.5, J - 2.5, 0> } #end
#declare A = texture { pigment { granite color_map { Ramp } scale .4 } finish { F } }
#declare B = texture { pigment { rgb <.8, .6, .3> } normal { bumps 1 scale .1 } finish { F phong .4 } }
#declare C = texture { pigment { rgb <.2, .7, .3> } finish { F reflection .3 } }
#declare D = texture { pigment { wood color_map { Ramp } scale .1 } finish { F } }
    texture { pigment { bozo color_map { [0 rgbt 1] [.5 rgbf <1, .5, .2, .6>] [1 rgb <.1, .2, .8>] } scale .2 } normal { wrinkles .5 scale .2 } finish { F } }
#declare Small = texture { gradient x texture_map { [.2 A] [.6 B] [.9 D] } scale .7 rotate 30*z }
Put(0, 0, texture { gradient y texture_map { [.1 A] [.4 B] [.7 C] [1 D] } })
Put(1, 0, texture { bozo texture_map { [.3 Small] [.7 C] } scale .3 turbulence .4 })
Put(2, 0, texture { average texture_map { [1 A] [2 B] [0 C] [.5 D] } rotate 20*z })
Put(3, 0, texture { checker texture { Small } texture { D } scale .2 })
Put(4, 0, texture { brick texture { B }, texture { A } brick_size .3 mortar .05 })
Put(5, 0, texture { hexagon texture { A }, texture { B }, texture { C } scale .2 rotate 90*x })
Put(6, 0, texture { material_map { png "rgb16.png" texture { A } texture { B } texture { D } } scale .6 })
Put(7, 0, texture { crackle solid texture_map { [.3 A] [.3 B] [.6 D] [.6 C] } scale .2 })
Ball(0, 1, texture { gradient y texture_map { [.1 A] [.4 B] [.7 C] [1 D] } })
Ball(1, 1, texture { slope y texture_map { [.3 A] [.6 B] [.8 D] } })
sphere { 0, .47 uv_mapping texture { checker texture { A scale .1 } texture { B scale .2 } scale .1 } translate <-1.5, -1.5, 0> }
Ball(3, 1, texture { uv_mapping gradient x texture_map { [0 A scale .3] [1 B scale .3] } })
Ball(4, 1, texture { gradient x texture_map { [.2 slope y texture_map { [.4 B] [.6 D] }] [.8 D] } })
Ball(5, 1, texture { spiral1 3 texture_map { [.2 B scale .5] [.5 B rotate 40*x] [.9 pigment { slope x color_map { Ramp } } normal { dents 1 scale .1 } finish { F }] } })
Ball(6, 1, texture { gradient x texture_map { [.3 pigment { image_map { png "rgb16.png" once } scale .5 } finish { F }] [.7 A] } })
sphere { 0, .47 texture { gradient y texture_map { [0 pigment { rgbf <1, .7, .5, .8> } finish { F }] [.6 A] [1 B] } } interior { ior 1.3 } translate <3.5, -1.5, 0> }
Ball(0, 2, texture { onion texture_map { [0 gradient x texture_map { [0 gradient y texture_map { [0 A] [1 B] } scale .3] [1 C] } scale .4] [1 gradient z texture_map { [0 D] [1 B] } scale .5] } scale .3 })
Ball(1, 2, texture { average texture_map { [1 average texture_map { [1 B] [3 D] }] [1 Small] } })
Ball(2, 2, texture { marble texture_map { [.3 A] [.6 B] } turbulence .5 scale .3 })
Put(3, 2, texture { gradient x texture_map { [.3 pigment { slope y color_map { Ramp } } normal { slope { x + y } 1 } finish { F }] [.7 D] } })
Ball(5, 2, texture { pigment { gradient x pigment_map { [.3 image_map { png "rgb16.png" once } scale .5] [.7 rgb y] } } finish { F } })
Ball(6, 2, texture { pigment { average pigment_map { [1 image_map { png "rgb16.png" once } scale .5] [2 rgb y] } } finish { F } })
object { union { sphere { <-.2, 0, 0>, .25 texture { A } } box { <0, -.3, 0>, <.4, .3, .2> } } texture { Small } translate <.5, -.5, 0> }
plane { z, 1 texture { gradient x texture_map { [0 A] [.5 B] [1 C] } scale 3 } }
