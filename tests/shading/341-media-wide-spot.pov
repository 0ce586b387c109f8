// expect: 0 0 0.270542 0.270542 0.270542
// expect: 1 0 0.084154 0.084154 0.084154
// expect: 2 0 0.219303 0.219303 0.219303
// expect: 3 0 0.205463 0.205463 0.205463
// expect: 4 0 0.108217 0.108217 0.108217
// expect: 0 1 0.288075 0.288075 0.288075
// expect: 1 1 0.226429 0.226429 0.226429
// expect: 2 1 0.373754 0.373754 0.373754
// expect: 3 1 0.323659 0.323659 0.323659
// expect: 4 1 0.115236 0.115236 0.115236
// expect: 0 2 0.115236 0.115236 0.115236
// expect: 1 2 0.323659 0.323659 0.323659
// expect: 2 2 0.268070 0.268070 0.268070
// expect: 3 2 0.226429 0.226429 0.226429
// expect: 4 2 0.288075 0.288075 0.288075
// expect: 0 3 0.108217 0.108217 0.108217
// expect: 1 3 0.205463 0.205463 0.205463
// expect: 2 3 0.090715 0.090715 0.090715
// expect: 3 3 0.084154 0.084154 0.084154
// expect: 4 3 0.270542 0.270542 0.270542
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A spotlight of 89 degrees from within the medium.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <0,0,0>, rgb 1 spotlight point_at <0,0,9> radius 60 falloff 89 }box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { scattering { 1,.2 } intervals 3 } }  }

