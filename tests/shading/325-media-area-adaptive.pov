// expect: 0 0 0.404517 0.430808 0.418128
// expect: 1 0 0.461433 0.551934 0.510796
// expect: 2 0 0.608347 0.670298 0.642237
// expect: 3 0 0.623438 0.688991 0.659068
// expect: 4 0 0.245624 0.284504 0.265461
// expect: 0 1 0.395789 0.420218 0.408469
// expect: 1 1 0.511818 0.570428 0.546044
// expect: 2 1 0.585962 0.620005 0.605615
// expect: 3 1 0.373266 0.416144 0.395758
// expect: 4 1 0.239185 0.276417 0.258213
// expect: 0 2 0.176181 0.202213 0.189181
// expect: 1 2 0.522240 0.550759 0.538689
// expect: 2 2 0.443046 0.506859 0.478767
// expect: 3 2 0.530037 0.595850 0.568185
// expect: 4 2 0.428428 0.454826 0.441993
// expect: 0 3 0.163516 0.191455 0.177371
// expect: 1 3 0.399405 0.449454 0.427405
// expect: 2 3 0.369650 0.429114 0.402625
// expect: 3 3 0.414099 0.476326 0.449058
// expect: 4 3 0.408072 0.435615 0.422263
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: An adaptive area light in a medium.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb 1 area_light x*2,y*2,5,5 adaptive 0 }box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { scattering { 1, rgb <.2,.3,.25> } samples 4 } }  }
sphere { <.8,.8,-.5>,.5 pigment { rgb 1 } }
