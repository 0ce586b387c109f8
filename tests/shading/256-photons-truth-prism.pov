// expect: 0 0 1.379916 1.034937 0.689958
// expect: 1 0 1.379916 1.034937 0.689958
// expect: 2 0 1.379916 1.034937 0.689958
// expect: 0 1 1.379916 1.034937 0.689958
// expect: 1 1 1.379916 1.034937 0.689958
// expect: 2 1 1.379916 1.034937 0.689958
// expect: 0 2 1.379916 1.034937 0.689958
// expect: 1 2 1.379916 1.034937 0.689958
// expect: 2 2 1.379916 1.034937 0.689958
// size: 3 3
// tol: abs 0.005 rel 0.05
// about: Truth: a prism of ior 1.5 whose exit face is turned by A = 35 degrees sends parallel light off at B = asin(1.5 sin A), in a beam
// about: that the wall meets with cos A cos (B - A) / cos B of the direct light, which comes there too.
#version 3.7;
global_settings { assumed_gamma 1.0 photons { spacing 0.01 } }
camera { orthographic location <-2.2636,0,-2> direction z right 0.6*x up 0.6*y }
light_source { <0,0,-8>, rgb 1 parallel point_at 0 }
plane { -z, 0 pigment { rgb <0.8,0.6,0.4> } finish { ambient 0 diffuse 0.7 } }
intersection { box { <-1.2,-1.2,-6.5>, <1.2,1.2,-3> } plane { <0.573576436,0,0.819152044>, 0 translate -5*z } pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { ior 1.5 } photons { target refraction on reflection off } }
