liblambert_a_SOURCES += \
	%D%/image.h
