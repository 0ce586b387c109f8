// expect: 0 0 0.439887 0.416693 0.393500
// expect: 1 0 0.335317 0.327291 0.319249
// expect: 2 0 0.639551 0.616190 0.592828
// expect: 3 0 0.659846 0.636164 0.612467
// expect: 4 0 0.263264 0.252247 0.241215
// expect: 0 1 0.378225 0.355917 0.333623
// expect: 1 1 0.567971 0.560830 0.553689
// expect: 2 1 0.626047 0.607843 0.589654
// expect: 3 1 0.833158 0.814008 0.794858
// expect: 4 1 0.209369 0.198581 0.187793
// expect: 0 2 0.135683 0.129686 0.123690
// expect: 1 2 0.643732 0.634699 0.625666
// expect: 2 2 0.564736 0.559976 0.555200
// expect: 3 2 0.729107 0.722530 0.715938
// expect: 4 2 0.420890 0.395102 0.369299
// expect: 0 3 0.166400 0.161486 0.156573
// expect: 1 3 0.453101 0.443320 0.433555
// expect: 2 3 0.476310 0.471077 0.465843
// expect: 3 3 0.326772 0.319402 0.312016
// expect: 4 3 0.390249 0.367422 0.344579
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: Two media, one with two patterns, moved.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb <1,.9,.8> }
box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { emission .5 density { bozo turbulence .5 color_map {[0 rgb 0][.5 rgb .2][1 rgb 1]} } scale .7 rotate y*40 } media { absorption .2 density { wrinkles } } }  }

