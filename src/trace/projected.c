#include "trace/projected.h"

#include <stdlib.h>

#include "base/arena.h"
#include "scene/boundary.h"
#include "scene/shape.h"
#include "trace/scratch.h"

// A node of the window's tree, in preorder.
struct window_node {
    const struct object *object;
    struct aabb box; // of all crossings of its leaves, outside the window
    uint32_t end;    // of the nodes below it
};

struct window {
    uint32_t count;
    struct window_node node[];
};

static uint32_t node_count(const struct object *o)
{
    uint32_t n = 1;
    for (uint32_t i = 0; o->kind == OBJECT_CSG && i < o->child_count; i++)
        n += node_count(o->child[i]);
    return n;
}

// Many times what crossings are off.
static struct aabb grown(struct aabb b)
{
    static const double margin = 1e-6;
    if (!aabb_is_finite(b))
        return aabb_infinite();
    const double by = margin * fmax(vec3_max_abs(b.min), vec3_max_abs(b.max));
    return (struct aabb){vec3_sub(b.min, vec3(by, by, by)),
                         vec3_add(b.max, vec3(by, by, by))};
}

static struct aabb node_add(struct window *w, const struct object *o,
                            const struct transform *above)
{
    const struct transform t = transform_then(o->transform, above);
    struct window_node *n = &w->node[w->count++];
    struct aabb box = aabb_empty();
    if (o->kind == OBJECT_SHAPE)
        box = grown(aabb_transform(o->ops->bounds(o->shape), &t));
    for (uint32_t i = 0; o->kind == OBJECT_CSG && i < o->child_count; i++)
        box = aabb_join(box, node_add(w, o->child[i], &t));
    *n = (struct window_node){o, box, w->count};
    return box;
}

const struct window *window_new(struct arena *a, const struct object *o)
{
    const struct transform none = transform_identity;
    struct window *w =
        arena_alloc(a, sizeof *w + node_count(o) * sizeof(struct window_node));
    w->count = 0;
    node_add(w, o, &none);
    return w;
}

static void leaf_gather(const struct object *o, const struct ray *ray,
                        struct boundary_list *out)
{
    struct boundary_list own = {0};
    o->ops->intersect(o->shape, ray, &own);
    for (uint32_t i = 0; i < own.count; i++) {
        const struct boundary *b = &own.at[i];
        if (b->t > 0)
            boundary_list_add(out, b->t, b->dt, b->crossing, b->part)->drawn = b->drawn;
    }
    boundary_list_free(&own);
}

// The crossings of the leaves below node i, whose ray comes from the node above.
static void gather(const struct window *w, uint32_t i, const struct box_ray *outside,
                   struct ray ray, struct boundary_list *out)
{
    const struct window_node *n = &w->node[i];
    const struct object *o = n->object;
    double begin;
    if (!box_meets(&n->box, outside, &begin))
        return;
    if (!o->transform->identity)
        ray = transform_inverse_ray(o->transform, &ray);
    if (o->kind == OBJECT_SHAPE)
        leaf_gather(o, &ray, out);
    for (uint32_t k = i + 1; k < n->end; k = w->node[k].end)
        gather(w, k, outside, ray, out);
}

static int by_t(const void *a, const void *b)
{
    const double p = ((const struct boundary *)a)->t, q = ((const struct boundary *)b)->t;
    return (p > q) - (p < q);
}

double window_hit(const struct window *w, struct vec3 origin, struct vec3 d)
{
    const struct ray ray = {origin, d, 0, INFINITY};
    const struct box_ray outside = box_ray_of(&ray);
    const struct object *o = w->node[0].object;
    struct boundary_list l = {0};
    gather(w, 0, &outside, ray, &l);
    if (!l.count)
        return INFINITY;
    qsort(l.at, l.count, sizeof *l.at, by_t);
    double hit = INFINITY, before = 0;
    // A crossing of a leaf is one of the whole where the inside changes across it.
    bool inside = object_inside(o, ray_at(&ray, l.at[0].t / 2));
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

bool window_met(const struct window *w, struct vec3 origin, struct vec3 d, double *t_max)
{
    const double t = window_hit(w, origin, d);
    if (!(t < *t_max))
        return false;
    *t_max = t;
    return true;
}

// ---- batches ----------------------------------------------------------------------------

static bool ray_met(const struct lamp *lamp, struct ray_batch *b, uint32_t i)
{
    return window_met(lamp->window, vec3(b->o[0][i], b->o[1][i], b->o[2][i]),
                      vec3(b->d[0][i], b->d[1][i], b->d[2][i]), &b->t_max[i]);
}

void window_factors_near(struct tracer *t, const struct lamp *lamp, uint32_t count,
                         struct rgb *out)
{
    static const struct rgb none = {0, 0, 0}, all = {1, 1, 1};
    bool met[BATCH_SIZE];
    for (uint32_t i = 0; i < count; i++) {
        met[i] = ray_met(lamp, t->near.rays, i);
        out[i] = all;
    }
    if (!lamp->light->shadowless)
        shadow_factors_near(t, lamp->index, count, out);
    for (uint32_t i = 0; i < count; i++)
        if (!met[i])
            out[i] = none;
}

static void ray_move(struct shadow_batch *b, uint32_t to, uint32_t from)
{
    for (int a = 0; a < 3; a++) {
        b->rays->o[a][to] = b->rays->o[a][from];
        b->rays->d[a][to] = b->rays->d[a][from];
        b->value[a][to] = b->value[a][from];
    }
    b->rays->t_max[to] = b->rays->t_max[from];
    b->slot[to] = b->slot[from];
}

uint32_t window_take(struct tracer *t, const struct lamp *lamp, uint32_t first,
                     uint32_t end)
{
    struct shadow_batch *b = &t->simple;
    uint32_t n = first;
    for (uint32_t i = first; i < end; i++) {
        if (!ray_met(lamp, b->rays, i))
            continue;
        if (!lamp->light->shadowless)
            ray_move(b, n++, i);
        for (int c = 0; lamp->light->shadowless && c < 3; c++)
            t->wave.own[c][b->slot[i]] += b->value[c][i];
    }
    return n;
}
