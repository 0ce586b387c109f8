liblambert_a_SOURCES += \
	%D%/bmp.c %D%/hdr.c %D%/jpeg.c %D%/jpeg_job.h %D%/linear.c %D%/tga.c %D%/writers.def %D%/dither.c %D%/dither.h %D%/codec.h %D%/exr.c %D%/exr_file.h %D%/read_exr.c %D%/file.c %D%/image.c %D%/image.h %D%/png.c %D%/png_error.h %D%/ppm.c \
	%D%/quantize.c %D%/read_bmp.c %D%/read_gif.c %D%/read_hdr.c %D%/read_iff.c \
	%D%/read_jpeg.c %D%/read_png.c %D%/read_pnm.c %D%/read_tga.c %D%/read_tiff.c \
	%D%/texels.c %D%/texels.h
