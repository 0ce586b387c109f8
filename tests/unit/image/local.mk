check_PROGRAMS += test_image
test_image_SOURCES = %D%/test_image.c
test_image_CPPFLAGS = $(test_cppflags)
test_image_LDADD = $(test_ldadd)
