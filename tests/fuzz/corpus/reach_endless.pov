// Samples of irradiance so far from the eye that their reach is no number.
#version 3.7;
global_settings { assumed_gamma 1 radiosity { nearest_count 1 pretrace_start 1 pretrace_end 1 count 20 } }
camera { orthographic location <0, 0, -1e308> direction z right .02*x up .02*y }
sphere { <.5, .7, -2>, 1.2 pigment { rgb 1 } finish { emission 3 } no_image }
plane { -z, 0 pigment { rgb .7 } }
