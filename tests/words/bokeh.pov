#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5 * z look_at 0 aperture 0.1 blur_samples 4 focal_point 0 bokeh { pigment { rgb 1 } } }
