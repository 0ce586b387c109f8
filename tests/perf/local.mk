# Benchmarks: run by hand (make perf), never by make check.
perf_scenes = \
	%D%/box_minus_2000.scn %D%/csg_1000.scn %D%/drilled_1500.scn %D%/function_calls.scn %D%/function_pigment.scn %D%/glass_balls.scn %D%/mesh_sphere.scn \
	%D%/nested_csg.scn %D%/one_object.scn %D%/quadric_field.scn %D%/shadows_8.scn \
	%D%/spheres_100k.scn %D%/texture_agate.scn %D%/texture_crackle.scn \
	%D%/texture_granite.scn %D%/texture_layers.scn %D%/texture_maps.scn %D%/texture_normals.scn %D%/texture_woods.scn \
	%D%/texture_wrinkles.scn %D%/tori.scn %D%/union_4000.scn
perf_shapes = \
	%D%/shapes/bicubic_patch.scn \
	%D%/shapes/blob.scn \
	%D%/shapes/blob_10000.scn \
	%D%/shapes/blob_cylinders.scn \
	%D%/shapes/box.scn \
	%D%/shapes/cone.scn \
	%D%/shapes/cubic.scn \
	%D%/shapes/cylinder.scn \
	%D%/shapes/disc.scn \
	%D%/shapes/height_field.scn \
	%D%/shapes/height_field_smooth.scn \
	%D%/shapes/isosurface.scn \
	%D%/shapes/isosurface_gyroid.scn \
	%D%/shapes/isosurface_helix.scn \
	%D%/shapes/isosurface_noise.scn \
	%D%/shapes/isosurface_polynomial.scn \
	%D%/shapes/julia_fractal.scn \
	%D%/shapes/julia_hypercomplex.scn \
	%D%/shapes/julia_sin.scn \
	%D%/shapes/lathe_1000.scn \
	%D%/shapes/lathe_bezier.scn \
	%D%/shapes/lathe_cubic.scn \
	%D%/shapes/lathe_linear.scn \
	%D%/shapes/lathe_quadratic.scn \
	%D%/shapes/mesh.scn \
	%D%/shapes/mesh2.scn \
	%D%/shapes/ovus.scn \
	%D%/shapes/parametric.scn \
	%D%/shapes/poly.scn \
	%D%/shapes/poly_order_12.scn \
	%D%/shapes/poly_order_35.scn \
	%D%/shapes/polygon.scn \
	%D%/shapes/prism_bezier.scn \
	%D%/shapes/prism_conic.scn \
	%D%/shapes/prism_cubic.scn \
	%D%/shapes/prism_linear.scn \
	%D%/shapes/quadric.scn \
	%D%/shapes/quartic.scn \
	%D%/shapes/smooth_triangle.scn \
	%D%/shapes/sor.scn \
	%D%/shapes/sphere.scn \
	%D%/shapes/sphere_sweep_b.scn \
	%D%/shapes/sphere_sweep_cubic.scn \
	%D%/shapes/sphere_sweep_linear.scn \
	%D%/shapes/superellipsoid.scn \
	%D%/shapes/text.scn \
	%D%/shapes/torus.scn \
	%D%/shapes/triangle.scn
perf_core = %D%/core/csg.scn %D%/core/flake.scn %D%/core/one.scn %D%/core/sponge.scn
EXTRA_DIST += $(perf_scenes) $(perf_shapes) $(perf_core) %D%/core.sh %D%/examples.sh %D%/run.sh %D%/shapes.sh \
	%D%/parse/generate.sh %D%/parse/run.sh
perf: lambert
	LAMBERT=./lambert bash $(top_srcdir)/tests/perf/run.sh
	LAMBERT=./lambert bash $(top_srcdir)/tests/perf/core.sh
.PHONY: perf
EXTRA_PROGRAMS += trace_bench
trace_bench_SOURCES = %D%/trace_bench.c
trace_bench_LDADD = $(lambert_libs)
