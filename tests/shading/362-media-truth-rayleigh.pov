// expect: 0 0 0.596717 0.775839 0.802621
// expect: 1 0 0.596717 0.775839 0.802621
// expect: 0 1 0.596717 0.775839 0.802621
// expect: 1 1 0.596717 0.775839 0.802621
// size: 2 2
// tol: abs 0.0001 rel 0.005
// about: Truth: single scattering back along the view, s p L (1 - exp(-2 E l)) / (2 E): light and sight cross the same smoke.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
background { rgb <0.3,0.6,0.9> }
light_source { <0,0,-50>, rgb <1,0.9,0.5> parallel point_at 0 }
box { <-3,-3,-2>, <3,3,2> hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { method 2 intervals 20 samples 10 absorption rgb 0.02 scattering { 4, rgb <0.1,0.15,0.05> } } } }
