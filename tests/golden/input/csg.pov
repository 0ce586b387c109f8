#version 3.7;
global_settings { assumed_gamma 1 }
#declare Ball = sphere { 0, 1 }
#declare Cut = difference {
  box { -1, 1 }
  union { object { Ball } cylinder { -2 * z, 2 * z, 0.5 } }
}
union {
  object { Cut rotate 45 * y }
  intersection { object { Ball } plane { x, 0 inverse } translate 3 * x }
  merge { object { Ball translate x } object { Ball scale <1, 2, 1> } clipped_by { plane { y, 1 } } }
  bounded_by { box { -4, 4 } }
  scale 2
}
blob { threshold 0.5 sphere { 0, 1, 1 } cylinder { 0, y, 0.5, 1 } translate -5 * x }
