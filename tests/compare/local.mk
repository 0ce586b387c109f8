EXTRA_DIST += %D%/run.sh %D%/evaluate.sh

# Against POV-Ray, over its sample scenes; not part of check.
compare: lambert$(EXEEXT)
	$(SHELL) $(top_srcdir)/tests/compare/run.sh ./lambert$(EXEEXT) compare-out
# Reads them and the standard includes with both; not part of check.
evaluate: lambert$(EXEEXT)
	$(SHELL) $(top_srcdir)/tests/compare/evaluate.sh ./lambert$(EXEEXT) evaluate-out
.PHONY: compare evaluate
