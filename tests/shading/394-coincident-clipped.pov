// expect: 1 4 0.25 0.5 0.75
// expect: 2 4 0.25 0.5 0.75
// expect: 3 4 0.25 0.5 0.75
// expect: 4 4 0.5 0.75 0.25
// expect: 6 4 0.75 0.25 0.5
// tol: abs 1e-6 rel 1e-6
// size: 8 8
// about: Planes in one place that are cut off: where two are left the first is seen, also where others end beside them.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location -9*z look_at 0 right 8*x up 8*y }
#macro Cut(Plane, From, To, Color)
  plane { Plane, 0 clipped_by { box { <From, -3, -2>, <To, 3, 2> } } texture { pigment { rgb Color } finish { ambient 0 diffuse 0 emission 1 } } }
#end
Cut(<0, 0, 1>, -4, 0, <.25, .5, .75>)
object { Cut(<0, 0, -1>, -2, 1, <.5, .75, .25>) }
object { Cut(<0, 0, 1>, 1, 4, <.75, .25, .5>) }
intersection { plane { -z, 0 } box { <-1.5, -3, -1>, <0, 3, 1> } texture { pigment { rgb .9 } finish { ambient 0 diffuse 0 emission 1 } } no_shadow }
