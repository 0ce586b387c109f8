#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, 1 pigment { gradient x
  warp { repeat x flip y offset <1, 0, 0> }
  warp { black_hole 0, 1 falloff 2 strength 1.5 inverse turbulence 0.1 }
  warp { turbulence 0.5 octaves 2 lambda 2 omega 0.5 }
  warp { cylindrical orientation z dist_exp 1 }
  warp { spherical } warp { planar z, 0 } warp { toroidal major_radius 2 }
  warp { cubic }
} }
