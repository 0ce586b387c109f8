// expect: 0 0 0.089250 0.084306 0.086732
// expect: 1 0 0.023926 0.018494 0.021042
// expect: 2 0 0.060472 0.047028 0.053330
// expect: 3 0 0.059800 0.046250 0.052598
// expect: 4 0 0.035691 0.033722 0.034699
// expect: 0 1 0.089586 0.084794 0.087160
// expect: 1 1 0.017548 0.011627 0.014282
// expect: 2 1 0.455207 0.448127 0.450111
// expect: 3 1 0.043885 0.029068 0.035706
// expect: 4 1 0.035843 0.033921 0.034867
// expect: 0 2 0.035843 0.033921 0.034867
// expect: 1 2 0.043885 0.029068 0.035706
// expect: 2 2 0.219852 0.252811 0.237980
// expect: 3 2 0.017548 0.011627 0.014282
// expect: 4 2 0.089586 0.084794 0.087160
// expect: 0 3 0.035691 0.033722 0.034699
// expect: 1 3 0.059800 0.046250 0.052598
// expect: 2 3 0.024186 0.018814 0.021332
// expect: 3 3 0.023926 0.018494 0.021042
// expect: 4 3 0.089250 0.084306 0.086732
// size: 5 4
// tol: abs 3e-4 rel 6e-4
// about: A spotlight that shines along the view.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,0,-6> direction 1.2*z right x*4/3 up y }
background { rgb <.1,.2,.3> }
plane { z, 6 hollow pigment { checker rgb .2 rgb .5 } finish { ambient .2 diffuse .6 } }
light_source { <0,0,-8>, rgb 1.5 spotlight point_at <0,.3,0> radius 5 falloff 8 }box { -2, 2 hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 } interior { media { scattering { 3, rgb <.2,.3,.25> } intervals 3 samples 4 } }  }

