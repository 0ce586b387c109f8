// expect: 0 0 0.432074 0.301396 0.103532
// expect: 1 0 0.432639 0.301778 0.103655
// expect: 2 0 0.346685 0.288594 0.101595
// expect: 3 0 0.612634 0.561364 0.356313
// expect: 4 0 0.237369 0.400458 0.068544
// expect: 5 0 0.279957 0.276768 0.088396
// expect: 0 1 0.328283 0.270237 0.087861
// expect: 1 1 0.328695 0.270573 0.087953
// expect: 2 1 0.355749 0.273869 0.088701
// expect: 3 1 0.121447 0.333898 0.318242
// expect: 4 1 0.355825 0.174350 0.081804
// expect: 5 1 0.330404 0.207828 0.076570
// expect: 0 2 0.188190 0.127016 0.115007
// expect: 1 2 0.583490 0.443000 0.206744
// expect: 2 2 0.037690 0.076249 0.103548
// expect: 3 2 0.601755 0.551568 0.350881
// expect: 4 2 0.215045 0.363241 0.055238
// expect: 5 2 0.044053 0.121279 0.107469
// expect: 0 3 0.118914 0.327062 0.312551
// expect: 1 3 0.280537 0.218997 0.113481
// expect: 2 3 0.595880 0.546304 0.347936
// expect: 3 3 0.119249 0.327993 0.313313
// expect: 4 3 0.166583 0.341512 0.038453
// expect: 5 3 0.596460 0.546822 0.348226
// size: 6 4
// tol: abs 0.0002 rel 0.0006
// about: before version 3.5 the filter of a layer is transmit where there is another layer below; behind the surface and in its shadow too.
#version 3.1;
global_settings { assumed_gamma 1 }
camera { orthographic location <0,0,-10> direction z right 6*x up 4*y }
light_source { <2,27,-40>, rgb <1,0.9,0.5> }
#declare Upper = texture { pigment { rgbft <0.5,0.8,0.2,0.6,0.1> } finish { ambient 0.2 diffuse 0.7 } }
#declare Lower = texture { pigment { rgbft <1,0.5,0.5,0.5,0.1> } finish { ambient 0.1 diffuse 0.5 } }
plane { -z, -2 pigment { checker rgb 1, rgb <0.2,0.6,0.9> scale 1.37 } }
box { <-3,0,0>, <0,2,0.1> texture { Lower } texture { Upper } }
sphere { <-1.5,-1,0>, 0.95 texture { pigment { rgb <0.9,0.8,0.7> } } texture { Upper } texture { Lower } }
sphere { <1.5,-1,0>, 0.95 texture { Upper } }
box { <1,0,0>, <3,2,0.1> texture { bozo texture_map { [0 Lower] [1 Upper] } scale 0.3 } }
