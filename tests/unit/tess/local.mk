check_PROGRAMS += test_tess_mesh
test_tess_mesh_SOURCES = %D%/test_mesh.c
test_tess_mesh_CPPFLAGS = $(test_cppflags)
test_tess_mesh_LDADD = $(test_ldadd)
