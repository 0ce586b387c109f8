// expect: 0 0 0.092760 0.017395 0.001831
// expect: 1 0 0.949722 0.178073 0.018738
// expect: 3 0 0.143572 0.107683 0.071794
// expect: 0 1 0.942565 0.176730 0.018601
// expect: 1 1 0.651377 0.120195 0.012924
// expect: 2 1 0.969909 0.727428 0.484962
// expect: 0 2 0.974090 0.182635 0.019226
// expect: 1 2 0.654978 0.120836 0.013001
// expect: 2 2 0.980392 0.735302 0.490196
// expect: 0 3 0.092424 0.017334 0.001831
// expect: 1 3 0.957275 0.179492 0.018891
// expect: 3 3 0.144930 0.108690 0.072465
// size: 4 4
// tol: abs 0.03 rel 0.08
// about: A coloured pane with pass_through before the target: photons pass it straight, filtered. Statistical.
#version 3.7;
global_settings { assumed_gamma 1.0 photons { spacing 0.01 } }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
light_source { <0,0,-18>, rgb 1 }
plane { -z, 0 pigment { rgb <0.8,0.6,0.4> } finish { ambient 0 diffuse 0.7 } }
sphere { <0,0,-12>, 1 pigment { rgbt <1,1,1,1> } finish { ambient 0 diffuse 0 } interior { ior 1.02 } photons { target refraction on reflection off } }
box { <-3,-3,-14>,<0,3,-13.9> pigment { rgbf <1,.5,.2,.8> } finish { ambient 0 diffuse 0 } photons { pass_through } }
