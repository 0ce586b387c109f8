// The kernels of one instruction set (shape_kernels.h): ISA names it.
#include "scene/shape_kernels.h"

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

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)

const struct shape_kernels PASTE(shape_kernels_, ISA) = {
    .blob = PASTE(blob_closest8_, ISA),
    .extrude = PASTE(extrude_closest8_, ISA),
    .height_field = PASTE(height_closest8_, ISA),
    .isosurface = PASTE(iso_closest8_, ISA),
    .julia = PASTE(julia_closest8_, ISA),
    .ovus = PASTE(ovus_closest8_, ISA),
    .patch = PASTE(patch_closest8_, ISA),
    .poly = PASTE(poly_closest8_, ISA),
    .polygon = PASTE(polygon_closest8_, ISA),
    .revolve = PASTE(revolve_closest8_, ISA),
    .sphere_sweep = PASTE(sweep_closest8_, ISA),
    .superellipsoid = PASTE(superellipsoid_closest8_, ISA),
};
