// expect: 2 0 0 0 0
// expect: 7 0 0 0 0
// expect: 4 1 0 0 0
// expect: 1 2 0 0 0
// expect: 6 2 0.200073 0.171509 0.142944
// expect: 3 3 0.248535 0.231323 0.137573
// expect: 0 4 0 0 0
// expect: 5 4 0.647949 0.593262 0.539062
// expect: 2 5 0.168579 0.224731 0.140503
// expect: 7 5 0 0 0
// size: 8 6
// tol: abs 3e-4 rel 6e-4
// about: Light through CSG, a union whose leaves are culled and moved, and without shadows; behind glass and in fog.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,4,-8> look_at <0,0.5,0> right x*4/3 }
light_source { <-5,8,-5>, rgb <.7,.6,.5> projected_through { difference { sphere { <-3,5,-3>,1.6 } box { <-4,0,-5>,<-3,9,5> } } } }
light_source { <5,8,-5>, rgb <.4,.6,.7> projected_through { union { torus { .8,.2 rotate x*50 } box { -.3,.3 rotate y*40 translate x*2 } cylinder { -x*3,-x,.4 } scale 1.2 translate <3,5,-3> } } }
light_source { <0,9,2>, rgb .4 shadowless projected_through { object { cone { 0,1.5,y,.5 } translate <0,5,1> } } }
plane { y,-1 pigment { checker rgb .9 rgb <.6,.8,.5> } finish { ambient 0 diffuse .8 } }
plane { z,5 pigment { rgb .7 } normal { ripples .6 scale 2 } finish { ambient 0 diffuse .6 specular .3 } }
sphere { 0,1 pigment { rgbt <.9,.4,.3,.6> } finish { ambient 0 diffuse .3 phong .5 } interior { ior 1.3 } }
box { <-3,-1,-1>,<-2,1,1> pigment { granite color_map { [0 rgb 1][1 rgb .2] } } finish { ambient 0 diffuse .7 } }
fog { distance 40 rgb <.5,.6,.7> }
