#version 3.7;
global_settings { assumed_gamma 1 }
camera { perspective location -5 * z right x up y direction z sky y angle 40 look_at 0
  aperture 0.1 blur_samples 4 focal_point 0 confidence 0.9 variance 0.01 }
