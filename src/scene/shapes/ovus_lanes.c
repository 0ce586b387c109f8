// Eight rays and an ovus: ovus.c in lanes, operation by operation, with the same bits. ISA names
// the instruction set.
#include "scene/shapes/lanes.h"
#include "scene/shapes/ovus.h"

struct walk8 {
    struct lines8 l;
    struct real8 noise;
    struct real8 stop[OVUS_PARTS + 1];
    struct mask8 down;    // the lanes that meet the top first
    struct mask8 flat;    // the lanes that stay in one part
    struct real8 only[3]; // that part
};

struct part8 {
    struct real8 h, v, r;
};

// The i-th part on the way.
LANES_INLINE struct part8 part_of(const struct ovus *s, const struct walk8 *w, int i)
{
    const struct ovus_part *up = &s->part[i], *down = &s->part[OVUS_PARTS - 1 - i];
    struct part8 k = {r8_select(w->down, r8_set(down->h), r8_set(up->h)),
                      r8_select(w->down, r8_set(down->v), r8_set(up->v)),
                      r8_select(w->down, r8_set(down->r), r8_set(up->r))};
    if (m8_bits(w->flat)) {
        k.h = r8_select(w->flat, w->only[0], k.h);
        k.v = r8_select(w->flat, w->only[1], k.v);
        k.r = r8_select(w->flat, w->only[2], k.r);
    }
    return k;
}

LANES_INLINE struct real8 distance(const struct lines8 *l, const struct part8 *k,
                                   struct real8 t, struct real8 *slope)
{
    const struct real8 zero = r8_set(0);
    const struct vec8 p = v8_mad(l->o, t, l->u);
    const struct real8 rho = r8_sqrt(r8_add(r8_mul(p.x, p.x), r8_mul(p.z, p.z)));
    const struct real8 q = r8_add(rho, k->h), w = r8_sub(p.y, k->v);
    const struct real8 d = r8_sqrt(r8_add(r8_mul(q, q), r8_mul(w, w)));
    const struct real8 along = r8_add(r8_mul(p.x, l->u.x), r8_mul(p.z, l->u.z));
    const struct real8 out = r8_select(r8_lt(zero, rho), r8_div(along, rho), zero);
    const struct real8 rise = r8_add(r8_mul(q, out), r8_mul(w, l->u.y));
    *slope = r8_select(r8_lt(zero, d), r8_div(rise, d), zero);
    return r8_sub(d, k->r);
}

// As approach of ovus.c; returns the lanes with a root.
static unsigned approach(const struct walk8 *w, const struct part8 *k, struct real8 t,
                         struct real8 to, double way, unsigned lanes, struct real8 *root,
                         struct real8 *slope)
{
    const struct real8 zero = r8_set(0), ahead = r8_set(way);
    unsigned found = 0;
    for (int i = 0; i < 100 && lanes; i++) {
        struct real8 rise;
        const struct real8 g = distance(&w->l, k, t, &rise);
        const struct mask8 here = m8_of(lanes);
        *slope = r8_select(here, rise, *slope);
        *root = r8_select(here, t, *root);
        const unsigned met = lanes & m8_bits(r8_le(g, w->noise));
        const struct real8 next = r8_sub(t, r8_div(g, rise));
        const unsigned on = m8_bits(m8_and(r8_lt(r8_mul(rise, ahead), zero),
                                           r8_le(zero, r8_mul(r8_sub(to, next), ahead))));
        const unsigned same = lanes & on & m8_bits(r8_eq(next, t));
        found |= met | same;
        lanes &= on & ~met & ~same;
        t = r8_select(m8_of(lanes), next, t);
    }
    *root = r8_select(m8_of(lanes), t, *root); // a graze
    return found | lanes;
}

// Where the lines enter the i-th part's stretch of the egg; returns the lanes that do.
static unsigned entry(const struct ovus *s, const struct walk8 *w, int i, unsigned lanes,
                      struct real8 *lo, struct real8 *slope)
{
    const struct part8 k = part_of(s, w, i);
    const struct real8 a = w->stop[i], b = w->stop[i + 1];
    lanes &= m8_bits(r8_lt(a, b));
    if (!lanes)
        return 0;
    const unsigned outside =
        lanes & m8_bits(r8_lt(r8_set(0), distance(&w->l, &k, a, slope)));
    *lo = a;
    return (lanes & ~outside) | approach(w, &k, a, b, 1, outside, lo, slope);
}

// The same of the exit, for lanes that have the entry lo.
static void leave(const struct ovus *s, const struct walk8 *w, int i, unsigned lanes,
                  struct real8 lo, struct real8 *hi, struct real8 *slope)
{
    const struct part8 k = part_of(s, w, i);
    const struct real8 b = w->stop[i + 1];
    const unsigned outside =
        lanes & m8_bits(r8_lt(r8_set(0), distance(&w->l, &k, b, slope)));
    *hi = b;
    const unsigned found = approach(w, &k, b, lo, -1, outside, hi, slope);
    *hi = r8_select(m8_of(outside & ~found), lo, *hi);
}

