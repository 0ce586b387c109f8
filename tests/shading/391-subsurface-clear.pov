// expect: 1 1 0.695247 0.929878 0.996359
// expect: 2 3 0.695752 0.930011 0.996394
// size: 4 4
// tol: abs 0.001 rel 0.002
// about: What lies behind a body is seen through it, weakened by the way alone.
#version 3.7;
global_settings { assumed_gamma 1.0 mm_per_unit 1 subsurface { samples 20,20 } }
camera { location <0,3,-20> look_at 0 right x up y angle 2 }
box { <-10,-2,-10>, <10,-1.001,10> pigment { rgb 1 } finish { ambient 0 diffuse 0 emission 1 } }
box { <-10,-1,-10>, <10,0,10> pigment { rgb .5 } finish { ambient 0 diffuse 0.8 subsurface { translucency rgb <4,20,400> } } interior { ior 1.5 } }
