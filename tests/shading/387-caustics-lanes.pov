// expect: 2 0 0.0195923 0.0195923 0.0195923
// expect: 7 0 0.0175018 0.0175018 0.0175018
// expect: 4 1 0.190918 0.190918 0.190918
// expect: 1 2 0.331055 0.331055 0.331055
// expect: 6 2 0.28418 0.28418 0.28418
// expect: 3 3 0.256592 0.31665 0.256592
// expect: 0 4 0.423828 0.423828 0.423828
// expect: 5 4 0.386719 0.386719 0.386719
// expect: 2 5 0.424072 0.424072 0.424072
// expect: 7 5 0.37085 0.37085 0.37085
// size: 8 6
// tol: abs 4e-4 rel 1e-3
// about: Fake caustics of glass of one colour, of bumpy glass and of a map of textures; each layer multiplies by itself.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0,4,-8> look_at <0,0.5,0> right x*4/3 }
light_source { <-4,12,-4>, rgb .6 }
plane { y,-1 pigment { rgb .9 } finish { ambient 0 diffuse .8 } }
#declare Clear = texture { pigment { rgbf <.9,.95,1,.9> } normal { bumps .4 scale .4 } finish { ambient 0 diffuse .1 } }
sphere { <-2,.5,0>,1 pigment { rgbf <.9,1,.9,.9> } finish { ambient 0 diffuse .1 specular .5 } interior { ior 1.4 caustics .8 } }
box { <-.5,0,-1>,<.8,1,1> texture { Clear } texture { pigment { rgbt <1,.9,.8,.8> } normal { ripples .5 } } interior { ior 1.2 caustics 1 } }
sphere { <2.6,.5,0>,1 texture { gradient x texture_map { [.4 Clear][.6 pigment { rgbf <1,.5,.5,.7> } normal { dents .4 }] } } interior { ior 1.1 caustics .5 } hollow }
