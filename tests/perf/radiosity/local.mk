# Radiosity against truths: `make radiosity-data` measures (half an hour), `make
# radiosity-chart` draws doc/radiosity.svg from the committed tables.
EXTRA_PROGRAMS += radiosity_bench radiosity_stability radiosity_truth
radiosity_bench_SOURCES = %D%/radiosity_bench.c
radiosity_bench_LDADD = $(lambert_libs)
radiosity_truth_SOURCES = %D%/radiosity_truth.c
radiosity_truth_LDADD = -lm
radiosity_stability_SOURCES = %D%/radiosity_stability.c \
	tests/unit/radiosity/meshes.c tests/unit/radiosity/meshes.h
radiosity_stability_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests/unit/radiosity
radiosity_stability_LDADD = $(lambert_libs)
EXTRA_DIST += %D%/cap.pov %D%/chart.gp %D%/cornell.pov %D%/cube.pov %D%/discs.pov \
	%D%/povray.tsv %D%/run.sh %D%/solutions.tsv %D%/stability.tsv doc/radiosity.svg
radiosity-data: radiosity_bench radiosity_stability
	bash $(top_srcdir)/tests/perf/radiosity/run.sh . $(top_srcdir)/tests/perf/radiosity
radiosity-chart:
	gnuplot -e "data='$(top_srcdir)/tests/perf/radiosity'; out='$(top_srcdir)/doc/radiosity.svg'" \
	  $(top_srcdir)/tests/perf/radiosity/chart.gp
.PHONY: radiosity-data radiosity-chart
