#version 3.7;
global_settings { assumed_gamma 1 }
global_settings { mm_per_unit 10 subsurface { samples 10, 10 radiosity off } }
sphere { 0, 1 finish { subsurface { translucency 0.5 } } interior { ior 1.5 } }
