// Patterns and pigments as formulas (pattern_formula.h): the ways of warp.c, pattern.c and
// pigment.c, step by step.
#include "scene/pattern_formula.h"

#include <string.h>

#include "base/arena.h"
#include "math/color.h"
#include "math/pi.h"
#include "scene/pattern_math.h"
#include "scene/warp.h"

// ---- small functions --------------------------------------------------------------------

uint32_t formula_fraction(struct formula *f, uint32_t v)
{
    return formula_subtract(f, v, formula_floor(f, v));
}

uint32_t formula_odd(struct formula *f, uint32_t v)
{
    return formula_abs(f, tape_binary(f->b, TAPE_MOD, v, formula_constant(f, 2)));
}

static uint32_t squared(struct formula *f, uint32_t v)
{
    return tape_unary(f->b, TAPE_SQUARE, v);
}

uint32_t formula_length(struct formula *f, uint32_t x, uint32_t y)
{
    return tape_unary(f->b, TAPE_SQRT, formula_add(f, squared(f, x), squared(f, y)));
}

uint32_t formula_length3(struct formula *f, const uint32_t at[3])
{
    const uint32_t two = formula_add(f, squared(f, at[0]), squared(f, at[1]));
    return tape_unary(f->b, TAPE_SQRT, formula_add(f, two, squared(f, at[2])));
}

uint32_t formula_fade_out(struct formula *f, uint32_t v)
{
    const uint32_t rest = formula_subtract(f, formula_constant(f, 1), v);
    return tape_binary(f->b, TAPE_MAX, rest, formula_constant(f, 0));
}

uint32_t formula_wrap(struct formula *f, uint32_t v)
{
    const uint32_t one = formula_constant(f, 1);
    return formula_where(f, formula_less(f, one, v), tape_binary(f->b, TAPE_MOD, v, one),
                         v);
}

// ---- warps ------------------------------------------------------------------------------

static void move(struct formula *f, const struct transform *t, uint32_t at[3])
{
    uint32_t in[3];
    for (int i = 0; i < 3; i++)
        in[i] = formula_offset(f, at[i], -vec3_axis(t->offset, i));
    for (int i = 0; i < 3; i++) {
        at[i] = formula_constant(f, 0);
        for (int k = 0; k < 3; k++)
            if (t->inverse.m[k][i] != 0)
                at[i] =
                    formula_add(f, at[i], formula_scale(f, in[k], t->inverse.m[k][i]));
    }
}

static void turbulence(struct formula *f, const struct turbulence *t, uint32_t at[3])
{
    const uint32_t moved = formula_octaves(f, at);
    for (int i = 0; i < 3; i++)
        if (vec3_axis(t->amount, i) != 0)
            at[i] = moved;
}

static void repeat(struct formula *f, const struct warp *w, uint32_t at[3])
{
    const int axis = w->repeat.x != 0 ? 0 : w->repeat.y != 0 ? 1 : 2;
    const float width = (float)vec3_axis(w->repeat, axis);
    if (width == 0)
        return;
    const uint32_t n =
        formula_floor(f, tape_quotient(f->b, at[axis], formula_constant(f, width)));
    const uint32_t odd = formula_odd(f, n);
    at[axis] = formula_subtract(f, at[axis], formula_scale(f, n, width));
    for (int i = 0; i < 3; i++) {
        if (vec3_axis(w->flip, i) != 0) {
            uint32_t other = formula_scale(f, at[i], -1);
            if (i == axis)
                other = formula_offset(f, other, width);
            at[i] = formula_where(f, odd, other, at[i]);
        }
        at[i] = formula_add(f, at[i], formula_scale(f, n, vec3_axis(w->offset, i)));
    }
}

