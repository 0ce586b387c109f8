liblambert_a_SOURCES += \
	%D%/aabb.h %D%/color.h %D%/dd.h %D%/elementary.c %D%/elementary.h %D%/polynomial.c %D%/polynomial.h %D%/trig.c %D%/transform.h %D%/vec.h
