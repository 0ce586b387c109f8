// Eight rays and a polynomial's set, for the first crossing: the polynomials along the rays,
// isolation and Newton's method in lanes (math/polynomial_lanes.h). Where that does not tell,
// as at double roots, a lane is left to poly.c. ISA names the instruction set.
#include "scene/shapes/poly_lanes.h"

#include <string.h>

#include "math/polynomial_lanes.h"
#include "scene/shapes/lanes.h"
#include "scene/shapes/poly.h"

// ---- along the rays -----------------------------------------------------------------------

// As line_poly and its functions in poly.c, operation by operation.
struct line_poly8 {
    int degree;
    struct real8 c[POLYNOMIAL_DEGREE_MAX + 1];
};

LANES_INLINE void times_line(struct line_poly8 *p, struct real8 o, struct real8 d)
{
    if (p->degree < 0)
        return;
    p->degree++;
    p->c[p->degree] = r8_mul(d, p->c[p->degree - 1]);
    for (int i = p->degree - 1; i > 0; i--)
        p->c[i] = r8_add(r8_mul(o, p->c[i]), r8_mul(d, p->c[i - 1]));
    p->c[0] = r8_mul(p->c[0], o);
}

LANES_INLINE void add_poly(struct line_poly8 *p, const struct line_poly8 *q)
{
    for (int i = p->degree + 1; i <= q->degree; i++)
        p->c[i] = r8_set(0);
    for (int i = 0; i <= q->degree; i++)
        p->c[i] = r8_add(p->c[i], q->c[i]);
    p->degree = q->degree > p->degree ? q->degree : p->degree;
}

LANES_INLINE void add_constant(struct line_poly8 *p, double c)
{
    if (c == 0)
        return;
    p->c[0] = p->degree < 0 ? r8_set(c) : r8_add(p->c[0], r8_set(c));
    p->degree = p->degree < 0 ? 0 : p->degree;
}

static void times_power(struct line_poly8 *p, struct real8 o, struct real8 d, int power)
{
    while (power-- > 0)
        times_line(p, o, d);
}

static void along(const struct poly *s, const struct vec8 *o, const struct vec8 *d,
                  struct line_poly8 *out)
{
    struct line_poly8 in_y, in_z;
    int x = s->order;
    out->degree = -1;
    for (uint32_t i = 0; i < s->rows;) {
        const int at = s->row[i].x;
        int y = s->row[i].y;
        in_y.degree = -1;
        for (; i < s->rows && s->row[i].x == at; i++) {
            const struct poly_row *r = &s->row[i];
            times_power(&in_y, o->y, d->y, y - r->y);
            y = r->y;
            in_z.degree = -1;
            for (int k = r->top; k >= 0; k--) {
                times_line(&in_z, o->z, d->z);
                add_constant(&in_z, r->c[r->top - k]);
            }
            add_poly(&in_y, &in_z);
        }
        times_power(&in_y, o->y, d->y, y);
        times_power(out, o->x, d->x, x - at);
        x = at;
        add_poly(out, &in_y);
    }
    times_power(out, o->x, d->x, x);
}

// ---- errors ---------------------------------------------------------------------------------

LANES_INLINE struct real8 power(struct real8 x, int n)
{
    struct real8 v = r8_set(1);
    for (; n > 0; n /= 2, x = r8_mul(x, x))
        v = n % 2 ? r8_mul(v, x) : v;
    return v;
}

// The sum of the terms at a point; sizes: of their sizes.
LANES_INLINE struct real8 sum_at(const struct poly *s, struct vec8 p, bool sizes)
{
    struct real8 sum = r8_set(0);
    for (uint32_t i = 0; i < s->rows; i++) {
        const struct poly_row *r = &s->row[i];
        struct real8 in_z = r8_set(0);
        for (int k = 0; k <= r->top; k++)
            in_z = r8_add(r8_mul(in_z, p.z), r8_set(sizes ? fabs(r->c[k]) : r->c[k]));
        sum = r8_add(sum, r8_mul(r8_mul(power(p.x, r->x), power(p.y, r->y)), in_z));
    }
    return sum;
}

static struct real8 value_at(const struct poly *s, const struct lines8 *l, struct real8 t)
{
    return sum_at(s, v8_mad(l->o, t, l->u), false);
}

// As lost_at of poly.c.
static struct real8 lost_at(const struct poly *s, const struct lines8 *l, struct real8 t)
{
    const struct vec8 o = {r8_abs(l->o.x), r8_abs(l->o.y), r8_abs(l->o.z)};
    const struct vec8 u = {r8_abs(l->u.x), r8_abs(l->u.y), r8_abs(l->u.z)};
    return r8_mul(r8_set(4 * s->order * ROUNDOFF),
                  sum_at(s, v8_mad(o, r8_abs(t), u), true));
}