static void black_hole(struct formula *f, const struct warp *w, uint32_t at[3])
{
    const struct vec3 v = w->repeat, u = w->uncertainty;
    if (w->type != 0)
        return;
    if (u.x != 0 || u.y != 0 || u.z != 0) {
        at[0] = at[1] = at[2] = formula_unknown(f, -INFINITY, INFINITY, at);
        return;
    }
    uint32_t d[3];
    for (int i = 0; i < 3; i++) {
        d[i] = formula_offset(f, at[i], -vec3_axis(w->centre, i));
        const double width = vec3_axis(v, i);
        if ((v.x != 0 || v.y != 0 || v.z != 0) && width >= PATTERN_EDGE) {
            const uint32_t block =
                formula_floor(f, tape_quotient(f->b, at[i], formula_constant(f, width)));
            d[i] = formula_subtract(f, d[i], formula_scale(f, block, width));
        }
    }
    const uint32_t radius = formula_constant(f, w->radius);
    const uint32_t length = formula_length3(f, d), zero = formula_constant(f, 0);
    uint32_t k = tape_quotient(f->b, formula_subtract(f, radius, length), radius);
    k = tape_binary(f->b, TAPE_POW, tape_binary(f->b, TAPE_MAX, k, zero),
                    formula_constant(f, w->falloff));
    k = tape_binary(f->b, TAPE_MIN, formula_scale(f, k, w->strength),
                    formula_constant(f, 1));
    if (w->inverse)
        k = tape_unary(f->b, TAPE_NEGATE, k);
    k = formula_where(f, formula_less(f, length, radius), k, zero);
    for (int i = 0; i < 3; i++)
        at[i] = formula_add(f, at[i], formula_multiply(f, k, d[i]));
}

static void orient(struct formula *f, const struct warp *w, uint32_t x, uint32_t y,
                   uint32_t z, uint32_t out[3])
{
    const struct vec3 o = w->orientation;
    const uint32_t in[3] = {x, y, z};
    const double by[3][3] = {{o.y + o.z, 0, o.x}, {0, o.x + o.z, -o.y}, {-o.x, o.y, o.z}};
    const bool plain = o.x == 0 && o.y == 0 && o.z == 1;
    for (int i = 0; i < 3; i++) {
        uint32_t sum = formula_constant(f, 0);
        for (int k = 0; k < 3; k++)
            sum = formula_add(f, sum, formula_scale(f, in[k], by[i][k]));
        out[i] = plain ? in[i] : sum;
    }
}

static uint32_t distance_factor(struct formula *f, const struct warp *w, uint32_t v,
                                uint32_t r)
{
    if (w->dist_exp == 0)
        return v;
    if (w->dist_exp != 1)
        r = tape_binary(f->b, TAPE_POW, r, formula_constant(f, w->dist_exp));
    return formula_multiply(f, v, r);
}

// azimuth of scene/pattern_math.h in turns: 0..1.
static uint32_t turns(struct formula *f, uint32_t x, uint32_t z)
{
    const uint32_t zero = formula_constant(f, 0);
    const uint32_t a =
        formula_scale(f, tape_binary(f->b, TAPE_ATAN2, z, x), 1 / (2 * PI));
    return formula_where(f, formula_less(f, a, zero), formula_offset(f, a, 1), a);
}

static void cylindrical(struct formula *f, const struct warp *w, uint32_t at[3])
{
    const uint32_t length = formula_length(f, at[0], at[2]);
    const uint32_t a = distance_factor(f, w, turns(f, at[0], at[2]), length);
    orient(f, w, a, at[1], length, at);
}

static void spherical(struct formula *f, const struct warp *w, uint32_t at[3])
{
    const uint32_t rho = formula_length3(f, at), flat = formula_length(f, at[0], at[2]);
    const uint32_t a = distance_factor(f, w, turns(f, at[0], at[2]), rho);
    const uint32_t up = tape_binary(f->b, TAPE_ATAN2, at[1], flat);
    const uint32_t b =
        distance_factor(f, w, formula_offset(f, formula_scale(f, up, 1 / PI), 0.5), rho);
    orient(f, w, a, b, rho, at);
}

static void toroidal(struct formula *f, const struct warp *w, uint32_t at[3])
{
    const uint32_t length = formula_length(f, at[0], at[2]);
    const uint32_t x = formula_offset(f, length, -w->major_radius);
    const uint32_t r = formula_length(f, x, at[1]);
    const uint32_t a = distance_factor(f, w, turns(f, at[0], at[2]), r);
    uint32_t phi = tape_binary(f->b, TAPE_ATAN2, formula_abs(f, at[1]),
                               tape_unary(f->b, TAPE_NEGATE, x));
    const uint32_t other = formula_subtract(f, formula_constant(f, 2 * PI), phi);
    phi = formula_where(f, formula_less(f, formula_constant(f, 0), at[1]), other, phi);
    phi = distance_factor(f, w, formula_scale(f, phi, 1 / (2 * PI)), r);
    orient(f, w, a, phi, r, at);
}

