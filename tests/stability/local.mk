stability_sources = %D%/loaded.c %D%/loaded.h %D%/scenes.h
check_PROGRAMS += test_stability
test_stability_SOURCES = %D%/test_stability.c %D%/cases.def %D%/cases.h $(stability_sources)
test_stability_CPPFLAGS = $(test_cppflags)
test_stability_LDADD = $(test_ldadd)
check_PROGRAMS += test_pictures
test_pictures_SOURCES = %D%/test_pictures.c $(stability_sources)
test_pictures_CPPFLAGS = $(test_cppflags)
test_pictures_LDADD = $(test_ldadd)
check_PROGRAMS += test_nested
test_nested_SOURCES = %D%/test_nested.c $(stability_sources)
test_nested_CPPFLAGS = $(test_cppflags)
test_nested_LDADD = $(test_ldadd)
# On demand: make accuracy, then povray.sh (doc/accuracy.md).
EXTRA_PROGRAMS += accuracy
accuracy_SOURCES = %D%/accuracy.c $(stability_sources) %D%/cases.def %D%/cases.h
accuracy_CPPFLAGS = $(test_cppflags)
accuracy_LDADD = $(test_ldadd)
EXTRA_DIST += %D%/povray.sh %D%/failures.sh doc/failures.png
check_PROGRAMS += test_states
test_states_SOURCES = %D%/test_states.c $(stability_sources)
test_states_CPPFLAGS = $(test_cppflags)
test_states_LDADD = $(test_ldadd)
check_PROGRAMS += test_functions
test_functions_SOURCES = %D%/test_functions.c $(stability_sources)
test_functions_CPPFLAGS = $(test_cppflags)
test_functions_LDADD = $(test_ldadd)
check_PROGRAMS += test_lanes
test_lanes_SOURCES = %D%/test_lanes.c $(stability_sources)
test_lanes_CPPFLAGS = $(test_cppflags)
test_lanes_LDADD = $(test_ldadd)
check_PROGRAMS += test_random_rays
test_random_rays_SOURCES = %D%/test_random_rays.c %D%/samples.h $(stability_sources)
test_random_rays_CPPFLAGS = $(test_cppflags)
test_random_rays_LDADD = $(test_ldadd)
check_PROGRAMS += test_chains
test_chains_SOURCES = %D%/test_chains.c $(stability_sources)
test_chains_CPPFLAGS = $(test_cppflags)
test_chains_LDADD = $(test_ldadd)
# The random tests with many more rays; minutes, so by hand.
check-long: test_random_rays test_states test_nested
	LAMBERT_ROUNDS=10000 ./test_random_rays
	LAMBERT_ROUNDS=20000 ./test_states
	LAMBERT_ROUNDS=20000 ./test_nested
.PHONY: check-long
