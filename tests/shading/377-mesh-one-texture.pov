// expect: 8 9 0.246723 0.473503 0.083772
// expect: 10 14 0.481300 0.307179 0.108492
// expect: 12 6 0.249332 0.421775 0.078462
// expect: 7 14 0.039994 0.039994 0.039994
// expect: 9 18 0.039994 0.039994 0.039994
// expect: 19 11 0.545556 0.484947 0.060624
// expect: 21 9 0.551949 0.490623 0.061326
// expect: 23 8 0.554650 0.493019 0.061631
// expect: 20 13 0.059831 0.119661 0.418814
// expect: 18 12 0.542245 0.482002 0.060243
// expect: 22 12 0.060136 0.120287 0.420996
// expect: 24 9 0.550744 0.489555 0.061189
// expect: 2 2 0.239261 0.239261 0.239261
// expect: 29 20 0.229496 0.229496 0.229496
// size: 32 24
// tol: abs 0.0004 rel 0.002
// about: meshes all of whose faces have one texture
#version 3.7;
global_settings { assumed_gamma 1.0 }
#declare T = texture { pigment { gradient y color_map { [0 rgb <.1,1,.1>] [1 rgb <1,.4,.2>] } scale 1.3 }
  finish { ambient .1 diffuse .7 specular .4 reflection .1 } }
#declare Tile = texture { uv_mapping pigment { checker rgb <.9,.8,.1> rgb <.1,.2,.7> scale .5 } }
mesh2 { vertex_vectors { 4, <-1,-1,0>, <1,-1,0>, <1,1,.3>, <-1,1,0> }
  texture_list { 1, texture { T } } face_indices { 2, <0,1,2>,0, <0,2,3>,0 }
  pigment { rgb <1,0,1> } scale <1,2,1> rotate <10,20,30> translate -1.3*x }
mesh { triangle { <-1,-1,0>, <1,-1,0>, <0,1,0> uv_vectors <0,0>, <1,0>, <.5,1> texture { Tile } }
  triangle { <1,-1,0>, <2,1,0>, <0,1,0> uv_vectors <1,0>, <1,1>, <.5,1> texture { Tile } }
  rotate -15*y translate <1.1,.3,0> }
plane { -z, -3 pigment { rgb .4 } }
camera { location <0,1,-6> look_at 0 }
light_source { <5,10,-15> rgb 1 }
