#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, .3, -5> look_at 0 }
light_source { <3, 5, -7>, 1 }
difference { sphere { 0, 1 } sphere { <1, 0, 0>, 1e308 } scale 2 pigment { rgb 1 } }
