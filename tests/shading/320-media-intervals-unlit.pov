// expect: 0 0 0.153429 0.153429 0.153429
// expect: 1 0 0.278981 0.278981 0.278981
// expect: 2 0 0.326955 0.326955 0.326955
// expect: 3 0 0.330373 0.330373 0.330373
// expect: 4 0 0.095109 0.095109 0.095109
// expect: 0 1 0.151629 0.151629 0.151629
// expect: 1 1 0.411215 0.411215 0.411215
// expect: 2 1 0.447623 0.447623 0.447623
// expect: 3 1 0.456397 0.456397 0.456397
// expect: 4 1 0.093248 0.093248 0.093248
// expect: 0 2 0.093248 0.093248 0.093248
// expect: 1 2 0.455436 0.455436 0.455436
// expect: 2 2 0.398688 0.398688 0.398688
// expect: 3 2 0.411215 0.411215 0.411215
// expect: 4 2 0.151629 0.151629 0.151629
// expect: 0 3 0.095033 0.095033 0.095033
// expect: 1 3 0.329854 0.329854 0.329854
// expect: 2 3 0.272175 0.272175 0.272175
// expect: 3 3 0.278981 0.278981 0.278981
// expect: 4 3 0.153429 0.153429 0.153429
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A medium that only glows is divided at the cone of a spotlight all the same.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <2,3,0>, rgb <1,.9,.8>*1.5 spotlight point_at <0,0,0> radius 12 falloff 18 }
box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { emission .1 absorption .05 intervals 4 } }  }

