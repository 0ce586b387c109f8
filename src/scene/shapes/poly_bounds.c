// The bounds of a polynomial's set, by interval arithmetic when the shape is read.
//
// On the surface of the cube of half side R the terms of the highest degree n add up to m R^n
// or more, m their least value on the unit cube's, and those of degree k < n to -A_k R^k or
// more. Where m R^n exceeds the sum of the A_k R^k it does so for all larger R: the set lies
// within that cube. The cells of the cube that it may meet then give the box.
#include <math.h>

#include "math/gamma.h"
#include "math/larger.h"
#include "scene/shapes/poly.h"

// Terms looked at in all, and how often a face and the cube are halved.
enum { WORK_MAX = 100000, FACE_DEPTH = 5, CELL_DEPTH = 5 };

struct search {
    const struct poly *s;
    int degree; // of the terms that count; -1: all
    long work;  // that is left
    struct aabb found;
};

struct range {
    double lo, hi;
};

static struct range times(struct range a, struct range b)
{
    const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
    return (struct range){smaller(smaller(p, q), smaller(r, s)),
                          larger(larger(p, q), larger(r, s))};
}

static void powers_of(double lo, double hi, int n, struct range *out)
{
    double a = 1, b = 1;
    out[0] = (struct range){1, 1};
    for (int i = 1; i <= n; i++) {
        a *= lo;
        b *= hi;
        out[i] = (struct range){smaller(a, b), larger(a, b)};
        if (i % 2 == 0 && lo < 0 && hi > 0)
            out[i].lo = 0;
    }
}

// No more than the least value in a box.
static double least_in(struct search *v, const struct aabb *box)
{
    const struct poly *s = v->s;
    struct range x[POLYNOMIAL_DEGREE_MAX + 1], y[POLYNOMIAL_DEGREE_MAX + 1],
        z[POLYNOMIAL_DEGREE_MAX + 1];
    double sum = 0, size = 0;
    powers_of(box->min.x, box->max.x, s->order, x);
    powers_of(box->min.y, box->max.y, s->order, y);
    powers_of(box->min.z, box->max.z, s->order, z);
    for (uint32_t i = 0; i < s->rows; i++) {
        const struct poly_row *r = &s->row[i];
        const struct range xy = times(x[r->x], y[r->y]);
        for (int k = 0; k <= r->top; k++) {
            const double c = r->c[r->top - k];
            if (c == 0 || (v->degree >= 0 && r->x + r->y + k != v->degree))
                continue;
            const struct range p = times(xy, z[k]);
            sum += c > 0 ? c * p.lo : c * p.hi;
            size += fabs(c) * larger(-p.lo, p.hi);
            v->work--;
        }
    }
    // Up to three times the order roundings in a term, as many as there are terms in the sum.
    return sum - size * (4 * s->order + 1e4) * ROUNDOFF;
}

// The least value on a part of a face, once it is found to be positive; else 0.
static double least_on(struct search *v, const struct aabb *part, int axis, int depth)
{
    const double least = least_in(v, part);
    if (least > 0 || depth == FACE_DEPTH || v->work < 0)
        return fmax(least, 0);
    const struct vec3 m = vec3_scale(0.5, vec3_add(part->min, part->max));
    double all = INFINITY;
    for (int i = 0; i < 4 && all > 0; i++) {
        double lo[3] = {part->min.x, part->min.y, part->min.z};
        double hi[3] = {part->max.x, part->max.y, part->max.z};
        for (int k = 0; k < 2; k++) {
            const int at = (axis + 1 + k) % 3;
            *(i >> k & 1 ? &lo[at] : &hi[at]) = vec3_axis(m, at);
        }
        const struct aabb quarter = {vec3(lo[0], lo[1], lo[2]),
                                     vec3(hi[0], hi[1], hi[2])};
        all = fmin(all, least_on(v, &quarter, axis, depth + 1));
    }
    return all;
}

