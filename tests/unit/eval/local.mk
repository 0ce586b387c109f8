# tests of unit/eval
check_PROGRAMS += test_values
test_values_SOURCES = %D%/test_values.c
test_values_CPPFLAGS = $(test_cppflags)
test_values_LDADD = $(test_ldadd)
check_PROGRAMS += test_builder
test_builder_SOURCES = %D%/test_builder.c
test_builder_CPPFLAGS = $(test_cppflags)
test_builder_LDADD = $(test_ldadd)
check_PROGRAMS += test_internal
test_internal_SOURCES = %D%/test_internal.c %D%/internal_values.def
test_internal_CPPFLAGS = $(test_cppflags)
test_internal_LDADD = $(test_ldadd)
