// expect: 0 0 0.000000 0.000000 0.000000
// expect: 1 0 0.000000 0.000000 0.000000
// expect: 2 0 0.000000 0.000000 0.000000
// expect: 3 0 0.000000 0.000000 0.000000
// expect: 4 0 0.000000 0.000000 0.000000
// expect: 5 0 0.000000 0.000000 0.000000
// expect: 0 1 0.000000 0.000000 0.000000
// expect: 1 1 0.000000 0.000000 0.000000
// expect: 2 1 0.152865 0.120272 0.352041
// expect: 3 1 0.000000 0.000000 0.000000
// expect: 4 1 0.000000 0.000000 0.000000
// expect: 5 1 0.000000 0.000000 0.000000
// expect: 0 2 0.372442 0.000000 0.000000
// expect: 1 2 0.000000 0.335607 0.000000
// expect: 2 2 0.171695 0.000000 0.216556
// expect: 3 2 0.361852 0.000000 0.000000
// expect: 4 2 0.357717 0.000000 0.000000
// expect: 5 2 0.000000 0.321691 0.000000
// expect: 0 3 0.000000 0.352209 0.000000
// expect: 1 3 0.386221 0.000000 0.000000
// expect: 2 3 0.000000 0.348608 0.000000
// expect: 3 3 0.381949 0.000000 0.000000
// expect: 4 3 0.000000 0.344747 0.000000
// expect: 5 3 0.377417 0.000000 0.000000
// size: 6 4
// tol: abs 0.0002 rel 0.0006
// about: before version 1.5 there are no sums: a sign begins the next number.
#version 1.0
global_settings { assumed_gamma 1 }
// A scene of 1992: no commas, signs that begin a number, colour maps of two colours an entry.
#declare Light = color red 0.8 green 0.7 blue 0.6
camera { location <0 0.5 -6> direction <0 0 1> up <0 1 0> right <1.5 0 0> look_at <0 0 0> }
object { light_source { <-20 30 -40> color Light } }
sphere { <-1 -0.5 +1> 1 pigment { color red 1 green 0.5 } finish { ambient 0.2 diffuse 0.8 } }
plane { <0 1 0> -1.5 pigment { checker color red 1 color green 1 } }
quadric { <1 1 1> <0 0 0> <0 -1 0> -1 scale <0.5 0.5 0.5> translate <2 -0.5 1> pigment { color red 0.2 blue 1 } }
blob { threshold 0.6 component 1 1 <0.75 0 0> component 1 1 <-0.375 0.64952 -1> component 1 1 <-0.375 -0.64952 0>
  pigment { gradient <0 1 0> color_map { [0 0.5 color red 1 color blue 1] [0.5 1.01 color blue 1 color Light] } } }
