# tests of unit/eval
check_PROGRAMS += test_values
test_values_SOURCES = %D%/test_values.c
test_values_CPPFLAGS = $(test_cppflags)
test_values_LDADD = $(test_ldadd)
check_PROGRAMS += test_builder
test_builder_SOURCES = %D%/test_builder.c
test_builder_CPPFLAGS = $(test_cppflags)
test_builder_LDADD = $(test_ldadd)
