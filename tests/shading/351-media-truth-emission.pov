// expect: 0 0 0.500000 1.000000 0.980000
// expect: 1 0 0.500000 1.000000 0.980000
// expect: 0 1 0.500000 1.000000 0.980000
// expect: 1 1 0.500000 1.000000 0.980000
// size: 2 2
// tol: abs 0.00002 rel 0.0006
// about: Truth: 4 units that only glow.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
background { rgb <0.3,0.6,0.9> }
box { <-3,-3,-2>, <3,3,2> hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { emission rgb <.05,.1,.02> } } }
