// expect: 0 0 0.245619 0.329287 0.221937
// expect: 1 0 0.245619 0.329287 0.221937
// expect: 0 1 0.245619 0.329287 0.221937
// expect: 1 1 0.245619 0.329287 0.221937
// size: 2 2
// tol: abs 0.00002 rel 0.0008
// about: Truth: a density from 0 to 1 over 4 units; method 2 takes middles, which is exact for it.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
background { rgb <0.3,0.6,0.9> }
box { <-3,-3,-2>, <3,3,2> hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { method 2 samples 8 absorption rgb <.1,.3,.7> density { function { (z+2)/4 } color_map { [0 rgb 0][1 rgb 1] } } } } }
