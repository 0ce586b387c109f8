# Speed against accuracy of intersection: `make intersection-data` measures (minutes), `make
# intersection-chart` draws doc/intersection.svg from the committed table.
EXTRA_PROGRAMS += intersection_bench
intersection_bench_SOURCES = %D%/bench.c %D%/bench.h %D%/csg.c %D%/isosurface.c %D%/patch.c \
	%D%/quad.c %D%/quad.h %D%/quadric.c %D%/quartic.c $(stability_sources)
intersection_bench_CPPFLAGS = $(test_cppflags) -I$(top_srcdir)/tests/stability
intersection_bench_LDADD = $(test_ldadd)
EXTRA_DIST += %D%/chart.gp %D%/intersection.tsv doc/intersection.svg
intersection-data: intersection_bench
	./intersection_bench >$(top_srcdir)/tests/perf/accuracy/intersection.tsv
intersection-chart:
	gnuplot -e "data='$(top_srcdir)/tests/perf/accuracy/intersection.tsv'; \
	  out='$(top_srcdir)/doc/intersection.svg'" $(top_srcdir)/tests/perf/accuracy/chart.gp
.PHONY: intersection-data intersection-chart
