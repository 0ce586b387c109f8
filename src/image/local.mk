liblambert_a_SOURCES += \
	%D%/codec.h %D%/exr.c %D%/file.c %D%/image.c %D%/image.h %D%/png.c %D%/ppm.c \
	%D%/quantize.c