static unsigned put(const struct ovus *s, const struct walk8 *w,
                    const struct shape_rays *rays, unsigned lanes, struct real8 t,
                    struct real8 slope, bool exits, struct shape_hits *out)
{
    const double size = fmax(s->bottom + s->top, 2 * s->top);
    const struct real8 two = r8_set(2), twice = r8_mul(two, w->noise);
    const struct real8 graze =
        r8_mul(two, r8_sqrt(r8_mul(r8_mul(twice, two), r8_set(size))));
    const struct real8 dt = r8_add(r8_min(r8_div(twice, r8_abs(slope)), graze),
                                   r8_mul(r8_set(GAMMA(4)), r8_abs(w->l.shift)));
    return lines8_hits(&w->l, rays, lanes, t, dt, exits ? 255 : 0, out);
}

// The stops between the parts, and which parts they are.
static void set_up(struct walk8 *w, const struct ovus *s, struct real8 reach)
{
    const struct real8 back = r8_neg(reach), o = w->l.o.y, u = w->l.u.y;
    const struct real8 t0 = r8_div(r8_sub(r8_set(s->joint[0]), o), u);
    const struct real8 t1 = r8_div(r8_sub(r8_set(s->joint[1]), o), u);
    w->flat = m8_without(m8_of(255), r8_lt(r8_set(GAMMA(12)), r8_abs(u)));
    w->down = m8_without(m8_of(255), r8_lt(r8_set(0), u));
    w->stop[0] = back;
    w->stop[1] = r8_max(back, r8_min(reach, r8_min(t0, t1)));
    w->stop[2] = r8_max(back, r8_min(reach, r8_max(t0, t1)));
    w->stop[3] = reach;
    if (!m8_bits(w->flat))
        return;
    w->stop[1] = r8_select(w->flat, reach, w->stop[1]);
    w->stop[2] = r8_select(w->flat, reach, w->stop[2]);
    const struct mask8 low = r8_lt(o, r8_set(s->joint[0]));
    const struct mask8 high = r8_lt(r8_set(s->joint[1]), o);
    const struct ovus_part *p = s->part;
    const double of[3][3] = {
        {p[0].h, p[1].h, p[2].h}, {p[0].v, p[1].v, p[2].v}, {p[0].r, p[1].r, p[2].r}};
    for (int i = 0; i < 3; i++)
        w->only[i] =
            r8_select(low, r8_set(of[i][OVUS_BOTTOM]),
                      r8_select(high, r8_set(of[i][OVUS_TOP]), r8_set(of[i][OVUS_ARC])));
}

static unsigned closest(const struct ovus *s, const struct shape_rays *rays,
                        unsigned lanes, struct shape_hits *out)
{
    const double size = fmax(s->bottom + s->top, 2 * s->top);
    const struct vec3 middle = vec3(0, s->around.y, 0);
    struct walk8 w;
    w.l = lines8_of(rays, middle);
    const struct vec8 off = v8_sub(w.l.o, V8_SET(middle));
    const struct real8 reach2 =
        r8_sub(r8_set(s->around.r * s->around.r), v8_dot(off, off));
    lanes &= m8_bits(r8_lt(r8_set(0), reach2));
    if (!lanes)
        return 0;
    const struct real8 zero = r8_set(0), reach = r8_sqrt(r8_max(reach2, zero));
    lanes &= m8_bits(r8_lt(w.l.lo, reach));
    w.noise = r8_mul(r8_set(GAMMA(8)), r8_add(r8_set(2 * size), r8_abs(w.l.shift)));
    set_up(&w, s, reach);
    struct real8 first = zero, slope = zero;
    unsigned any = 0;
    for (int i = 0; i < OVUS_PARTS && (lanes & ~any); i++) {
        struct real8 lo = zero, rise = zero;
        const unsigned in = entry(s, &w, i, lanes & ~any, &lo, &rise);
        first = r8_select(m8_of(in), lo, first);
        slope = r8_select(m8_of(in), rise, slope);
        any |= in;
    }
    if (!any)
        return 0;
    const unsigned met = put(s, &w, rays, any, first, slope, false, out);
    // Beyond the entry, or not as far.
    unsigned late = any & ~met & ~m8_bits(r8_lt(r8_load(rays->t_max), r8_load(out->t)));
    if (!late)
        return met;
    const unsigned through = late;
    struct real8 last = zero;
    for (int i = OVUS_PARTS - 1; i >= 0 && late; i--) {
        struct real8 rise = zero, begin = zero, hi = zero;
        const unsigned more = entry(s, &w, i, late, &begin, &rise);
        if (!more)
            continue;
        leave(s, &w, i, more, begin, &hi, &rise);
        last = r8_select(m8_of(more), hi, last);
        slope = r8_select(m8_of(more), rise, slope);
        late &= ~more;
    }
    return met | put(s, &w, rays, through, last, slope, true, out);
}

unsigned OF_ISA(ovus_closest8_)(const struct ovus *s, const struct shape_rays *rays,
                                unsigned lanes, struct shape_hits *out)
{
    return closest(s, rays, lanes, out);
}
