// expect: 0 0 0.417212 0.304494 0.308324
// expect: 1 0 0.476509 0.032410 0.162051
// expect: 2 0 0.780606 0.323491 0.426261
// expect: 3 0 0.803830 0.334768 0.439429
// expect: 4 0 0.224842 0.125017 0.141726
// expect: 0 1 0.409659 0.300526 0.303868
// expect: 4 1 0.218967 0.122560 0.138643
// expect: 0 2 0.229023 0.131609 0.146670
// expect: 2 2 0.755093 0.015457 0.233112
// expect: 4 2 0.442832 0.330373 0.330404
// expect: 0 3 0.548074 0.411688 0.391836
// expect: 3 3 0.827573 0.343206 0.432563
// expect: 4 3 0.460960 0.333272 0.322148
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: Negative absorption and emission.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb <1,.9,.8> }
box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { absorption -.1 emission <.1,-.05,0> } }  }
plane { y,-2.5 hollow pigment { rgb .7 } finish { ambient 0 diffuse .8 } }
