# tests of unit/scene
check_PROGRAMS += test_patterns
test_patterns_SOURCES = %D%/test_patterns.c
test_patterns_CPPFLAGS = $(test_cppflags)
test_patterns_LDADD = $(test_ldadd)
EXTRA_DIST += tests/data/pattern-values.tsv tests/data/normal-values.tsv \
	tests/data/t8.df3 tests/data/t16.df3 tests/data/t32.df3
check_PROGRAMS += test_shape_truths
test_shape_truths_SOURCES = %D%/test_shape_truths.c %D%/fake_args.c %D%/fake_args.h
test_shape_truths_CPPFLAGS = $(test_cppflags)
test_shape_truths_LDADD = $(test_ldadd)
check_PROGRAMS += test_shapes
test_shapes_SOURCES = %D%/test_shapes.c %D%/fake_args.c %D%/fake_args.h
test_shapes_CPPFLAGS = $(test_cppflags)
test_shapes_LDADD = $(test_ldadd)
check_PROGRAMS += test_pattern_packets
test_pattern_packets_SOURCES = %D%/test_pattern_packets.c
test_pattern_packets_CPPFLAGS = $(test_cppflags)
test_pattern_packets_LDADD = $(test_ldadd)
check_PROGRAMS += test_pigment_tapes
test_pigment_tapes_SOURCES = %D%/test_pigment_tapes.c
test_pigment_tapes_CPPFLAGS = $(test_cppflags)
test_pigment_tapes_LDADD = $(test_ldadd)
check_PROGRAMS += test_crackle
test_crackle_SOURCES = %D%/test_crackle.c
test_crackle_CPPFLAGS = $(test_cppflags)
test_crackle_LDADD = $(test_ldadd)
