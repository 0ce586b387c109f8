// expect: 0 0 0.416884 0.205327 0.102664
// size: 1 1
// tol: abs 0.0002 rel 0.0006
// about: importance 0.3: only the first three tenths of the rays see the sphere, and each that does counts for 1/0.3.
#version 3.7;
global_settings { assumed_gamma 1.0 radiosity { nearest_count 1 pretrace_start 1 pretrace_end 1 count 50 recursion_limit 1 } }
camera { orthographic location <0,0,-10> direction z right 0.02*x up 0.02*y }
background { rgb <0.1,0.2,0.3> }
sphere { <0.5,0.7,-2>, 1.2 pigment { rgb <1,0.5,0.2> } finish { ambient 0 diffuse 0 emission 3 } radiosity { importance 0.3 } no_image }
plane { -z, 0 pigment { rgb <0.8,0.6,0.4> } finish { ambient 0.5 diffuse 0.7 } }
