#version 3.7;
global_settings { assumed_gamma 1 }
light_source { 5, rgb 1 area_light x, y, 3, 3 adaptive 1 jitter circular orient area_illumination on }
light_source { 5, rgb 1 spotlight point_at 0 radius 10 falloff 20 tightness 2 }
light_source { 5, rgb 1 cylinder point_at 0 parallel fade_distance 3 fade_power 2 }
light_source { 5, rgb 1 shadowless media_attenuation on media_interaction off looks_like { sphere { 0, 1 } } }
light_source { 5, rgb 1 projected_through { sphere { 3, 1 } } }
light_group { light_source { 5, rgb 1 } sphere { 0, 1 } global_lights on }
