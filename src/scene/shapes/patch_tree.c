// The tree of sub-patches of a Bezier patch, and its points.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "math/larger.h"
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
    const struct vec3 a = middle(p[0], p[1]), b = middle(p[1], p[2]),
                      c = middle(p[2], p[3]);
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
    for (int k = 0; k < 2; k++) {
        low->u[k] = high->u[k] = from->u[k];
        low->v[k] = high->v[k] = from->v[k];
    }
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

// Adds to l->bend how far one derivative is from its mean.
static void add_bend(struct patch_leaf *l, bool along_u)
{
    const double nn = vec3_dot(l->n, l->n);
    double most[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            const struct vec3 d = along_u ? vec3_sub(l->p[i + 1][j], l->p[i][j])
                                          : vec3_sub(l->p[j][i + 1], l->p[j][i]);
            const struct vec3 e = vec3_sub(vec3_scale(3, d), along_u ? l->du : l->dv);
            most[0] = larger(most[0], fabs(vec3_dot(e, l->n_dv)));
            most[1] = larger(most[1], fabs(vec3_dot(e, l->du_n)));
            most[2] = larger(most[2], fabs(vec3_dot(e, l->n)));
        }
    for (int k = 0; k < 3; k++)
        l->bend[k] += nn > 0 ? most[k] / nn : INFINITY;
}

static void measure_own(struct patch_leaf *l)
{
    const struct vec3 axis[3] = {l->n_dv, l->du_n, l->n};
    for (int k = 0; k < 3; k++) {
        double *own = l->own[k];
        own[0] = HUGE_VAL;
        own[1] = -HUGE_VAL;
        for (int i = 0; i < 16; i++) {
            const double at = vec3_dot(axis[k], vec3_sub(l->p[i / 4][i % 4], l->middle));
            own[0] = at < own[0] ? at : own[0];
            own[1] = larger(at, own[1]);
        }
    }
}

// What is known of a leaf from all directions.
static void finish_leaf(struct patch_leaf *l)
{
    static const double b[4] = {1. / 8, 3. / 8, 3. / 8, 1. / 8};
    l->middle = l->du = l->dv = vec3(0, 0, 0);
    l->size = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            l->middle = vec3_mad(l->middle, b[i] * b[j], l->p[i][j]);
            l->size = larger(l->size, vec3_max_abs(l->p[i][j]));
        }
    for (int i = 0; i < 4; i++) {
        l->du = vec3_mad(l->du, 0.25, vec3_sub(l->p[3][i], l->p[0][i]));
        l->dv = vec3_mad(l->dv, 0.25, vec3_sub(l->p[i][3], l->p[i][0]));
    }
    l->n = vec3_cross(l->du, l->dv);
    l->n_dv = vec3_cross(l->dv, l->n);
    l->du_n = vec3_cross(l->n, l->du);
    l->bend[0] = l->bend[1] = l->bend[2] = 0;
    add_bend(l, true);
    add_bend(l, false);
    measure_own(l);
    atomic_init(&l->half, NULL);
}

static struct aabb box_of(const struct patch_leaf *l)
{
    struct aabb box = aabb_empty();
    for (int i = 0; i < 16; i++)
        box = aabb_add(box, l->p[i / 4][i % 4]);
    return aabb_pad(box);
}

struct patch_half *patch_halves(struct patch_leaf *l)
{
    struct patch_half *half = atomic_load_explicit(&l->half, memory_order_acquire);
    if (half)
        return half;
    half = must_calloc(2, sizeof *half);
    double length;
    split(l, bend(l, true, &length) >= bend(l, false, &length), &half[0].leaf,
          &half[1].leaf);
    for (int k = 0; k < 2; k++) {
        finish_leaf(&half[k].leaf);
        half[k].box = box_of(&half[k].leaf);
    }
    struct patch_half *made = NULL;
    if (atomic_compare_exchange_strong_explicit(
            &l->half, &made, half, memory_order_acq_rel, memory_order_acquire))
        return half;
    free(half); // another thread was first; what it made is the same
    return made;
}

static void free_halves(struct patch_leaf *l)
{
    struct patch_half *half = atomic_load_explicit(&l->half, memory_order_relaxed);
    if (!half)
        return;
    free_halves(&half[0].leaf);
    free_halves(&half[1].leaf);
    free(half);
}

struct all_leaves {
    struct patch_leaf *leaf;
    uint32_t count;
};

static void free_all_halves(void *data)
{
    const struct all_leaves *all = data;
    for (uint32_t i = 0; i < all->count; i++)
        free_halves(&all->leaf[i]);
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
    if (depth < DEPTH_MAX && (split_u || split_v)) {
        struct patch_leaf low, high;
        split(l, split_u && (!split_v || bend_u > bend_v), &low, &high);
        grow(p, &low, depth + 1);
        const uint32_t other = grow(p, &high, depth + 1);
        n->other = other;
        n->box = aabb_join(p->node[at + 1].box, p->node[other].box);
        return at;
    }
    n->box = box_of(l);
    n->leaf = p->leaves;
    memcpy(&p->leaf[p->leaves], l, sizeof *l);
    finish_leaf(&p->leaf[p->leaves++]);
    return at;
}

// From Bernstein polynomials to powers of w - 1/2.
static void to_powers(const double p[4], double c[4])
{
    c[0] = (p[0] + p[3] + 3 * (p[1] + p[2])) / 8;
    c[1] = 0.75 * ((p[3] - p[0]) + (p[2] - p[1]));
    c[2] = 1.5 * ((p[0] - p[1]) + (p[3] - p[2]));
    c[3] = (p[3] - p[0]) - 3 * (p[2] - p[1]);
}

static void make_powers(struct patch *p)
{
    p->size = 0;
    for (int k = 0; k < 3; k++) {
        double half[4][4], size = 0;
        for (int i = 0; i < 4; i++) {
            double row[4];
            for (int j = 0; j < 4; j++)
                row[j] = vec3_axis(p->p[i][j], k);
            to_powers(row, half[i]);
        }
        for (int j = 0; j < 4; j++) {
            const double from[4] = {half[0][j], half[1][j], half[2][j], half[3][j]};
            double to[4];
            to_powers(from, to);
            for (int i = 0; i < 4; i++) {
                p->power[k][i][j] = to[i];
                size += ldexp(fabs(to[i]), -i - j);
            }
        }
        for (int i = 0; i < 16; i++)
            size = fmax(size, fabs(vec3_axis(p->p[i / 4][i % 4], k)));
        p->size = fmax(p->size, size);
    }
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
    make_powers(p);
    struct all_leaves *leaves = arena_new_struct(arena, struct all_leaves);
    *leaves = (struct all_leaves){p->leaf, p->leaves};
    arena_at_end(arena, free_all_halves, leaves);
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
