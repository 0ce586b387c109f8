stability_sources = %D%/loaded.c %D%/loaded.h
check_PROGRAMS += test_stability
test_stability_SOURCES = %D%/test_stability.c %D%/cases.def %D%/cases.h $(stability_sources)
test_stability_CPPFLAGS = $(test_cppflags)
test_stability_LDADD = $(test_ldadd)
