// expect: 0 0 0.292454 0.321157 0.348669
// expect: 1 0 0.275090 0.405005 0.511955
// expect: 2 0 0.417655 0.513176 0.593683
// expect: 3 0 0.409857 0.509224 0.592554
// expect: 4 0 0.143664 0.180591 0.215869
// expect: 0 1 0.305394 0.332433 0.358389
// expect: 1 1 0.363027 0.535866 0.664591
// expect: 2 1 0.497917 0.622232 0.719097
// expect: 3 1 0.488396 0.618906 0.719600
// expect: 4 1 0.147951 0.183398 0.217334
// expect: 0 2 0.147951 0.183398 0.217334
// expect: 1 2 0.488396 0.618906 0.719600
// expect: 2 2 0.363500 0.532326 0.658946
// expect: 3 2 0.363027 0.535866 0.664591
// expect: 4 2 0.305394 0.332433 0.358389
// expect: 0 3 0.143664 0.180591 0.215869
// expect: 1 3 0.409857 0.509224 0.592554
// expect: 2 3 0.276036 0.403037 0.508034
// expect: 3 3 0.275090 0.405005 0.511955
// expect: 4 3 0.292454 0.321157 0.348669
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A lamp with looks_like in the medium.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { 0, rgb .8 looks_like { sphere { 0,.4 pigment { rgb 1 } finish { ambient 1 } } } }box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { scattering { 1, <.1,.2,.3> } } }  }

