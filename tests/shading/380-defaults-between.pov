// expect: 0 0 0.000000 0.697810 0.000000
// expect: 1 0 0.484092 0.000000 0.000000
// expect: 2 0 0.000000 0.000000 0.639338
// expect: 3 0 0.794491 0.699565 0.639643
// expect: 4 0 0.000000 0.000000 0.639811
// expect: 5 0 0.000000 0.000000 0.000000
// expect: 0 1 0.000000 0.000000 0.000000
// expect: 1 1 0.000000 0.000000 0.000000
// expect: 2 1 0.000000 0.000000 0.000000
// expect: 3 1 0.000000 0.000000 0.000000
// expect: 4 1 0.000000 0.000000 0.000000
// expect: 5 1 0.000000 0.000000 0.000000
// expect: 0 2 0.800214 0.697002 0.000000
// expect: 1 2 0.809644 0.697734 0.000000
// expect: 2 2 0.822080 0.698283 0.000000
// expect: 3 2 0.000000 0.698650 0.638926
// expect: 4 2 0.000000 0.698833 0.639063
// expect: 5 2 0.000000 0.000000 0.000000
// expect: 0 3 0.800092 0.696269 0.000000
// expect: 1 3 0.810071 0.697002 0.000000
// expect: 2 3 0.823621 0.697551 0.000000
// expect: 3 3 0.000000 0.697917 0.638331
// expect: 4 3 0.000000 0.698100 0.638483
// expect: 5 3 0.757351 0.697795 0.000000
// size: 6 4
// tol: abs 0.0002 rel 0.0006
// about: an object without a texture has what #default named when it was written; one that was declared, when it was used.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0,0,-10> direction z right 6*x up 4*y }
light_source { <2,3,-40>, rgb <0.6,0.5,0.4> }
#default { pigment { rgb x } }
#declare Declared = sphere { <-2.5,1.5,0>, 0.9 }
sphere { <-1.5,1.5,0>, 0.9 }
#default { pigment { rgb y } finish { ambient 0.4 } }
object { Declared }
union {
  sphere { <-0.5,1.5,0>, 0.9 }
  #default { pigment { rgb z } }
  sphere { <0.5,1.5,0>, 0.9 pigment { rgb 1 } }
  sphere { <1.5,1.5,0>, 0.9 }
}
#default { texture { pigment { rgb <1,1,0> } } }
box { <-3,-2,0>, <0,0.4,1> }
light_source { 0, rgb <0.2,0,0> looks_like { sphere { 0, 0.9 } } translate <2.5,-1.5,-2> }
#default { pigment { rgb <0,1,1> } }
box { <0,-2,0>, <2,0.4,1> }
