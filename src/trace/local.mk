liblambert_a_SOURCES += \
	%D%/intersect.h %D%/render.h %D%/world.h
