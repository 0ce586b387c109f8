// Eight rays through a julia_fractal side by side: julia_fractal.c and julia_iterate.c in lanes,
// operation by operation, with the same bits. ISA names the instruction set.
#include "scene/shapes/julia_lanes.h"

#include "math/elementary.h"
#include "math/quick_lanes.h"
#include "scene/shapes/julia.h"
#include "scene/shapes/lanes.h"

// ---- complex numbers ------------------------------------------------------------------------

struct complex8 {
    struct real8 re, im;
};

LANES_INLINE struct complex8 c8_scale(double k, struct complex8 a)
{
    return (struct complex8){r8_mul(r8_set(k), a.re), r8_mul(r8_set(k), a.im)};
}
LANES_INLINE struct complex8 c8_add(struct complex8 a, struct complex b)
{
    return (struct complex8){r8_add(a.re, r8_set(b.re)), r8_add(a.im, r8_set(b.im))};
}
LANES_INLINE struct complex8 c8_mul(struct complex8 a, struct complex8 b)
{
    return (struct complex8){r8_sub(r8_mul(a.re, b.re), r8_mul(a.im, b.im)),
                             r8_add(r8_mul(a.re, b.im), r8_mul(a.im, b.re))};
}
LANES_INLINE struct real8 c8_norm(struct complex8 a)
{
    return r8_add(r8_mul(a.re, a.re), r8_mul(a.im, a.im));
}
LANES_INLINE struct complex8 c8_inverse(struct complex8 a)
{
    const struct real8 n = c8_norm(a), zero = r8_set(0);
    const struct mask8 some = r8_lt(zero, n);
    return (struct complex8){r8_select(some, r8_div(a.re, n), zero),
                             r8_select(some, r8_div(r8_neg(a.im), n), zero)};
}

// exp_of and sincos_of of julia_iterate.c, of the lanes that are still wanted.
static struct real8 exp8(struct real8 x, unsigned lanes)
{
    double in[8], out[8];
    const unsigned plain = m8_bits(r8_lt(r8_abs(x), r8_set(700)));
    r8_store(in, r8_select(m8_of(plain), x, r8_set(0)));
    quick_exp8(in, out);
    if (lanes & ~plain) {
        r8_store(in, x);
        for (unsigned m = lanes & ~plain; m; m &= m - 1)
            out[__builtin_ctz(m)] = det_exp(in[__builtin_ctz(m)]);
    }
    return r8_load(out);
}

static void sincos8(struct real8 x, unsigned lanes, struct real8 *s, struct real8 *c)
{
    const unsigned plain = m8_bits(r8_lt(r8_abs(x), r8_set(1e5)));
    quick_sincos8(r8_select(m8_of(plain), x, r8_set(0)), s, c);
    if (!(lanes & ~plain))
        return;
    double in[8], sine[8], cosine[8];
    r8_store(in, x);
    r8_store(sine, *s);
    r8_store(cosine, *c);
    for (unsigned m = lanes & ~plain; m; m &= m - 1) {
        const int l = __builtin_ctz(m);
        sine[l] = det_sin(in[l]);
        cosine[l] = det_cos(in[l]);
    }
    *s = r8_load(sine);
    *c = r8_load(cosine);
}

// The hyperbolic sine and cosine of x, the sine and cosine of y.
LANES_INLINE void parts8(struct real8 x, struct real8 y, unsigned lanes, struct real8 *sh,
                         struct real8 *ch, struct real8 *s, struct real8 *c)
{
    const struct real8 half = r8_set(0.5), e = exp8(x, lanes);
    const struct real8 inverse = r8_div(r8_set(1), e);
    *ch = r8_mul(half, r8_add(e, inverse));
    *sh = r8_mul(half, r8_sub(e, inverse));
    sincos8(y, lanes, s, c);
}

LANES_INLINE void c8_sincos(struct complex8 a, unsigned lanes, struct complex8 *sine,
                            struct complex8 *cosine)
{
    struct real8 sh, ch, s, c;
    parts8(a.im, a.re, lanes, &sh, &ch, &s, &c);
    *sine = (struct complex8){r8_mul(s, ch), r8_mul(c, sh)};
    *cosine = (struct complex8){r8_mul(c, ch), r8_mul(r8_neg(s), sh)};
}

