# Benchmarks: run by hand (make perf), never by make check.
perf_scenes = \
	%D%/box_minus_2000.scn %D%/csg_1000.scn %D%/drilled_1500.scn %D%/function_calls.scn %D%/function_pigment.scn %D%/glass_balls.scn %D%/mesh_sphere.scn \
	%D%/nested_csg.scn %D%/one_object.scn %D%/quadric_field.scn %D%/shadows_8.scn \
	%D%/spheres_100k.scn %D%/tori.scn %D%/union_4000.scn
EXTRA_DIST += $(perf_scenes) %D%/run.sh
perf: lambert
	LAMBERT=./lambert bash $(top_srcdir)/tests/perf/run.sh
.PHONY: perf
EXTRA_PROGRAMS += trace_bench
trace_bench_SOURCES = %D%/trace_bench.c
trace_bench_LDADD = $(lambert_libs)
