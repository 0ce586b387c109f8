// expect: 0 0 0.476738 0.426810 0.383932
// expect: 1 0 0.391501 0.369467 0.350088
// expect: 2 0 0.488151 0.429191 0.376959
// expect: 3 0 0.494453 0.434134 0.381292
// expect: 4 0 0.406867 0.383536 0.363638
// expect: 0 1 0.470909 0.421210 0.377813
// expect: 1 1 0.383307 0.361486 0.341939
// expect: 2 1 0.699916 0.597330 0.478309
// expect: 3 1 0.487221 0.427771 0.374746
// expect: 4 1 0.399222 0.376181 0.356191
// expect: 0 2 0.389441 0.370245 0.353460
// expect: 1 2 0.468101 0.415900 0.369055
// expect: 2 2 0.462425 0.414374 0.352804
// expect: 3 2 0.385046 0.362554 0.342458
// expect: 4 2 0.483375 0.428763 0.381277
// expect: 0 3 0.361746 0.356588 0.351537
// expect: 1 3 0.372519 0.359518 0.346395
// expect: 2 3 0.382971 0.362554 0.344350
// expect: 3 3 0.388006 0.367330 0.349081
// expect: 4 3 0.477714 0.427390 0.384192
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A medium that fills the scene before fog and a mirror.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
fog { distance 20 color rgb .7 } media { absorption <.02,.05,.1> } light_source { <3,4,-5>, rgb <1,.9,.8> }
sphere { 0,1 pigment { rgb .8 } finish { reflection .4 } }
