// The tree of (u, v) rectangles of a parametric surface (parametric.h).
#include <stdlib.h>

#include "base/arena.h"
#include "base/memory.h"
#include "math/next_float.h"
#include "scene/shapes/parametric.h"

enum { DEPTH_MAX = 5 };

// Slopes hardly turn in a cell whose bounds of them are this much smaller than themselves.
static const double FLAT = 0.3;

struct vec3 uv_point(const struct parametric *p, double u, double v, struct vec3 *by_u,
                     struct vec3 *by_v)
{
    const double at[3] = {u, v, 0};
    double s[3], g[3][2] = {{0}};
    for (int i = 0; i < 3; i++)
        if (by_u)
            s[i] = tape_gradient(p->f[i], at, 2, g[i]);
        else
            tape_run(p->f[i], at, &s[i]);
    if (by_u) {
        *by_u = vec3(g[0][0], g[1][0], g[2][0]);
        *by_v = vec3(g[0][1], g[1][1], g[2][1]);
    }
    return vec3(s[0], s[1], s[2]);
}

static void free_cells(struct uv_cell *c)
{
    for (int i = 0; c && i < 8; i++)
        free_cells(atomic_load_explicit(&c[i].child, memory_order_relaxed));
    free(c);
}

static void free_tree(void *root)
{
    struct uv_cell *c = root;
    free_cells(atomic_load_explicit(&c->child, memory_order_relaxed));
}

struct uv_cell *uv_tree_new(struct arena *a, const struct parametric *p)
{
    struct uv_cell *c = arena_new_struct(a, struct uv_cell);
    c->u[0] = p->low.u;
    c->u[1] = p->high.u;
    c->v[0] = p->low.v;
    c->v[1] = p->high.v;
    for (int i = 0; i < 3; i++) {
        c->box[i][0] = -INFINITY;
        c->box[i][1] = INFINITY;
    }
    arena_at_end(a, free_tree, c);
    return c;
}

static void set_range(float out[2], double lo, double hi)
{
    out[0] = float_below((float)lo);
    out[1] = float_above((float)hi);
}

// Bounds of function i over eight cells, by its own bounds and by the mean value form.
static void bound(const struct parametric *p, struct uv_cell *c, int i)
{
    struct tape_boxes box = {0}, middle = {0};
    struct tape_slopes r, m;
    for (int l = 0; l < TAPE_LANES; l++) {
        box.lo[0][l] = c[l].u[0];
        box.hi[0][l] = c[l].u[1];
        box.lo[1][l] = c[l].v[0];
        box.hi[1][l] = c[l].v[1];
        for (int k = 0; k < 2; k++)
            middle.lo[k][l] = middle.hi[k][l] = 0.5 * (box.lo[k][l] + box.hi[k][l]);
    }
    tape_bounds_packet(p->f[i], &box, true, &r);
    tape_bounds_packet(p->f[i], &middle, false, &m);
    for (int l = 0; l < TAPE_LANES; l++) {
        struct interval v = interval(m.lo[l], m.hi[l]);
        for (int k = 0; k < 2; k++) {
            const struct interval d = interval(r.slope_lo[k][l], r.slope_hi[k][l]);
            const struct interval side = interval(box.lo[k][l], box.hi[k][l]);
            const struct interval off =
                interval_subtract(side, interval_point(middle.lo[k][l]));
            v = interval_add(v, interval_multiply(d, off));
            set_range(c[l].slope[k][i], d.lo, d.hi);
        }
        set_range(c[l].box[i], fmax(v.lo, r.lo[l]), fmin(v.hi, r.hi[l]));
    }
}

