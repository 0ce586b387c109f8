# tests of stability
check_PROGRAMS += test_stability
test_stability_SOURCES = %D%/test_stability.c %D%/cases.def
test_stability_CPPFLAGS = $(test_cppflags)
test_stability_LDADD = $(test_ldadd)
