# tests of unit/scene
check_PROGRAMS += test_patterns
test_patterns_SOURCES = %D%/test_patterns.c
test_patterns_CPPFLAGS = $(test_cppflags)
test_patterns_LDADD = $(test_ldadd)
EXTRA_DIST += tests/data/pattern-values.tsv tests/data/normal-values.tsv
