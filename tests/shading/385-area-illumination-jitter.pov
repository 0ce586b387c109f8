// size: 4 3
// expect: 0 0 .1 .2 .3
// about: area_illumination whose points jitter, and a parallel one, which lanes leave to the general rule.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,4,-8> look_at <0,0.5,0> right x*4/3 }
light_source { <4,5,-4>, rgb .4 parallel point_at 0 area_light x,z,3,3 area_illumination on }
light_source { <-4,5,-4>, rgb <.5,.4,.3> area_light 2*x,2*z,3,3 adaptive 1 jitter area_illumination on }
plane { y,-1 pigment { checker rgb .9 rgb <.6,.8,.5> } finish { ambient 0 diffuse .8 } }
sphere { 0,1 pigment { rgb <.9,.4,.3> } normal { bumps .5 scale .3 } finish { ambient 0 diffuse .7 phong .5 } }
plane { z,6 pigment { rgb <.1,.2,.3> } finish { ambient 0 diffuse 0 emission 1 } }
