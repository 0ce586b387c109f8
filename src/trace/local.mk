liblambert_a_SOURCES += \
	%D%/accel.h %D%/bvh.c %D%/intersect.c %D%/intersect.h %D%/render.h %D%/scratch.h \
	%D%/sweep.c %D%/world.c %D%/world.h
