// The kernels of one instruction set (shape_kernels.h): ISA names it.
#include "scene/shape_kernels.h"

#include "scene/shapes/isosurface_lanes.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)

const struct shape_kernels PASTE(shape_kernels_, ISA) = {
    .isosurface = PASTE(iso_closest8_, ISA),
};