LANES_INLINE void c8_sinhcosh(struct complex8 a, unsigned lanes, struct complex8 *sine,
                              struct complex8 *cosine)
{
    struct real8 sh, ch, s, c;
    parts8(a.re, a.im, lanes, &sh, &ch, &s, &c);
    *sine = (struct complex8){r8_mul(sh, c), r8_mul(ch, s)};
    *cosine = (struct complex8){r8_mul(ch, c), r8_mul(sh, s)};
}

// ---- hypercomplex iterates --------------------------------------------------------------------

// f(z) and its derivative.
static struct complex8 apply(const struct julia *j, struct complex8 z, unsigned lanes,
                             struct complex8 *d)
{
    const struct complex8 z2 = c8_mul(z, z);
    struct complex8 f, g;
    struct real8 e, s, c;
    switch (j->function) {
    case JULIA_CUBE: *d = c8_scale(3, z2); return c8_mul(z2, z);
    case JULIA_EXP:
        e = exp8(z.re, lanes);
        sincos8(z.im, lanes, &s, &c);
        return *d = (struct complex8){r8_mul(e, c), r8_mul(e, s)};
    case JULIA_RECIPROCAL:
        f = c8_inverse(z);
        *d = c8_scale(-1, c8_mul(f, f));
        return f;
    case JULIA_SIN: c8_sincos(z, lanes, &f, d); return f;
    case JULIA_COS:
        c8_sincos(z, lanes, &g, &f);
        *d = c8_scale(-1, g);
        return f;
    case JULIA_SINH: c8_sinhcosh(z, lanes, &f, d); return f;
    case JULIA_COSH: c8_sinhcosh(z, lanes, d, &f); return f;
    case JULIA_TAN:
    case JULIA_TANH:
        if (j->function == JULIA_TAN)
            c8_sincos(z, lanes, &f, &g);
        else
            c8_sinhcosh(z, lanes, &f, &g);
        g = c8_inverse(g);
        *d = c8_mul(g, g);
        return c8_mul(f, g);
    default: // squares
        *d = c8_scale(2, z);
        return z2;
    }
}

struct pair8 {
    struct complex8 a, b;
};

LANES_INLINE struct pair8 pair8_of(struct vec8 p, struct real8 w)
{
    return (struct pair8){{r8_sub(p.x, w), r8_add(p.y, p.z)},
                          {r8_add(p.x, w), r8_sub(p.y, p.z)}};
}

LANES_INLINE struct real8 pair8_norm(const struct pair8 *h)
{
    return r8_mul(r8_set(0.5), r8_add(c8_norm(h->a), c8_norm(h->b)));
}

LANES_INLINE struct real8 growth8(const struct pair8 *h, const struct pair8 *slope,
                                  struct pair8 s)
{
    const struct complex8 da = c8_mul(slope->a, s.a), db = c8_mul(slope->b, s.b);
    const struct real8 sum =
        r8_add(r8_add(r8_add(r8_mul(h->a.re, da.re), r8_mul(h->a.im, da.im)),
                      r8_mul(h->b.re, db.re)),
               r8_mul(h->b.im, db.im));
    return r8_mul(r8_set(0.5), sum);
}

LANES_INLINE void pair8_step(const struct julia *j, struct pair8 *h, struct pair8 *slope,
                             bool slopes, unsigned lanes)
{
    const struct complex ca = {j->c[0] - j->c[3], j->c[1] + j->c[2]};
    const struct complex cb = {j->c[0] + j->c[3], j->c[1] - j->c[2]};
    struct complex8 da, db;
    if (j->function == JULIA_SQR) {
        if (slopes) {
            slope->a = c8_scale(2, c8_mul(slope->a, h->a));
            slope->b = c8_scale(2, c8_mul(slope->b, h->b));
        }
        h->a = c8_add(c8_mul(h->a, h->a), ca);
        h->b = c8_add(c8_mul(h->b, h->b), cb);
        return;
    }
    h->a = c8_add(apply(j, h->a, lanes, &da), ca);
    h->b = c8_add(apply(j, h->b, lanes, &db), cb);
    if (slopes) {
        slope->a = c8_mul(slope->a, da);
        slope->b = c8_mul(slope->b, db);
    }
}

