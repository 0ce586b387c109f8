// The cells of an isosurface's container (isosurface.h).
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "math/next_float.h"
#include "scene/shapes/isosurface.h"

enum {
    DEPTH_MAX = 6,     // 64 cells along an axis: 14 MB if the surface were in all of them
    DEPTH_SMOOTH = 3,  // enough where the gradient hardly turns
    COMPARED_MAX = 64, // trees, the youngest, when an isosurface looks for its own
};

// The gradient hardly turns in a cell whose bounds of it are this much smaller than itself. Halves
// of a cell cost as much as a hundred rays through it: the last are made where little is known.
static const double SMOOTH = 0.7, SMOOTH_AT_LAST = 1;
// Slopes between samples of an opaque function are taken to be this much too small.
static const double SAMPLE_MARGIN = 1.25;
// Cells are widened by this share of their size's order: points on a ray are rounded.
static const double WIDENED = 0x1p-38;

static void free_cells(struct iso_cell *c)
{
    for (int i = 0; c && i < 8; i++)
        free_cells(atomic_load_explicit(&c[i].child, memory_order_relaxed));
    free(c);
}

struct iso_tree {
    struct iso_cell root;
    struct isosurface of; // the first that has it
    struct iso_tree *next;
};

static void free_tree(void *tree)
{
    struct iso_tree *t = tree;
    free_cells(atomic_load_explicit(&t->root.child, memory_order_relaxed));
}

static bool has_same_cells(const struct isosurface *s, const struct isosurface *r)
{
    return s->threshold == r->threshold && s->max_gradient == r->max_gradient &&
           memcmp(&s->bounds, &r->bounds, sizeof s->bounds) == 0 &&
           tape_equal(s->f, r->f);
}

struct iso_cell *iso_tree_of(const struct isosurface *s, struct arena *a, void **trees)
{
    struct iso_tree *t = *trees;
    for (int i = 0; t && i < COMPARED_MAX; t = t->next, i++)
        if (has_same_cells(s, &t->of))
            return &t->root;
    t = arena_new_struct(a, struct iso_tree);
    t->root.kind = CELL_BRANCH;
    t->of = *s;
    t->next = *trees;
    *trees = t;
    arena_at_end(a, free_tree, t);
    return &t->root;
}

// Whether the gradient points one way, more or less.
static bool is_smooth(const struct interval *d, int depth)
{
    const double most = depth == DEPTH_MAX - 1 ? SMOOTH_AT_LAST : SMOOTH;
    double size = 0, spread = 0;
    for (int i = 0; i < 3; i++) {
        const double m = interval_middle(d[i]), w = 0.5 * interval_width(d[i]);
        if (!(w < INFINITY))
            return false;
        size += m * m;
        spread += w * w;
    }
    return spread < most * most * size;
}

static void set_kind(struct iso_cell *c, struct interval v, const struct interval *d,
                     int depth)
{
    if (v.lo > 0)
        c->kind = CELL_OUTSIDE;
    else if (v.hi <= 0)
        c->kind = CELL_INSIDE;
    else
        c->kind = depth >= DEPTH_MAX || (depth >= DEPTH_SMOOTH && is_smooth(d, depth))
                      ? CELL_LEAF
                      : CELL_BRANCH;
    for (int i = 0; i < 3; i++) {
        c->slope[i][0] = float_below((float)d[i].lo);
        c->slope[i][1] = float_above((float)d[i].hi);
    }
}

