# tests of unit/math
check_PROGRAMS += test_elementary
test_elementary_SOURCES = %D%/test_elementary.c
test_elementary_CPPFLAGS = $(test_cppflags)
test_elementary_LDADD = $(test_ldadd)
