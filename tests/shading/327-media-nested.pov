// expect: 0 0 0.352651 0.308034 0.267399
// expect: 1 0 0.268345 0.200748 0.149599
// expect: 2 0 0.415732 0.308324 0.227604
// expect: 3 0 0.424811 0.314611 0.231998
// expect: 4 0 0.192462 0.167590 0.144793
// expect: 0 1 0.347845 0.304448 0.264820
// expect: 1 1 0.268147 0.178408 0.121736
// expect: 2 1 0.378668 0.249088 0.166537
// expect: 3 1 0.549065 0.339818 0.165530
// expect: 4 1 0.468910 0.341207 0.141878
// expect: 0 2 0.125628 0.100069 0.081422
// expect: 1 2 0.290455 0.181567 0.119524
// expect: 2 2 0.237964 0.155810 0.106432
// expect: 3 2 0.435462 0.268025 0.120409
// expect: 4 2 0.658427 0.507591 0.287098
// expect: 0 3 0.111223 0.088304 0.072755
// expect: 1 3 0.255543 0.172244 0.121340
// expect: 2 3 0.198611 0.138338 0.098970
// expect: 3 3 0.237018 0.171450 0.124773
// expect: 4 3 0.355932 0.311223 0.270359
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A sphere with a medium that leaves the box with another.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb <1,.9,.8> }
box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { absorption <.1,.2,.3> scattering { 1, .1 } } }  }
sphere { <2,0,0>, 1 hollow pigment { rgbt 1 } interior { media { emission <.3,.2,0> } } }
