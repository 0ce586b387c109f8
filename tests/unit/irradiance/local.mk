check_PROGRAMS += test_store
test_store_SOURCES = %D%/test_store.c
test_store_CPPFLAGS = $(test_cppflags)
test_store_LDADD = $(test_ldadd)