// By bounds of the function and of its gradient, and by the mean value form: the value in
// the middle and the way to the farthest point.
static void look(const struct isosurface *s, struct iso_cell *c, const struct aabb *b,
                 double slack, int depth)
{
    struct tape_boxes box, middle;
    struct tape_slopes r, m;
    for (int l = 0; l < TAPE_LANES; l++)
        for (int i = 0; i < 3; i++) {
            box.lo[i][l] = vec3_axis(b[l].min, i) - slack;
            box.hi[i][l] = vec3_axis(b[l].max, i) + slack;
            middle.lo[i][l] = middle.hi[i][l] = 0.5 * (box.lo[i][l] + box.hi[i][l]);
        }
    tape_bounds_packet(s->f, &box, true, &r);
    tape_bounds_packet(s->f, &middle, false, &m);
    for (int l = 0; l < TAPE_LANES; l++) {
        struct interval v = interval(m.lo[l], m.hi[l]), d[3];
        for (int i = 0; i < 3; i++) {
            d[i] = interval(r.slope_lo[i][l], r.slope_hi[i][l]);
            const struct interval off = interval_subtract(
                interval(box.lo[i][l], box.hi[i][l]), interval_point(middle.lo[i][l]));
            v = interval_add(v, interval_multiply(d[i], off));
        }
        v = interval(fmax(v.lo, r.lo[l]), fmin(v.hi, r.hi[l]));
        if (interval_is_whole(d[0]) || interval_is_whole(d[1]) ||
            interval_is_whole(d[2])) {
            struct interval in[3];
            for (int i = 0; i < 3; i++)
                in[i] = interval(box.lo[i][l], box.hi[i][l]);
            const struct interval either = tape_bounds(s->f, in);
            v = interval(fmax(v.lo, either.lo), fmin(v.hi, either.hi));
        }
        v = interval_subtract(v, interval_point(s->threshold));
        set_kind(&c[l], v, d, depth);
    }
}

// By samples: the middle and the corners, and a slope that is at least max_gradient and
// at least what the samples show.
static void sample(const struct isosurface *s, struct iso_cell *c, const struct aabb *b,
                   int depth)
{
    double at[3][TAPE_LANES], v[1][TAPE_LANES];
    for (int l = 0; l < TAPE_LANES; l++) {
        at[0][l] = l & 1 ? b->max.x : b->min.x;
        at[1][l] = l & 2 ? b->max.y : b->min.y;
        at[2][l] = l & 4 ? b->max.z : b->min.z;
    }
    tape_run_packet(s->f, (const double(*)[TAPE_LANES])at, v);
    const struct vec3 m = vec3_scale(0.5, vec3_add(b->min, b->max));
    const double middle = iso_value(s, m),
                 half = 0.5 * vec3_length(vec3_sub(b->max, b->min));
    double steepest = s->max_gradient;
    for (int l = 0; l < TAPE_LANES; l++) {
        const double slope = fabs(v[0][l] - s->threshold - middle) / half;
        steepest = fmax(steepest, SAMPLE_MARGIN * slope);
    }
    for (int i = 0; i < 3; i++) {
        c->slope[i][0] = -INFINITY;
        c->slope[i][1] = INFINITY;
    }
    c->steepest = (float)fmin(steepest, FLT_MAX);
    if (fabs(middle) > steepest * half)
        c->kind = middle > 0 ? CELL_OUTSIDE : CELL_INSIDE;
    else
        c->kind = depth >= DEPTH_MAX ? CELL_LEAF : CELL_BRANCH;
}

struct iso_cell *iso_children(const struct isosurface *s, struct iso_cell *cell,
                              const struct aabb *box, int depth, uint32_t *evaluations)
{
    struct iso_cell *c = atomic_load_explicit(&cell->child, memory_order_acquire);
    if (c)
        return c;
    c = must_calloc(8, sizeof *c);
    const struct vec3 m = vec3_scale(0.5, vec3_add(box->min, box->max));
    const double slack = WIDENED * vec3_max_abs(vec3_sub(s->bounds.max, s->bounds.min));
    struct aabb b[8];
    for (int i = 0; i < 8; i++) {
        b[i] = iso_child_box(box, &m, i);
        atomic_init(&c[i].child, NULL);
        if (tape_is_opaque(s->f))
            sample(s, &c[i], &b[i], depth + 1);
    }
    if (!tape_is_opaque(s->f))
        look(s, c, b, slack, depth + 1);
    *evaluations += tape_is_opaque(s->f) ? 8 * (1 + TAPE_LANES) : 16;
    struct iso_cell *made = NULL;
    if (atomic_compare_exchange_strong_explicit(
            &cell->child, &made, c, memory_order_acq_rel, memory_order_acquire))
        return c;
    free(c); // another thread was first; what it made is the same
    return made;
}
