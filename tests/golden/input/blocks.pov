#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 7 }
camera { location <0, 2, -6> look_at 0 angle 40 }
light_source { <10, 20, -30>, rgb <1, 0.9, 0.8> spotlight radius 20 falloff 25 }
background { rgb 0.25 }
#declare Skin = texture {
  pigment { gradient y color_map { [0 rgb 0] [0.5 rgbt <1, 1, 0, 0.5>] [1 rgb 1] } }
  normal { bumps 0.25 scale 0.5 }
  finish { phong 0.75 reflection { 0.25 } }
}
sphere { 0, 1 texture { Skin } translate <1, 0, 0> no_shadow }
plane { y, -1 pigment { checker rgb 1 rgb 0 scale 2 } hollow }
