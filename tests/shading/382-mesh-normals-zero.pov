// expect: 0 0 0.000000 0.497627 0.000000
// expect: 1 0 0.000000 0.492653 0.000000
// expect: 2 0 0.000000 0.550057 0.000000
// expect: 3 0 0.139010 0.000000 0.000000
// expect: 4 0 0.349920 0.000000 0.000000
// expect: 5 0 0.404242 0.000000 0.000000
// expect: 0 1 0.000000 0.197223 0.000000
// expect: 1 1 0.000000 0.435065 0.000000
// expect: 2 1 0.000000 0.100008 0.000000
// expect: 3 1 0.523201 0.000000 0.000000
// expect: 4 1 0.410498 0.000000 0.000000
// expect: 5 1 0.104448 0.000000 0.000000
// expect: 0 2 0.000000 0.000000 0.100008
// expect: 1 2 0.200000 0.200000 0.200000
// expect: 2 2 0.200000 0.200000 0.200000
// expect: 3 2 0.200000 0.200000 0.200000
// expect: 4 2 0.200000 0.200000 0.200000
// expect: 5 2 0.200000 0.200000 0.200000
// expect: 0 3 0.000000 0.000000 0.303319
// expect: 1 3 0.000000 0.000000 0.301091
// expect: 2 3 0.200000 0.200000 0.200000
// expect: 3 3 0.200000 0.200000 0.200000
// expect: 4 3 0.200000 0.200000 0.200000
// expect: 5 3 0.200000 0.200000 0.200000
// size: 6 4
// tol: abs 0.0002 rel 0.0006
// about: a normal <0,0,0> in a mesh is <1,0,0>; a smooth_triangle one of whose normals is square to it is not drawn.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0,0,-10> direction z right 6*x up 4*y }
light_source { <-20,30,-40>, rgb <1,0.9,0.5> }
background { rgb 0.2 }
mesh {
  smooth_triangle { <-3,0,0>, <0,0,0>, <-3,2,0>, -z, <-0.1,0,0>, -z }
  smooth_triangle { <-3,2,0>, -z, <-0.1,0,0>, <0,1e-11,0>, <-0.1,2,0>, -z-x }
  pigment { rgb y }
}
mesh2 {
  vertex_vectors { 4, <0,0,0>, <3,0,0>, <3,2,0>, <0,2,0> }
  normal_vectors { 3, -z, <0,0,0>, <1,1,-1> }
  face_indices { 2, <0,1,2>, <0,2,3> }
  normal_indices { 2, <0,1,2>, <0,2,1> }
  pigment { rgb x }
}
smooth_triangle { <-3,-2,0>, -z, <0,-2,0>, -z, <-3,0,0>, x pigment { rgb 1 } }
smooth_triangle { <-3,-2,1>, -z, <0,-2,1>, -z, <-3,0,1>, x-z pigment { rgb z } }
smooth_triangle { <0,-2,0>, <0,0,0>, <3,-2,0>, -z, <3,0,0>, -z pigment { rgb 1 } }
