// An area light infinitely far away: ways to it have no shaft.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 }
light_source { <1e999, 4, -5>, rgb 1 area_light x*2, y*2, 3, 3 }
plane { z, 6 hollow pigment { rgb 0.5 } }
box { -2, 2 hollow pigment { rgbt 1 } interior { media { scattering { 1, 0.3 } samples 4 } } }
sphere { <0.8, 0.8, -0.5>, 0.5 pigment { rgb 1 } }
