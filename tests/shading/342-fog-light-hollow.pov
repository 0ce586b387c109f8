// expect: 0 0 0.466285 0.466285 0.466285
// expect: 3 0 0.462211 0.462211 0.462211
// expect: 6 0 0.474022 0.474022 0.474022
// expect: 1 1 0.399222 0.399222 0.399222
// expect: 4 1 0.423575 0.423575 0.423575
// expect: 7 1 0.474266 0.474266 0.474266
// expect: 2 2 0.395056 0.395056 0.395056
// expect: 5 2 0.418158 0.418158 0.418158
// expect: 0 3 0.463020 0.463020 0.463020
// expect: 3 3 0.451118 0.451118 0.451118
// expect: 6 3 0.424918 0.424918 0.424918
// expect: 1 4 0.422858 0.422858 0.422858
// expect: 4 4 0.426917 0.426917 0.426917
// expect: 7 4 0.448249 0.448249 0.448249
// expect: 2 5 0.339727 0.339727 0.339727
// expect: 5 5 0.414542 0.414542 0.414542
// size: 8 6
// tol: abs 3e-4 rel 6e-4
// about: Fog dims light only where it is hollow: not in the left sphere.
#version 3.7; global_settings { assumed_gamma 1.0 }
camera { location <0, 2, -10> look_at <0,1,0> }
fog { color rgb .5 distance 8 }
plane { y, -1 pigment { checker rgb .8 rgb .4 scale 2 } finish { ambient .2 diffuse .8 } hollow }
plane { z, 5 pigment { checker rgb .7 rgb .5 scale 2 } finish { ambient .2 diffuse .8 } hollow }
sphere { <-2.6, 2, 0>, 2.5 pigment { rgbt <1,1,1,.8> } finish { ambient 0 diffuse 0.1 phong 1 phong_size 5 } interior { ior 1.05 } }
sphere { <2.6, 2, 0>, 2.5 pigment { rgbt <1,1,1,.8> } finish { ambient 0 diffuse 0.1 phong 1 phong_size 5 } interior { ior 1.05 } hollow }
light_source { <20, 30, -20>, rgb 40 media_attenuation on }
