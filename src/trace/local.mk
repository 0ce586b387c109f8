liblambert_a_SOURCES += \
	%D%/accel.h %D%/accel.c %D%/accel_classify.c %D%/accel_product.c %D%/coincident.c %D%/coincident.h %D%/contact.c %D%/contact.h %D%/face.h %D%/face_curved.c %D%/face_flat.c %D%/face_pairs.c %D%/face_pairs.h %D%/cutaway.c %D%/cutaway.h %D%/csg_bounds.c %D%/csg_bounds.h %D%/user_bounds.c %D%/user_bounds.h \
	%D%/intersect.c %D%/intersect.h %D%/render.h %D%/scratch.h \
	%D%/stab.c %D%/sweep.c %D%/world.c %D%/world.h \
	%D%/world_build.h %D%/world_flatten.c %D%/world_leaf.c %D%/world_light.c
liblambert_a_SOURCES += \
	%D%/antialias.c %D%/antialias.h %D%/antialias_methods.h %D%/antialias_quarters.c %D%/antialias_scan.c %D%/area.c %D%/area.h %D%/fog.c \
	%D%/indirect.h %D%/indirect_lanes.c %D%/indirect_lanes.h %D%/inside.c %D%/inside.h %D%/job.c %D%/job.h %D%/lamp.c %D%/lamp.h \
	%D%/layers.c %D%/layers.h %D%/lens.c %D%/media.c %D%/media.h \
	%D%/media_light.c %D%/media_wave.c %D%/media_lit.c %D%/media_lit.h %D%/media_march.c %D%/media_march.h \
	%D%/media_mix.c %D%/media_mix.h %D%/photon_flight.h %D%/photon_media.c %D%/photon_grid.c %D%/photon_grid.h \
	%D%/photon_map.c %D%/photon_map.h %D%/photon_path.c %D%/photon_path.h %D%/photon_volley.c %D%/photon_volley.h \
	%D%/photons.c %D%/photons.h %D%/shade_photons.c %D%/subsurface.c %D%/subsurface.h %D%/subsurface_plan.c %D%/mesh_samples.c %D%/mesh_samples.h %D%/near_zero.h %D%/lens.h %D%/paint.c %D%/paint_lit.c %D%/paint_compile.c %D%/paint.h %D%/projected.c %D%/projected.h %D%/render.c \
	%D%/scout.c %D%/scout.h %D%/shade.c %D%/shade.h \
	%D%/shade_light.c %D%/shade_transmit.c %D%/ray_shaft.h %D%/shadow.c %D%/shadow_list.c %D%/shadow_list.h %D%/shadow_walk.c %D%/shadow_walk.h %D%/sky.c %D%/sky.h \
	%D%/simple.c %D%/simple.h %D%/simple_bounce.c %D%/tile.c %D%/tile.h %D%/tracer.c %D%/tracer.h \
	%D%/path_queue.c %D%/wave.c %D%/wave.h %D%/wave_order.c

# What is compiled once per instruction set.
packet_sources = src/scene/noise_kernel.c src/scene/noise_kernel.h src/scene/noise_lattice.h src/scene/noise_bounds_kernel.c \
	src/scene/cells_bounds_kernel.c src/scene/cells_kernel.c src/scene/rings_kernel.c src/scene/grid_kernel.c src/scene/fractal_kernel.c src/scene/pattern_lanes.h \
	src/scene/surface_kernel.c src/scene/shape_kernels.c src/scene/tape_kernel.c src/scene/tape_kernel.h src/scene/tape_slope_lanes.h \
	src/scene/shapes/blob.h src/scene/shapes/blob_lanes.c \
	src/scene/shapes/extrude_lanes.c src/scene/shapes/extrude_lanes.h src/scene/shapes/outline_lanes.h \
	src/scene/shapes/polygon.h src/scene/shapes/polygon_lanes.c \
	src/scene/shapes/height_field_lanes.c src/scene/shapes/height_field_lanes.h \
	src/scene/shapes/revolve_lanes.c \
	src/scene/shapes/sphere_sweep.h src/scene/shapes/sphere_sweep_lanes.c \
	src/scene/shapes/isosurface_lanes.c src/scene/shapes/isosurface_lanes.h \
	src/scene/shapes/patch_lanes.c src/scene/shapes/patch_lanes.h \
	src/scene/shapes/isosurface_lane_roots.h src/scene/shapes/isosurface_lane_values.h \
	src/scene/shapes/julia_lanes.c src/scene/shapes/julia_lanes.h src/scene/shapes/lanes.h src/scene/shapes/ovus_lanes.c src/scene/shapes/superellipsoid_lanes.c src/scene/shapes/poly_lanes.c src/scene/shapes/poly_lanes.h \
	src/irradiance/store.h src/irradiance/store_kernel.c src/irradiance/store_kernel.h \
	src/radiosity/sight_kernel.c src/radiosity/sight_kernel.h \
	%D%/media_kernel.c %D%/photon_kernel.c %D%/photon_search.h %D%/subsurface_kernel.c %D%/subsurface_kernel.h \
	%D%/packet_kernel.c %D%/packet_product.h %D%/packet_quick.h \
	%D%/packet.h %D%/packet_any.h %D%/packet_bound.h %D%/packet_carve.h %D%/packet_clip.h %D%/packet_cross.h %D%/packet_csg.h %D%/packet_csg_spans.h %D%/packet_objects.h %D%/packet_parts.h %D%/packet_shapes.h \
	%D%/packet_lanes.h %D%/packet_list.h %D%/packet_mesh.h %D%/packet_ring.h %D%/packet_shaft.h %D%/packet_sponge.h %D%/packet_torus.h %D%/packet_tree.h \
	%D%/shade_kernel.c %D%/shade_kernel.h %D%/shade_air.h %D%/shade_area.h %D%/shade_lightlets.h %D%/shade_lights.h %D%/shade_bounce.h %D%/shade_camera.h %D%/shade_caustic.h \
	%D%/shade_color.h %D%/shade_judge.h %D%/shade_lamp.h %D%/shade_lanes.h %D%/shade_lit.h %D%/shade_place.h \
	%D%/shade_sheets.h
noinst_LIBRARIES += libpacket_base.a
libpacket_base_a_SOURCES = $(packet_sources)
libpacket_base_a_CPPFLAGS = $(AM_CPPFLAGS) -DISA=base
liblambert_a_SOURCES += %D%/packet.c
packet_objects = $(libpacket_base_a_OBJECTS)
if X86
noinst_LIBRARIES += libpacket_avx2.a libpacket_avx512.a
libpacket_avx2_a_SOURCES = $(packet_sources)
libpacket_avx2_a_CPPFLAGS = $(AM_CPPFLAGS) -DISA=avx2
libpacket_avx2_a_CFLAGS = $(AM_CFLAGS) -mavx2 -mbmi -mbmi2 -mlzcnt -mpopcnt
libpacket_avx512_a_SOURCES = $(packet_sources)
libpacket_avx512_a_CPPFLAGS = $(AM_CPPFLAGS) -DISA=avx512
libpacket_avx512_a_CFLAGS = $(libpacket_avx2_a_CFLAGS) \
	-mavx512f -mavx512dq -mavx512vl -mavx512bw
liblambert_a_CPPFLAGS += -DLAMBERT_X86
packet_objects += $(libpacket_avx2_a_OBJECTS) $(libpacket_avx512_a_OBJECTS)
endif
liblambert_a_LIBADD += $(packet_objects)
EXTRA_liblambert_a_DEPENDENCIES = $(packet_objects)
