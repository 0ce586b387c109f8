#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
light_source { <2,3,-4>, rgb <1,0.9,0.5> }
light_group { light_source { <-3,2,-4>, rgb <0.2,0.4,1> } box { <-2,-2,0>, <0,2,1> pigment { rgb <0.8,0.6,0.4> } finish { ambient 0 diffuse 0.7 } } global_lights on }
box { <0,-2,0>, <2,21e999,1> pigment { rgb <0.8,0.6,0.4> } finish { ambient 0 diffuse 0.7 } }
