// expect: 0 0 0.547234 0.430945 0.287297
// expect: 1 0 0.550744 0.433707 0.289143
// expect: 2 0 0.553735 0.436057 0.290715
// expect: 3 0 0.556146 0.437964 0.291981
// expect: 4 0 0.557992 0.439414 0.292943
// expect: 5 0 0.559228 0.440391 0.293599
// expect: 6 0 0.559838 0.440879 0.293919
// expect: 7 0 0.559838 0.440879 0.293919
// expect: 0 1 0.177462 0.157183 0.130022
// expect: 1 1 0.175921 0.156756 0.130907
// expect: 2 1 0.048707 0.050263 0.032685
// expect: 3 1 0.040742 0.059159 0.047807
// expect: 4 1 0.260731 0.169055 0.058640
// expect: 5 1 0.279713 0.131121 0.043946
// expect: 6 1 0.107485 0.141085 0.188113
// expect: 7 1 0.107485 0.141085 0.188113
// expect: 0 2 0.075380 0.097810 0.134203
// expect: 1 2 0.550149 0.433249 0.288838
// expect: 2 2 0.553124 0.435584 0.290394
// expect: 3 2 0.555535 0.437491 0.291661
// expect: 4 2 0.557382 0.438926 0.292622
// expect: 5 2 0.558602 0.439902 0.293263
// expect: 6 2 0.559228 0.440391 0.293599
// expect: 7 2 0.559228 0.440391 0.293599
// expect: 0 3 0.545495 0.429572 0.286381
// expect: 1 3 0.548974 0.432319 0.288212
// expect: 2 3 0.551934 0.434653 0.289769
// expect: 3 3 0.554330 0.436530 0.291020
// expect: 4 3 0.556146 0.437964 0.291981
// expect: 5 3 0.557382 0.438926 0.292622
// expect: 6 3 0.557992 0.439414 0.292943
// expect: 7 3 0.557992 0.439414 0.292943
// expect: 0 4 0.256382 0.228168 0.134630
// expect: 1 4 0.218433 0.068376 0.045274
// expect: 2 4 0.252232 0.158465 0.076799
// expect: 3 4 0.216052 0.195834 0.101961
// expect: 4 4 0.333425 0.093935 0.030213
// expect: 5 4 0.270481 0.113878 0.055863
// expect: 6 4 0.063401 0.048859 0.029282
// expect: 7 4 0.044450 0.038132 0.024155
// expect: 0 5 0.144274 0.105715 0.071656
// expect: 1 5 0.544915 0.429129 0.286076
// expect: 2 5 0.242985 0.221225 0.133806
// expect: 3 5 0.550149 0.433249 0.288838
// expect: 4 5 0.265400 0.115938 0.057893
// expect: 5 5 0.215290 0.140536 0.107027
// expect: 6 5 0.071763 0.069245 0.047135
// expect: 7 5 0.132433 0.108583 0.067369
// size: 8 6
// tol: abs 0.0002 rel 0.0006
// about: What patterns, layers, maps of textures, uv maps and inner textures let through of light on its way.
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0,0,-10> direction z right 8*x up 6*y }
light_source { <3,2,-30>, rgb <1,0.9,0.7> }
plane { z, 0 pigment { rgb <0.8,0.7,0.6> } finish { ambient 0 diffuse 0.7 } }
#declare Clouds = pigment { bozo turbulence 0.4 color_map { [0 rgbt <1,0.8,0.4,0.9>] [0.6 rgbf <0.4,0.6,1,0.7>] [1 rgb 0.5] } scale 0.5 };
#declare Steps = pigment { gradient x color_map { [0 rgbf <1,0.2,0.2,0.9>] [1 rgbt <0.2,1,0.2,0.8>] } rotate 30*z scale 0.7 };
sphere { <-3,1.5,-1.5>, 0.95 pigment { Clouds } no_image }
sphere { <-1,1.5,-1.5>, 0.95 texture { pigment { Clouds } normal { bumps 0.6 scale 0.2 } } texture { pigment { Steps } } no_image }
sphere { <1,1.5,-1.5>, 0.95 texture { gradient y texture_map { [0.2 pigment { Steps }] [0.8 pigment { Clouds }] } scale 1.3 } no_image }
sphere { <3,1.5,-1.5>, 0.95 uv_mapping pigment { checker rgbt <1,0.5,0.2,0.8> rgbf <0.3,0.5,1,0.8> scale <0.1,0.2,1> } no_image }
sphere { <-3,-1.5,-1.5>, 0.95 texture { pigment { Steps } } interior_texture { pigment { Clouds scale 0.5 } } no_image }
sphere { <-1,-1.5,-1.5>, 0.95 texture { average texture_map { [1 pigment { Clouds }] [3 pigment { Steps }] } } no_image }
box { <0.2,-2.3,-2>, <1.8,-0.7,-1> pigment { slope -z color_map { [0 rgbf <0.9,0.5,0.3,0.9>] [1 rgbt <0.3,0.5,0.9,0.7>] } } rotate 10*y no_image }
sphere { <3,-1.5,-1.5>, 0.95 pigment { granite color_map { [0 rgbf <1,0.9,0.8,1>] [1 rgbf <0.2,0.4,0.5,0.5>] } scale 0.8 } finish { irid { 0.3 } } interior { ior 1.3 fade_distance 1 fade_power 2 } no_image }
