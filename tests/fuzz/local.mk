# Replays the corpus and a few mutants of it; the long run takes a larger count.
noinst_PROGRAMS += fuzz_parse
fuzz_parse_SOURCES = %D%/fuzz_parse.c %D%/mutate.c
fuzz_parse_CPPFLAGS = -D_DEFAULT_SOURCE -DPOVRAY_INCLUDE_DIR='"$(povray_includes)"' $(test_cppflags)
fuzz_parse_LDADD = $(lambert_libs)
noinst_PROGRAMS += fuzz_ini
fuzz_ini_SOURCES = %D%/fuzz_ini.c %D%/mutate.c src/cmd/args.c src/cmd/cmd.h src/cmd/ini.c src/cmd/output.c
fuzz_ini_CPPFLAGS = -D_DEFAULT_SOURCE $(test_cppflags)
fuzz_ini_LDADD = $(lambert_libs)
TESTS += %D%/replay.sh
EXTRA_DIST += %D%/replay.sh \
	%D%/corpus/animation.ini %D%/corpus/many_files.ini %D%/corpus/sections.ini \
	%D%/corpus/blocks.pov %D%/corpus/directives.pov %D%/corpus/functions.pov \
	%D%/corpus/difference_huge.pov %D%/corpus/if_in_case.pov %D%/corpus/if_in_condition.pov \
	%D%/corpus/if_in_elseif.pov %D%/corpus/map_alone.pov %D%/corpus/box_endless.pov %D%/corpus/while_at_end.pov \
	%D%/corpus/subscript_huge.pov %D%/corpus/while_in_macro.pov %D%/corpus/mesh_camera_missed.pov %D%/corpus/lamp_endless.pov \
	%D%/corpus/box_huge.pov %D%/corpus/reach_endless.pov %D%/corpus/count_nowhere.pov \
	%D%/corpus/mirror_nowhere.pov %D%/corpus/blur_endless.pov
# The image readers, over the small files of tests/data/images.
noinst_PROGRAMS += fuzz_image
fuzz_image_SOURCES = %D%/fuzz_image.c %D%/mutate.c
fuzz_image_CPPFLAGS = -D_DEFAULT_SOURCE $(test_cppflags)
fuzz_image_LDADD = $(lambert_libs)
