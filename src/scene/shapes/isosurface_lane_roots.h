#ifndef ISOSURFACE_LANE_ROOTS_H
#define ISOSURFACE_LANE_ROOTS_H

// From the brackets of eight rays to their crossings, with bounds on the errors.
#include "scene/shapes/isosurface_lane_values.h"

// ---- roots --------------------------------------------------------------------------------

struct roots8 {
    struct real8 t, a, b; // the root is between a and b
};

// Chandrupatla's method (1997) in all lanes, from the secant's first guess.
static struct roots8 refine(struct walk8 *w, unsigned lanes)
{
    struct real8 x1 = r8_load(w->a), f1 = r8_load(w->fa), x0 = r8_load(w->b),
                 f0 = r8_load(w->fb);
    struct real8 u = r8_div(f0, r8_sub(f0, f1)), x2, f2;
    struct roots8 r = {x0, r8_min(x0, x1), r8_max(x0, x1)};
    u = r8_max(r8_min(u, r8_set(63. / 64)), r8_set(1. / 64));
    const struct real8 zero = r8_set(0), one = r8_set(1), half = r8_set(0.5);
    for (int i = 0; i < ISO_REFINE_MAX && lanes && !shape_hits_give_up(w->out); i++) {
        const struct real8 x = r8_add(x0, r8_mul(u, r8_sub(x1, x0)));
        const struct real8 f = value(w, x, lanes);
        const unsigned in = not_positive(f);
        const struct mask8 same = m8_of(~(in ^ not_positive(f0)) & 255);
        x2 = r8_select(same, x0, x1);
        f2 = r8_select(same, f0, f1);
        x1 = r8_select(same, x1, x0);
        f1 = r8_select(same, f1, f0);
        x0 = x;
        f0 = f;
        const struct real8 best = r8_select(r8_lt(r8_abs(f1), r8_abs(f0)), x1, x0);
        const struct real8 near = r8_add(r8_mul(r8_set(2 * ROUNDOFF), r8_abs(best)),
                                         r8_mul(r8_set(0x1p-56), w->chord));
        const struct real8 left = r8_div(near, r8_abs(r8_sub(x1, x0)));
        const struct mask8 exact = r8_eq(f0, zero), here = m8_of(lanes);
        r.t = r8_select(here, r8_select(exact, x0, best), r.t);
        r.a = r8_select(here, r8_select(exact, x0, r8_min(x0, x1)), r.a);
        r.b = r8_select(here, r8_select(exact, x0, r8_max(x0, x1)), r.b);
        lanes &= ~m8_bits(m8_or(m8_or(exact, r8_eq(f1, zero)), r8_lt(half, left)));
        const struct real8 xi = r8_div(r8_sub(x0, x1), r8_sub(x2, x1));
        const struct real8 phi = r8_div(r8_sub(f0, f1), r8_sub(f2, f1));
        const struct real8 p = r8_sub(one, phi);
        const struct mask8 quadratic =
            m8_and(r8_lt(r8_mul(phi, phi), xi), r8_lt(r8_mul(p, p), r8_sub(one, xi)));
        const struct real8 by_f1 =
            r8_mul(r8_div(f0, r8_sub(f1, f0)), r8_div(f2, r8_sub(f1, f2)));
        const struct real8 by_x =
            r8_mul(r8_div(r8_sub(x2, x0), r8_sub(x1, x0)), r8_div(f0, r8_sub(f2, f0)));
        const struct real8 by_f2 = r8_mul(by_x, r8_div(f1, r8_sub(f2, f1)));
        u = r8_select(quadratic, r8_add(by_f1, by_f2), half);
        u = r8_max(r8_min(u, r8_sub(one, left)), left);
    }
    return r;
}