// ---- roots ----------------------------------------------------------------------------------

// The sign of the polynomial where the rays begin; 0 within its rounding. Where the sum along
// the line is rounding, as near the surface and within high orders' flat middles, the terms
// tell better.
LANES_INLINE struct real8 first_sign(const struct poly *s, const struct line_poly8 *p,
                                     int n, const struct lines8 *l, unsigned lanes)
{
    const struct real8 one = r8_set(1), size = poly8_size(p->c, n, l->lo);
    struct real8 v = poly8_value(p->c, n, l->lo);
    const struct mask8 clear = r8_lt(r8_mul(r8_set(64 * ROUNDOFF), size), r8_abs(v));
    if (lanes & ~m8_bits(clear))
        v = r8_select(clear, v, value_at(s, l, l->lo));
    return r8_select(r8_lt(r8_mul(r8_set(4 * ROUNDOFF), size), r8_abs(v)),
                     r8_copysign(one, v), r8_set(0));
}

struct first8 {
    struct real8 t; // of the lanes found
    unsigned found, unsure, below;
};

// How far the polynomial along the lines may be off at t: by the rounding of its sum, and by what
// its coefficients have lost.
static struct real8 value_error(const struct poly *s, const struct line_poly8 *p,
                                const struct lines8 *l, struct real8 t)
{
    const struct real8 size = poly8_size(p->c, p->degree, t);
    return r8_add(lost_at(s, l, t),
                  r8_mul(r8_set((2 * p->degree + 4 * s->order) * ROUNDOFF), size));
}

// Lanes whose sign at t is no rounding.
static unsigned sign_is_clear(const struct poly *s, const struct line_poly8 *p,
                              const struct lines8 *l, struct real8 t)
{
    const struct real8 v = poly8_value(p->c, p->degree, t);
    return m8_bits(r8_lt(value_error(s, p, l, t), r8_abs(v)));
}

LANES_INLINE struct first8 first_of(const struct poly *s, const struct line_poly8 *p,
                                    int n, const struct lines8 *l, unsigned lanes,
                                    unsigned halved, bool any,
                                    const volatile bool *cancel)
{
    struct first8 f;
    const struct brackets8 r = poly8_isolate(
        p->c, n, l->lo, l->hi, first_sign(s, p, n, l, lanes), lanes, halved, any, cancel);
    f.below = m8_bits(r8_lt(r.sign, r8_set(0)));
    f.found = r.found;
    f.unsure = r.unsure;
    // Two signs say that there is a root between if rounding has made neither: a shadow's ray may
    // begin or end on the surface.
    if (any && s->order > POLY_LOW_ORDER && f.found)
        f.unsure |=
            f.found & ~(sign_is_clear(s, p, l, r.a) & sign_is_clear(s, p, l, r.b));
    f.t =
        any ? r8_mul(r8_set(0.5), r8_add(r.a, r.b)) : poly8_refine(p->c, n, &r, r.found);
    return f;
}

// The usual degrees by loops that unroll.
static struct first8 first_root(const struct poly *s, const struct line_poly8 *p,
                                const struct lines8 *l, unsigned lanes, unsigned halved,
                                bool any, const volatile bool *cancel)
{
    switch (p->degree) {
    case 3: return first_of(s, p, 3, l, lanes, halved, any, cancel);
    case 4: return first_of(s, p, 4, l, lanes, halved, any, cancel);
    case 6: return first_of(s, p, 6, l, lanes, halved, any, cancel);
    default: return first_of(s, p, p->degree, l, lanes, halved, any, cancel);
    }
}

// As polynomial_root_bound, of the lane.
static double lane_bound(const struct line_poly8 *p, int lane)
{
    double c[POLYNOMIAL_DEGREE_MAX + 1], each[8];
    for (int i = 0; i <= p->degree; i++) {
        r8_store(each, p->c[i]);
        c[i] = each[lane];
    }
    return polynomial_root_bound(c, p->degree);
}

// The exponents that frexp has, but for numbers too small to be normal: these get the least.
enum { LEAST_EXPONENT = -1022 };
static struct real8 exponent8(struct real8 x)
{
    double v[8];
    uint64_t bits[8];
    r8_store(v, x);
    memcpy(bits, v, sizeof bits);
    for (int i = 0; i < 8; i++)
        v[i] = (double)((int)(bits[i] >> 52 & 0x7ff) + LEAST_EXPONENT);
    return r8_load(v);
}

