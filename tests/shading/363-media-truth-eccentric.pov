// expect: 0 0 0.320494 0.526104 0.777451
// expect: 1 0 0.320494 0.526104 0.777451
// expect: 0 1 0.320494 0.526104 0.777451
// expect: 1 1 0.320494 0.526104 0.777451
// size: 2 2
// tol: abs 0.0001 rel 0.005
// about: Truth as in 360 for type 5 with eccentricity 0.4 and extinction 0.5.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
background { rgb <0.3,0.6,0.9> }
light_source { <0,0,-50>, rgb <1,0.9,0.5> parallel point_at 0 }
box { <-3,-3,-2>, <3,3,2> hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { method 2 intervals 20 samples 10 absorption rgb 0.02 scattering { 5, rgb <0.1,0.15,0.05> eccentricity .4 extinction .5 } } } }
