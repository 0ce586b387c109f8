// expect: 4 0 0.25 0.5 0.75
// expect: 4 3 0.25 0.5 0.75
// expect: 4 4 0 0 0
// expect: 4 7 0 0 0
// tol: abs 1e-6 rel 1e-6
// size: 9 8
// about: A column that a height field clips ends at the field's bottom, y = 0, not at minus infinity.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0, .05, -9> direction z right 2*x up 2*y }
cylinder {
  -5*y, 5*y, .4 open
  clipped_by { height_field { function 9, 9 { .9 } translate <-.5, 0, -.5> scale <1, 1.2, 1> } }
  pigment { rgb <.25, .5, .75> }
  finish { ambient 0 diffuse 0 emission 1 }
}