// ---- samples ------------------------------------------------------------------------------------

struct walk8 {
    const struct julia *j;
    struct lines8 l;
    struct real8 w; // how the fourth component of hypercomplex starts moves along them
};

// As struct sample of julia_fractal.c; of each lane wanted.
struct samples8 {
    unsigned in, smooth;
    struct real8 over, step;
};

LANES_INLINE struct real8 w_at(const struct julia *j, struct vec8 p)
{
    return r8_add(r8_add(r8_add(r8_set(j->start[3]), r8_mul(r8_set(j->start[0]), p.x)),
                         r8_mul(r8_set(j->start[1]), p.y)),
                  r8_mul(r8_set(j->start[2]), p.z));
}

static void hyper_samples(const struct walk8 *m, struct vec8 p, unsigned lanes,
                          bool want_step, struct samples8 *s)
{
    const struct julia *j = m->j;
    const struct complex8 unit = {r8_set(1), r8_set(0)};
    struct pair8 h = pair8_of(p, w_at(j, p)), slope = {unit, unit};
    const struct pair8 way = pair8_of(m->l.u, m->w);
    const struct real8 escape = r8_set(j->escape), delta = r8_set(1 / j->precision);
    struct real8 last = r8_set(0);
    for (int k = 0; k < j->iterations && lanes; k++) {
        const struct real8 norm = pair8_norm(&h);
        const unsigned out = lanes & ~m8_bits(r8_le(norm, escape));
        last = r8_select(m8_of(lanes), norm, last);
        if (out) {
            if (want_step) {
                const struct real8 fall = r8_mul(r8_set(-2), growth8(&h, &slope, way));
                const struct real8 reach = r8_mul(delta, fall);
                const struct mask8 usable =
                    m8_and(m8_and(r8_lt(r8_set(2e-8), fall), r8_lt(reach, norm)),
                           r8_lt(norm, r8_mul(r8_mul(r8_set(30), delta), fall)));
                const struct real8 step =
                    r8_select(usable, r8_div(norm, fall), r8_set(0));
                s->step = r8_select(m8_of(out), step, s->step);
            }
            s->in &= ~out;
            if (k < j->iterations - 1)
                s->smooth &= ~out;
            lanes &= ~out;
        }
        if (lanes && k < j->iterations - 1)
            pair8_step(j, &h, &slope, want_step, lanes);
    }
    s->over = r8_sub(last, escape);
}

static void quaternion_samples(const struct walk8 *m, struct vec8 p, unsigned lanes,
                               bool want_step, struct samples8 *s)
{
    const struct julia *j = m->j;
    const bool cube = j->function == JULIA_CUBE;
    const struct real8 escape = r8_set(j->escape);
    struct real8 x = p.x, y = p.y, z = p.z, w = w_at(j, p), product = r8_set(1);
    struct real8 last = r8_set(0), last_product = product, last_scale = product;
    double scale = 1;
    for (int k = 0; k < j->iterations && lanes; k++) {
        const struct real8 x2 = r8_mul(x, x), y2 = r8_mul(y, y), z2 = r8_mul(z, z);
        const struct real8 q = r8_add(r8_add(y2, z2), r8_mul(w, w));
        // norm4 and square_escape add up in different orders.
        const struct real8 norm =
            cube ? r8_add(r8_add(r8_add(x2, y2), z2), r8_mul(w, w)) : r8_add(x2, q);
        const unsigned out = lanes & ~m8_bits(r8_le(norm, escape));
        const struct mask8 here = m8_of(lanes);
        last = r8_select(here, norm, last);
        scale *= cube ? 3 : 2;
        last_scale = r8_select(here, r8_set(scale), last_scale);
        last_product = r8_select(here, product, last_product);
        s->in &= ~out;
        if (k < j->iterations - 1)
            s->smooth &= ~out;
        lanes &= ~out;
        product = r8_mul(product, norm);
        const struct real8 f =
            cube ? r8_sub(r8_mul(r8_mul(r8_set(3), x), x), q) : r8_mul(r8_set(2), x);
        const struct real8 real =
            cube ? r8_mul(x, r8_sub(x2, r8_mul(r8_set(3), q))) : r8_sub(x2, q);
        x = r8_add(real, r8_set(j->c[0]));
        y = r8_add(r8_mul(f, y), r8_set(j->c[1]));
        z = r8_add(r8_mul(f, z), r8_set(j->c[2]));
        w = r8_add(r8_mul(f, w), r8_set(j->c[3]));
    }
    if (want_step) {
        double norm[8];
        r8_store(norm, r8_select(r8_lt(escape, last), last, r8_set(1)));
        quick_log8(norm, norm);
        s->step = r8_div(r8_load(norm), r8_mul(last_scale, r8_sqrt(last_product)));
    }
    s->over = r8_sub(last, escape);
}

