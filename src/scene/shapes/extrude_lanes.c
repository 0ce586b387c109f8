// Eight rays and outlines that are swept (extrude.c, conic.c), compiled once per instruction
// set. Walls are met by the operations of the one line, so that every t has the same bits;
// they are not sorted: the nearest that is wanted and the parity of those before the ends of
// the slab tell the first crossing.
#include "scene/shapes/extrude_lanes.h"

#include "scene/shapes/extrude.h"
#include "scene/shapes/lanes.h"
#include "scene/shapes/outline_lanes.h"

// Boxes are widened by this share of all coordinates, far more than rounding moves a crossing.
#define BOX_PAD 0x1p-30

struct sweep8 {
    const struct extrude_solid *s;
    struct real8 o[3], d[3]; // in (u, v, h)
    struct real8 inverse[3], o_size;
    struct real8 t_min, t_max;
    struct real8 t0, t1, dt; // where the rays are in the slab
    unsigned always, up;     // lanes that are in it all along; that rise
    struct line8 line;
    struct real8 dd;   // of a linear sweep: |d|^2 in the plane
    struct real8 apex; // of a conic one: t of the height 0
};

// What is known of an outline's walls; masks are parities.
struct walls8 {
    unsigned before, before_t0, before_t1, before_apex;
    struct real8 t, w, segment; // of the nearest that is wanted
};

static void add_wall(const struct sweep8 *e, unsigned lanes, struct real8 t,
                     struct real8 w, uint32_t i, struct walls8 *x)
{
    const unsigned early = lanes & m8_bits(r8_lt(t, e->t0));
    const unsigned wanted = lanes & ~early & m8_bits(r8_lt(e->t_min, t));
    x->before ^= lanes & ~wanted;
    x->before_t0 ^= early;
    x->before_t1 ^= lanes & m8_bits(r8_lt(t, e->t1));
    if (e->s->conic)
        x->before_apex ^= lanes & ~e->always & m8_bits(r8_lt(t, e->apex));
    const struct mask8 nearer = m8_and(m8_of(wanted), r8_lt(t, x->t));
    x->t = r8_select(nearer, t, x->t);
    x->w = r8_select(nearer, w, x->w);
    x->segment = r8_select(nearer, r8_set(i), x->segment);
}

// t of the walls at w; takes the lanes away where it is nowhere.
LANES_INLINE struct real8 wall_t(const struct sweep8 *e, const struct outline_segment *s,
                                 struct real8 w, unsigned *lanes)
{
    const struct point8 p = outline_point8(s, w);
    if (!e->s->conic)
        return r8_div(r8_add(r8_mul(r8_sub(p.u, e->o[0]), e->d[0]),
                             r8_mul(r8_sub(p.v, e->o[1]), e->d[1])),
                      e->dd);
    const struct real8 du = r8_sub(e->d[0], r8_mul(p.u, e->d[2]));
    const struct real8 dv = r8_sub(e->d[1], r8_mul(p.v, e->d[2]));
    const struct mask8 by_u = r8_lt(r8_abs(dv), r8_abs(du));
    const struct real8 off = r8_sub(r8_mul(r8_select(by_u, p.u, p.v), e->o[2]),
                                    r8_select(by_u, e->o[0], e->o[1]));
    const struct real8 t = r8_div(off, r8_select(by_u, du, dv));
    *lanes &= m8_bits(r8_lt(r8_abs(t), r8_set(INFINITY)));
    return t;
}

static void meet_walls(const struct sweep8 *e, const struct outline *o, unsigned lanes,
                       struct walls8 *x)
{
    struct line8 line = e->line;
    const struct real8 size = r8_set(outline_size(o));
    line8_size(&line, e->s->conic
                          ? size
                          : r8_add(size, r8_max(r8_abs(e->o[0]), r8_abs(e->o[1]))));
    *x = (struct walls8){.t = r8_set(INFINITY)};
    x->w = x->segment = r8_set(0);
    for (uint32_t i = 0; i < o->count; i++) {
        const struct outline_segment *s = &o->segment[i];
        const unsigned near = lanes & outline_near8(s, &line);
        struct outline_roots8 r;
        if (!near)
            continue;
        outline_roots8(s, &line, near, &r);
        for (int k = 0; k < OUTLINE_ROOTS; k++)
            if (r.met[k]) {
                const struct real8 t = wall_t(e, s, r.w[k], &r.met[k]);
                add_wall(e, r.met[k], t, r.w[k], i, x);
            }
    }
}

