// expect: 0 0 0.339086 0.315175 0.291264
// expect: 1 0 0.146654 0.135988 0.125322
// expect: 2 0 0.389090 0.360174 0.331258
// expect: 3 0 0.399786 0.369802 0.339834
// expect: 4 0 0.157366 0.145617 0.133883
// expect: 0 1 0.334524 0.311070 0.287617
// expect: 1 1 0.124407 0.115419 0.106432
// expect: 2 1 0.196963 0.182422 0.167895
// expect: 3 1 0.337423 0.312306 0.287190
// expect: 4 1 0.154025 0.142626 0.131228
// expect: 0 2 0.129335 0.120409 0.111467
// expect: 1 2 0.272343 0.253742 0.235142
// expect: 2 2 0.074968 0.069535 0.064103
// expect: 3 2 0.127962 0.118624 0.109285
// expect: 4 2 0.365911 0.339330 0.312734
// expect: 0 3 0.240925 0.216831 0.192737
// expect: 1 3 0.165133 0.148623 0.132097
// expect: 2 3 0.248249 0.223423 0.198596
// expect: 3 3 0.377966 0.340169 0.302373
// expect: 4 3 0.380407 0.342367 0.304326
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A shadow through a density by method 2.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb <1,.9,.8> }
box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { method 2 samples 3 intervals 4 absorption .5 density { spherical color_map { [0 rgb 0][1 rgb 1] } scale 1.8 } } }  }
plane { y,-2.5 hollow pigment { rgb .7 } finish { ambient 0 diffuse .8 } }
