check_PROGRAMS += test_api
test_api_SOURCES = %D%/test_api.c
test_api_CPPFLAGS = $(test_cppflags)
test_api_LDADD = $(test_ldadd)
