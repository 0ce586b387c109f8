#include "trace/projected.h"

#include <stdlib.h>

#include "scene/boundary.h"
#include "scene/shape.h"

static void gather(const struct object *o, struct ray ray, struct boundary_list *out)
{
    if (!o->transform->identity)
        ray = transform_inverse_ray(o->transform, &ray);
    if (o->kind == OBJECT_SHAPE) {
        struct boundary_list own = {0};
        o->ops->intersect(o->shape, &ray, &own);
        for (uint32_t i = 0; i < own.count; i++) {
            const struct boundary *b = &own.at[i];
            if (b->t > 0)
                boundary_list_add(out, b->t, b->dt, b->crossing, b->part)->drawn =
                    b->drawn;
        }
        boundary_list_free(&own);
    } else if (o->kind == OBJECT_CSG) {
        for (uint32_t i = 0; i < o->child_count; i++)
            gather(o->child[i], ray, out);
    }
}

static int by_t(const void *a, const void *b)
{
    const double p = ((const struct boundary *)a)->t, q = ((const struct boundary *)b)->t;
    return (p > q) - (p < q);
}

double object_first_hit(const struct object *o, struct vec3 origin, struct vec3 d)
{
    const struct ray ray = {origin, d, 0, INFINITY};
    struct boundary_list l = {0};
    gather(o, ray, &l);
    if (l.count)
        qsort(l.at, l.count, sizeof *l.at, by_t);
    double hit = INFINITY, before = 0;
    // A crossing of a leaf is one of the whole where the inside changes across it.
    bool inside = l.count && object_inside(o, ray_at(&ray, l.at[0].t / 2));
    for (uint32_t i = 0; i < l.count && hit == INFINITY; i++) {
        const double t = l.at[i].t;
        if (i + 1 < l.count && l.at[i + 1].t == t)
            continue;
        const double after = i + 1 < l.count ? (t + l.at[i + 1].t) / 2 : t + (t - before);
        const bool then = object_inside(o, ray_at(&ray, after));
        if (l.at[i].drawn && (then != inside || l.at[i].crossing == CROSS_TOUCH))
            hit = t;
        inside = then;
        before = t;
    }
    boundary_list_free(&l);
    return hit;
}
