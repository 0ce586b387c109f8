// expect: 0 0 0.404547 0.430884 0.418189
// expect: 1 0 0.460594 0.550423 0.509606
// expect: 2 0 0.607782 0.669368 0.641474
// expect: 3 0 0.622980 0.688273 0.658473
// expect: 4 0 0.245579 0.284413 0.265400
// expect: 0 1 0.393561 0.417197 0.405814
// expect: 1 1 0.511055 0.569802 0.545342
// expect: 2 1 0.584314 0.618402 0.603952
// expect: 3 1 0.373342 0.416312 0.395880
// expect: 4 1 0.239139 0.276280 0.258122
// expect: 0 2 0.176837 0.203052 0.189944
// expect: 1 2 0.520241 0.550225 0.537591
// expect: 2 2 0.443290 0.507118 0.479011
// expect: 3 2 0.531121 0.597406 0.569543
// expect: 4 2 0.428336 0.454643 0.441871
// expect: 0 3 0.164599 0.192233 0.178271
// expect: 1 3 0.406409 0.452995 0.432380
// expect: 2 3 0.369451 0.429297 0.402655
// expect: 3 3 0.414893 0.477592 0.450095
// expect: 4 3 0.408133 0.435737 0.422370
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: An area light in a medium with a shadow.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb 1 area_light x*2,y*2,3,3 }box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { scattering { 1, rgb <.2,.3,.25> } samples 4 } }  }
sphere { <.8,.8,-.5>,.5 pigment { rgb 1 } }
