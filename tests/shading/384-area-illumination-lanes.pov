// expect: 2 0 0.292725 0.251221 0.209717
// expect: 7 0 0.104675 0.0965576 0.0883789
// expect: 4 1 0.16333 0.144287 0.125122
// expect: 1 2 0.186646 0.185791 0.184937
// expect: 6 2 0.105835 0.0966797 0.0875854
// expect: 3 3 0.197998 0.0704956 0.0397644
// expect: 0 4 0.50293 0.447266 0.391846
// expect: 5 4 0.447754 0.444824 0.44165
// expect: 2 5 0.335693 0.39502 0.213989
// expect: 7 5 0.314209 0.290039 0.265869
// size: 8 6
// tol: abs 3e-4 rel 1e-3
// about: area_illumination on simple, bumpy and layered surfaces: a grid that fades, a spot, a circular one turned to each point.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,4,-8> look_at <0,0.5,0> right x*4/3 }
light_source { <-4,5,-4>, rgb <.5,.4,.3> area_light 2*x,2*z,3,5 adaptive 0 area_illumination on fade_distance 6 fade_power 2 }
light_source { <4,5,-4>, rgb <.3,.4,.5> spotlight radius 15 falloff 25 point_at 0 area_light x,y,4,4 adaptive 1 circular orient area_illumination on }
light_source { <0,9,0>, rgb .3 area_light x,z,2,3 area_illumination on shadowless }
plane { y,-1 pigment { checker rgb .9 rgb <.6,.8,.5> } finish { ambient 0 diffuse .8 } }
plane { z,5 pigment { rgb .7 } normal { ripples .6 scale 2 } finish { ambient 0 diffuse .6 specular .3 } }
sphere { 0,1 pigment { rgb <.9,.4,.3> } finish { ambient 0 diffuse .7 phong .5 metallic } }
box { <-3,-1,-1>,<-2,1,1> texture { pigment { rgb <.4,.5,.9> } finish { ambient 0 diffuse .7 brilliance 2 } }
  texture { pigment { gradient y color_map { [0 rgbt <1,1,1,1>][1 rgbf <.5,1,.5,.5>] } } finish { ambient 0 diffuse .5 specular .4 irid { .3 } } } }
