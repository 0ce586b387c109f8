// A mirror's normal is no number: neither is where the rays of samples go from it.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { count 30 error_bound 0.5 recursion_limit 2 } }
camera { location <0, 1, -4> look_at 0 }
light_source { <3, 3, -5>, rgb 1 }
plane { y, -1 pigment { rgb 0.8 } }
sphere { 0, 1 pigment { rgb 0.5 } finish { reflection 0.4 }
  normal { wood 0.4 normal_map { [-1e308 bumps 0.3 scale 0.1] [0.7 agate 0.2] } bump_size 0.5 } }