// The largest |f| at points of the rays, with the rounding of their origins' place.
static struct real8 size_at(struct walk8 *w, const struct shape_rays *rays,
                            struct real8 t, unsigned lanes)
{
    const struct vec8 o = {r8_load(rays->o[0]), r8_load(rays->o[1]), r8_load(rays->o[2])};
    const struct real8 slack =
        r8_mul(r8_set(GAMMA(6)),
               r8_add(v8_max_abs(o), r8_mul(r8_abs(w->shift), v8_max_abs(w->d))));
    struct tape_boxes box;
    struct tape_slopes r;
    stretch_box(w->o, w->d, t, t, slack, lanes, &box);
    TAPE.bounds(w->s->f, &box, false, &r);
    w->evaluations += (unsigned)__builtin_popcount(lanes);
    const struct real8 at = r8_set(w->s->threshold), e = r8_set(1 + INTERVAL_ROUNDING);
    return r8_mul(
        e, r8_max(r8_abs(r8_sub(r8_load(r.lo), at)), r8_abs(r8_sub(r8_load(r.hi), at))));
}

// As error_of of isosurface_walk.c.
static struct real8 error_of(struct walk8 *w, const struct shape_rays *rays,
                             const struct roots8 *root, unsigned lanes)
{
    const struct real8 t = root->t;
    const struct real8 endless = r8_set(INFINITY);
    const struct real8 bracket =
        r8_add(r8_sub(root->b, root->a), r8_mul(r8_set(8 * ROUNDOFF), r8_abs(t)));
    struct real8 r = bracket;
    const struct real8 f = size_at(w, rays, t, lanes);
    const struct real8 first = r8_add(r, r8_div(f, r8_load(w->slope)));
    const struct mask8 good = r8_lt(first, r8_mul(r8_set(ISO_ERROR_GOOD), w->chord));
    // Else unknown, or a jump at a pole.
    const struct mask8 known = m8_and(r8_lt(r8_set(0), f), r8_lt(f, endless));
    r = r8_select(m8_and(good, known), first, r);
    lanes &= m8_bits(m8_without(known, good));
    for (int i = 0; i < ISO_ERROR_TRIES && lanes; i++) {
        struct tape_boxes box;
        stretch_box(w->o, w->d, r8_sub(t, r), r8_add(t, r), r8_set(0), lanes, &box);
        const struct over8 v = over(w, &box, (const double(*)[8])w->dirs, lanes);
        const struct real8 slope = least_size(v.slope_lo, v.slope_hi);
        const struct real8 reach = r8_div(f, slope);
        const struct mask8 sloped = r8_lt(r8_set(0), slope);
        lanes &= ~m8_bits(m8_and(sloped, r8_le(reach, r)));
        const struct real8 next =
            r8_select(sloped, r8_add(reach, reach), r8_mul(r8_set(16), r));
        r = r8_select(m8_of(lanes), next, r);
    }
    return r8_select(r8_lt(r, endless), r, bracket);
}

static unsigned settle_roots(struct walk8 *w, const struct shape_rays *rays,
                             unsigned lanes, struct shape_hits *out)
{
    const struct roots8 root = refine(w, lanes);
    const struct real8 t = r8_add(root.t, w->shift);
    const struct real8 dt =
        r8_add(error_of(w, rays, &root, lanes),
               r8_mul(r8_set(GAMMA(4)), r8_add(r8_abs(w->shift), r8_abs(root.t))));
    const struct mask8 m = m8_of(lanes);
    keep(out->t, m, t);
    keep(out->dt, m, dt);
    const unsigned before = lanes & m8_bits(r8_le(t, r8_load(rays->t_min)));
    w->odd |= before;
    return lanes & ~before & m8_bits(r8_le(t, r8_load(rays->t_max)));
}

// Brackets that lie in the wanted range tell enough.
static unsigned settle_any(const struct walk8 *w, const struct shape_rays *rays,
                           struct shape_hits *out)
{
    const struct real8 a = r8_add(r8_load(w->a), w->shift);
    const struct real8 b = r8_add(r8_load(w->b), w->shift);
    const unsigned in = w->found & m8_bits(m8_and(r8_lt(r8_load(rays->t_min), a),
                                                  r8_lt(b, r8_load(rays->t_max))));
    keep(out->t, m8_of(in), b);
    keep(out->dt, m8_of(in), r8_sub(b, a));
    return in;
}
#endif
