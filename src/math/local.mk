liblambert_a_SOURCES += \
	%D%/aabb.h %D%/color.h %D%/dd.h %D%/elementary.c %D%/elementary.h %D%/trig.c %D%/transform.h %D%/vec.h
