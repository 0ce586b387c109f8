// expect: 2 3 0.101625 0.141970 0.165850
// size: 4 4
// tol: abs 0.01 rel 0.04
// about: A thin plate lit from behind and, by a spotlight, from the front.
#version 3.7;
global_settings { assumed_gamma 1.0 mm_per_unit 10 subsurface { samples 9000,1000 } }
camera { location <0,0,-4> look_at 0 right x up y angle 40 }
light_source { <3,2,5>, rgb 3 }
light_source { <-3,4,-2>, rgb <.2,.4,.8> spotlight point_at 0 radius 10 falloff 20 }
box { <-1,-1,-.1>, <1,1,.1> pigment { rgb <0.9,0.8,0.7> } finish { ambient 0 diffuse 0.8 specular .2 subsurface { translucency rgb <9,5,3> } } interior { ior 1.4 } rotate <20,30,0> }
