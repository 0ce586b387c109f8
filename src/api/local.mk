liblambert_a_SOURCES += \
	include/lambert/lambert.h \
	%D%/context.c %D%/context.h %D%/gi.c %D%/gi.h %D%/load.c %D%/mesh.c \
	%D%/mesh_file.c %D%/mesh_file.h %D%/options.c %D%/options.def %D%/photon_file.c %D%/photon_file.h %D%/sample_file.c %D%/sample_file.h %D%/picture.c \
	%D%/probe.c %D%/probe.h %D%/render.c %D%/state.c %D%/state.h
lambertincludedir = $(includedir)/lambert
lambertinclude_HEADERS = include/lambert/lambert.h
liblambert_a_CPPFLAGS += -DLAMBERT_VERSION='"$(PACKAGE_VERSION)"' \
	-DLAMBERT_INCLUDE_DIR='"$(pkgdatadir)/include"' \
	-DPOVRAY_INCLUDE_DIR='"$(povray_includes)"'
