// expect: 11 4 0.25 0.5 0.75
// expect: 12 8 0.25 0.5 0.75
// expect: 7 9 0.25 0.5 0.75
// expect: 20 13 0.25 0.5 0.75
// expect: 21 14 0.25 0.5 0.75
// expect: 24 20 0.25 0.5 0.75
// expect: 6 16 0.25 0.5 0.75
// expect: 13 18 0.25 0.5 0.75
// expect: 10 19 0.25 0.5 0.75
// tol: abs 1e-6 rel 1e-6
// size: 32 24
// about: A clear ball in an opaque block, a clear rod and a clear ring in grooves, and a clear paraboloid: where their faces lie in those of opaque objects these are seen, nothing behind.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }
camera { location <0, 9, -6> look_at <0, 0, 0> angle 38 }
#declare Glow = texture { pigment { rgb <.25, .5, .75> } finish { ambient 0 diffuse 0 emission 1 } }
#declare Clear = texture { pigment { rgbt 1 } finish { ambient 0 diffuse 0 } }
#macro Within(Solid, Again, Place)
  difference { box { <-1.2, -1.3, -1.2>, <1.2, 0, 1.2> } object { Solid } texture { Glow } interior_texture { pigment { rgb x } finish { ambient 1 diffuse 0 } } translate Place }
  object { Again texture { Clear } interior { ior 1.3 } translate Place }
#end
Within(sphere { 0, 1 scale <1, 1.2, 1> rotate 31*y }, sphere { 0, 3 scale <1, 1.2, 1> rotate 51*y scale 1/3 rotate -20*y }, <-1.4, 0, 1.4>)
Within(cylinder { -.9*x, .9*x, .8 rotate 7*y }, cylinder { -3*x, 3*x, 2.4 scale <.3, 1/3, 1/3> rotate -43*y rotate 50*y }, <1.4, 0, 1.4>)
Within(torus { .7, .35 rotate 5*x}, torus { 1.4, .7 rotate 50*x scale .5 rotate -45*x }, <-1.4, 0, -1.4>)
Within(intersection { quadric { <1, 0, 1>, 0, -y, -1 } plane { y, 1 } rotate 13*z }, intersection { quadric { <1, 0, 1>, 0, -9*y, -9 scale <1/3, 1, 1/3> scale <3, 3, 3> scale 1/3 rotate -27*z rotate 40*z } sphere { 0, 1.2 } }, <1.4, 0, -1.4>)
