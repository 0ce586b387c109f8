// expect: 0 0 0.355488 0.378405 0.387766
// expect: 1 0 0.310082 0.340728 0.363650
// expect: 2 0 0.322587 0.348935 0.361249
// expect: 3 0 0.331302 0.347978 0.355488
// expect: 0 1 0.176056 0.185084 0.205341
// expect: 1 1 0.161142 0.197988 0.220043
// expect: 2 1 0.273209 0.302165 0.325032
// expect: 3 1 0.341840 0.354502 0.362055
// expect: 0 2 0.353801 0.378385 0.399555
// expect: 1 2 0.311610 0.336373 0.358019
// expect: 3 2 0.357980 0.359278 0.333475
// expect: 0 3 0.415989 0.436911 0.447348
// expect: 1 3 0.401285 0.416634 0.427125
// expect: 2 3 0.397262 0.404635 0.401713
// expect: 3 3 0.391191 0.396755 0.390328
// size: 4 4
// tol: abs 0.01 rel 0.04
// about: An unbounded body holds other objects: ways that escape are not counted, light scattered once is there without a far wall, and nothing is seen of what is inside. By POV-Ray with 3000 and 1000 samples.
#version 3.7;
global_settings { assumed_gamma 1.0 mm_per_unit 1 subsurface { samples 600,300 } }
camera { location <0,4,-3> look_at 0 right x up y angle 40 }
light_source { <-10,10,-10>, rgb 1 }
sphere { <.7,-.6,-.5>, .5 pigment { rgb 1 } finish { ambient 0 diffuse 0 emission 1 } }
sphere { <-.7,-1.9,.6>, .8 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }
plane { y, 0 pigment { rgb .5 } finish { ambient 0 diffuse 0.8 subsurface { translucency rgb <4,2,1> } } interior { ior 1.5 } }