// Without bounds: the corners, and room between them for a slope of max_gradient.
static void sample(const struct parametric *p, struct uv_cell *c, int i)
{
    double f[2][2], lo = INFINITY, hi = -INFINITY;
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++) {
            tape_run(p->f[i], (const double[]){c->u[a], c->v[b], 0}, &f[a][b]);
            lo = fmin(lo, f[a][b]);
            hi = fmax(hi, f[a][b]);
        }
    const double side = fmax(c->u[1] - c->u[0], c->v[1] - c->v[0]);
    const double room = fmax(0, 0.5 * (2 * p->max_gradient * side - (hi - lo)));
    set_range(c->box[i], lo - room, hi + room);
    for (int k = 0; k < 2; k++)
        set_range(c->slope[k][i], -INFINITY, INFINITY);
}

static bool hardly_turns(float slope[3][2])
{
    double size = 0, spread = 0;
    for (int i = 0; i < 3; i++) {
        const double m = 0.5 * ((double)slope[i][0] + slope[i][1]);
        const double w = 0.5 * ((double)slope[i][1] - slope[i][0]);
        size += m * m;
        spread += w * w;
    }
    return spread < FLAT * FLAT * size; // false for what is no number
}

static void finish(const struct parametric *p, struct uv_cell *c, int depth)
{
    const struct vec3 m =
        uv_point(p, 0.5 * (c->u[0] + c->u[1]), 0.5 * (c->v[0] + c->v[1]), NULL, NULL);
    c->middle[0] = m.x;
    c->middle[1] = m.y;
    c->middle[2] = m.z;
    c->flat = hardly_turns(c->slope[0]) && hardly_turns(c->slope[1]);
    c->leaf = c->flat || depth >= DEPTH_MAX;
}

// How far the surface goes along one side of a cell, about.
static double extent(const struct parametric *p, const struct uv_cell *c, bool along_u)
{
    double sum = 0;
    struct vec3 last = {0};
    for (int i = 0; i <= 4; i++) {
        const double s = along_u ? i / 4. : 0.5, t = along_u ? 0.5 : i / 4.;
        const struct vec3 q = uv_point(p, c->u[0] + s * (c->u[1] - c->u[0]),
                                       c->v[0] + t * (c->v[1] - c->v[0]), NULL, NULL);
        sum += i ? vec3_length(vec3_sub(q, last)) : 0;
        last = q;
    }
    return sum;
}

// Four parts along the side the surface is longer on, two along the other.
static void divide(const struct parametric *p, const struct uv_cell *c,
                   struct uv_cell *out)
{
    const int nu = extent(p, c, true) >= extent(p, c, false) ? 4 : 2, nv = 8 / nu;
    for (int l = 0; l < 8; l++) {
        const int i = l % nu, j = l / nu;
        const double du = c->u[1] - c->u[0], dv = c->v[1] - c->v[0];
        out[l].u[0] = c->u[0] + du * i / nu;
        out[l].u[1] = i + 1 == nu ? c->u[1] : c->u[0] + du * (i + 1) / nu;
        out[l].v[0] = c->v[0] + dv * j / nv;
        out[l].v[1] = j + 1 == nv ? c->v[1] : c->v[0] + dv * (j + 1) / nv;
        atomic_init(&out[l].child, NULL);
    }
}

struct uv_cell *uv_children(const struct parametric *p, struct uv_cell *cell, int depth)
{
    struct uv_cell *c = atomic_load_explicit(&cell->child, memory_order_acquire);
    if (c)
        return c;
    c = must_calloc(8, sizeof *c);
    divide(p, cell, c);
    for (int i = 0; i < 3; i++) {
        if (!tape_is_opaque(p->f[i])) {
            bound(p, c, i);
            continue;
        }
        for (int l = 0; l < 8; l++)
            sample(p, &c[l], i);
    }
    for (int l = 0; l < 8; l++)
        finish(p, &c[l], depth + 1);
    struct uv_cell *made = NULL;
    if (atomic_compare_exchange_strong_explicit(
            &cell->child, &made, c, memory_order_acq_rel, memory_order_acquire))
        return c;
    free(c); // another thread was first; what it made is the same
    return made;
}
