// Shapes whose points and normals are found eight at a time, as written and moved, turned
// inside out, smooth, at a tip. The picture is compared with that of the general rule.
// size: 8 6
// tol: abs 1e-3 rel 1e-3
// expect: 0 1 0.179400 0.128145 0.076890
// expect: 1 1 0.389364 0.278111 0.166873
// expect: 2 1 0.537758 0.384726 0.231693
// expect: 3 1 0.400290 0.285924 0.171557
// expect: 4 1 0.216983 0.154986 0.092988
// expect: 5 1 0.138094 0.098634 0.059174
// expect: 7 1 0.418036 0.298604 0.179156
// expect: 1 2 0.587564 0.587564 0.293782
// expect: 3 3 0.332372 0.237415 0.142443
// expect: 0 4 0.082689 0.165377 0.220508
// expect: 1 4 0.235554 0.471107 0.628138
// expect: 2 4 0.219654 0.439307 0.585748
// expect: 3 4 0.168429 0.336873 0.449165
// expect: 4 4 0.148974 0.297963 0.397284
// expect: 6 4 0.358785 0.598596 0.758465
// expect: 4 5 0.127306 0.254612 0.339483
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { location <0, 0, -12> look_at 0 angle 50 right x*4/3 }
light_source { <5, 9, -12>, rgb 1 }
light_source { <-8, 3, -9>, rgb 0.4 shadowless }
background { rgb 0.2 }
#default { pigment { rgb <0.7, 0.5, 0.3> } finish { phong 0.4 phong_size 30 diffuse 0.6 } }
#declare Row = union {
  torus { 0.6, 0.25 rotate 50*x translate <-5, 0, 0> }
  torus { 0.3, 0.5 rotate -40*x translate <-3.4, 0, 0> }
  cone { <-2.4, -0.7, 0>, 0.6, <-1.8, 0.8, 0.2>, 0 }
  cone { <-0.9, -0.6, 0>, 0.3, <-0.6, 0.7, -0.2>, 0.5 open }
  intersection {
    quadric { <1, -1, 1>, 0, 0, -0.1 }
    box { <-0.7, -0.7, -0.7>, <0.7, 0.7, 0.7> }
    rotate 30*z translate 0.9*x
  }
  quadric { <1, 2, 1>, <0.3, 0, 0.1>, 0, -0.4 translate 2.5*x }
  disc { <4, 0, 0>, <1, 2, -3>, 0.7, 0.2 }
  triangle { <4.6, -0.7, 0>, <5.6, -0.5, 0.4>, <5, 0.8, 0> }
}
object { Row translate 2.4*y }
object { Row scale <1, 1.2, 0.7> rotate <0, 12, 2> translate -2.3*y pigment { rgb <0.3, 0.6, 0.8> } }
difference {
  sphere { <-3, 0.1, 0>, 0.9 }
  torus { 0.7, 0.2 rotate 90*x translate <-3, 0.1, -0.6> }
  cone { <-3, 0.1, -1>, 0.5, <-3, 0.1, 0.2>, 0.1 }
  pigment { rgb <0.8, 0.8, 0.4> }
}
smooth_triangle { <-1.5, -0.8, 0>, <-1, -0.4, -1>, <1.4, -0.6, 0>, <1, -0.4, -1>, <0, 1, 0>, <0, 1, -1> }
smooth_triangle {
  <-1, -0.8, 0>, <-1, -0.4, -1>, <1, -0.6, 0>, <1, -0.4, -1>, <0, 0.9, 0>, <0, 1, -1>
  scale <0.8, 1.1, 1> rotate 20*y translate 3*x pigment { rgb <0.4, 0.8, 0.5> }
}
