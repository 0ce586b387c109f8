check_PROGRAMS += test_library
test_library_SOURCES = %D%/test_library.c
test_library_CPPFLAGS = $(test_cppflags) $(LOADED_CPPFLAGS)
test_library_LDADD = $(test_ldadd)
check_PROGRAMS += test_diag
test_diag_SOURCES = %D%/test_diag.c
test_diag_CPPFLAGS = $(test_cppflags)
test_diag_LDADD = $(test_ldadd)
