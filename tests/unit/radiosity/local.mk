check_PROGRAMS += test_form_factors test_solvers
test_form_factors_SOURCES = %D%/meshes.c %D%/meshes.h %D%/test_form_factors.c
test_form_factors_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_form_factors_LDADD = $(test_ldadd)
test_solvers_SOURCES = %D%/meshes.c %D%/meshes.h %D%/test_solvers.c
test_solvers_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/%D%
test_solvers_LDADD = $(test_ldadd)