// ---- where the rays are ------------------------------------------------------------------

// Of a coordinate over an outline's sweep.
struct extent {
    double min, max, size;
};

static inline double least(double a, double b) { return a < b ? a : b; }
static inline double most(double a, double b) { return a > b ? a : b; }

static inline struct extent extent_of(const struct extrude_solid *s, double min,
                                      double max)
{
    if (s->conic) {
        const double low = least(s->low * min, least(s->low * max, s->high * min));
        max = most(s->low * max, most(s->low * min, s->high * max));
        min = low;
    }
    return (struct extent){min, max, most(fabs(min), fabs(max))};
}

// The stretch on which a crossing may be wanted.
struct stretch8 {
    struct real8 near, far;
};

LANES_INLINE struct stretch8 stretch_of(const struct sweep8 *e)
{
    return (struct stretch8){r8_max(e->t0, e->t_min), r8_min(e->t1, e->t_max)};
}

LANES_INLINE void narrow(const struct sweep8 *e, int axis, struct extent x,
                         struct stretch8 *s)
{
    const struct real8 pad = r8_mul(r8_set(BOX_PAD), r8_add(e->o_size, r8_set(x.size)));
    const struct real8 inverse = e->inverse[axis];
    const struct real8 a =
        r8_mul(r8_sub(r8_sub(r8_set(x.min), pad), e->o[axis]), inverse);
    const struct real8 b =
        r8_mul(r8_sub(r8_add(r8_set(x.max), pad), e->o[axis]), inverse);
    const struct mask8 back = r8_lt(inverse, r8_set(0));
    s->near = r8_max(r8_select(back, b, a),
                     s->near); // NaN, of a ray in a face, changes nothing
    s->far = r8_min(r8_select(back, a, b), s->far);
}

// The lanes that may meet the outline's box within the slab and their range.
static unsigned in_box(const struct sweep8 *e, const struct outline *o)
{
    struct stretch8 s = stretch_of(e);
    narrow(e, 0, extent_of(e->s, o->min.u, o->max.u), &s);
    narrow(e, 1, extent_of(e->s, o->min.v, o->max.v), &s);
    return m8_bits(r8_le(s.near, s.far));
}

// Where all stretches are along u, so that most of a text's letters need not be looked at.
// What is not finite is everywhere.
static struct extent reach_of(const struct sweep8 *e, unsigned lanes)
{
    const struct stretch8 s = stretch_of(e);
    const struct real8 a = r8_add(e->o[0], r8_mul(s.near, e->d[0])),
                       b = r8_add(e->o[0], r8_mul(s.far, e->d[0]));
    struct extent x = {INFINITY, -INFINITY, 0};
    double from[8], to[8], size[8];
    r8_store(from, a);
    r8_store(to, b);
    r8_store(size, e->o_size);
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        if (!(fabs(from[i]) < INFINITY && fabs(to[i]) < INFINITY))
            return (struct extent){-INFINITY, INFINITY, 0};
        x.min = least(x.min, least(from[i], to[i]));
        x.max = most(x.max, most(from[i], to[i]));
        x.size = most(x.size, size[i]);
    }
    return x;
}

// Whether stretches that reach so far may come to the outline.
static inline bool reached(const struct sweep8 *e, const struct extent *reach,
                           const struct outline *o)
{
    const struct extent x = extent_of(e->s, o->min.u, o->max.u);
    const double pad = BOX_PAD * (reach->size + x.size);
    return reach->min <= x.max + pad && x.min - pad <= reach->max;
}

// As extrude_slab_of; returns the lanes that are somewhere in the slab.
static unsigned set_slab(struct sweep8 *e)
{
    const struct real8 low = r8_set(e->s->low), high = r8_set(e->s->high);
    const struct real8 zero = r8_set(0), h = e->o[2], down = r8_abs(e->d[2]);
    const struct real8 along = r8_max(r8_abs(e->d[0]), r8_abs(e->d[1]));
    const struct mask8 up = r8_lt(zero, e->d[2]);
    e->up = m8_bits(up);
    e->always = ~m8_bits(r8_lt(r8_mul(r8_set(GAMMA(12)), along), down)) & 255;
    e->t0 = r8_div(r8_sub(r8_select(up, low, high), h), e->d[2]);
    e->t1 = r8_div(r8_sub(r8_select(up, high, low), h), e->d[2]);
    e->dt = r8_div(
        r8_mul(r8_set(GAMMA(12)), r8_add(r8_abs(h), r8_max(r8_abs(low), r8_abs(high)))),
        down);
    e->apex = r8_div(r8_neg(h), e->d[2]);
    if (!e->always)
        return 255;
    const struct mask8 always = m8_of(e->always);
    e->t0 = r8_select(always, r8_set(-INFINITY), e->t0);
    e->t1 = r8_select(always, r8_set(INFINITY), e->t1);
    return ~e->always | m8_bits(m8_and(r8_le(low, h), r8_le(h, high)));
}

