// expect: 1 1 0.459404 0.463406 0.479478
// expect: 2 2 0.459007 0.462918 0.478959
// size: 4 4
// tol: abs 0.002 rel 0.02
// about: As 392, with media on.
#version 3.7;
global_settings { assumed_gamma 1.0 radiosity { count 400 media on error_bound .5 recursion_limit 1 pretrace_start .08 pretrace_end .02 } }
camera { location <0,.7,-.1> look_at 0 right x up y angle 20 }
fog { fog_type 1 distance 20 color rgb <.7,.8,.9> }
light_source { <0,4,0> rgb 2 }
cylinder { <0,3.8,0>, <0,3.9,0>, 1 pigment { rgb .5 } finish { ambient 0 diffuse .6 } }
sphere { 0, 8 pigment { rgb .5 } finish { ambient 0 diffuse .6 emission <.2,.1,.05> } hollow }
plane { y, 0 pigment { rgb .8 } finish { ambient 0 diffuse 1 } }
