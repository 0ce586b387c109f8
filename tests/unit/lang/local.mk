check_PROGRAMS += test_stream
test_stream_SOURCES = %D%/test_stream.c
test_stream_CPPFLAGS = $(test_cppflags)
test_stream_LDADD = $(test_ldadd)
check_PROGRAMS += test_literal
test_literal_SOURCES = %D%/test_literal.c
test_literal_CPPFLAGS = $(test_cppflags)
test_literal_LDADD = $(test_ldadd)
