liblambert_a_SOURCES += \
	%D%/aabb.h %D%/color.h %D%/elementary.h %D%/transform.h %D%/vec.h
