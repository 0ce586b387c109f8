// Eight rays and a superellipsoid that is convex, or eight places or parts of one line: superellipsoid.c
// in lanes, operation by operation, with the same bits. ISA names the instruction set.
#include "math/quick_lanes.h"
#include "scene/shapes/lanes.h"
#include "scene/shapes/superellipsoid.h"

static const double noise = GAMMA(64), edge = 1 + 0x1p-20;

LANES_INLINE struct real8 pow8(struct real8 x, double y)
{
    double in[8], out[8];
    r8_store(in, x);
    quick_pow8(in, y, out);
    return r8_load(out);
}

LANES_INLINE struct real8 power(struct real8 x, const struct exponent *e)
{
    if (e->squares < 0)
        return pow8(x, e->p);
    for (int i = 0; i < e->squares; i++)
        x = r8_mul(x, x);
    return x;
}

LANES_INLINE struct real8 root(struct real8 x, const struct exponent *e)
{
    if (e->squares < 0)
        return pow8(x, 1 / e->p);
    for (int i = 0; i < e->squares; i++)
        x = r8_sqrt(x);
    return x;
}

LANES_INLINE struct real8 norm2(struct real8 a, struct real8 b, const struct exponent *p,
                                struct real8 *da, struct real8 *db)
{
    const struct real8 one = r8_set(1), zero = r8_set(0);
    const struct mask8 turned = r8_lt(a, b);
    const struct real8 big = r8_select(turned, b, a), small = r8_select(turned, a, b);
    const struct mask8 both = r8_lt(r8_mul(r8_set(0x1p-1000), big), small);
    const struct real8 q = r8_select(both, r8_div(small, big), one), w = power(q, p);
    const struct real8 sum = r8_add(one, w), c = root(sum, p);
    const struct real8 by_big = r8_select(both, r8_div(c, sum), one);
    const struct real8 by_small = r8_select(both, r8_div(r8_mul(by_big, w), q), zero);
    *da = r8_select(turned, by_small, by_big);
    *db = r8_select(turned, by_big, by_small);
    return r8_mul(r8_select(both, c, one), big);
}

struct samples8 {
    struct real8 f, slope;
};

// F + 1 and its gradient.
LANES_INLINE struct vec8 gradient(const struct superellipsoid *s, struct vec8 p,
                                  struct real8 *f)
{
    struct real8 dx, dy, da, dz;
    const struct real8 a = norm2(r8_abs(p.x), r8_abs(p.y), &s->p, &dx, &dy);
    *f = norm2(a, r8_abs(p.z), &s->q, &da, &dz);
    return (struct vec8){r8_copysign(r8_mul(da, dx), p.x),
                         r8_copysign(r8_mul(da, dy), p.y), r8_copysign(dz, p.z)};
}

static struct samples8 at(const struct superellipsoid *s, const struct lines8 *l,
                          struct real8 t)
{
    struct real8 f;
    const struct vec8 g = gradient(s, v8_mad(l->o, t, l->u), &f);
    return (struct samples8){r8_sub(f, r8_set(1)), v8_dot(g, l->u)};
}

LANES_INLINE void slab(struct real8 o, struct real8 u, struct real8 *a, struct real8 *b,
                       struct mask8 *beside)
{
    const struct real8 side = r8_copysign(r8_set(edge), u);
    const struct mask8 flat = r8_eq(u, r8_set(0));
    const struct real8 in = r8_div(r8_sub(r8_neg(side), o), u);
    const struct real8 out = r8_div(r8_sub(side, o), u);
    *beside = m8_or(*beside, m8_and(flat, r8_lt(r8_set(edge), r8_abs(o))));
    *a = r8_select(flat, *a, r8_max(*a, in));
    *b = r8_select(flat, *b, r8_min(*b, out));
}

// As approach of superellipsoid.c; returns the lanes with a root.
static unsigned approach(const struct superellipsoid *s, const struct lines8 *l,
                         struct real8 t, struct real8 to, double way, unsigned lanes,
                         struct real8 *root, struct real8 *slope, struct shape_hits *out)
{
    const struct real8 zero = r8_set(0), ahead = r8_set(way);
    unsigned found = 0;
    for (int i = 0; i < 100 && lanes && !shape_hits_give_up(out); i++) {
        const struct samples8 v = at(s, l, t);
        const struct mask8 here = m8_of(lanes);
        *slope = r8_select(here, v.slope, *slope);
        *root = r8_select(here, t, *root);
        const unsigned met = lanes & m8_bits(r8_le(v.f, r8_set(noise)));
        const struct real8 next = r8_sub(t, r8_div(v.f, v.slope));
        const unsigned on = m8_bits(m8_and(r8_lt(r8_mul(v.slope, ahead), zero),
                                           r8_le(zero, r8_mul(r8_sub(to, next), ahead))));
        const unsigned same = lanes & on & m8_bits(r8_eq(next, t));
        found |= met | same;
        lanes &= on & ~met & ~same;
        t = r8_select(m8_of(lanes), next, t);
    }
    return found | lanes; // a graze, where steps only halve
}

// The error of t on a line where F has that slope.
LANES_INLINE struct real8 error_of(const struct lines8 *l, struct real8 t,
                                   struct real8 slope)
{
    return r8_add(r8_div(r8_set(2 * noise), r8_max(r8_abs(slope), r8_set(0x1p-26))),
                  r8_mul(r8_set(GAMMA(4)), r8_add(r8_abs(l->shift), r8_abs(t))));
}

LANES_INLINE unsigned put(const struct lines8 *l, const struct shape_rays *rays,
                          unsigned lanes, struct real8 t, struct real8 slope, bool exits,
                          struct shape_hits *out)
{
    return lines8_hits(l, rays, lanes, t, error_of(l, t, slope), exits ? 255 : 0, out);
}

// The stretches of the lines in the cube, of the lanes that are returned.
LANES_INLINE unsigned in_cube(const struct lines8 *l, struct real8 *a, struct real8 *b)
{
    struct mask8 beside = m8_of(0);
    *a = r8_set(-2 * edge);
    *b = r8_set(2 * edge);
    slab(l->o.x, l->u.x, a, b, &beside);
    slab(l->o.y, l->u.y, a, b, &beside);
    slab(l->o.z, l->u.z, a, b, &beside);
    return m8_bits(m8_without(r8_lt(*a, *b), beside));
}

static unsigned closest(const struct superellipsoid *s, const struct shape_rays *rays,
                        unsigned lanes, struct shape_hits *out)
{
    const struct lines8 l = lines8_of(rays, vec3(0, 0, 0));
    const struct real8 zero = r8_set(0);
    struct real8 a, b;
    lanes &= in_cube(&l, &a, &b);
    lanes &= m8_bits(r8_lt(l.lo, b));
    const unsigned late = lanes & m8_bits(r8_lt(a, l.lo));
    if (late) { // a convex F that rises from above zero has no root ahead
        const struct samples8 here = at(s, &l, l.lo);
        lanes &= ~(late & m8_bits(m8_and(r8_lt(r8_set(noise), here.f),
                                         r8_lt(zero, here.slope))));
    }
    if (!lanes)
        return 0;
    struct real8 first = a, last = b, slope = zero;
    lanes = approach(s, &l, a, b, 1, lanes, &first, &slope, out);
    const unsigned met = put(&l, rays, lanes, first, slope, false, out);
    // Beyond the entry, or not as far.
    const unsigned within =
        lanes & ~met & ~m8_bits(r8_lt(r8_load(rays->t_max), r8_load(out->t)));
    if (!within)
        return met;
    const unsigned two = approach(s, &l, b, first, -1, within, &last, &slope, out);
    last = r8_select(m8_of(two), last, first);
    return met | put(&l, rays, within, last, slope, true, out);
}

unsigned OF_ISA(superellipsoid_closest8_)(const struct superellipsoid *s,
                                          const struct shape_rays *rays, unsigned lanes,
                                          bool any, struct shape_hits *out)
{
    (void)any;
    return closest(s, rays, lanes, out);
}

static void end_put(const struct superellipsoid *s, const struct lines8 *l,
                    const struct shape_rays *rays, struct real8 t, struct real8 slope,
                    struct superellipsoid_ends *out, int k)
{
    const struct vec8 d = v8_load(rays->d);
    const struct real8 at = r8_div(r8_add(t, l->shift), l->length);
    struct real8 f;
    const struct vec8 n = v8_normalize(gradient(s, v8_mad(v8_load(rays->o), at, d), &f));
    r8_store(out->t[k], at);
    r8_store(out->dt[k], r8_div(error_of(l, t, slope), l->length));
    r8_store(out->slope[k], r8_abs(v8_dot(n, d)));
}

