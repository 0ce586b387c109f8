// expect: 0 0 0.437354 0.413443 0.389532
// expect: 1 0 0.890913 0.880247 0.869581
// expect: 2 0 0.866331 0.837400 0.808469
// expect: 4 0 0.288777 0.277043 0.265309
// expect: 0 1 0.503578 0.480125 0.456672
// expect: 4 1 0.293370 0.281956 0.270558
// expect: 0 2 0.215091 0.206149 0.197208
// expect: 2 2 0.912245 0.901732 0.891218
// expect: 4 2 0.469490 0.442893 0.416297
// expect: 0 3 0.251133 0.242802 0.234455
// expect: 1 3 0.671153 0.648554 0.625956
// expect: 2 3 0.750896 0.741329 0.731746
// expect: 3 3 0.503548 0.493736 0.483940
// expect: 4 3 0.457389 0.433219 0.409049
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: aa_level 6 on a density with edges.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb <1,.9,.8> }
box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { emission .4 aa_level 6 aa_threshold .02 density { cells color_map { [0 rgb 0][1 rgb 1] } scale .5 } } }  }