// in and smooth are of `lanes` only.
static struct samples8 samples_at(const struct walk8 *m, struct real8 t, unsigned lanes,
                                  bool want_step)
{
    struct samples8 s = {lanes, lanes, r8_set(0), r8_set(0)};
    const struct vec8 p = v8_mad(m->l.o, t, m->l.u);
    if (m->j->hypercomplex)
        hyper_samples(m, p, lanes, want_step, &s);
    else
        quaternion_samples(m, p, lanes, want_step, &s);
    return s;
}

// ---- the rays -------------------------------------------------------------------------------------

struct stretch8 {
    struct real8 lo, hi;
    struct samples8 a, b;
    unsigned found;
};

LANES_INLINE void keep_samples(struct samples8 *to, unsigned lanes,
                               const struct samples8 *s)
{
    const struct mask8 m = m8_of(lanes);
    to->in = (to->in & ~lanes) | (s->in & lanes);
    to->smooth = (to->smooth & ~lanes) | (s->smooth & lanes);
    to->over = r8_select(m, s->over, to->over);
    to->step = r8_select(m, s->step, to->step);
}

// As narrow of julia_fractal.c.
static void narrow(const struct walk8 *m, struct stretch8 *x, unsigned lanes,
                   struct real8 enough, struct shape_hits *out)
{
    const struct real8 half = r8_set(0.5);
    unsigned first = 0, second = 0; // the side that moved last
    for (int i = 0; i < 100 && lanes && !shape_hits_give_up(out); i++) {
        const struct real8 width = r8_sub(x->hi, x->lo);
        lanes &= m8_bits(r8_lt(enough, width));
        struct real8 t = r8_mul(half, r8_add(x->lo, x->hi));
        if (i % 8 != 7) {
            const struct real8 rim = r8_mul(half, enough);
            struct real8 s = r8_add(
                x->lo, r8_mul(width, r8_div(x->a.over, r8_sub(x->a.over, x->b.over))));
            s = r8_max(r8_min(s, r8_sub(x->hi, rim)), r8_add(x->lo, rim));
            t = r8_select(m8_of(x->a.smooth & x->b.smooth), s, t);
        }
        lanes &= m8_bits(m8_and(r8_lt(x->lo, t), r8_lt(t, x->hi)));
        if (!lanes)
            return;
        const struct samples8 s = samples_at(m, t, lanes, false);
        const unsigned left = lanes & ~(s.in ^ x->a.in), right = lanes & ~left;
        x->b.over = r8_select(m8_of(left & first), r8_mul(half, x->b.over), x->b.over);
        x->a.over = r8_select(m8_of(right & second), r8_mul(half, x->a.over), x->a.over);
        x->lo = r8_select(m8_of(left), t, x->lo);
        x->hi = r8_select(m8_of(right), t, x->hi);
        keep_samples(&x->a, left, &s);
        keep_samples(&x->b, right, &s);
        first = (first & ~right) | left;
        second = (second & ~left) | right;
    }
}

