// The patch's own parameters.
#include "scene/shapes/patch.h"
#include "tess/map.h"

static uint32_t count(const void *shape)
{
    const struct patch *s = shape;
    return s->leaves > 0;
}

static void at(const void *shape, uint32_t piece, double u, double v,
               struct map_point *out)
{
    (void)piece;
    patch_derivatives(shape, u, v, &out->p, &out->du, &out->dv);
    out->n = vec3_normalize(vec3_cross(out->du, out->dv));
}

static uint32_t locate(const void *shape, const struct boundary *b, struct vec3 p,
                       double *u, double *v)
{
    (void)shape;
    (void)p;
    *u = b->u;
    *v = b->v;
    return 0;
}

const struct tess_map bicubic_patch_map = {
    .ops = &bicubic_patch_ops, .count = count, .at = at, .locate = locate};
