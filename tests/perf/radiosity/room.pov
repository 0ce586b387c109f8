#version 3.7;
// The room of room.faces as CSG; half of it is lit round a partition.
global_settings { assumed_gamma 1 }
#macro M(C, E) texture { pigment { rgb C } finish { ambient 0 diffuse 1 emission E } } #end
camera { location <.5, .5, 1.6> sky z up z right -4/3*x look_at <3, 2.5, .8> }
difference { box { -1, <6, 5, 3.6> } box { 0, <5, 4, 2.6> } M(<.7, .68, .62>, 0) }
box { <1.8, 1.6, 2.3>, <3.2, 2.2, 2.4> texture { pigment { rgb 1 } finish { ambient 0 diffuse .6 emission 1 } } }
union {
  box { <1.5, 1.2, .7>, <3.1, 2.2, .75> }
  box { <1.55, 1.25, 0>, <1.62, 1.32, .7> }
  box { <2.98, 1.25, 0>, <3.05, 1.32, .7> }
  box { <1.55, 2.08, 0>, <1.62, 2.15, .7> }
  box { <2.98, 2.08, 0>, <3.05, 2.15, .7> }
  M(<.45, .3, .15>, 0)
}
box { <.05, 2.9, 0>, <.65, 3.8, 1.9> M(<.2, .35, .6>, 0) }
box { <3.7, 0, 0>, <3.8, 2.4, 2.6> M(.75, 0) }
union {
  box { <4.1, .4, 0>, <4.9, 2.2, .4> }
  box { <4.7, .4, .4>, <4.9, 2.2, .9> }
  M(<.6, .15, .1>, 0)
}