// Where the set has no box, all roots are within polynomial_root_bound.
static void clip_to_roots(const struct line_poly8 *p, struct lines8 *l)
{
    const struct real8 lead = exponent8(p->c[p->degree]), none = r8_set(-INFINITY);
    struct real8 most = none;
    double e[8], far[8];
    for (int i = 0; i < p->degree; i++) {
        const struct real8 above = r8_add(r8_sub(exponent8(p->c[i]), lead), r8_set(1));
        const struct real8 share =
            r8_neg(r8_floor(r8_div(r8_neg(above), r8_set(p->degree - i)))); // rounded up
        const struct mask8 zero = r8_eq(p->c[i], r8_set(0));
        most = r8_max(most, r8_select(zero, none, share));
    }
    const unsigned normal = m8_bits(
        m8_and(r8_lt(r8_set(LEAST_EXPONENT), lead), r8_lt(r8_abs(most), r8_set(1000))));
    r8_store(e, most);
    for (int k = 0; k < 8; k++) {
        if (normal >> k & 1) {
            const uint64_t bits = (uint64_t)((int)e[k] + 1 + 1023) << 52;
            memcpy(&far[k], &bits, sizeof bits);
        } else {
            far[k] = lane_bound(p, k);
        }
    }
    l->lo = r8_max(r8_neg(r8_load(far)), l->lo);
    l->hi = r8_min(r8_load(far), l->hi);
}

// How far a root at t may be off; infinite where it is not simple.
static struct real8 error_at(const struct poly *s, const struct line_poly8 *p,
                             const struct lines8 *l, struct real8 t)
{
    return r8_add(poly8_root_error(p->c, p->degree, t, value_error(s, p, l, t)),
                  r8_mul(r8_set(0x1p-51), r8_add(r8_abs(l->shift), r8_abs(t))));
}

// Lanes whose error dt moves the rays that go on from a root at t by what may be seen. The
// one-ray form of high orders knows roots better there.
static unsigned is_coarse(const struct poly *s, const struct lines8 *l, struct real8 t,
                          struct real8 dt)
{
    static const double share = 0x1p-30; // of where the root lies
    if (s->order <= POLY_LOW_ORDER)
        return 0;
    return m8_bits(r8_lt(r8_mul(r8_set(share), r8_add(r8_abs(l->shift), r8_abs(t))), dt));
}

// Lanes that begin nearer to a root than the polynomial along the line tells: on a surface, of
// which it may have either side.
static unsigned begins_in_doubt(const struct poly *s, const struct line_poly8 *p,
                                const struct lines8 *l)
{
    const unsigned doubt = ~sign_is_clear(s, p, l, l->lo);
    return doubt ? doubt & is_coarse(s, l, l->lo, error_at(s, p, l, l->lo)) : 0;
}

// As sharpened of poly.c, of roots whose error is dt.
static struct real8 sharpened(const struct poly *s, const struct line_poly8 *p,
                              const struct lines8 *l, struct real8 t, struct real8 dt)
{
    const struct real8 own =
        r8_mul(r8_set(POLY_ROUGH * 0x1p-51), r8_add(r8_abs(l->shift), r8_abs(t)));
    const struct mask8 rough = r8_lt(own, dt);
    if (!m8_bits(rough))
        return t;
    struct real8 slope = r8_set(0), v = slope;
    for (int i = p->degree; i >= 0; i--) {
        slope = r8_add(r8_mul(slope, t), v);
        v = r8_add(r8_mul(v, t), p->c[i]);
    }
    const struct real8 step = r8_div(value_at(s, l, t), slope);
    return r8_select(m8_and(rough, r8_le(r8_abs(step), dt)), r8_sub(t, step), t);
}

static unsigned closest(const struct poly *s, const struct shape_rays *rays,
                        unsigned lanes, bool any, struct shape_hits *out)
{
    struct lines8 l = lines8_of(rays, vec3(0, 0, 0));
    struct line_poly8 p;
    // The first root is looked for beyond what else has been met: where that lies, which
    // depends on the order of the search, must not move its bracket and so its last bits.
    const struct real8 reach = l.hi;
    if (!any)
        l.hi = r8_set(INFINITY);
    if (s->compact)
        lanes &= lines8_clip(&l, &s->box) & m8_bits(r8_lt(l.lo, reach));
    if (!lanes || shape_hits_give_up(out))
        return 0;
    along(s, &l.o, &l.u, &p);
    if (p.degree < 1)
        return 0;
    if (!s->compact)
        clip_to_roots(&p, &l);
    unsigned halved = 0;
    if (p.degree == 4) {
        const struct narrowed8 narrowed = quartic8_narrow(p.c, &l.lo, &l.hi);
        lanes &= ~narrowed.none;
        halved = narrowed.both;
    }
    lanes &= m8_bits(r8_lt(l.lo, r8_min(reach, l.hi)));
    if (!lanes)
        return 0;
    struct first8 f = first_root(s, &p, &l, lanes, halved, any, out->cancel);
    struct real8 dt = r8_set(0);
    unsigned unsure = f.unsure, found = f.found;
    if (s->order > POLY_LOW_ORDER)
        unsure |= lanes & begins_in_doubt(s, &p, &l);
    if (found && !any) {
        dt = error_at(s, &p, &l, f.t);
        unsure |=
            found & (~m8_bits(r8_lt(dt, r8_set(INFINITY))) | is_coarse(s, &l, f.t, dt));
        f.t = sharpened(s, &p, &l, f.t, dt);
    }
    // Clearly beyond it there is nothing to tell.
    const struct real8 margin =
        r8_mul(r8_set(0x1p-30), r8_add(r8_abs(l.shift), r8_abs(reach)));
    if (!any)
        found &= m8_bits(r8_le(f.t, r8_add(reach, margin)));
    found &= ~unsure;
    const unsigned met = lines8_hits(&l, rays, found, f.t, dt, f.below, out);
    // What rounding has put out of the range is for the one-ray form to tell as well.
    return met | shape_lanes_alone(&poly_ops, s, rays, unsure | (found & ~met), out);
}

