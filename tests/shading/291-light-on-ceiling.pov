// expect: 0 0 0.2 0.2 0.2
// expect: 1 0 0.2 0.2 0.2
// expect: 2 0 0.2 0.2 0.2
// expect: 0 1 0.2 0.2 0.2
// expect: 1 2 0.2 0.2 0.2
// size: 3 3
// tol: abs 0.0005 rel 0.001
// about: A lamp that lies on a slanting wall is not in the wall's shadow, whichever way its rounding goes.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-0.001> direction z right 0.0002*x up 0.0002*y }
#declare I = 0;
#while (I < 20)
  // On a circle, each with its own rounding, on a small disc of its own that slants.
  #declare L = vrotate(<1,0,-3>, 18*I*z);
  light_source { L, sqrt(10)/300 }
  disc { L, vrotate(<3/10,-1/10,-1>, 7*I*z), 1e-3 }
  #declare I = I + 1;
#end
plane { -z, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }
