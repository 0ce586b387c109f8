liblambert_a_SOURCES += \
	%D%/args.h %D%/boundary.h %D%/camera.h %D%/light.h %D%/object.h \
	%D%/pattern.h %D%/patterns.def %D%/scene.h %D%/shape.h %D%/shapes.def %D%/texture.h
