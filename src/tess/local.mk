liblambert_a_SOURCES += \
	%D%/contour.c %D%/contour.h %D%/feature.c %D%/mesh.c %D%/mesh.h %D%/sheet.c %D%/sheet.h %D%/solid.c %D%/solid.h
