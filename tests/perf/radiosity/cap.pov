#version 3.7;
// Three quarters of a sphere closed by a disc; B is known exactly (S6).
global_settings { assumed_gamma 1 }
#macro M(Rho, E) texture { pigment { rgb 1 } finish { ambient 0 diffuse Rho emission E } } #end
camera { location <.03, .02, .1> look_at <.03, .02, 1> }
difference {
  box { -2, 2 }
  intersection { sphere { 0, 1 M(.6, 1) } box { <-2, -2, -.5>, 2 M(.4, 0) } }
  M(.5, 0)
}
