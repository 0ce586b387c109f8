// expect: 18 6 0.25 0.5 0.75
// expect: 22 7 0.25 0.5 0.75
// expect: 14 9 0.25 0.5 0.75
// expect: 17 9 0.25 0.5 0.75
// expect: 26 16 0.25 0.5 0.75
// expect: 9 6 0.25 0.5 0.75
// expect: 3 4 0.25 0.5 0.75
// tol: abs 1e-6 rel 1e-6
// size: 32 24
// about: Blocks of glass on a table and in a frame: where their faces lie in those of opaque objects these are seen, nothing behind.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
camera { location <0, 9, -9> look_at <0, .8, 0> angle 40 }
#declare Glow = texture { pigment { rgb <.25, .5, .75> } finish { ambient 0 diffuse 0 emission 1 } }
#declare Clear = texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 } }
plane { y, 0 texture { Glow } }
difference { box { <-2.3, .1, -1.7>, <2.3, 1.7, 1.9> } box { <-1.3, -1, -1.1>, <1.3, 3, 1.3> } texture { Glow } rotate 31*y }
box { <-1.3, 0, -1.1>, <1.3, 2.1, 1.3> texture { Clear } interior { ior 1.3 } rotate 31*y }
box { <-.4, -.7, -.3>, <.4, .7, .3> texture { Clear } interior { ior 1.2 } rotate -40*y translate <-3.1, .7, -1> }
box { <-.4, -.7, -.3>, <.4, .7, .3> texture { Clear } interior { ior 1.2 } rotate 20*y translate <3.1, .7, -1> }
