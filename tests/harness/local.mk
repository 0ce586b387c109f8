# Checks of the code base itself, and what the other tests share.
harness_checks = %D%/check-layers.sh %D%/check-state.sh %D%/check-headers.sh \
	%D%/check-tables.sh %D%/compatibility.sh
TESTS += $(harness_checks)
EXTRA_DIST += $(harness_checks) %D%/random.h %D%/test.h %D%/run-scene.sh %D%/same.sh src/LAYERS \
	doc/compatibility.md doc/compatibility.exceptions
.PHONY: update-compatibility
update-compatibility: lambert$(EXEEXT)
	top_srcdir='$(top_srcdir)' top_builddir='$(top_builddir)' \
	  $(SHELL) $(top_srcdir)/%D%/compatibility.sh --update
