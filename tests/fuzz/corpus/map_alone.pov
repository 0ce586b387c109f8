#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -4*z look_at 0 }
light_source { <2, 4, -5>, 1 }
sphere { 0, 1 pigment { color_map { [0 rgb 0] [1 rgb <1, 0, 0>] } } }
sphere { x, 1 pigment { pigment_map { [0 rgb 0] [1 rgb <1, 0, 0>] } } }
