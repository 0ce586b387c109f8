liblambert_a_SOURCES += \
	%D%/aabb.c %D%/aabb.h %D%/acos_lanes.h %D%/bvh8.c %D%/bvh8_build.c %D%/bvh8.h %D%/chi_square.c %D%/chi_square.h %D%/color.h %D%/dd.h %D%/dd_lanes.h %D%/eigen.c %D%/eigen.h %D%/elementary.c %D%/elementary.h \
	%D%/gamma.h %D%/halton.h %D%/isa.h %D%/interval.c %D%/interval.h %D%/pi.h %D%/lanes.h %D%/lanes_bits.h %D%/lanes_gather.h %D%/lanes_pack.h %D%/lanes_vec.h %D%/larger.h %D%/near_lanes.h %D%/next_float.h %D%/polynomial.c %D%/polynomial.h %D%/polynomial_lanes.h %D%/power.h %D%/power_lanes.h %D%/processor.c %D%/processor.h %D%/quadratic.c %D%/quadratic.h %D%/quick.h %D%/quick_lanes.h %D%/trig_lanes.h %D%/single.c %D%/single.h %D%/single_lanes.h \
	%D%/transform.c %D%/transform.h %D%/trig.c %D%/trig.h %D%/vec.h
