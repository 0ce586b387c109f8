// about: Everything random in media at once: for the test that compares threads, tiles and instruction sets.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
light_source { <3,4,-5>, rgb 1 area_light x*2,y*2,2,2 jitter }
light_source { <2,3,0>, rgb 1 spotlight point_at 0 radius 12 falloff 18 media_attenuation on }
media { scattering { 1, .01 } samples 4 jitter .5 }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 }
  interior {
    media { method 1 samples 2,4 intervals 2 emission .1 scattering { 5, .2 eccentricity .3 } density { spherical scale 2 } }
    media { absorption .1 density { wrinkles } } } }
