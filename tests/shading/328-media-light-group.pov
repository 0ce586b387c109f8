// expect: 0 0 0.214099 0.322225 0.509285
// expect: 1 0 0.307591 0.425727 0.643458
// expect: 2 0 0.377264 0.508080 0.737285
// expect: 3 0 0.379141 0.505486 0.723659
// expect: 4 0 0.120912 0.180438 0.285313
// expect: 0 1 0.210498 0.315480 0.497063
// expect: 1 1 0.384695 0.468833 0.650721
// expect: 2 1 0.444114 0.523049 0.686030
// expect: 3 1 0.454154 0.526757 0.670878
// expect: 4 1 0.118334 0.176059 0.277684
// expect: 0 2 0.119692 0.181064 0.293034
// expect: 1 2 0.432868 0.509209 0.682841
// expect: 2 2 0.363378 0.420066 0.554253
// expect: 3 2 0.381415 0.434516 0.551659
// expect: 4 2 0.187778 0.239597 0.319341
// expect: 0 3 0.119631 0.178988 0.287892
// expect: 1 3 0.347097 0.436088 0.603464
// expect: 2 3 0.270024 0.334920 0.462272
// expect: 3 3 0.274113 0.336248 0.456672
// expect: 4 3 0.182376 0.222416 0.287831
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: The medium of an object of a light group with global lights.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_group { light_source { <3,4,-5>, rgb <1,.5,.2> } box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { scattering { 1, <.1,.2,.3> } } }  }
 global_lights on }light_source { <-3,4,-5>, rgb <.2,.5,1> }
