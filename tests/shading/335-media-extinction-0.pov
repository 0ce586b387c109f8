// expect: 0 0 0.509804 0.468818 0.427832
// expect: 1 0 0.917769 0.829999 0.742214
// expect: 4 0 0.328069 0.299260 0.270451
// expect: 0 1 0.499413 0.459464 0.419532
// expect: 4 1 0.318914 0.291020 0.263127
// expect: 0 2 0.294285 0.268864 0.243427
// expect: 4 2 0.530800 0.487724 0.444648
// expect: 0 3 0.484886 0.436408 0.387915
// expect: 4 3 0.551125 0.496010 0.440894
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: Scattering without extinction casts no shadow.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb <1,.9,.8> }
box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { scattering { 1, .3 extinction 0 } } }  }
plane { y,-2.5 hollow pigment { rgb .7 } finish { ambient 0 diffuse .8 } }
