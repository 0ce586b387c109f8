// expect: 1 1 0.125 0.125 0.125
// expect: 4 6 0.25 0.5 0.75
// expect: 7 7 0.25 0.5 0.75
// tol: abs 1e-6 rel 1e-6
// size: 8 8
// about: A clear half space among finite and infinite opaque objects: of two planes in one place the opaque one is seen.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
camera { location <0, 3, -9> look_at <0, 1.5, 0> angle 40 }
background { rgb .125 }
#declare Glow = texture { pigment { rgb <.25, .5, .75> } finish { ambient 0 diffuse 0 emission 1 } }
plane { y, 0 texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 } } }
plane { <1, 1, 1>, -500 texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 } } }
plane { y, 0 texture { Glow } }
#for (I, 0, 8) box { I*x - 30*z, I*x + <.5, .5, -29.5> texture { Glow } } #end
sphere { 100*z, 1 texture { Glow } }
