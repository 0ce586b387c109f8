// expect: 0 0 0.089250 0.084306 0.086732
// expect: 1 0 0.108095 0.119387 0.115084
// expect: 2 0 0.060472 0.047028 0.053330
// expect: 3 0 0.205890 0.203632 0.183093
// expect: 4 0 0.035691 0.033722 0.034699
// expect: 0 1 0.089586 0.084794 0.087160
// expect: 1 1 0.017548 0.011627 0.014282
// expect: 2 1 0.314092 0.285679 0.270573
// expect: 3 1 0.044129 0.029313 0.035920
// expect: 4 1 0.035843 0.033921 0.034867
// expect: 0 2 0.035843 0.033921 0.034867
// expect: 1 2 0.263066 0.200275 0.202319
// expect: 2 2 0.294575 0.242924 0.237629
// expect: 3 2 0.017548 0.011627 0.014282
// expect: 4 2 0.089586 0.084794 0.087160
// expect: 0 3 0.037232 0.034958 0.035889
// expect: 1 3 0.235477 0.177127 0.183017
// expect: 2 3 0.159442 0.121172 0.122560
// expect: 3 3 0.058457 0.045060 0.051942
// expect: 4 3 0.089250 0.084306 0.086732
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: Intervals of a spotlight and a cylinder light.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <2,3,0>, rgb <1,.9,.8>*1.5 spotlight point_at <0,0,0> radius 12 falloff 18 }
light_source { <-2,3,0>, rgb .7 cylinder point_at <0,0,0> radius .4 falloff .6 }box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { scattering { 1, rgb <.2,.3,.25> } intervals 6 } }  }

