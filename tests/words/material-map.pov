#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, 1 texture { material_map { function 8, 8 { x } texture { pigment { rgb 1 } } texture { pigment { rgb x } } } } }
