// expect: 0 0 0.365936 0.413652 0.323069
// expect: 1 0 0.365936 0.413652 0.323069
// expect: 0 1 0.365936 0.413652 0.323069
// expect: 1 1 0.365936 0.413652 0.323069
// size: 2 2
// tol: abs 0.0002 rel 0.002
// about: Truth: m (1 - exp(-E l)) / E. The parts of method 3 count from their near ends: off by E l / (2 parts), here 0.0014 of the light.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
background { rgb <0.3,0.6,0.9> }
box { <-3,-3,-2>, <3,3,2> hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { absorption rgb <.1,.3,.7> emission rgb <.05,.1,.2> samples 2000 } } }
