// expect: 4 3 0.478370 0.418570 0.358785
// size: 8 6
// tol: abs 3e-4 rel 6e-4
// about: Light through a disc, which has a rim, unlike the half space that it is in CSG.
#version 3.7; global_settings { assumed_gamma 1.0  }
camera { location <0,4,-8> look_at <0,0,0> right x*4/3 }
plane { y,-1 pigment { rgb <.8,.7,.6> } finish { ambient 0 diffuse .8 } }
plane { z,5 pigment { rgb .7 } finish { ambient 0 diffuse .7 specular .3 } }
light_source { <-6,8,-4>, rgb 1 projected_through { disc { <-3,4,-2>, y, .6 } } }
sphere { 0,1 pigment { rgbt 1 } finish { ambient 0 diffuse 0  } interior { ior 1.5  }  }

