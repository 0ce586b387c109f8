check_PROGRAMS += test_form_factors test_solvers
test_form_factors_SOURCES = %D%/meshes.c %D%/meshes.h %D%/test_form_factors.c
test_form_factors_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_form_factors_LDADD = $(test_ldadd)
test_solvers_SOURCES = %D%/meshes.c %D%/meshes.h %D%/test_solvers.c
test_solvers_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_solvers_LDADD = $(test_ldadd)
check_PROGRAMS += test_scenes
test_scenes_SOURCES = %D%/test_scenes.c
test_scenes_CPPFLAGS = $(test_cppflags)
test_scenes_LDADD = $(test_ldadd)

# The truths of whole scenes at full size: minutes.
check-radiosity: test_scenes$(EXEEXT)
	LAMBERT_RADIOSITY_FULL=1 $(AM_TESTS_ENVIRONMENT) ./test_scenes$(EXEEXT)
.PHONY: check-radiosity
