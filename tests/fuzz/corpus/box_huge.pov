// A box wider than single precision holds: no corner of it lies among the tree's boxes.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 }
light_source { <3, 4, -5>, rgb 1 }
plane { z, 6 pigment { rgb 0.5 } }
box { 1e308, 2 pigment { rgbt 1 } }
sphere { <0.8, 0.8, -0.5>, 0.5 pigment { rgb 1 } }
