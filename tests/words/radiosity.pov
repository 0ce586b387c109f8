#version 3.7;
global_settings { assumed_gamma 1 }
global_settings { radiosity {
  always_sample on brightness 1 count 20 error_bound 1 gray_threshold 0.1 low_error_factor 0.5
  max_sample 1 maximum_reuse 0.2 minimum_reuse 0.01 nearest_count 5 pretrace_end 0.04 pretrace_start 0.08
  recursion_limit 1 normal off media off subsurface off adc_bailout 0.01 load_file "a" save_file "b"
} }
