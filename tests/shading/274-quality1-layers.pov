// expect: 0 0 1.000000 0.000000 0.250000
// size: 1 1
// options: +Q1
// tol: abs 0.0002 rel 0.0006
// about: +Q1: of layers the lowest that is seen, whatever lies over it.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
light_source { <2,3,-4>, rgb <1,0.9,0.5> }
plane { -z, 0
  texture { pigment { rgb <0,0,1> } }
  texture { pigment { rgb <1,0,0.25> } }
  texture { pigment { rgbt <0,1,0,0.6> } }
  texture { pigment { rgbf <0.5,1,0,0.2> } }
}