// ---- all crossings ------------------------------------------------------------------------

static void lines_put(struct shape_lines *out, const struct lines8 *l, unsigned lanes,
                      int k, struct real8 t, struct real8 dt)
{
    lanes_put(out->t[k], lanes, r8_div(r8_add(t, l->shift), l->length));
    lanes_put(out->dt[k], lanes, r8_div(dt, l->length));
    for (unsigned m = lanes; m; m &= m - 1)
        out->count[__builtin_ctz(m)]++;
}

// One root after the other, from where the one before is known to lie in front of; returns
// the lanes that are left unsure.
LANES_INLINE unsigned roots_of(const struct poly *s, const struct line_poly8 *p, int n,
                               struct lines8 *l, unsigned lanes, unsigned halved,
                               struct shape_lines *out)
{
    struct real8 sign = first_sign(s, p, n, l, lanes);
    unsigned unsure = lanes & m8_bits(r8_eq(sign, r8_set(0)));
    lanes &= ~unsure;
    out->leaving = m8_bits(r8_lt(sign, r8_set(0)));
    for (int k = 0; lanes; k++, halved = 0) {
        const struct brackets8 r =
            poly8_isolate(p->c, n, l->lo, l->hi, sign, lanes, halved, false, NULL);
        unsure |= r.unsure;
        lanes = r.found;
        if (!lanes)
            break;
        if (k == LINE_CROSSINGS) // more than there can be
            return unsure | lanes;
        const struct real8 t = poly8_refine(p->c, n, &r, lanes);
        const struct real8 dt = error_at(s, p, l, t);
        const unsigned simple = lanes & m8_bits(r8_lt(dt, r8_set(INFINITY)));
        unsure |= lanes & ~simple;
        // Within the bracket, so that roots stay in order.
        const struct real8 sharp = sharpened(s, p, l, t, dt);
        const struct mask8 here = m8_and(r8_lt(r.a, sharp), r8_lt(sharp, r.b));
        lines_put(out, l, simple, k, r8_select(here, sharp, t), dt);
        lanes = simple & m8_bits(r8_lt(r.b, l->hi));
        l->lo = r.b;
        sign = r8_neg(r.sign);
    }
    return unsure;
}

static unsigned lines(const struct poly *s, const struct shape_rays *rays, unsigned lanes,
                      struct shape_lines *out)
{
    struct lines8 l = lines8_of(rays, vec3(0, 0, 0));
    struct line_poly8 p;
    unsigned here = lanes, halved = 0;
    if (s->order > POLY_LOW_ORDER)
        return 0;
    memset(out->count, 0, sizeof out->count);
    l.lo = r8_set(-INFINITY);
    l.hi = r8_set(INFINITY);
    out->leaving = 0;
    if (s->compact)
        here &= lines8_clip(&l, &s->box);
    if (!here)
        return lanes;
    along(s, &l.o, &l.u, &p);
    if (p.degree < 1)
        return lanes;
    if (!s->compact)
        clip_to_roots(&p, &l);
    if (p.degree == 4) {
        const struct narrowed8 narrowed = quartic8_narrow(p.c, &l.lo, &l.hi);
        here &= ~narrowed.none;
        halved = narrowed.both;
    }
    here &= m8_bits(r8_lt(l.lo, l.hi));
    if (!here)
        return lanes;
    if (p.degree == 4)
        return lanes & ~roots_of(s, &p, 4, &l, here, halved, out);
    return lanes & ~roots_of(s, &p, p.degree, &l, here, halved, out);
}

unsigned OF_ISA(poly_lines8_)(const struct poly *s, const struct shape_rays *rays,
                              unsigned lanes, struct shape_lines *out)
{
    return lines(s, rays, lanes, out);
}

unsigned OF_ISA(poly_closest8_)(const struct poly *s, const struct shape_rays *rays,
                                unsigned lanes, bool any, struct shape_hits *out)
{
    return closest(s, rays, lanes, any, out);
}
