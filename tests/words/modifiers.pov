#version 3.7;
global_settings { assumed_gamma 1 }
#declare I = interior { ior 1.5 caustics 0.5 dispersion 1.02 dispersion_samples 7 fade_color rgb 1 fade_distance 2 fade_power 1 }
#declare J = interior { ior 1.5 fade_colour rgb 1 }
sphere { 0, 1 texture { pigment { rgb 1 } } interior_texture { pigment { rgb x } } interior { I }
  no_image no_reflection no_shadow no_radiosity double_illuminate hollow inverse dtag "a" radiosity { importance 0.5 } }
sphere { 0, 1 bounded_by { box { -1, 1 } } clipped_by { bounded_by } matrix <1,0,0, 0,1,0, 0,0,1, 0,0,0> interior { J } }
difference { box { -1, 1 } sphere { 1, 1 } cutaway_textures }
union { box { -1, 1 } sphere { 1, 1 } split_union off }
