// expect: 0 0 0.646616 0.349248 0.171206
// expect: 1 0 0.531914 0.519280 0.486564
// expect: 2 0 0.799313 0.757702 0.578393
// expect: 3 0 0.581033 0.522423 0.363012
// expect: 0 1 0.406332 0.421210 0.454032
// expect: 1 1 0.299519 0.176394 0.089769
// expect: 2 1 0.204044 0.221057 0.255085
// expect: 3 1 0.586633 0.275639 0.074418
// expect: 0 2 0.341680 0.194705 0.093217
// expect: 1 2 0.300984 0.223941 0.281025
// expect: 2 2 0.154070 0.095537 0.046662
// expect: 3 2 0.447959 0.424109 0.367086
// expect: 0 3 0.203357 0.205295 0.250507
// expect: 1 3 0.206394 0.084184 0.037919
// expect: 2 3 0.283680 0.258030 0.250690
// expect: 3 3 0.578195 0.284092 0.090089
// size: 4 4
// tol: abs 0.0002 rel 0.0006
// about: area lights that are round and turned, spot, parallel, on layers, glass and bumps, in fog.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
fog { distance 30 color rgb <0.3,0.4,0.9> }
light_source { <2,3,-4>, rgb <1,0.9,0.5> area_light 1.5*x,1.5*y,5,5 adaptive 1 circular orient }
light_source { <-3,2,-5>, rgb <0.3,0.4,0.6> spotlight point_at <0,0,0> radius 15 falloff 25 area_light 1*x,1*y,1,7 }
light_source { <0,4,-6>, rgb 0.3 parallel point_at <0,0,0> area_light 1*x,1*z,3,4 adaptive 0 }
plane { z, 0
  texture { pigment { rgb <0.8,0.6,0.4> } finish { ambient 0 diffuse 0.7 } }
  texture { pigment { checker rgbt <0.2,0.5,0.9,0.6>, rgbf <0.9,0.5,0.2,0.5> } finish { ambient 0.1 diffuse 0.5 phong 0.5 phong_size 20 } } }
sphere { <0.6,1.0,-1.5>, 0.8 pigment { rgb 1 } finish { specular 0.4 } }
sphere { <-0.7,-0.8,-1.2>, 0.6 pigment { rgbf <0.9,0.7,0.8,0.8> } normal { bumps 0.4 } finish { ambient 0 reflection 0.2 } }
