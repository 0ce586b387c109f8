#version 3.7;
// Two coaxial discs, reflectance .8, one gives off 1 (C4).
global_settings { assumed_gamma 1 }
#macro M(Rho, E) texture { pigment { rgb 1 } finish { ambient 0 diffuse Rho emission E } } #end
camera { location <0, 0, .5> look_at z }
disc { 0, z, 1 M(.8, 1) }
disc { z, z, 1 M(.8, 0) }
