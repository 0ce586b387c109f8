#version 3.7;
global_settings { assumed_gamma 1 }
global_settings { photons {
  spacing 0.1 gather 20, 100 autostop 0 expand_thresholds 0.2, 40 jitter 1 max_trace_level 5 adc_bailout 0.01 radius 0.1
} }
light_source { 10, rgb 1 photons { refraction on reflection off } }
sphere { 0, 1 photons { target reflection on collect off } }
