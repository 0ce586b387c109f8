// expect: 0 0 0.066392 0.066392 0.066392
// expect: 1 0 0.027207 0.027207 0.027207
// expect: 2 0 0.068574 0.068574 0.068574
// expect: 3 0 0.096773 0.093889 0.091020
// expect: 4 0 0.026551 0.026551 0.026551
// expect: 0 1 0.067323 0.067323 0.067323
// expect: 1 1 0.027604 0.027604 0.027604
// expect: 2 1 0.128893 0.122972 0.117037
// expect: 3 1 0.069093 0.069078 0.069078
// expect: 4 1 0.026932 0.026932 0.026932
// expect: 0 2 0.026932 0.026932 0.026932
// expect: 1 2 0.153536 0.145083 0.136629
// expect: 2 2 0.110613 0.102342 0.094072
// expect: 3 2 0.027604 0.027604 0.027604
// expect: 4 2 0.067323 0.067323 0.067323
// expect: 0 3 0.141466 0.129976 0.118486
// expect: 1 3 0.200412 0.187167 0.173922
// expect: 2 3 0.100832 0.093492 0.086152
// expect: 3 3 0.027207 0.027207 0.027207
// expect: 4 3 0.066392 0.066392 0.066392
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A medium that fills the scene, lit by a spotlight.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
media { scattering { 1, .03 } intervals 5 }light_source { <2,3,0>, rgb <1,.9,.8>*1.5 spotlight point_at <0,0,0> radius 12 falloff 18 }

