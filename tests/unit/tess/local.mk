check_PROGRAMS += test_tess_mesh
test_tess_mesh_SOURCES = %D%/test_mesh.c
test_tess_mesh_CPPFLAGS = $(test_cppflags)
test_tess_mesh_LDADD = $(test_ldadd)
check_PROGRAMS += test_tess_map
test_tess_map_SOURCES = %D%/test_map.c tests/unit/scene/fake_args.c tests/unit/scene/fake_args.h
test_tess_map_CPPFLAGS = $(test_cppflags)
test_tess_map_LDADD = $(test_ldadd)
