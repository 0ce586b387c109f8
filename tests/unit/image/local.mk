check_PROGRAMS += test_image test_quantize test_texels
test_quantize_SOURCES = %D%/test_quantize.c
test_quantize_CPPFLAGS = $(test_cppflags)
test_quantize_LDADD = $(test_ldadd)
test_image_SOURCES = %D%/test_image.c
test_image_CPPFLAGS = $(test_cppflags)
test_image_LDADD = $(test_ldadd)
test_texels_SOURCES = %D%/test_texels.c
test_texels_CPPFLAGS = $(test_cppflags)
test_texels_LDADD = $(test_ldadd)
EXTRA_DIST += tests/data/images/make.py tests/data/images/texels.tsv $(image_files)
image_files = \
	tests/data/images/bits.bmp \
	tests/data/images/bits.pbm \
	tests/data/images/bits4.pbm \
	tests/data/images/grey100.pgm \
	tests/data/images/grey1000.pgm \
	tests/data/images/grey16-text.pgm \
	tests/data/images/grey16.pgm \
	tests/data/images/grey16.png \
	tests/data/images/grey16.tif \
	tests/data/images/grey2.png \
	tests/data/images/grey8.pgm \
	tests/data/images/grey8.png \
	tests/data/images/grey8.tga \
	tests/data/images/grey8.tif \
	tests/data/images/greya8.png \
	tests/data/images/ham6.iff \
	tests/data/images/packed.hdr \
	tests/data/images/palette-packed.iff \
	tests/data/images/palette-rle.tga \
	tests/data/images/palette-rle4.bmp \
	tests/data/images/palette-rle8.bmp \
	tests/data/images/palette.gif \
	tests/data/images/palette.iff \
	tests/data/images/palette4.bmp \
	tests/data/images/palette4.png \
	tests/data/images/palette4.tif \
	tests/data/images/palette8.bmp \
	tests/data/images/palette8.png \
	tests/data/images/palette8.tif \
	tests/data/images/photo.exr \
	tests/data/images/tiled.exr tests/data/images/luma.exr tests/data/images/saturated.exr \
	tests/data/images/saturated.tsv tests/data/images/cmyk.jpg \
	tests/data/images/rgb555.bmp tests/data/images/rgb565.bmp tests/data/images/argb4444.bmp \
	tests/data/images/xbgr32.bmp tests/data/images/palette-interlaced.gif \
	tests/data/images/photo.jpg \
	tests/data/images/plain.hdr \
	tests/data/images/rgb16-text.ppm \
	tests/data/images/rgb16.png \
	tests/data/images/rgb16.ppm \
	tests/data/images/rgb16.tif \
	tests/data/images/rgb24-rle.tga \
	tests/data/images/rgb24-top.bmp \
	tests/data/images/rgb24.bmp \
	tests/data/images/rgb24.iff \
	tests/data/images/rgb24.tga \
	tests/data/images/rgb8-gama.png \
	tests/data/images/rgb8-text.ppm \
	tests/data/images/rgb8.png \
	tests/data/images/rgb8.ppm \
	tests/data/images/rgb8.tif \
	tests/data/images/rgba16.tga \
	tests/data/images/rgba32.bmp \
	tests/data/images/rgba32.tga \
	tests/data/images/rgba8.png \
	tests/data/images/rgba8.tif
