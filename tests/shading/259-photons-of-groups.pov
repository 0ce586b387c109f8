// expect: 7 0 0.374487 0.280873 0.187243
// expect: 8 0 0.374487 0.280873 0.187243
// expect: 7 1 0.389975 0.292470 0.194980
// expect: 8 1 0.386099 0.289570 0.193057
// expect: 7 2 0.089006 0.066758 0.044511
// expect: 8 2 0.061921 0.046433 0.030961
// expect: 7 3 0.100618 0.075456 0.050309
// expect: 8 3 0.065782 0.049348 0.032898
// expect: 7 4 0.108354 0.081270 0.054185
// expect: 8 4 0.077394 0.058045 0.038697
// expect: 7 5 0.085130 0.063859 0.042573
// expect: 8 5 0.058045 0.043534 0.029023
// expect: 7 6 0.030961 0.023224 0.015473
// expect: 8 6 0.027085 0.020310 0.013550
// expect: 7 7 0.011612 0.008713 0.005798
// expect: 8 7 0.011612 0.008713 0.005798
// expect: 7 8 0.366751 0.275059 0.183368
// expect: 8 8 0.366751 0.275059 0.183368
// expect: 7 9 0.366751 0.275059 0.183368
// expect: 8 9 0.366751 0.275059 0.183368
// size: 16 10
// tol: abs 0.03 rel 0.08
// about: photons of unions and light groups beside those of their parts, targets that pass, lights that do not light a group. Statistical.
#version 3.7;
global_settings { assumed_gamma 1.0 photons { spacing 0.005 } }
camera { orthographic location <0,0,-10> direction z right 8*x up 5*y }
light_source { <-30,0,-40>, rgb 1 parallel point_at 0 }
plane { -z, 0 pigment { rgb <0.8,0.6,0.4> } finish { ambient 0 diffuse 0.7 } }
#macro Lens(Y) sphere { <-1.5,Y,-2>, 0.45 pigment { rgbt <1,1,1,0.9> } finish { ambient 0 diffuse 0 } interior { ior 1.4 } #end
union { Lens(2) photons { target refraction on } } photons { refraction off } }
union { Lens(1) photons { refraction on } } photons { target } }
light_group { Lens(0) photons { refraction off } } photons { target refraction on } global_lights on }
light_group { Lens(-1) photons { target refraction on } } global_lights off }
Lens(-2) photons { target refraction on } photons { refraction off pass_through } }
