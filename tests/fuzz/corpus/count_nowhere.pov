// A count that is no number: not as many rays as fit into an integer.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { count 1e999 - 1e999 } }
camera { location <0, 0, -4> look_at 0 }
light_source { <3, 3, -5>, rgb 1 }
sphere { 0, 1 pigment { rgb 1 } }
plane { y, -1 pigment { rgb 1 } }