// As convex of superellipsoid.c.
unsigned OF_ISA(superellipsoid_ends8_)(const struct superellipsoid *s,
                                       const struct shape_rays *rays, unsigned lanes,
                                       struct superellipsoid_ends *out)
{
    const struct lines8 l = lines8_of(rays, vec3(0, 0, 0));
    struct shape_hits none = {.cancel = NULL};
    struct real8 a, b, slope[2] = {r8_set(1), r8_set(1)};
    lanes &= in_cube(&l, &a, &b);
    struct real8 first = a, last = b;
    lanes = approach(s, &l, a, b, 1, lanes, &first, &slope[0], &none);
    if (!lanes)
        return 0;
    const unsigned two = approach(s, &l, b, first, -1, lanes, &last, &slope[1], &none);
    last = r8_select(m8_of(two), last, first);
    end_put(s, &l, rays, first, slope[0], out, 0);
    end_put(s, &l, rays, last, slope[1], out, 1);
    return lanes;
}

void OF_ISA(superellipsoid_samples8_)(const struct superellipsoid *s, struct vec3 o,
                                      struct vec3 u, const double t[8], double f[8],
                                      double slope[8])
{
    const struct lines8 l = {.o = V8_SET(o), .u = V8_SET(u)};
    const struct samples8 v = at(s, &l, r8_load(t));
    r8_store(f, v.f);
    r8_store(slope, v.slope);
}

// As root_between of superellipsoid.c, of eight lines.
void OF_ISA(superellipsoid_roots8_)(const struct superellipsoid *s, unsigned lanes,
                                    struct superellipsoid_roots *r)
{
    const struct superellipsoid_roots *from = r;
    const struct lines8 l = {.o = v8_load(from->o), .u = v8_load(from->u)};
    const struct real8 zero = r8_set(0);
    struct real8 outside = r8_load(r->outside), inside = r8_load(r->inside),
                 t = r8_load(r->t), slope = r8_set(1);
    for (int i = 0; i < 100 && lanes; i++) {
        const struct samples8 v = at(s, &l, t);
        const struct mask8 here = m8_of(lanes), above = r8_lt(zero, v.f);
        slope = r8_select(here, v.slope, slope);
        outside = r8_select(above, t, outside);
        inside = r8_select(above, inside, t);
        const struct real8 lo = r8_min(outside, inside), hi = r8_max(outside, inside);
        const struct real8 step = r8_sub(t, r8_div(v.f, v.slope));
        const struct mask8 in = m8_and(r8_lt(lo, step), r8_lt(step, hi));
        const struct real8 next =
            r8_select(in, step, r8_mul(r8_set(0.5), r8_add(lo, hi)));
        const struct mask8 still = r8_eq(step, t);
        const struct mask8 on =
            m8_without(m8_and(m8_and(r8_lt(lo, next), r8_lt(next, hi)),
                              r8_le(r8_set(GAMMA(2)), r8_abs(r8_sub(next, t)))),
                       still);
        t = r8_select(m8_without(here, still), next, t);
        lanes &= m8_bits(on);
    }
    r8_store(r->t, t);
    r8_store(r->slope, slope);
}

LANES_INLINE struct real8 least(struct real8 p, struct real8 q)
{
    const struct real8 zero = r8_set(0);
    return r8_select(r8_lt(zero, r8_mul(p, q)), r8_min(r8_abs(p), r8_abs(q)), zero);
}

void OF_ISA(superellipsoid_least8_)(const struct superellipsoid *s, struct vec3 o,
                                    struct vec3 u, const double t[9], double f[8])
{
    const struct vec8 p = v8_mad(V8_SET(o), r8_load(t), V8_SET(u)),
                      q = v8_mad(V8_SET(o), r8_load(t + 1), V8_SET(u));
    struct real8 da, db;
    const struct real8 a = norm2(least(p.x, q.x), least(p.y, q.y), &s->p, &da, &db);
    r8_store(f, r8_sub(norm2(a, least(p.z, q.z), &s->q, &da, &db), r8_set(1)));
}
