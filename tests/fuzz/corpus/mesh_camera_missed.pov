// A mesh camera none of whose pixels lies on a face: no ray is traced.
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, 1 }
camera {
  mesh_camera {
    1 3
    mesh {
      triangle { 0, x, y uv_vectors <5, 5>, <6, 5>, <5, 6> }
    }
  }
  location <0, 0, .1>
}
