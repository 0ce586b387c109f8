#ifndef ISOSURFACE_LANE_VALUES_H
#define ISOSURFACE_LANE_VALUES_H

// Eight rays in an isosurface: what is kept of them, f at points and its bounds over stretches.
#include "math/gamma.h"
#include "math/isa.h"
#include "math/lanes.h"
#include "scene/shape_kernels.h"
#include "scene/shapes/isosurface.h"
#include "scene/shapes/isosurface_lanes.h"
#include "scene/tape_kernel.h"

#define TAPE OF_ISA(tape_kernels_)

// A plane's distance along a ray that hardly moves across it; never infinite, so that a ray
// in the plane has no NaN.
#define STEEPEST 0x1p996

struct walk8 {
    const struct isosurface *s;
    struct shape_hits *out;
    struct vec8 o, d, inverse; // o nearest to the middle of the container
    struct real8 shift, chord; // t of o; length of the stretch in the container
    struct real8 limit;        // no crossing beyond is wanted
    struct real8 last_t, last_f;
    double dirs[3][8];
    unsigned alive, started, inside;
    unsigned late;  // begin inside the container
    unsigned face;  // meet the container first
    unsigned found; // have a bracket
    unsigned odd;   // for the one-ray walk
    unsigned mirror;
    double a[8], fa[8], b[8], fb[8], slope[8]; // the brackets
    uint32_t spent[8];                         // evaluations of one ray alone
    uint64_t evaluations;
};

// ---- f --------------------------------------------------------------------------------

// Lanes that are not wanted look where the first wanted one does, since points that are near
// each other share work, as the cells of patterns. lanes: not 0.
LANES_INLINE void store_wanted(double *to, struct real8 v, unsigned lanes)
{
    r8_store(to, v);
    if (lanes != 255)
        r8_store(to, r8_select(m8_of(lanes), v, r8_set(to[__builtin_ctz(lanes)])));
}

static struct real8 value_at_points(struct walk8 *w, struct vec8 p, unsigned lanes)
{
    double at[3][8], v[8];
    store_wanted(at[0], p.x, lanes);
    store_wanted(at[1], p.y, lanes);
    store_wanted(at[2], p.z, lanes);
    TAPE.values(w->s->f, (const double(*)[8])at, v);
    return r8_sub(r8_load(v), r8_set(w->s->threshold));
}

static struct real8 value(struct walk8 *w, struct real8 t, unsigned lanes)
{
    w->evaluations += (unsigned)__builtin_popcount(lanes);
    return value_at_points(w, v8_mad(w->o, t, w->d), lanes);
}

LANES_INLINE struct real8 rounded_down(struct real8 v, double unit)
{
    return r8_sub(v, r8_mul(r8_abs(v), r8_set(unit)));
}

LANES_INLINE struct real8 rounded_up(struct real8 v, double unit)
{
    return r8_add(v, r8_mul(r8_abs(v), r8_set(unit)));
}

LANES_INLINE void stretch_axis(struct real8 o, struct real8 d, struct real8 a,
                               struct real8 b, struct real8 slack, unsigned lanes,
                               double *lo, double *hi)
{
    const struct real8 p = r8_mul(a, d), q = r8_mul(b, d);
    const double e = INTERVAL_ROUNDING;
    const struct real8 low = rounded_down(r8_add(o, rounded_down(r8_min(p, q), e)), e);
    const struct real8 high = rounded_up(r8_add(o, rounded_up(r8_max(p, q), e)), e);
    store_wanted(lo, r8_sub(low, slack), lanes);
    store_wanted(hi, r8_add(high, slack), lanes);
}

// The boxes of stretches.
LANES_INLINE void stretch_box(struct vec8 o, struct vec8 d, struct real8 a,
                              struct real8 b, struct real8 slack, unsigned lanes,
                              struct tape_boxes *box)
{
    stretch_axis(o.x, d.x, a, b, slack, lanes, box->lo[0], box->hi[0]);
    stretch_axis(o.y, d.y, a, b, slack, lanes, box->lo[1], box->hi[1]);
    stretch_axis(o.z, d.z, a, b, slack, lanes, box->lo[2], box->hi[2]);
}

struct over8 {
    struct real8 lo, hi, slope_lo, slope_hi;
};

// Where the slope jumps the value is looked at on either side.
static void jump(const struct isosurface *s, const struct tape_boxes *box, int lane,
                 double *lo, double *hi)
{
    struct interval in[3];
    for (int i = 0; i < 3; i++)
        in[i] = interval(box->lo[i][lane], box->hi[i][lane]);
    const struct interval v = tape_bounds(s->f, in);
    *lo = fmax(*lo, v.lo);
    *hi = fmin(*hi, v.hi);
}

// f and its derivative along d over boxes; only the bounds of `lanes` are wanted.
static struct over8 over(struct walk8 *w, const struct tape_boxes *box,
                         const double dirs[3][8], unsigned lanes)
{
    struct tape_slopes r;
    TAPE.along(w->s->f, box, dirs, &r);
    w->evaluations += (unsigned)__builtin_popcount(lanes);
    struct over8 v = {.slope_lo = r8_load(r.slope_lo[0]),
                      .slope_hi = r8_load(r.slope_hi[0])};
    const unsigned jumps = m8_bits(m8_and(r8_le(v.slope_lo, r8_set(-INFINITY)),
                                          r8_le(r8_set(INFINITY), v.slope_hi))) &
                           lanes;
    for (unsigned m = jumps; m; m &= m - 1) {
        const int l = __builtin_ctz(m);
        jump(w->s, box, l, &r.lo[l], &r.hi[l]);
    }
    const struct real8 at = r8_set(w->s->threshold);
    v.lo = rounded_down(r8_sub(r8_load(r.lo), at), INTERVAL_ROUNDING);
    v.hi = rounded_up(r8_sub(r8_load(r.hi), at), INTERVAL_ROUNDING);
    return v;
}

LANES_INLINE struct real8 least_size(struct real8 lo, struct real8 hi)
{
    return r8_max(r8_max(lo, r8_neg(hi)), r8_set(0));
}

LANES_INLINE unsigned not_positive(struct real8 f)
{
    return m8_bits(r8_le(f, r8_set(0)));
}

// Stores the lanes of m, and leaves the others.
LANES_INLINE void keep(double *to, struct mask8 m, struct real8 v)
{
    r8_store(to, r8_select(m, v, r8_load(to)));
}

#endif
