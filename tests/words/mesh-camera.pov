#version 3.7;
global_settings { assumed_gamma 1 }
#declare M = mesh { triangle { 0, x, y } }
camera { mesh_camera { 1 0 mesh { M } } location 0 }
