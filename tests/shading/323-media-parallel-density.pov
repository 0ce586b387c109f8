// expect: 0 0 0.312139 0.312139 0.312139
// expect: 1 0 0.124849 0.124849 0.124849
// expect: 2 0 0.312428 0.312428 0.312276
// expect: 3 0 0.312139 0.312139 0.312139
// expect: 4 0 0.124849 0.124849 0.124849
// expect: 0 1 0.312139 0.312139 0.312139
// expect: 1 1 0.198886 0.202441 0.162554
// expect: 2 1 0.552346 0.562524 0.441382
// expect: 3 1 0.365820 0.368444 0.339269
// expect: 4 1 0.124849 0.124849 0.124849
// expect: 0 2 0.124849 0.124849 0.124849
// expect: 1 2 0.383230 0.386435 0.349355
// expect: 2 2 0.412726 0.423941 0.285176
// expect: 3 2 0.194003 0.197360 0.159899
// expect: 4 2 0.312139 0.312139 0.312139
// expect: 0 3 0.124849 0.124849 0.124849
// expect: 1 3 0.284947 0.283680 0.298070
// expect: 2 3 0.125322 0.125338 0.125093
// expect: 3 3 0.124849 0.124849 0.124849
// expect: 4 3 0.312139 0.312139 0.312139
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A parallel light on Rayleigh scattering with a spherical density; extinction 0.7.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb 1 parallel point_at 0 }box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { scattering { 4, rgb <.2,.3,.25> extinction .7 } density { spherical color_map { [0 rgb 0][1 rgb <1,.7,.4>] } scale 1.8 } } }  }

