// expect: 0 0 0.204987 0.153740 0.102493
// expect: 1 0 0.213090 0.159818 0.106545
// expect: 2 0 0.213090 0.159818 0.106545
// expect: 3 0 0.204987 0.153740 0.102493
// expect: 0 1 0.213090 0.159818 0.106545
// expect: 1 1 0.221744 0.166308 0.110872
// expect: 2 1 0.221744 0.166308 0.110872
// expect: 3 1 0.213090 0.159818 0.106545
// expect: 0 2 0.213090 0.159818 0.106545
// expect: 1 2 0.221744 0.166308 0.110872
// expect: 2 2 0.221744 0.166308 0.110872
// expect: 3 2 0.213090 0.159818 0.106545
// expect: 0 3 0.204987 0.153740 0.102493
// expect: 1 3 0.213090 0.159818 0.106545
// expect: 2 3 0.213090 0.159818 0.106545
// expect: 3 3 0.204987 0.153740 0.102493
// size: 4 4
// tol: abs 0.002 rel 0.06
// about: Truth: photons through a slab of ior 1.0001 bring the light of a lamp that fades, cos a * 2 / (1 + (d / 4)^2) of it.
#version 3.7;
global_settings { assumed_gamma 1.0 photons { spacing 0.03 } }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
light_source { <0,0,-8>, rgb 1 fade_distance 4 fade_power 2 }
plane { -z, 0 pigment { rgb <0.8,0.6,0.4> } finish { ambient 0 diffuse 0.7 } }
box { <-3,-3,-3>, <3,3,-2> pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { ior 1.0001 } photons { target refraction on reflection off } }
