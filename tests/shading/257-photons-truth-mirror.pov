// expect: 0 0 0.387979 0.290985 0.193990
// expect: 1 0 0.387979 0.290985 0.193990
// expect: 2 0 0.387979 0.290985 0.193990
// expect: 0 1 0.387979 0.290985 0.193990
// expect: 1 1 0.387979 0.290985 0.193990
// expect: 2 1 0.387979 0.290985 0.193990
// expect: 0 2 0.387979 0.290985 0.193990
// expect: 1 2 0.387979 0.290985 0.193990
// expect: 2 2 0.387979 0.290985 0.193990
// size: 3 3
// tol: abs 0.005 rel 0.05
// about: Truth: a mirror of 0.8 turned by 30 degrees throws parallel light on a wall that it meets at 30 degrees; no direct light reaches the wall.
#version 3.7;
global_settings { assumed_gamma 1.0 photons { spacing 0.01 } }
camera { orthographic location <2,0,0.113> direction x right 0.6*z up 0.6*y }
light_source { <0,0,-8>, rgb 1 parallel point_at 0 }
plane { -x, -5 pigment { rgb <0.8,0.6,0.4> } finish { ambient 0 diffuse 0.7 } }
box { <-1.2,-1.2,0>, <1.2,1.2,0.1> pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection 0.8 } rotate -30*y translate 3*z photons { target reflection on refraction off } }