// From lo on to the first stretch where the state changes, or to the end: as march of
// julia_fractal.c, but that nothing beyond the rays' ranges is looked for. through: the lanes
// that are inside where they leave the ball.
static unsigned march(const struct walk8 *m, unsigned lanes, struct real8 end,
                      struct stretch8 *x, unsigned *through, struct shape_hits *out)
{
    const struct real8 least = r8_set(1 / m->j->precision), zero = r8_set(0);
    struct real8 t = r8_max(r8_neg(end), m->l.lo);
    lanes &= m8_bits(r8_lt(t, end));
    struct samples8 here = samples_at(m, t, lanes, true);
    here.in &= m8_bits(r8_lt(r8_neg(end), t));
    x->lo = x->hi = t;
    x->a = x->b = here;
    x->found = *through = 0;
    while (lanes && !shape_hits_give_up(out)) {
        const struct real8 step = r8_select(m8_of(here.in), zero, here.step);
        const struct real8 next = r8_min(r8_add(t, r8_max(step, least)), end);
        struct samples8 now = samples_at(m, next, lanes, true);
        const unsigned leaves = lanes & m8_bits(r8_eq(next, end));
        const unsigned whole = here.in & leaves & now.in;
        *through |= whole;
        lanes &= ~whole;
        now.in &= ~leaves;
        const unsigned turn = lanes & (now.in ^ here.in);
        if (turn) {
            x->lo = r8_select(m8_of(turn), t, x->lo);
            x->hi = r8_select(m8_of(turn), next, x->hi);
            keep_samples(&x->a, turn, &here);
            keep_samples(&x->b, turn, &now);
            x->found |= turn;
            lanes &= ~turn;
        }
        here = now;
        t = next;
        lanes &= m8_bits(m8_and(r8_lt(t, end), r8_le(t, m->l.hi)));
    }
    return x->found;
}

static void put_normals(const struct walk8 *m, unsigned lanes, struct real8 inner,
                        struct real8 outer, unsigned exits, struct shape_hits *out)
{
    double o[3][8], u[3][8], in[8], beyond[8];
    v8_store(o, m->l.o);
    v8_store(u, m->l.u);
    r8_store(in, inner);
    r8_store(beyond, outer);
    for (; lanes; lanes &= lanes - 1) {
        const int l = __builtin_ctz(lanes);
        out->part[l] = julia_normal(m->j, vec3(o[0][l], o[1][l], o[2][l]),
                                    vec3(u[0][l], u[1][l], u[2][l]), in[l], beyond[l],
                                    exits >> l & 1);
    }
}

static unsigned closest(const struct julia *j, const struct shape_rays *rays,
                        unsigned lanes, bool any, struct shape_hits *out)
{
    struct walk8 m = {.j = j, .l = lines8_of(rays, vec3(0, 0, 0))};
    const struct real8 reach2 =
        r8_sub(r8_set(j->radius * j->radius), v8_dot(m.l.o, m.l.o));
    lanes &= m8_bits(r8_lt(r8_set(0), reach2));
    if (!lanes)
        return 0;
    const struct real8 end = r8_sqrt(r8_max(reach2, r8_set(0)));
    const struct real8 error =
        r8_mul(r8_set(GAMMA(32)), r8_add(r8_abs(m.l.shift), r8_set(j->radius)));
    struct stretch8 x;
    unsigned through;
    m.w = v8_dot(V8_SET(vec3(j->start[0], j->start[1], j->start[2])), m.l.u);
    unsigned met = march(&m, lanes, end, &x, &through, out);
    // A change that lies in the range is enough for some, unless it may be the very surface
    // that the ray begins on.
    const unsigned apart = ~x.a.in | m8_bits(r8_lt(m.l.lo, x.lo));
    const unsigned sure = any ? met & apart & m8_bits(r8_lt(x.hi, m.l.hi)) : 0;
    if (met & ~sure)
        narrow(&m, &x, met & ~sure, r8_mul(r8_set(0.25), error), out);
    const unsigned exits = x.a.in | through;
    struct real8 inner = r8_select(m8_of(x.a.in), x.lo, x.hi);
    struct real8 outer = r8_select(m8_of(x.a.in), x.hi, x.lo);
    inner = r8_select(m8_of(through), end, inner);
    outer = r8_select(m8_of(through), end, outer);
    met |= through;
    const struct real8 t = r8_select(m8_of(sure), x.hi, inner);
    met = lines8_hits(&m.l, rays, met, t, error, exits, out);
    if (!any)
        put_normals(&m, met, inner, outer, exits, out);
    return met;
}

unsigned OF_ISA(julia_closest8_)(const struct julia *j, const struct shape_rays *rays,
                                 unsigned lanes, bool any, struct shape_hits *out)
{
    return closest(j, rays, lanes, any, out);
}
