check_PROGRAMS += test_store
test_store_SOURCES = %D%/test_store.c
test_store_CPPFLAGS = $(test_cppflags)
test_store_LDADD = $(test_ldadd)

check_PROGRAMS += test_gather
test_gather_SOURCES = %D%/test_gather.c
test_gather_CPPFLAGS = $(test_cppflags)
test_gather_LDADD = $(test_ldadd)
