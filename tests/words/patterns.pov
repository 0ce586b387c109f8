#version 3.7;
global_settings { assumed_gamma 1 }
#macro P(Which)
  sphere { 0, 1 pigment {
    #switch (Which)
      #case (0) agate agate_turb 0.5 #break
      #case (1) boxed #break
      #case (2) bozo #break
      #case (3) cells #break
      #case (4) crackle form <1, 0, 0> metric 2 offset 0.1 solid #break
      #case (5) dents #break
      #case (6) granite #break
      #case (7) leopard #break
      #case (8) marble turbulence 0.5 octaves 3 lambda 2 omega 0.5 #break
      #case (9) onion #break
      #case (10) planar #break
      #case (11) quilted control0 0.5 control1 0.75 #break
      #case (12) radial frequency 6 phase 0.25 #break
      #case (13) ripples #break
      #case (14) slope { y, 0, 0.5 altitude y, -1, 1 } #break
      #case (15) spherical #break
      #case (16) spiral1 3 #break
      #case (17) spiral2 3 #break
      #case (18) spotted #break
      #case (19) waves #break
      #case (20) wood #break
      #case (21) wrinkles noise_generator 1 #break
      #case (22) cylindrical ramp_wave #break
      #case (23) gradient x sine_wave #break
      #case (24) bumps scallop_wave #break
      #case (25) julia <0.35, 0.28>, 10 interior 1, 1 exterior 1, 1 #break
      #case (26) mandel 10 exponent 3 #break
      #case (27) magnet 1 mandel 10 #break
      #case (28) tiling 3 #break
      #case (29) pavement number_of_sides 6 number_of_tiles 3 pattern 1 exterior 0 interior 1 form 2 #break
      #case (31) aoi #break
      #case (32) function { x * y } cubic_wave #break
      #case (34) pigment_pattern { checker rgb 0 rgb 1 } poly_wave 2 #break
      #case (35) image_pattern { function 8, 8 { x } } triangle_wave #break
    #end
    color_map { [0 rgb 0] [1 color rgb 1] }
  } }
#end
#for (I, 0, 35) P(I) #end
