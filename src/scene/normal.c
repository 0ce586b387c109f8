// Bumps: a surface normal turned by a pattern (spec/textures 11).

#include "base/arena.h"
#include "scene/image_map.h"
#include "scene/surface_eval.h"

// `accuracy` this large changes nothing; the strength of the bump goes with it.
#define ACCURACY_UNIT 0.02

// keep: the length of the normal, as the entries of a map with no_bump_scale do.
static struct vec3 perturb(const struct normal *n, struct vec3 v, struct vec3 place,
                           const struct texture_point *at, bool keep);

double normal_slope_height(const struct slope_map *m, double v)
{
    uint32_t a, b;
    double t;
    map_find(m->key, m->count, v, &a, &b, &t);
    if (a == b)
        return m->entry[b].u;
    const struct vec2 p = m->entry[a], q = m->entry[b];
    return t * t * t * (p.v + q.v + 2 * (p.u - q.u)) -
           t * t * (2 * p.v + q.v + 3 * (p.u - q.u)) + t * p.v + p.u;
}

const struct vec3 normal_sides[4] = {
    {0.942809041, -0.333333333, 0},
    {-0.471404521, -0.333333333, 0.816496581},
    {-0.471404521, -0.333333333, -0.816496581},
    {0, 1, 0},
};

double normal_difference_scale(const struct normal *n)
{
    return n->amount * -5.0 * (ACCURACY_UNIT / n->delta);
}

// The gradient of the value by differences along four directions.
static struct vec3 by_differences(const struct normal *n, struct vec3 v, struct vec3 q,
                                  const struct texture_point *at)
{
    const struct pattern_context c = pattern_context_of(at);
    const double scale = normal_difference_scale(n);
    for (int i = 0; i < 4; i++) {
        const struct vec3 s = vec3_mad(q, n->delta, normal_sides[i]);
        double h = pattern_value_at(&n->pattern, s, &c);
        if (n->kind == NORMAL_SLOPES)
            h = normal_slope_height(n->slopes, h);
        v = vec3_mad(v, h * scale, normal_sides[i]);
    }
    return v;
}

static struct vec3 by_map(const struct normal *n, struct vec3 v, struct vec3 q,
                          const struct texture_point *at, bool keep)
{
    const struct pattern_context c = pattern_context_of(at);
    const struct normal_map *m = n->map;
    uint32_t a, b;
    double f;
    map_find(m->key, m->count, pattern_value_at(&n->pattern, q, &c), &a, &b, &f);
    struct vec3 high = perturb(m->entry[b], v, q, at, keep);
    if (a == b)
        return high;
    return vec3_mad(vec3_scale(1 - f, perturb(m->entry[a], v, q, at, keep)), f, high);
}

static struct vec3 by_average(const struct normal_map *m, struct vec3 v, struct vec3 q,
                              const struct texture_point *at, bool keep)
{
    struct vec3 sum = {0, 0, 0};
    double total = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        sum = vec3_mad(sum, m->key[i], perturb(m->entry[i], v, q, at, keep));
        total += m->key[i];
    }
    return vec3_scale(1 / total, sum);
}

static struct vec3 perturb(const struct normal *n, struct vec3 v, struct vec3 place,
                           const struct texture_point *at, bool keep)
{
    keep |= n->no_bump_scale;
    if (n->kind == NORMAL_UV)
        return vec3_normalize(perturb(n->map->entry[0], v, uv_point(at), at, keep));
    const struct pattern *p = &n->pattern;
    const struct vec3 q = pattern_warp(p, place);
    v = pattern_normal_in(p, v, keep);
    switch (n->kind) {
    case NORMAL_MAP: v = by_map(n, v, q, at, keep); break;
    case NORMAL_AVERAGE: v = by_average(n->map, v, q, at, keep); break;
    case NORMAL_PATTERN:
    case NORMAL_SLOPES:
        if (!p->ops)
            break; // flat: an entry of a normal list that was not given
        v = p->ops->perturb ? p->ops->perturb(p, n->amount, v, q)
                            : by_differences(n, v, q, at);
        break;
    case NORMAL_BUMP_MAP:
        if (n->image)
            v = image_map_bump(n->image, n->amount, v, q);
        break;
    case NORMAL_UV: break;
    }
    return pattern_normal_out(p, v, keep);
}

struct vec3 normal_perturb(const struct normal *n, const struct texture_point *at)
{
    return perturb(n, at->normal, texture_place(at), at, false);
}

const struct normal *normal_transform(struct arena *a, const struct normal *n,
                                      const struct transform *t)
{
    if (n->kind == NORMAL_UV)
        return n;
    struct normal *copy = arena_new_struct(a, struct normal);
    *copy = *n;
    pattern_add_transform(a, &copy->pattern, t);
    return copy;
}