LANES_INLINE struct real8 length8(const struct real8 v[3])
{
    return r8_sqrt(
        r8_add(r8_add(r8_mul(v[0], v[0]), r8_mul(v[1], v[1])), r8_mul(v[2], v[2])));
}

LANES_INLINE struct real8 cross8(const struct sweep8 *e, int i, int j)
{
    return r8_sub(r8_mul(e->o[i], e->d[j]), r8_mul(e->o[j], e->d[i]));
}

// The line in the outline's plane. Returns the lanes that are a point there.
static unsigned set_line(struct sweep8 *e)
{
    struct line8 *l = &e->line;
    if (!e->s->conic) {
        l->k[0] = e->d[1];
        l->k[1] = r8_neg(e->d[0]);
        l->k[2] = r8_sub(r8_mul(e->d[0], e->o[1]), r8_mul(e->d[1], e->o[0]));
        e->dd = r8_add(r8_mul(e->d[0], e->d[0]), r8_mul(e->d[1], e->d[1]));
        l->norm = r8_sqrt(e->dd);
        const struct real8 across = r8_max(r8_abs(e->d[0]), r8_abs(e->d[1]));
        return ~m8_bits(r8_lt(r8_mul(r8_set(GAMMA(12)), r8_abs(e->d[2])), across));
    }
    l->k[0] = cross8(e, 1, 2);
    l->k[1] = cross8(e, 2, 0);
    l->k[2] = cross8(e, 0, 1);
    l->norm = r8_sqrt(r8_add(r8_mul(l->k[0], l->k[0]), r8_mul(l->k[1], l->k[1])));
    return m8_bits(r8_le(length8(l->k),
                         r8_mul(r8_mul(r8_set(GAMMA(8)), length8(e->o)), length8(e->d))));
}

static void set_up(struct sweep8 *e, const struct extrude_solid *s,
                   const struct shape_rays *rays)
{
    struct vec8 o = v8_load(rays->o), d = v8_load(rays->d);
    if (s->tilt && !s->tilt->identity) {
        o = v8_inverse_point(s->tilt, o);
        d = v8_row_times(d, &s->tilt->inverse);
    }
    const struct real8 from[3] = {o.x, o.y, o.z}, to[3] = {d.x, d.y, d.z};
    e->s = s;
    for (int i = 0; i < 3; i++) {
        e->o[i] = from[s->axis[i]];
        e->d[i] = to[s->axis[i]];
    }
    e->inverse[0] = r8_div(r8_set(1), e->d[0]);
    e->inverse[1] = r8_div(r8_set(1), e->d[1]);
    e->o_size = v8_max_abs(o);
    e->t_min = r8_load(rays->t_min);
    e->t_max = r8_load(rays->t_max);
}

// ---- the first crossing ------------------------------------------------------------------

// What lanes are taken out of.
struct sweep_lanes {
    double o[3][8], d[3][8], w[8], segment[8];
};

static void set_lanes(const struct sweep8 *e, const struct walls8 *x,
                      struct sweep_lanes *out)
{
    for (int k = 0; k < 3; k++) {
        r8_store(out->o[k], e->o[k]);
        r8_store(out->d[k], e->d[k]);
    }
    r8_store(out->w, x->w);
    r8_store(out->segment, x->segment);
}

static void put_wall(const struct sweep8 *e, const struct outline *o,
                     const struct sweep_lanes *x, int lane, bool in, uint32_t part,
                     struct shape_hits *out)
{
    struct extrude_ray r;
    for (int k = 0; k < 3; k++) {
        r.o[k] = x->o[k][lane];
        r.d[k] = x->d[k][lane];
    }
    const uint32_t i = (uint32_t)x->segment[lane];
    struct boundary b;
    if (e->s->conic)
        conic_wall(o, e->s->low, e->s->high, &r, i, x->w[lane], &b);
    else
        b = extrude_wall(o, &r, i, x->w[lane]);
    b.crossing = in ? CROSS_EXIT : CROSS_ENTER;
    b.u = in ? -b.u : b.u;
    b.part |= part;
    shape_hits_put(out, lane, &b);
}

