#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, 1 pigment { image_map { function 8, 8 { x } map_type 1 once interpolate 2 filter all 0.1 transmit all 0.1 } } }
sphere { 0, 1 normal { bump_map { function 8, 8 { x } bump_size 2 use_color } } }
sphere { 0, 1 normal { bump_map { function 8, 8 { x } use_colour } } }
sphere { 0, 1 pigment { image_pattern { function 8, 8 { x } use_alpha } } }
