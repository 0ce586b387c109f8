# What the front end makes of a few scenes, token by token and tree by tree.
golden_files = \
	%D%/input/blocks.pov \
	%D%/tokens/blocks.txt \
	%D%/ast/blocks.txt \
	%D%/csg/blocks.txt \
	%D%/input/csg.pov \
	%D%/tokens/csg.txt \
	%D%/ast/csg.txt \
	%D%/csg/csg.txt \
	%D%/input/directives.pov \
	%D%/tokens/directives.txt \
	%D%/ast/directives.txt \
	%D%/csg/directives.txt
TESTS += %D%/golden.sh
EXTRA_DIST += %D%/golden.sh $(golden_files)
.PHONY: update-golden
update-golden: lambert$(EXEEXT)
	top_builddir='$(top_builddir)' $(SHELL) $(top_srcdir)/%D%/golden.sh --update
