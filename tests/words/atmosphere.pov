#version 3.7;
global_settings { assumed_gamma 1 }
fog { fog_type 2 distance 10 rgbt <1, 1, 1, 0.1> fog_offset 1 fog_alt 2 up y turbulence 0.5 turb_depth 0.5 octaves 2 lambda 2 omega 0.5 }
rainbow { angle 30 width 5 distance 10 direction z jitter 0.1 falloff_angle 20 arc_angle 100 up y color_map { [0 rgbt 1] [1 rgbt 0.5] } }
sky_sphere { pigment { gradient y color_map { [0 rgb 0] [1 rgb z] } } emission rgb 1 }
background { rgb 1 }
