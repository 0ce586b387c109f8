#version 3.7;
global_settings { assumed_gamma 1 }
media { absorption 0.1 emission 0.1 scattering { 5, 0.1 eccentricity 0.5 extinction 0.9 } intervals 2 samples 3, 5 method 3
  ratio 0.9 confidence 0.9 variance 0.01 aa_level 3 aa_threshold 0.1 jitter 0.1
  density { spherical density_map { [0 rgb 0] [1 rgb 1] } } }
