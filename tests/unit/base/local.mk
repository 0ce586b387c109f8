check_PROGRAMS += test_diag
test_diag_SOURCES = %D%/test_diag.c
test_diag_CPPFLAGS = $(test_cppflags)
test_diag_LDADD = $(test_ldadd)
