// The kernels of one instruction set (shape_kernels.h): ISA names it.
#include "scene/shape_kernels.h"

#include "math/isa.h"
#include "scene/shapes/blob.h"
#include "scene/shapes/extrude_lanes.h"
#include "scene/shapes/height_field_lanes.h"
#include "scene/shapes/isosurface_lanes.h"
#include "scene/shapes/julia_lanes.h"
#include "scene/shapes/ovus.h"
#include "scene/shapes/patch_lanes.h"
#include "scene/shapes/poly_lanes.h"
#include "scene/shapes/polygon.h"
#include "scene/shapes/revolve.h"
#include "scene/shapes/sphere_sweep.h"
#include "scene/shapes/superellipsoid.h"

const struct shape_kernels OF_ISA(shape_kernels_) = {
    .blob = OF_ISA(blob_closest8_),
    .extrude = OF_ISA(extrude_closest8_),
    .height_field = OF_ISA(height_closest8_),
    .isosurface = OF_ISA(iso_closest8_),
    .julia = OF_ISA(julia_closest8_),
    .ovus = OF_ISA(ovus_closest8_),
    .patch = OF_ISA(patch_closest8_),
    .poly = OF_ISA(poly_closest8_),
    .poly_lines = OF_ISA(poly_lines8_),
    .polygon = OF_ISA(polygon_closest8_),
    .revolve = OF_ISA(revolve_closest8_),
    .sphere_sweep = OF_ISA(sweep_closest8_),
    .superellipsoid = OF_ISA(superellipsoid_closest8_),
    .superellipsoid_samples = OF_ISA(superellipsoid_samples8_),
    .superellipsoid_roots = OF_ISA(superellipsoid_roots8_),
    .superellipsoid_least = OF_ISA(superellipsoid_least8_),
};
