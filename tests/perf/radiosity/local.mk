# Radiosity against truths: `make radiosity-data` measures, `make radiosity-chart` draws
# doc/radiosity.svg from the committed tables. PARTS=csg, PARTS='cube pictures-cube' and what
# run.sh reads (ONLY, RUNS, LIMIT) measure some of it.
EXTRA_PROGRAMS += radiosity_bench radiosity_picture radiosity_stability radiosity_truth
radiosity_bench_SOURCES = %D%/radiosity_bench.c %D%/truth.c %D%/truth.h
radiosity_bench_LDADD = $(lambert_libs)
radiosity_picture_SOURCES = %D%/radiosity_picture.c %D%/truth.c %D%/truth.h
radiosity_picture_LDADD = $(lambert_libs)
radiosity_stability_SOURCES = %D%/radiosity_stability.c \
	tests/unit/radiosity/meshes.c tests/unit/radiosity/meshes.h
radiosity_stability_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/tests/unit/radiosity
radiosity_stability_LDADD = $(lambert_libs)
radiosity_truth_SOURCES = %D%/radiosity_truth.c
radiosity_truth_LDADD = -lm
EXTRA_DIST += %D%/chart.gp %D%/cornell.faces %D%/cornell.pov %D%/cornell.truth.tsv \
	%D%/csg.pov %D%/cube.pov %D%/cube.truth.tsv %D%/pictures.tsv %D%/room.faces \
	%D%/room.pov %D%/room.truth.tsv %D%/run.sh %D%/solutions.tsv %D%/stability.tsv \
	doc/radiosity.svg
radiosity-data: radiosity_bench radiosity_picture radiosity_stability lambert
	bash $(top_srcdir)/tests/perf/radiosity/run.sh . $(top_srcdir)/tests/perf/radiosity $(PARTS)
# The tables of truth: the cube in seconds, the others in minutes each.
radiosity-truth: radiosity_truth
	cd $(top_srcdir)/tests/perf/radiosity && \
	  b=$(abs_builddir)/radiosity_truth && $$b cube >cube.truth.tsv && \
	  $$b cornell.faces 1e8 >cornell.truth.tsv && $$b room.faces 1.2e7 >room.truth.tsv
radiosity-chart:
	gnuplot -e "data='$(top_srcdir)/tests/perf/radiosity'; out='$(top_srcdir)/doc/radiosity.svg'" \
	  $(top_srcdir)/tests/perf/radiosity/chart.gp
.PHONY: radiosity-data radiosity-truth radiosity-chart
