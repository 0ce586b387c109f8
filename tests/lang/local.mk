# Small scenes of the language. What POV-Ray prints for them is in their comments.
SCN_LOG_DRIVER = $(LOG_DRIVER)
SCN_LOG_COMPILER = $(SHELL) $(top_srcdir)/tests/harness/run-scene.sh
lang_scenes = \
	%D%/001-numbers.scn \
	%D%/002-arithmetic.scn \
	%D%/003-compare.scn \
	%D%/004-logic.scn \
	%D%/005-conditional.scn \
	%D%/006-no-short-circuit.scn \
	%D%/007-vectors.scn \
	%D%/008-widths.scn \
	%D%/009-members.scn \
	%D%/010-colour.scn \
	%D%/011-srgb.scn \
	%D%/012-strings.scn \
	%D%/013-str.scn \
	%D%/014-vstr.scn \
	%D%/015-float-functions.scn \
	%D%/016-vector-functions.scn \
	%D%/017-rand.scn \
	%D%/018-while.scn \
	%D%/019-for.scn \
	%D%/020-switch.scn \
	%D%/021-if.scn \
	%D%/022-macro-values.scn \
	%D%/023-macro-reference.scn \
	%D%/024-macro-recursion.scn \
	%D%/025-macro-scope.scn \
	%D%/026-macro-braces.scn \
	%D%/027-arrays.scn \
	%D%/028-undef.scn \
	%D%/029-include.scn \
	%D%/030-version.scn \
	%D%/031-default.scn \
	%D%/032-copies.scn \
	%D%/033-csg.scn \
	%D%/034-transforms.scn \
	%D%/035-functions.scn \
	%D%/036-splines.scn \
	%D%/037-order.scn \
	%D%/038-commas.scn \
	%D%/039-comments.scn \
	%D%/041-predeclared.scn \
	%D%/042-datetime.scn \
	%D%/043-mixed-blocks.scn \
	%D%/044-blocks-first.scn \
	%D%/045-unicode.scn \
	%D%/046-clipped-names.scn \
	%D%/047-angles-at-any-place.scn
TESTS += $(lang_scenes)
EXTRA_DIST += $(lang_scenes) %D%/locals.inc %D%/show.inc %D%/povray.sh
