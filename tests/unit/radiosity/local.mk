check_PROGRAMS += test_form_factors test_solvers
test_form_factors_SOURCES = %D%/meshes.c %D%/meshes.h %D%/test_form_factors.c
test_form_factors_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_form_factors_LDADD = $(test_ldadd)
test_solvers_SOURCES = %D%/meshes.c %D%/meshes.h %D%/test_solvers.c
test_solvers_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_solvers_LDADD = $(test_ldadd)
check_PROGRAMS += test_sight
test_sight_SOURCES = %D%/scenes.c %D%/scenes.h %D%/test_sight.c
test_sight_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_sight_LDADD = $(test_ldadd)
check_PROGRAMS += test_furnaces test_scenes test_failures test_limits
test_furnaces_SOURCES = %D%/scenes.c %D%/scenes.h %D%/test_furnaces.c
test_furnaces_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_furnaces_LDADD = $(test_ldadd)
test_scenes_SOURCES = %D%/scenes.c %D%/scenes.h %D%/test_scenes.c
test_scenes_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_scenes_LDADD = $(test_ldadd)
test_failures_SOURCES = %D%/scenes.c %D%/scenes.h %D%/test_failures.c
test_failures_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_failures_LDADD = $(test_ldadd)
test_limits_SOURCES = %D%/scenes.c %D%/scenes.h %D%/test_limits.c
test_limits_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_limits_LDADD = $(test_ldadd)
check_PROGRAMS += test_truths
test_truths_SOURCES = %D%/scenes.c %D%/scenes.h %D%/test_truths.c
test_truths_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_truths_LDADD = $(test_ldadd)
check_PROGRAMS += test_light
test_light_SOURCES = %D%/scenes.c %D%/scenes.h %D%/test_light.c \
	tests/perf/radiosity/truth.c tests/perf/radiosity/truth.h
test_light_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D% -I$(top_srcdir)/tests/perf/radiosity
test_light_LDADD = $(test_ldadd)

# The truths of whole scenes at full size: minutes.
radiosity_truths = test_form_factors$(EXEEXT) test_light$(EXEEXT) test_furnaces$(EXEEXT) \
	test_scenes$(EXEEXT) test_failures$(EXEEXT) test_limits$(EXEEXT) test_truths$(EXEEXT)
check-radiosity: $(radiosity_truths)
	for t in $(radiosity_truths); do \
	  LAMBERT_RADIOSITY_FULL=1; export LAMBERT_RADIOSITY_FULL; \
	  $(AM_TESTS_ENVIRONMENT) ./$$t || exit 1; done
check-long: check-radiosity
.PHONY: check-radiosity
