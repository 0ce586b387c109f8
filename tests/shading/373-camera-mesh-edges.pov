// expect: 23 15 0.25 0.5 0.75
// expect: 23 23 0.25 0.5 0.75
// expect: 21 25 0.25 0.5 0.75
// expect: 25 25 0.25 0.5 0.75
// expect: 0 0 0.25 0.5 0.75
// expect: 12 9 0.25 0.5 0.75
// size: 36 28
// tol: abs 1e-6 rel 1e-6
// about: mesh_camera, distribution 3: pixels whose uv lies on edges of faces, which rounding puts out of the faces on both sides.
#version 3.7;
global_settings { assumed_gamma 1.0 }
plane { z, 3 hollow pigment { rgb <.25, .5, .75> } finish { ambient 0 diffuse 0 emission 1 } }
#macro Corner(I, J) <I*(1/9), J*(1/7)> #end
#macro Face(A, B, C)
  triangle { A*.5, B*.5, C*.5 uv_vectors <A.x, A.y>, <B.x, B.y>, <C.x, C.y> }
#end
camera { mesh_camera { 1 3 mesh {
  #for (I, 0, 8)
    #for (J, 0, 6)
      Face(Corner(I, J) + 0*z, Corner(I, J+1) + 0*z, Corner(I+1, J) + 0*z)
      Face(Corner(I+1, J+1) + 0*z, Corner(I+1, J) + 0*z, Corner(I, J+1) + 0*z)
    #end
  #end
  } }
  location <0, 0, .1> }
