#include "trace/area.h"

#include "base/arena.h"
#include "trace/projected.h"

struct vec3 area_point(const struct lamp *lamp, const struct lamp_grid *grid,
                       uint32_t hash, int u, int v)
{
    double fu = u, fv = v;
    if (lamp->light->jitter) {
        const uint32_t h =
            hash_mix(hash_mix(hash, lamp->index), (uint32_t)(u * lamp->light->size2 + v));
        fu += hash_unit(hash_mix(h, 1)) - 0.5;
        fv += hash_unit(hash_mix(h, 2)) - 0.5;
    }
    return lamp_grid_point(lamp, grid, fu, fv);
}

// The grid as seen from one point; each of its points is traced when first asked for.
struct grid {
    const struct shading *s;
    const struct lamp *lamp;
    const struct shadow_request *request;
    struct lamp_grid place;
    struct rgb *value;
    bool *known;
};

// The shadow ray to a point of the grid.
static struct shadow_request grid_request(const struct grid *g, int u, int v)
{
    const struct vec3 p = g->s->at.p;
    struct lamp_view view;
    lamp_direction(g->lamp, area_point(g->lamp, &g->place, g->s->path->hash, u, v), p,
                   &view);
    struct shadow_request r = *g->request;
    r.d = view.l;
    r.t_max = view.distance;
    r.o = trace_offset(&g->s->at, r.d);
    return r;
}

// Finds the values of the corners of `count` cells that are not known, together: rays from
// one point to one lamp make good packets.
static void grid_ask(struct grid *g, const int (*cell)[4], int count)
{
    struct shadow_request r[16];
    struct rgb value[16];
    int at[16];
    uint32_t n = 0;
    for (int i = 0; i < 4 * count; i++) {
        const int u = cell[i / 4][i & 1 ? 2 : 0], v = cell[i / 4][i & 2 ? 3 : 1];
        const int k = u * g->lamp->light->size2 + v;
        if (g->known[k])
            continue;
        g->known[k] = true;
        at[n] = k;
        r[n++] = grid_request(g, u, v);
    }
    if (g->lamp->light->projected_through)
        for (uint32_t i = 0; i < n; i++)
            value[i] = projected_shadow(g->s->t, g->lamp, &r[i]);
    else
        shadow_factors(g->s->t, r, n, value);
    for (uint32_t i = 0; i < n; i++)
        g->value[at[i]] = value[i];
}

static struct rgb grid_value(const struct grid *g, int u, int v)
{
    return g->value[u * g->lamp->light->size2 + v];
}

static float difference(struct rgb a, struct rgb b, struct rgb color)
{
    return fabsf(color.r * (a.r - b.r)) + fabsf(color.g * (a.g - b.g)) +
           fabsf(color.b * (a.b - b.b));
}

// The mean over a cell {u1, v1, u2, v2} whose corners are known.
static struct rgb grid_mean(struct grid *g, const int cell[4], int level)
{
    static const float notable = 0.1f; // difference of corners that calls for more
    const int u1 = cell[0], v1 = cell[1], u2 = cell[2], v2 = cell[3];
    struct rgb a = grid_value(g, u1, v1), b = grid_value(g, u2, v1),
               c = grid_value(g, u1, v2), d = grid_value(g, u2, v2);
    const struct rgb k = g->lamp->light->color;
    if ((u2 - u1 > 1 || v2 - v1 > 1) &&
        (level < g->lamp->light->adaptive || difference(a, b, k) > notable ||
         difference(c, d, k) > notable || difference(a, c, k) > notable ||
         difference(b, d, k) > notable)) {
        const int ul = (u1 + u2) / 2, uh = (u1 + u2 + 1) / 2;
        const int vl = (v1 + v2) / 2, vh = (v1 + v2 + 1) / 2;
        const int part[4][4] = {
            {u1, v1, ul, vl}, {uh, v1, u2, vl}, {u1, vh, ul, v2}, {uh, vh, u2, v2}};
        grid_ask(g, part, 4);
        a = grid_mean(g, part[0], level + 1);
        b = grid_mean(g, part[1], level + 1);
        c = grid_mean(g, part[2], level + 1);
        d = grid_mean(g, part[3], level + 1);
    }
    return rgb_scale(0.25f, rgb_add(rgb_add(a, b), rgb_add(c, d)));
}

struct rgb area_shadow(const struct shading *s, const struct lamp *lamp,
                       const struct shadow_request *r)
{
    enum { FEW = 400 };
    const int u = lamp->light->size1, v = lamp->light->size2;
    struct rgb few[FEW];
    bool few_known[FEW];
    struct grid g = {s, lamp, r, lamp_grid_of(lamp, s->at.p), few, few_known};
    if (u * v > FEW) {
        g.value = arena_new_array(s->t->arena, struct rgb, (size_t)u * (size_t)v);
        g.known = arena_new_array(s->t->arena, bool, (size_t)u *(size_t)v);
    }
    for (int i = 0; i < u * v; i++)
        g.known[i] = false;
    const int whole[1][4] = {{0, 0, u - 1, v - 1}};
    grid_ask(&g, whole, 1);
    return grid_mean(&g, whole[0], 0);
}

struct rgb projected_shadow(struct tracer *t, const struct lamp *lamp,
                            const struct shadow_request *r)
{
    const double h = object_first_hit(lamp->light->projected_through, r->o, r->d);
    if (!(h < r->t_max))
        return rgb(0, 0, 0);
    if (lamp->light->shadowless)
        return rgb(1, 1, 1);
    struct shadow_request near = *r;
    near.t_max = h;
    return shadow_factor(t, &near);
}
