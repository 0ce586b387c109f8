#include "scene/shape_kernels.h"

void shape_hits_put(struct shape_hits *h, int lane, const struct boundary *b)
{
    h->t[lane] = b->t;
    h->dt[lane] = b->dt;
    h->u[lane] = b->u;
    h->v[lane] = b->v;
    h->part[lane] = b->part;
    h->crossing[lane] = b->crossing;
}

struct boundary shape_hits_at(const struct shape_hits *h, int lane)
{
    return (struct boundary){.t = h->t[lane],
                             .dt = h->dt[lane],
                             .u = h->u[lane],
                             .v = h->v[lane],
                             .part = h->part[lane],
                             .crossing = h->crossing[lane],
                             .drawn = 1};
}

void shape_lines_add(const struct shape_lines *x, int lane, struct boundary_list *out)
{
    bool leaving = x->leaving >> lane & 1;
    for (int i = 0; i < x->count[lane]; i++, leaving = !leaving)
        boundary_list_add(out, x->t[i][lane], x->dt[i][lane],
                          leaving ? CROSS_EXIT : CROSS_ENTER, 0);
}

struct shape_rays shape_rays_alike(const struct ray *ray)
{
    struct shape_rays rays;
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 3; k++) {
            rays.o[k][i] = vec3_axis(ray->o, k);
            rays.d[k][i] = vec3_axis(ray->d, k);
        }
        rays.t_min[i] = ray->t_min;
        rays.t_max[i] = ray->t_max;
    }
    return rays;
}

struct ray shape_rays_lane(const struct shape_rays *rays, int lane)
{
    return (struct ray){.o = vec3(rays->o[0][lane], rays->o[1][lane], rays->o[2][lane]),
                        .d = vec3(rays->d[0][lane], rays->d[1][lane], rays->d[2][lane]),
                        .t_min = rays->t_min[lane],
                        .t_max = rays->t_max[lane]};
}

unsigned shape_lane_alone(const struct shape_ops *ops, const void *shape,
                          const struct shape_rays *rays, int lane, struct shape_hits *out)
{
    const struct ray ray = shape_rays_lane(rays, lane);
    struct boundary_list list = {.first_only = true, .cancel = out->cancel};
    unsigned found = 0;
    ops->intersect(shape, &ray, &list);
    for (uint32_t i = 0; i < list.count && !found; i++) {
        const struct boundary *b = &list.at[i];
        if (!b->drawn || !(b->t > ray.t_min && b->t <= ray.t_max))
            continue;
        shape_hits_put(out, lane, b);
        found = 1u << lane;
    }
    out->evaluations += list.evaluations;
    out->cut |= list.cut;
    boundary_list_free(&list);
    return found;
}

unsigned shape_lanes_alone(const struct shape_ops *ops, const void *shape,
                           const struct shape_rays *rays, unsigned lanes,
                           struct shape_hits *out)
{
    unsigned met = 0;
    for (; lanes; lanes &= lanes - 1)
        met |= shape_lane_alone(ops, shape, rays, __builtin_ctz(lanes), out);
    return met;
}