static void warp(struct formula *f, const struct warp *w, uint32_t at[3])
{
    switch (w->kind) {
    case WARP_TRANSFORM: move(f, &w->transform, at); break;
    case WARP_TURBULENCE: turbulence(f, &w->turbulence, at); break;
    case WARP_REPEAT: repeat(f, w, at); break;
    case WARP_BLACK_HOLE: black_hole(f, w, at); break;
    case WARP_PLANAR:
        orient(f, w, at[0], at[1], formula_constant(f, w->distance), at);
        break;
    case WARP_CYLINDRICAL: cylindrical(f, w, at); break;
    case WARP_SPHERICAL: spherical(f, w, at); break;
    case WARP_TOROIDAL: toroidal(f, w, at); break;
    case WARP_CUBIC:
        at[0] = formula_unknown(f, 0, 1, at);
        at[2] = formula_unknown(f, 0, WARP_FAR, at);
        at[1] = at[0];
        break;
    }
}

static void warped(struct formula *f, const struct pattern *p, uint32_t at[3])
{
    if (!p)
        return;
    for (const struct warp *w = p->warps; w; w = w->next)
        warp(f, w, at);
    if (turbulence_is_warp(p))
        turbulence(f, p->turbulence, at);
    const uint32_t far = formula_constant(f, WARP_FAR),
                   near = formula_constant(f, -WARP_FAR);
    for (int i = 0; i < 3; i++)
        at[i] =
            tape_binary(f->b, TAPE_MAX, tape_binary(f->b, TAPE_MIN, at[i], far), near);
}

// ---- values -----------------------------------------------------------------------------

static uint32_t value_at(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    const uint32_t v = p->ops->formula ? p->ops->formula(f, p, at)
                                       : formula_unknown(f, -INFINITY, INFINITY, at);
    return formula_finished(f, p, v);
}

// ---- pigments ---------------------------------------------------------------------------

// The largest channel that a pigment can have, for what its blends are rounded by.
static double largest(const struct pigment *p)
{
    double most = 1;
    if (p->kind == PIGMENT_MAP || p->kind == PIGMENT_AVERAGE || p->kind == PIGMENT_UV)
        for (uint32_t i = 0; i < p->map->count; i++)
            most = fmax(most, largest(p->map->entry[i]));
    const uint32_t count = p->kind == PIGMENT_COLORS ? p->colors->count : 1;
    for (uint32_t i = 0; i < count; i++) {
        const struct rgbft c = p->kind == PIGMENT_COLORS ? p->colors->color[i] : p->color;
        most = fmax(most, fmax(fmax(fabsf(c.r), fabsf(c.g)), fabsf(c.b)));
        most = fmax(most, fmax(fabsf(c.filter), fabsf(c.transmit)));
    }
    return most;
}

static void pigment_at(struct formula *f, const struct pigment *p, const uint32_t at[3],
                       uint32_t out[5]);

// From the last entry down: between two keys a blend, past the upper one what comes then.
static void blended(struct formula *f, const struct pigment *p, const uint32_t at[3],
                    uint32_t out[5])
{
    const struct pigment_map *m = p->map;
    const double slack = 4 * largest(p);
    const uint32_t v = value_at(f, p->pattern, at);
    uint32_t upper[5], lower[5];
    pigment_at(f, m->entry[m->count - 1], at, upper);
    memcpy(out, upper, sizeof upper);
    for (uint32_t i = m->count - 1; i > 0; i--) {
        const double key = m->key[i - 1], width = (double)m->key[i] - key;
        const uint32_t past = formula_less(f, formula_constant(f, m->key[i]), v);
        uint32_t part = formula_scale(f, formula_offset(f, v, -key), 1 / width);
        part = tape_binary(f->b, TAPE_MAX, part, formula_constant(f, 0));
        part = tape_binary(f->b, TAPE_MIN, part, formula_constant(f, 1));
        pigment_at(f, m->entry[i - 1], at, lower);
        for (int c = 0; c < 5; c++) {
            const uint32_t rise = formula_subtract(f, upper[c], lower[c]);
            uint32_t blend =
                width > 0 ? formula_add(f, lower[c], formula_multiply(f, part, rise))
                          : lower[c];
            blend = formula_single(f, slack, blend);
            out[c] = formula_where(f, past, out[c], blend);
        }
        memcpy(upper, lower, sizeof upper);
    }
}

