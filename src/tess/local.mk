liblambert_a_SOURCES += \
	%D%/contour.c %D%/contour.h %D%/feature.c %D%/mesh.c %D%/mesh.h %D%/parts.c %D%/parts.h %D%/sheet.c %D%/sheet.h %D%/solid.c %D%/solid.h \
	%D%/map.c %D%/map.h %D%/map_mesh.c %D%/map_mesh.h %D%/maps.def %D%/maps/bicubic_patch.c %D%/maps/disc.c %D%/maps/quadric.c \
	%D%/maps/revolve.c %D%/maps/torus.c
