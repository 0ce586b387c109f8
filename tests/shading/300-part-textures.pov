// expect: 9 6 0.167910 0.297124 0.259327
// expect: 7 9 0.492378 0.198795 0.222599
// expect: 11 9 0.169070 0.459297 0.203861
// expect: 8 8 0.250599 0.232822 0.127245
// expect: 5 7 0.397177 0.528389 0.397177
// expect: 4 6 0.353826 0.527764 0.353826
// expect: 14 6 0.249226 0.249226 0.249226
// expect: 10 10 0.241199 0.423011 0.130602
// expect: 20 9 0.439124 0.597070 0.439124
// expect: 21 6 0.488045 0.608682 0.488045
// expect: 23 8 0.615305 0.262943 0.337881
// expect: 25 9 0.350149 0.398322 0.197452
// expect: 19 7 0.251926 0.251926 0.251926
// expect: 22 10 0.698207 0.296712 0.289418
// expect: 15 17 0.263142 0.030610 0.039338
// expect: 16 17 0.088090 0.039643 0.105653
// expect: 17 16 0.382040 0.382040 0.382040
// expect: 18 17 0.025971 0.025971 0.025971
// expect: 19 16 0.593469 0.593469 0.593469
// expect: 12 17 0.589853 0.062623 0.062623
// expect: 16 14 0.226841 0.226841 0.362722
// size: 32 24
// tol: abs 0.0004 rel 0.002
// about: textures of single triangles, blends of three, components of a blob
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare R = texture { pigment { rgb <1,.1,.1> } finish { ambient .1 diffuse .7 specular .4 } }
#declare G = texture { pigment { gradient x color_map { [0 rgb <.1,1,.1>] [1 rgb 1] } scale 3 } }
#declare B = texture { pigment { rgbt <.1,.1,1,.5> } }
mesh { triangle { <-1,-1,0>, <1,-1,0>, <0,1,0> texture_list { R G B } }
  triangle { <-1,-1,0>, <-2,1,0>, <0,1,0> texture { G } }
  triangle { <1,-1,0>, <2,1,0>, <0,1,0> }
  pigment { rgb <1,1,0> } translate <-2,1.3,0> rotate 10*y }
mesh2 { vertex_vectors { 4, <-1,-1,0>, <1,-1,0>, <1,1,0>, <-1,1,0> }
  texture_list { 3, texture { R } texture { G } texture { B } }
  face_indices { 2, <0,1,2>,0,1,2, <0,2,3>,1 } translate <2,1.3,0> }
blob { threshold .5
  sphere { <-.7,0,0>, 1, 1 texture { R } }
  sphere { <.7,0,0>, 1, 1 pigment { gradient y color_map { [0 rgb 1] [1 rgb 0] } scale 2 } scale <1,1.4,1> translate .2*y }
  cylinder { <0,-1,0>, <0,1,0>, .4, 1 texture { B } translate .2*x }
  pigment { rgb <0,1,1> } translate -1.3*y }
plane { -z, -3 pigment { rgb .4 } }
camera { location <0,1,-6> look_at 0 }
light_source { <5,10,-15> rgb 1 }
