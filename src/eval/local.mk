liblambert_a_SOURCES += \
	%D%/args.c %D%/build.h %D%/build_array.c %D%/build_atmosphere.c %D%/build_camera.c \
	%D%/build_csg.c %D%/build_default_map.c %D%/build_effects.c \
	%D%/build_density_file.c %D%/build_finish.c %D%/build_function.c \
	%D%/build_image.c %D%/build_interior.c \
	%D%/build_items.c %D%/build_light.c %D%/build_map.c %D%/build_modifier.c \
	%D%/build_normal.c %D%/build_object.c %D%/build_pattern.c \
	%D%/build_pigment.c %D%/build_settings.c %D%/build_texture.c \
	%D%/build_transform.c %D%/build_warp.c %D%/builder.c
liblambert_a_SOURCES += \
	%D%/array.c %D%/array.h %D%/builder.h %D%/calc.c %D%/calc.h %D%/calc_compile.c %D%/color.c %D%/eval.c %D%/eval.h \
	%D%/expr.c %D%/expr.h %D%/file_data.c %D%/file_data.h %D%/file_io.c %D%/file_io.h \
	%D%/files.c %D%/formula.c %D%/formula.h %D%/function.c %D%/function.h \
	%D%/function_compile.c %D%/function_compile.h \
	%D%/functions.c %D%/functions.def \
	%D%/functions.h %D%/host.c %D%/image_source.c %D%/image_source.h %D%/include_hint.c %D%/include_hint.h %D%/internal.c %D%/internal.def \
	%D%/internal.h %D%/internal_noise.c %D%/message.c %D%/place.c %D%/random.c %D%/spline.c %D%/spline.h \
	%D%/strings.c %D%/symbol.c %D%/symbol.h %D%/text.c %D%/text.h %D%/value.c \
	%D%/value.h
