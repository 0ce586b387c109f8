#version 3.7;
global_settings { assumed_gamma 1 }
global_settings {
  adc_bailout 0.01 ambient_light rgb 1 charset ascii hf_gray_16 off irid_wavelength rgb <0.6, 0.5, 0.4>
  max_intersections 32 max_trace_level 6 mm_per_unit 10 number_of_waves 8 noise_generator 2
}
