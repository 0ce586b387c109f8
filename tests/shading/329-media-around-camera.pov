// expect: 0 0 0.434730 0.408057 0.381384
// expect: 1 0 0.316732 0.297932 0.279149
// expect: 2 0 0.464057 0.433997 0.403937
// expect: 3 0 0.479515 0.448035 0.416541
// expect: 4 0 0.352972 0.330999 0.309026
// expect: 0 1 0.428351 0.402121 0.375906
// expect: 1 1 0.307744 0.289570 0.271397
// expect: 2 1 0.452750 0.423606 0.394461
// expect: 3 1 0.462928 0.432883 0.402853
// expect: 4 1 0.332250 0.312093 0.291936
// expect: 0 2 0.307027 0.289387 0.271763
// expect: 1 2 0.429786 0.403067 0.376349
// expect: 2 2 0.304967 0.286900 0.268833
// expect: 3 2 0.311376 0.292836 0.274296
// expect: 4 2 0.450446 0.422004 0.393576
// expect: 0 3 0.308537 0.291005 0.273487
// expect: 1 3 0.420844 0.395224 0.369604
// expect: 2 3 0.304143 0.286442 0.268757
// expect: 3 3 0.309041 0.291020 0.272984
// expect: 4 3 0.436515 0.409659 0.382803
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: The camera stands in the medium.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb <1,.9,.8> }
box { -8,8 hollow pigment { rgbt 1 } interior { media { scattering { 2, .02 } absorption .02 emission .01 } } }
