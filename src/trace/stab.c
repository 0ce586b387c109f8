// A solid less many spheres, without the sweep: from the solid's first crossing the ray is
// moved out of every sphere it is in. Which spheres hold a point, or have a crossing that
// cannot be told from it, the tree of the leaves knows; most are never looked at.
#include "math/gamma.h"
#include "trace/accel.h"
#include "trace/scratch.h"

struct stab {
    const struct world *w;
    struct trace_scratch *s;
    const struct ray *ray;
    const struct bvh8 *tree;
    double size, speed;   // of coordinates; the largest component of d
    struct boundary here; // the crossing reached
    double end;           // where the solid ends
    struct boundary solid[2 * STAB_SOLIDS];
    uint32_t solid_count;
};

// The solid's own leaves: their common span. False: it is empty.
static bool solid_span(struct stab *v, uint32_t object, enum stab_result *result)
{
    const struct accel_large *a = accel_large(v->w->accel, &v->w->object[object], object);
    struct boundary_list *list = &v->s->crossings;
    v->s->own_count = 0;
    v->here.t = -INFINITY;
    v->end = INFINITY;
    *result = STAB_NOTHING;
    for (uint32_t i = 0; i < a->required_count; i++) {
        list->count = 0;
        leaf_crossings_in_csg(v->w, v->s, a->required[i], v->ray);
        v->s->stats.leaf_tests++;
        if (list->count == 0)
            return false;
        if (list->count != 2) {
            *result = STAB_UNSURE;
            return false;
        }
        if (list->at[1].t + list->at[1].dt <= v->ray->t_min)
            return false;
        v->solid[v->solid_count++] = list->at[0];
        v->solid[v->solid_count++] = list->at[1];
        if (list->at[0].t > v->here.t)
            v->here = list->at[0];
        if (list->at[1].t < v->end)
            v->end = list->at[1].t;
    }
    return v->here.t <= v->end;
}

static bool same_crossing(const struct boundary *a, const struct boundary *b)
{
    return a->leaf == b->leaf && a->crossing == b->crossing;
}

// Whether one of the crossings cannot be told from the one reached.
static bool is_near(const struct boundary *b, uint32_t count, const struct boundary *here)
{
    for (uint32_t i = 0; i < count; i++)
        if (!same_crossing(&b[i], here) && fabs(b[i].t - here->t) <= b[i].dt + here->dt)
            return true;
    return false;
}

// Looks at all leaves near the crossing reached; *next is the last end of those it lies
// in. False: some crossing cannot be told from it.
static bool look_around(struct stab *v, struct boundary *next)
{
    if (is_near(v->solid, v->solid_count, &v->here))
        return false;
    const struct vec3 p = vec3_sub(ray_at(v->ray, v->here.t), v->tree->origin);
    // The crossing of a sphere is off by e_p + 1.5 sqrt(e) at most, with e = 6 r e_p and
    // e_p = GAMMA(8) 4 size (scene/shapes/sphere.c): less than 2^-21 of the size.
    const double reach = 0x1p-20 * v->size + 2 * v->here.dt * v->speed;
    float lo[3], hi[3];
    for (int a = 0; a < 3; a++) {
        lo[a] = (float)(vec3_axis(p, a) - reach);
        hi[a] = (float)(vec3_axis(p, a) + reach);
    }
    struct boundary_list *list = &v->s->crossings;
    struct bvh8_walk walk;
    bvh8_walk_begin(&walk, v->tree);
    bool clear = true;
    *next = v->here;
    for (uint32_t first, n; clear && bvh8_walk_box(&walk, v->tree, lo, hi, &first, &n);)
        for (uint32_t i = first; clear && i < first + n; i++) {
            const uint32_t leaf = v->tree->item[i];
            if (!v->w->leaf[leaf].inverted)
                continue;
            list->count = 0;
            leaf_crossings(v->w, leaf, v->ray, list);
            v->s->stats.leaf_tests++;
            clear = !is_near(list->at, list->count, &v->here);
            if (list->count == 2 && list->at[0].t < v->here.t && next->t < list->at[1].t)
                *next = list->at[1];
        }
    v->s->stats.node_visits += walk.visits;
    return clear;
}

enum stab_result stab_object(const struct world *w, struct trace_scratch *s,
                             uint32_t object, const struct ray *ray, double limit,
                             struct boundary *out)
{
    struct stab v = {.w = w,
                     .s = s,
                     .ray = ray,
                     .tree = &accel_large(w->accel, &w->object[object], object)->leaves};
    enum stab_result result;
    if (!solid_span(&v, object, &result))
        return result;
    if (v.here.t > limit)
        return STAB_NOTHING;
    if (v.end <= ray->t_min)
        return STAB_UNSURE;
    if (v.here.t <= ray->t_min) // within the solid; in a hole of it, perhaps
        v.here = (struct boundary){.t = ray->t_min, .leaf = UINT32_MAX};
    s->stats.csg_tests++;
    v.size = vec3_max_abs(ray->o) +
             fmax(vec3_max_abs(v.tree->bounds.min), vec3_max_abs(v.tree->bounds.max));
    v.speed = vec3_max_abs(ray->d);
    for (;;) {
        struct boundary next;
        if (!look_around(&v, &next))
            return STAB_UNSURE;
        if (next.t == v.here.t)
            break; // the crossing counts
        v.here = next;
        if (v.here.t > limit || v.here.t > v.end)
            return STAB_NOTHING;
    }
    if (v.here.leaf == UINT32_MAX || fabs(v.here.t - ray->t_max) <= v.here.dt)
        return STAB_UNSURE;
    if (v.here.t > ray->t_max)
        return STAB_NOTHING;
    *out = boundary_as_shape_has_it(s, &v.here);
    return STAB_FOUND;
}
