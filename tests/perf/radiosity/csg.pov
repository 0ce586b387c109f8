#version 3.7;
// A furnace full of things that hide each other: wherever a surface of reflectance rho
// gives off 1 - rho, all of it has B = 1, whatever the scene.
global_settings { assumed_gamma 1 }
#macro M(Rho) texture { pigment { rgb 1 } finish { ambient 0 diffuse Rho emission 1 - Rho } } #end
camera { location <.05, -.55, .75> look_at 0 }
difference { box { -2, 2 } box { -1, 1 M(.7) } M(.5) }
difference {
  sphere { <-.3, .2, -.3>, .5 M(.4) }
  cylinder { <-.3, .2, -1>, <-.3, .2, 1>, .2 M(.9) }
  box { <-.3, .2, -.3>, <1, 1, 1> M(.5) }
}
cone { <.5, -.4, -1>, .35, <.5, -.4, .2>, .1 M(.3) }
intersection { box { -.25, .25 M(.85) } sphere { 0, .3 M(.2) } rotate 30 translate <.4, .5, .3> }
