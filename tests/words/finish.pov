#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, 1 finish { ambient 0.1 emission 0.1 diffuse albedo 0.5 brilliance 2 crand 0.1 phong albedo 0.5 phong_size 10
  specular albedo 0.5 roughness 0.1 metallic 0.5 irid { 0.1 thickness 0.5 turbulence 0.5 }
  reflection { 0.1, 0.5 fresnel on falloff 2 exponent 1 metallic 1 } conserve_energy } interior { ior 1.5 } }
sphere { 0, 1 finish { reflection 0.1 reflection_exponent 2 } }
