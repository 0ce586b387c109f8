liblambert_a_SOURCES += \
	%D%/args.c %D%/build.h %D%/build_atmosphere.c %D%/build_camera.c \
	%D%/build_csg.c %D%/build_default_map.c %D%/build_effects.c \
	%D%/build_finish.c %D%/build_function.c %D%/build_interior.c \
	%D%/build_items.c %D%/build_light.c %D%/build_map.c %D%/build_modifier.c \
	%D%/build_normal.c %D%/build_object.c %D%/build_pattern.c \
	%D%/build_pigment.c %D%/build_settings.c %D%/build_texture.c \
	%D%/build_transform.c %D%/build_warp.c %D%/builder.c
liblambert_a_SOURCES += \
	%D%/builder.h %D%/eval.h %D%/value.h
