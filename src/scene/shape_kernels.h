#ifndef SCENE_SHAPE_KERNELS_H
#define SCENE_SHAPE_KERNELS_H

#include "scene/shape.h"

// Eight rays, as shape_ops.closest8 takes them.
struct shape_rays {
    double o[3][8], d[3][8], t_min[8], t_max[8];
};

// What they meet first; only the lanes that closest8 returns are filled.
struct shape_hits {
    double t[8], dt[8], u[8], v[8];
    uint32_t part[8];
    uint8_t crossing[8];  // enum crossing
    uint64_t evaluations; // added to, as those of a boundary_list
    const volatile bool *cancel; // these two as well
    bool cut;
};

static inline bool shape_hits_give_up(struct shape_hits *h)
{
    if (!h->cancel || !*h->cancel)
        return false;
    return h->cut = true;
}

// What shapes have compiled once per instruction set, with the same results.
struct isosurface;
struct shape_kernels {
    unsigned (*isosurface)(const struct isosurface *s, const struct shape_rays *rays,
                           unsigned lanes, bool any, struct shape_hits *out);
};

extern const struct shape_kernels shape_kernels_base, shape_kernels_avx2,
    shape_kernels_avx512;

#endif