static void average(struct formula *f, const struct pigment *p, const uint32_t at[3],
                    uint32_t out[5])
{
    const struct pigment_map *m = p->map;
    double total = 0, sizes = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        total += m->key[i];
        sizes += fabsf(m->key[i]);
    }
    for (int c = 0; c < 5; c++)
        out[c] = formula_constant(f, 0);
    for (uint32_t i = 0; i < m->count; i++) {
        uint32_t one[5];
        pigment_at(f, m->entry[i], at, one);
        for (int c = 0; c < 5; c++)
            out[c] = formula_add(f, out[c], formula_scale(f, one[c], m->key[i] / total));
    }
    for (int c = 0; c < 5; c++)
        out[c] =
            formula_single(f, (m->count + 8) * largest(p) * sizes / fabs(total), out[c]);
}

static bool keys_ascend(const struct pigment_map *m)
{
    for (uint32_t i = 1; i < m->count; i++)
        if (!(m->key[i] >= m->key[i - 1]))
            return false;
    return true;
}

static void unknown_color(struct formula *f, const uint32_t at[3], uint32_t out[5])
{
    out[0] = formula_unknown(f, -INFINITY, INFINITY, at);
    for (int c = 1; c < 5; c++)
        out[c] = out[0];
}

static void pigment_at(struct formula *f, const struct pigment *p, const uint32_t at[3],
                       uint32_t out[5])
{
    const float solid[5] = {p->color.r, p->color.g, p->color.b, p->color.filter,
                            p->color.transmit};
    uint32_t q[3];
    memcpy(q, at, sizeof q);
    if (p->kind != PIGMENT_UV)
        warped(f, p->pattern, q);
    switch (p->kind) {
    case PIGMENT_SOLID:
        for (int c = 0; c < 5; c++)
            out[c] = formula_constant(f, solid[c]);
        return;
    case PIGMENT_COLORS:
        formula_colors(f, p->colors, value_at(f, p->pattern, q), out);
        return;
    case PIGMENT_MAP:
        if (keys_ascend(p->map))
            blended(f, p, q, out);
        else
            unknown_color(f, q, out);
        return;
    case PIGMENT_AVERAGE: average(f, p, q, out); return;
    case PIGMENT_IMAGE: unknown_color(f, q, out); return;
    case PIGMENT_UV:
        q[0] = f->outside[0];
        q[1] = f->outside[1];
        q[2] = formula_constant(f, 0);
        pigment_at(f, p->map->entry[0], q, out);
        return;
    case PIGMENT_NONE:
        for (int c = 0; c < 5; c++)
            out[c] = formula_constant(f, 0);
    }
}

uint32_t formula_grey(struct formula *f, const struct pigment *p, const uint32_t at[3])
{
    static const double weight[] = {LUMINANCE_RED, LUMINANCE_GREEN, LUMINANCE_BLUE};
    uint32_t c[5], sum = formula_constant(f, 0);
    pigment_at(f, p, at, c);
    for (int i = 0; i < 3; i++)
        sum = formula_add(f, sum, formula_scale(f, c[i], weight[i]));
    return formula_single(f, 2 * largest(p), sum);
}

// ---- whole tapes ------------------------------------------------------------------------

static struct formula begun(struct arena *a, struct arena *work)
{
    struct formula f = {.b = tape_builder_new(work), .arena = a};
    for (int i = 0; i < 3; i++)
        f.outside[i] = tape_argument(f.b, i);
    return f;
}

const struct tape *pattern_formula(struct arena *a, struct arena *work,
                                   const struct pattern *p)
{
    struct formula f = begun(a, work);
    uint32_t at[3];
    memcpy(at, f.outside, sizeof at);
    warped(&f, p, at);
    const uint32_t v = value_at(&f, p, at);
    return tape_finish(f.b, a, 3, &v, 1);
}

const struct tape *pigment_formula(struct arena *a, struct arena *work,
                                   const struct pigment *p)
{
    struct formula f = begun(a, work);
    uint32_t out[5];
    pigment_at(&f, p, f.outside, out);
    return tape_finish(f.b, a, 3, out, 5);
}