static void put_cap(const struct sweep8 *e, int lane, bool exit, uint32_t part,
                    struct shape_hits *out)
{
    double t[8], dt[8];
    r8_store(t, exit ? e->t1 : e->t0);
    r8_store(dt, e->dt);
    const bool low = (e->up >> lane & 1) != exit;
    const struct boundary b = {.t = t[lane],
                               .dt = dt[lane],
                               .part = part | (low ? EXTRUDE_LOW : EXTRUDE_HIGH),
                               .crossing = exit ? CROSS_EXIT : CROSS_ENTER};
    shape_hits_put(out, lane, &b);
}

// The first crossings of one outline, whatever t_max, in `out`.
static unsigned first(const struct sweep8 *e, const struct outline *o, unsigned lanes,
                      uint32_t part, struct shape_hits *out)
{
    struct walls8 x;
    meet_walls(e, o, lanes, &x);
    const unsigned start = x.before_apex;
    const unsigned capped = e->s->open ? 0 : lanes & ~e->always;
    const unsigned entry =
        capped & (start ^ x.before_t0) & m8_bits(r8_lt(e->t_min, e->t0));
    const unsigned wall = lanes & ~entry & m8_bits(r8_lt(x.t, e->t1));
    const unsigned exit =
        capped & ~entry & ~wall & (start ^ x.before_t1) & m8_bits(r8_lt(e->t_min, e->t1));
    struct sweep_lanes lane;
    if (wall)
        set_lanes(e, &x, &lane);
    for (unsigned m = wall; m; m &= m - 1) {
        const int l = __builtin_ctz(m);
        put_wall(e, o, &lane, l, (start ^ x.before) >> l & 1, part, out);
    }
    for (unsigned m = entry | exit; m; m &= m - 1) {
        const int l = __builtin_ctz(m);
        put_cap(e, l, exit >> l & 1, part, out);
    }
    return entry | wall | exit;
}

static unsigned in_range(const struct sweep8 *e, unsigned lanes,
                         const struct shape_hits *out)
{
    return lanes ? lanes & m8_bits(r8_le(r8_load(out->t), e->t_max)) : 0;
}

// The union of several: the first that is entered, or where the one is left that holds the
// ray's start. Where that one is not alone the one line's crossings decide.
static unsigned merge(const struct sweep8 *e, unsigned lanes, struct shape_hits *out,
                      unsigned *odd)
{
    unsigned met = 0, left = 0;
    struct shape_hits one;
    const struct extent reach = reach_of(e, lanes);
    for (uint32_t i = 0; i < e->s->count; i++) {
        const struct outline *o = &e->s->outline[i];
        if (!reached(e, &reach, o))
            continue;
        const unsigned near = lanes & ~*odd & in_box(e, o);
        unsigned found = near ? first(e, o, near, i << 16, &one) : 0;
        for (; found; found &= found - 1) {
            const int l = __builtin_ctz(found);
            const unsigned bit = 1u << l;
            const bool leaves = one.crossing[l] == CROSS_EXIT;
            const bool holds = left & bit;
            const bool after = (met & bit) && out->t[l] <= one.t[l];
            if (leaves ? holds || after : holds && one.t[l] <= out->t[l])
                *odd |= bit;
            if (leaves || !(after || holds)) {
                const struct boundary b = {.t = one.t[l],
                                           .dt = one.dt[l],
                                           .u = one.u[l],
                                           .v = one.v[l],
                                           .part = one.part[l],
                                           .crossing = one.crossing[l]};
                shape_hits_put(out, l, &b);
            }
            met |= bit;
            left |= leaves ? bit : 0;
        }
    }
    return met & ~*odd;
}

unsigned OF_ISA(extrude_closest8_)(const struct extrude_solid *s,
                                   const struct shape_rays *rays, unsigned lanes,
                                   struct shape_hits *out, unsigned *odd)
{
    struct sweep8 e;
    set_up(&e, s, rays);
    lanes &= set_slab(&e);
    *odd = lanes & set_line(&e);
    lanes &= ~*odd;
    unsigned met = 0;
    if (s->count > 1)
        met = merge(&e, lanes, out, odd);
    else if (s->count == 1 && s->outline->count && (lanes &= in_box(&e, s->outline)))
        met = first(&e, s->outline, lanes, 0, out);
    return in_range(&e, met, out);
}
