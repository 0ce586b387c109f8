# tests of unit/math
check_PROGRAMS += test_elementary
test_elementary_SOURCES = %D%/test_elementary.c
test_elementary_CPPFLAGS = $(test_cppflags)
test_elementary_LDADD = $(test_ldadd)
check_PROGRAMS += test_polynomial
test_polynomial_SOURCES = %D%/test_polynomial.c
test_polynomial_CPPFLAGS = $(test_cppflags)
test_polynomial_LDADD = $(test_ldadd)
check_PROGRAMS += test_bvh8
test_bvh8_SOURCES = %D%/test_bvh8.c
test_bvh8_CPPFLAGS = $(test_cppflags)
test_bvh8_LDADD = $(test_ldadd)
check_PROGRAMS += test_chi_square
test_chi_square_SOURCES = %D%/test_chi_square.c
test_chi_square_CPPFLAGS = $(test_cppflags)
test_chi_square_LDADD = $(test_ldadd)
