// expect: 0 0 0.339086 0.315175 0.291264
// expect: 1 0 0.146654 0.135988 0.125322
// expect: 2 0 0.390097 0.361166 0.332219
// expect: 3 0 0.399786 0.369802 0.339834
// expect: 4 0 0.157366 0.145617 0.133883
// expect: 0 1 0.334524 0.311070 0.287617
// expect: 1 1 0.280491 0.270085 0.259663
// expect: 3 1 0.527276 0.498177 0.469093
// expect: 4 1 0.154025 0.142626 0.131228
// expect: 0 2 0.103227 0.094911 0.086580
// expect: 1 2 0.314733 0.301900 0.289067
// expect: 2 2 0.728862 0.719020 0.709163
// expect: 3 2 0.258534 0.248310 0.238102
// expect: 4 2 0.191272 0.177142 0.163012
// expect: 0 3 0.147570 0.134813 0.122057
// expect: 1 3 0.220066 0.203067 0.186053
// expect: 2 3 0.164645 0.150225 0.135790
// expect: 3 3 0.171145 0.156039 0.140917
// expect: 4 3 0.242313 0.223087 0.203845
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A half transparent plane inside a medium.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb <1,.9,.8> }
box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { emission .4 density { spherical scale 1.8 } } }  }
plane { y,-1 hollow pigment { rgbt <1,1,1,.5> } finish { ambient 0 diffuse .3 } }