// Of the terms of an even degree on the surface of the unit cube, which has two sides of the
// same values.
static double least_on_cube(struct search *v)
{
    double least = INFINITY;
    for (int axis = 0; axis < 3 && least > 0; axis++) {
        const struct aabb face = {
            vec3(axis == 0 ? 1 : -1, axis == 1 ? 1 : -1, axis == 2 ? 1 : -1),
            vec3(1, 1, 1)};
        least = fmin(least, least_on(v, &face, axis, 0));
    }
    return least;
}

// By degree, what the terms may take off; returns the highest degree.
static int losses(const struct poly *s, double loss[POLYNOMIAL_DEGREE_MAX + 1])
{
    int degree = 0;
    for (int i = 0; i <= POLYNOMIAL_DEGREE_MAX; i++)
        loss[i] = 0;
    for (uint32_t i = 0; i < s->rows; i++) {
        const struct poly_row *r = &s->row[i];
        for (int k = 0; k <= r->top; k++) {
            const double c = r->c[r->top - k];
            const int n = r->x + r->y + k;
            const bool helps = c > 0 && r->x % 2 == 0 && r->y % 2 == 0 && k % 2 == 0;
            if (c != 0 && n > degree)
                degree = n;
            loss[n] += helps ? 0 : fabs(c);
        }
    }
    return degree;
}

// Half the side of a cube that holds the set: a power of two times 1, 5/4, 3/2 or 7/4.
static double cube_of(const double *loss, int degree, double least)
{
    for (int e = -120; e < 240; e++) {
        const double r = ldexp(1 + (e & 3) / 4., e >> 2);
        double sum = 0;
        for (int k = 0; k < degree; k++) // the sum of A_k R^(k - n)
            sum = (sum + loss[k]) / r;
        if (sum < least * (1 - 0x1p-20))
            return r;
    }
    return INFINITY;
}

static bool holds(const struct aabb *a, const struct aabb *b)
{
    return a->min.x <= b->min.x && a->min.y <= b->min.y && a->min.z <= b->min.z &&
           a->max.x >= b->max.x && a->max.y >= b->max.y && a->max.z >= b->max.z;
}

// Adds the cells below this one that may meet the set.
static void add_cells(struct search *v, const struct aabb *cell, int depth)
{
    if (holds(&v->found, cell) || (v->work > 0 && least_in(v, cell) > 0))
        return;
    if (depth == CELL_DEPTH || v->work <= 0) {
        v->found = aabb_join(v->found, *cell);
        return;
    }
    const struct vec3 m = vec3_scale(0.5, vec3_add(cell->min, cell->max));
    for (int i = 0; i < 8; i++) {
        struct aabb part = *cell;
        *(i & 1 ? &part.min.x : &part.max.x) = m.x;
        *(i & 2 ? &part.min.y : &part.max.y) = m.y;
        *(i & 4 ? &part.min.z : &part.max.z) = m.z;
        add_cells(v, &part, depth + 1);
    }
}

struct aabb poly_bounds(const struct poly *s)
{
    struct search v = {.s = s, .work = WORK_MAX, .found = aabb_empty()};
    double loss[POLYNOMIAL_DEGREE_MAX + 1];
    v.degree = losses(s, loss);
    if (v.degree == 0 || v.degree % 2 != 0)
        return aabb_infinite();
    const double least = least_on_cube(&v);
    const double r = least > 0 ? cube_of(loss, v.degree, least) : INFINITY;
    if (!(r < INFINITY))
        return aabb_infinite();
    v.degree = -1;
    const struct aabb cube = {vec3(-r, -r, -r), vec3(r, r, r)};
    add_cells(&v, &cube, 0);
    if (aabb_is_empty(v.found))
        return v.found;
    // Rounding along a line may move a root beyond.
    const double pad = 0x1p-20 * r;
    return (struct aabb){vec3_sub(v.found.min, vec3(pad, pad, pad)),
                         vec3_add(v.found.max, vec3(pad, pad, pad))};
}
