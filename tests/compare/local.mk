EXTRA_DIST += %D%/run.sh

# Against POV-Ray, over its sample scenes; not part of check.
compare: lambert$(EXEEXT)
	$(SHELL) $(top_srcdir)/tests/compare/run.sh ./lambert$(EXEEXT) compare-out
.PHONY: compare
