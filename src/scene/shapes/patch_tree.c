// The tree of sub-patches of a Bezier patch, and its points.
#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "scene/shapes/patch.h"

// A leaf is where the first derivatives differ from their mean by less than this share: a
// line then meets it seldom more than once, and Newton's method finds where.
static const double BEND = 0.15;
enum { DEPTH_MAX = 8 };

static struct vec3 middle(struct vec3 a, struct vec3 b)
{
    return vec3_scale(0.5, vec3_add(a, b));
}

// de Casteljau's halves of a cubic.
static void halve(const struct vec3 p[4], struct vec3 low[4], struct vec3 high[4])
{
    const struct vec3 a = middle(p[0], p[1]), b = middle(p[1], p[2]), c = middle(p[2], p[3]);
    const struct vec3 d = middle(a, b), e = middle(b, c), f = middle(d, e);
    low[0] = p[0];
    low[1] = a;
    low[2] = d;
    low[3] = high[0] = f;
    high[1] = e;
    high[2] = c;
    high[3] = p[3];
}

static void split(const struct patch_leaf *from, bool along_u, struct patch_leaf *low,
                  struct patch_leaf *high)
{
    *low = *high = *from;
    if (along_u) {
        for (int j = 0; j < 4; j++) {
            struct vec3 p[4], a[4], b[4];
            for (int i = 0; i < 4; i++)
                p[i] = from->p[i][j];
            halve(p, a, b);
            for (int i = 0; i < 4; i++) {
                low->p[i][j] = a[i];
                high->p[i][j] = b[i];
            }
        }
        low->u[1] = high->u[0] = 0.5 * (from->u[0] + from->u[1]);
        return;
    }
    for (int i = 0; i < 4; i++)
        halve(from->p[i], low->p[i], high->p[i]);
    low->v[1] = high->v[0] = 0.5 * (from->v[0] + from->v[1]);
}

// How much the derivative along one parameter varies, and the length it has.
static double bend(const struct patch_leaf *l, bool along_u, double *length)
{
    struct vec3 d[12], mean = {0, 0, 0};
    int n = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            d[n] = along_u ? vec3_sub(l->p[i + 1][j], l->p[i][j])
                           : vec3_sub(l->p[j][i + 1], l->p[j][i]);
            mean = vec3_mad(mean, 1. / 12, d[n++]);
        }
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, vec3_length(vec3_sub(d[i], mean)));
    *length = vec3_length(mean);
    return most;
}

// What is known of a leaf from all directions.
static void finish_leaf(struct patch_leaf *l, double bend_u, double bend_v)
{
    static const double b[4] = {1. / 8, 3. / 8, 3. / 8, 1. / 8};
    l->middle = l->du = l->dv = vec3(0, 0, 0);
    l->size = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            l->middle = vec3_mad(l->middle, b[i] * b[j], l->p[i][j]);
            l->size = fmax(l->size, vec3_max_abs(l->p[i][j]));
        }
    for (int i = 0; i < 4; i++) {
        l->du = vec3_mad(l->du, 0.25, vec3_sub(l->p[3][i], l->p[0][i]));
        l->dv = vec3_mad(l->dv, 0.25, vec3_sub(l->p[i][3], l->p[i][0]));
    }
    l->n = vec3_cross(l->du, l->dv);
    l->bend = 3 * (bend_u + bend_v) * fmax(vec3_length(l->du), vec3_length(l->dv));
}

static uint32_t grow(struct patch *p, const struct patch_leaf *l, int depth)
{
    const uint32_t at = p->nodes++;
    struct patch_node *n = &p->node[at];
    double length_u, length_v;
    const double bend_u = bend(l, true, &length_u), bend_v = bend(l, false, &length_v);
    const double ru = bend_u / length_u, rv = bend_v / length_v;
    const double size = fmax(length_u, length_v);
    // A collapsed or tiny side is left to the intersection.
    const bool split_u = ru > BEND && bend_u > 0x1p-10 * size;
    const bool split_v = rv > BEND && bend_v > 0x1p-10 * size;
    n->box = aabb_empty();
    if (depth < DEPTH_MAX && (split_u || split_v)) {
        struct patch_leaf low, high;
        split(l, split_u && (!split_v || bend_u > bend_v), &low, &high);
        grow(p, &low, depth + 1);
        const uint32_t other = grow(p, &high, depth + 1);
        n->other = other;
        n->box = aabb_join(p->node[at + 1].box, p->node[other].box);
        return at;
    }
    for (int i = 0; i < 16; i++)
        n->box = aabb_add(n->box, l->p[i / 4][i % 4]);
    n->box = aabb_pad(n->box);
    n->leaf = p->leaves;
    p->leaf[p->leaves] = *l;
    finish_leaf(&p->leaf[p->leaves++], bend_u, bend_v);
    return at;
}

void patch_build(struct patch *p, struct arena *arena)
{
    static const size_t most = 1 << DEPTH_MAX;
    struct arena *scratch = arena_new(most * sizeof *p->leaf);
    struct patch_leaf all = {.u = {0, 1}, .v = {0, 1}};
    memcpy(all.p, p->p, sizeof all.p);
    struct patch_leaf *leaf = arena_new_array(scratch, struct patch_leaf, most);
    struct patch_node *node = arena_new_array(scratch, struct patch_node, 2 * most);
    p->leaf = leaf;
    p->node = node;
    p->nodes = p->leaves = 0;
    grow(p, &all, 0);
    p->leaf = arena_new_array(arena, struct patch_leaf, p->leaves);
    p->node = arena_new_array(arena, struct patch_node, p->nodes);
    memcpy(p->leaf, leaf, p->leaves * sizeof *leaf);
    memcpy(p->node, node, p->nodes * sizeof *node);
    p->bounds = p->node[0].box;
    arena_free(scratch);
}

void patch_derivatives(const struct patch *p, double u, double v, struct vec3 *at,
                       struct vec3 *du, struct vec3 *dv)
{
    double bu[4], bv[4], cu[4], cv[4];
    basis(u, bu, cu);
    basis(v, bv, cv);
    *at = *du = *dv = vec3(0, 0, 0);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            *at = vec3_mad(*at, bu[i] * bv[j], p->p[i][j]);
            *du = vec3_mad(*du, cu[i] * bv[j], p->p[i][j]);
            *dv = vec3_mad(*dv, bu[i] * cv[j], p->p[i][j]);
        }
}
