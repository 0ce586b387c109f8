#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, 1 pigment { hexagon rgb 0 rgb 1 rgb x } normal { brick 0.5 } }
sphere { 0, 1 pigment { brick rgb 0 rgb 1 brick_size <3, 1, 1> mortar 0.1 } }
sphere { 0, 1 pigment { square rgb 0 rgb 1 rgb x rgb y } }
sphere { 0, 1 pigment { triangular rgb 0 rgb 1 rgb x rgb y rgb z rgb 1 } }
sphere { 0, 1 pigment { cubic rgb 0 rgb 1 rgb x rgb y rgb z rgb 1 } }
sphere { 0, 1 pigment { average pigment_map { [1 rgb 0] [2 rgb 1] } } }
sphere { 0, 1 pigment { gradient x colour_map { [0 rgb 0] [1 rgb 1] } quick_color rgb 1 } }
sphere { 0, 1 pigment { rgb 1 quick_colour rgb x } normal { agate 0.5 bump_size 2 no_bump_scale accuracy 0.01 } }
sphere { 0, 1 normal { gradient x 0.5 slope_map { [0 <0, 1>] [1 <1, 1>] } } }
sphere { 0, 1 pigment { object { box { 0, 1 } rgb 0 rgb 1 } } }
sphere { 0, 1 normal { facets coords 0.5 } }
sphere { 0, 1 normal { gradient x normal_map { [0 bumps 1] [1 dents 1] } } }
sphere { 0, 1 texture { gradient x texture_map { [0 pigment { rgb 1 }] [1 pigment { rgb x }] } } }
sphere { 0, 1 texture { tiles { texture { pigment { rgb 1 } } tile2 texture { pigment { rgb x } } } } }
sphere { 0, 1 uv_mapping pigment { uv_mapping checker rgb 1 rgb 0 } }
