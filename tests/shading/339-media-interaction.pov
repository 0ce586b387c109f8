// expect: 0 0 0.578180 0.554269 0.530358
// expect: 1 0 0.253315 0.242649 0.231983
// expect: 2 0 0.678584 0.649683 0.620783
// expect: 3 0 0.699565 0.669596 0.639612
// expect: 4 0 0.274723 0.262989 0.251240
// expect: 0 1 0.569039 0.545586 0.522133
// expect: 1 1 0.275807 0.255009 0.235889
// expect: 2 1 0.565148 0.558755 0.557885
// expect: 3 1 0.659144 0.634638 0.611994
// expect: 4 1 0.268055 0.256657 0.245243
// expect: 0 2 0.218738 0.209812 0.200900
// expect: 1 2 0.517266 0.515038 0.512535
// expect: 2 2 0.305943 0.282322 0.255680
// expect: 3 2 0.285512 0.263279 0.243275
// expect: 4 2 0.631830 0.605234 0.578653
// expect: 0 3 0.491630 0.502724 0.512657
// expect: 1 3 0.347158 0.403799 0.468360
// expect: 2 3 0.510964 0.539574 0.568231
// expect: 3 3 0.755947 0.718151 0.680354
// expect: 4 3 0.760815 0.722774 0.684733
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: Of two lights one ignores media.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <3,4,-5>, rgb 1 media_interaction off }light_source { <3,4,-5>, rgb <1,.9,.8> }
box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { scattering { 1,.2 } absorption .2 density { spherical color_map { [0 rgb 0][1 rgb <1,.7,.4>] } scale 1.8 } } }  }
plane { y,-2.5 hollow pigment { rgb .7 } finish { ambient 0 diffuse .8 } }
