// expect: 0 0 0.458489 0.276601 0.069047
// expect: 1 0 0.458489 0.276601 0.069047
// expect: 0 1 0.458489 0.276601 0.069047
// expect: 1 1 0.458489 0.276601 0.069047
// size: 2 2
// tol: abs 0.00002 rel 0.0006
// about: Truth: light that crosses 2 units of smoke to a wall; the camera looks past the smoke from within the gap.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
background { rgb <0.3,0.6,0.9> }
light_source { <0,0,-50>, rgb <1,0.9,0.5> parallel point_at 0 }
box { <-3,-3,-14>, <3,3,-12> hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { absorption rgb <.1,.3,.7> } } }
plane { -z, -3 hollow pigment { rgb .7 } finish { ambient 0 diffuse .8 } }
