// expect: 1 1 0.617350 0.614496 0.542336
// expect: 2 1 0.842222 0.873960 0.777783
// expect: 1 2 0.363882 0.301167 0.254047
// expect: 2 2 0.556359 0.534325 0.475502
// size: 4 4
// tol: abs 0.004 rel 0.03
// about: As 255 with 500 samples of each kind, which leave an error of a percent or two.
#version 3.7;
global_settings { assumed_gamma 1.0 mm_per_unit 10 subsurface { samples 500,500 } }
camera { location <0,0,-4> look_at 0 right x up y angle 40 }
light_source { <3,4,-6>, rgb 2 }
sphere { 0, 1 pigment { rgb <0.8,0.6,0.5> } finish { ambient 0 diffuse 0.8 subsurface { translucency rgb <3,1.5,1> } } interior { ior 1.3 } }
