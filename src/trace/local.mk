liblambert_a_SOURCES += \
	%D%/accel.h %D%/accel.c %D%/bvh8.c %D%/bvh8.h %D%/csg_bounds.c %D%/csg_bounds.h \
	%D%/intersect.c %D%/intersect.h %D%/render.h %D%/scratch.h \
	%D%/sweep.c %D%/world.c %D%/world.h
liblambert_a_SOURCES += \
	%D%/antialias.c %D%/antialias.h %D%/area.c %D%/area.h %D%/fog.c \
	%D%/inside.c %D%/inside.h %D%/job.c %D%/job.h %D%/lamp.c %D%/lamp.h \
	%D%/layers.c %D%/layers.h %D%/lens.c %D%/lens.h %D%/projected.c %D%/projected.h %D%/render.c \
	%D%/shade.c %D%/shade.h \
	%D%/shade_light.c %D%/shade_transmit.c %D%/shadow.c %D%/sky.c %D%/sky.h \
	%D%/tile.c %D%/tile.h %D%/tracer.h %D%/wave.c
