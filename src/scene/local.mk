liblambert_a_SOURCES += \
	%D%/args.h %D%/boundary.c %D%/boundary.h %D%/camera.h %D%/effects.h %D%/light.h \
	%D%/object.c %D%/object.h %D%/object_print.c \
	%D%/pattern.h %D%/patterns.def %D%/scene.h %D%/shape.c %D%/shape.h %D%/shapes.def %D%/texture.h \
	%D%/shapes/blob.c %D%/shapes/box.c %D%/shapes/box.h %D%/shapes/cone.c %D%/shapes/cone.h \
	%D%/shapes/cylinder.c %D%/shapes/cylinder.h %D%/shapes/disc.c %D%/shapes/disc.h \
	%D%/shapes/extrude.c %D%/shapes/extrude.h %D%/shapes/frame.c %D%/shapes/frame.h \
	%D%/shapes/lathe.c %D%/shapes/outline.c %D%/shapes/outline.h \
	%D%/shapes/plane.c %D%/shapes/plane.h %D%/shapes/poly.c %D%/shapes/prism.c \
	%D%/shapes/quadric.c %D%/shapes/quadric.h %D%/shapes/revolve.c %D%/shapes/revolve.h \
	%D%/shapes/sor.c %D%/shapes/sphere.c %D%/shapes/sphere.h %D%/shapes/superellipsoid.c \
	%D%/shapes/text.c %D%/shapes/torus.c %D%/shapes/triangle.c %D%/shapes/triangle.h
