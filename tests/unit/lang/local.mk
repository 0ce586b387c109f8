check_PROGRAMS += test_stream
test_stream_SOURCES = %D%/test_stream.c
test_stream_CPPFLAGS = $(test_cppflags)
test_stream_LDADD = $(test_ldadd)
