liblambert_a_SOURCES += \
	%D%/args.h %D%/mesh_camera.c %D%/mesh_camera.h %D%/boundary.c %D%/boundary.h %D%/camera.h %D%/effects.h %D%/light.h \
	%D%/object.c %D%/object.h %D%/object_print.c \
	%D%/pattern.h %D%/patterns.def %D%/scene.h %D%/shape.c %D%/shape.h %D%/shape_kernels.h %D%/shape_lane.c %D%/shapes.def %D%/texture.h \
	%D%/shapes/blob.c %D%/shapes/blob_walk.c %D%/shapes/blob_tree.c %D%/shapes/box.c %D%/shapes/box.h %D%/shapes/conic.c %D%/shapes/cone.c %D%/shapes/cone.h \
	%D%/shapes/cylinder.c %D%/shapes/cylinder.h %D%/shapes/disc.c %D%/shapes/disc.h \
	%D%/shapes/parametric.c %D%/shapes/parametric.h %D%/shapes/parametric_cells.c \
	%D%/shapes/container.c %D%/shapes/container.h %D%/shapes/isosurface.c \
	%D%/shapes/isosurface.h %D%/shapes/isosurface_open.h %D%/shapes/isosurface_tree.c %D%/shapes/isosurface_walk.c \
	%D%/shapes/extrude.c %D%/shapes/extrude.h %D%/shapes/frame.c %D%/shapes/frame.h \
	%D%/shapes/height_field.c %D%/shapes/height_field.h %D%/shapes/julia.h %D%/shapes/julia_fractal.c %D%/shapes/julia_iterate.c \
	%D%/shapes/lathe.c %D%/shapes/mesh.c %D%/shapes/mesh.h %D%/shapes/mesh_read.c %D%/shapes/mesh_read.h %D%/shapes/mesh_soup.c %D%/shapes/outline.c %D%/shapes/outline.h \
	%D%/shapes/ovus.c %D%/shapes/ovus.h %D%/shapes/bicubic_patch.c %D%/shapes/patch.h %D%/shapes/patch_meet.c %D%/shapes/patch_pov.c \
	%D%/shapes/patch_tree.c %D%/shapes/slabs.h %D%/shapes/plane.c %D%/shapes/plane.h %D%/shapes/poly.c %D%/shapes/poly.h %D%/shapes/poly_bounds.c %D%/shapes/poly_roots.c %D%/shapes/polygon.c %D%/shapes/prism.c \
	%D%/shapes/quadric.c %D%/shapes/quadric.h %D%/shapes/revolve.c %D%/shapes/revolve.h \
	%D%/shapes/sor.c %D%/shapes/sphere.c %D%/shapes/sphere.h %D%/shapes/sphere_sweep.c %D%/shapes/superellipsoid.c %D%/shapes/superellipsoid.h \
	%D%/shapes/superellipsoid_walk.c %D%/shapes/superellipsoid_walk.h \
	%D%/shapes/text.c %D%/shapes/torus.c %D%/shapes/torus.h %D%/shapes/triangle.c %D%/shapes/triangle.h
# functions
liblambert_a_SOURCES += \
	%D%/tape.def %D%/tape.h %D%/tape_bounds.c %D%/tape_build.c %D%/tape_build.h \
	%D%/tape_builder.h %D%/tape_call.c %D%/tape_equal.c %D%/tape_finish.c \
	%D%/tape_packet.c %D%/range_lanes.h %D%/tape_print.c %D%/tape_run.c %D%/tape_steps.h
# textures
liblambert_a_SOURCES += \
	%D%/finish.c %D%/interior.c %D%/map.c %D%/noise.c %D%/noise.h %D%/noise_packet.c %D%/noise_bounds.c %D%/noise_tables.h %D%/normal.c \
	%D%/pattern.c %D%/pattern_bounds.c %D%/pattern_formula.c %D%/pattern_formula.h %D%/pattern_function.c \
	%D%/pattern_function.h %D%/pattern_math.h %D%/pigment.c %D%/pigment_tape.c %D%/pigment_tape.h %D%/plain_lanes.h %D%/ramp_lanes.h %D%/surface_eval.h %D%/texture.c \
	%D%/warp.c %D%/warp.h %D%/warp_lanes.h
liblambert_a_SOURCES += \
	%D%/patterns/agate.c %D%/patterns/aoi.c %D%/patterns/boxed.c %D%/patterns/bozo.c %D%/patterns/plain_noise.c %D%/patterns/plain_noise.h \
	%D%/patterns/brick.c %D%/patterns/bumps.c %D%/patterns/cells.c \
	%D%/patterns/checker.c %D%/patterns/cubic.c %D%/patterns/cylindrical.c \
	%D%/patterns/dents.c %D%/patterns/function.c %D%/patterns/gradient.c \
	%D%/patterns/granite.c %D%/patterns/hexagon.c %D%/patterns/leopard.c \
	%D%/patterns/marble.c %D%/patterns/object.c %D%/patterns/onion.c \
	%D%/patterns/pigment_pattern.c %D%/patterns/planar.c %D%/patterns/quilted.c \
	%D%/patterns/radial.c %D%/patterns/ripples.c %D%/patterns/slope.c \
	%D%/patterns/spherical.c %D%/patterns/spiral.h %D%/patterns/spiral1.c \
	%D%/patterns/spiral2.c %D%/patterns/spotted.c %D%/patterns/square.c \
	%D%/patterns/triangular.c %D%/patterns/waves.c %D%/patterns/wood.c \
	%D%/patterns/wrinkles.c %D%/patterns/mandel.c %D%/patterns/julia.c \
	%D%/patterns/magnet.c %D%/patterns/crackle.h %D%/patterns/crackle_bounds.c %D%/patterns/fractal.h %D%/patterns/cellular.h %D%/patterns/rings.h \
	%D%/patterns/crackle.c %D%/patterns/facets.c \
	%D%/density_grid.c %D%/density_grid.h %D%/patterns/density_file.c \
	%D%/image_map.c %D%/image_map.h %D%/patterns/image_pattern.c \
	%D%/patterns/pavement.c %D%/patterns/pavement.def %D%/patterns/paving.c %D%/patterns/paving.h %D%/patterns/tiling.c \
	%D%/patterns/tiling.h %D%/patterns/tiling_mixed.c %D%/patterns/tiling_penrose.c
# The noise tables are computed, not written down.
noinst_PROGRAMS += gen_noise_tables
gen_noise_tables_SOURCES = %D%/gen_noise_tables.c %D%/noise_tables.h
nodist_liblambert_a_SOURCES += %D%/noise_tables.c
CLEANFILES += %D%/noise_tables.c
%D%/noise_tables.c: gen_noise_tables$(EXEEXT)
	$(AM_V_GEN)$(MKDIR_P) %D% && ./gen_noise_tables$(EXEEXT) >$@.tmp && mv $@.tmp $@
liblambert_a_SOURCES += %D%/camera.c %D%/camera_frame.h %D%/light.c
