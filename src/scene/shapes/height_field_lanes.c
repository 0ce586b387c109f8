// Eight rays over a height field side by side (height_field.h), for the first drawn surface
// they meet. ISA names the instruction set.
//
// Every lane walks blocks of its own: the block it is in says whether its line passes above
// or below all heights; then it goes on behind the block, one level up when it leaves that
// block's parent; else it looks at the quarter it is in. Cells are where heights decide, by
// the arithmetic of the one line, in units of values. A lane whose state at a block is other
// than was followed so far lost a crossing in rounding and is left to the one line.
#include <math.h>

#include "math/gamma.h"
#include "math/isa.h"
#include "math/lanes_gather.h"
#include "scene/shapes/height_field.h"
#include "scene/shapes/height_field_lanes.h"

enum { FIRST_LEVEL = 3, TOGETHER = 2 }; // lanes that wait in cells for one another

struct over8 {
    const struct height_field *f;
    const struct shape_rays *rays;
    struct vec8 o, d;              // as those of a height_walk, y in values
    struct real8 ix, iz;           // inverses of d
    struct real8 ahead_x, ahead_z; // 1: towards higher columns, rows; else 0
    struct real8 shift, length, error;
    struct real8 t, end;             // what is left of the line
    struct real8 i, j, level, scale; // the block; its side in cells
    struct real8 margin;             // of heights
    unsigned alive, started, in, odd;
    struct shape_hits *out;
};

// Where the lines leave their blocks, and across which sides.
struct leave8 {
    struct real8 t;
    struct mask8 x, z;
};

LANES_INLINE struct leave8 leave_of(const struct over8 *w)
{
    const struct real8 lx = r8_mul(r8_add(w->i, w->ahead_x), w->scale);
    const struct real8 lz = r8_mul(r8_add(w->j, w->ahead_z), w->scale);
    // NaN, of a line along this side, is passed over.
    const struct real8 tx = r8_mul(r8_sub(lx, w->o.x), w->ix);
    const struct real8 tz = r8_mul(r8_sub(lz, w->o.z), w->iz);
    struct leave8 e = {.t = r8_min(tx, r8_min(tz, w->end))};
    e.x = r8_le(tx, e.t);
    e.z = r8_le(tz, e.t);
    return e;
}

// Lanes that are known to be inside or not from here on.
LANES_INLINE void know(struct over8 *w, unsigned lanes, unsigned in)
{
    const unsigned fresh = lanes & ~w->started;
    w->started |= fresh;
    w->in |= fresh & in;
    const unsigned odd = lanes & (w->in ^ in);
    w->odd |= odd;
    w->alive &= ~odd;
}

// The lanes whose lines pass above or below all that is in their blocks.
LANES_INLINE unsigned pass_by(struct over8 *w, const struct leave8 *e, unsigned lanes)
{
    const struct height_field *f = w->f;
    const struct mask8 here = m8_of(lanes);
    const struct real8 level = r8_select(here, w->level, r8_set(1));
    const struct real8 width = r8_lookup16(f->level_width, level);
    const struct real8 at =
        r8_add(r8_lookup16(f->level_from, level), r8_add(r8_mul(w->j, width), w->i));
    struct real8 low, high;
    r8_gather_floats(f->ranges[0], r8_select(here, r8_add(at, at), r8_set(0)), &low,
                     &high);
    const struct real8 y0 = r8_add(w->o.y, r8_mul(w->t, w->d.y));
    const struct real8 y1 = r8_add(w->o.y, r8_mul(e->t, w->d.y));
    const unsigned over = lanes & m8_bits(r8_lt(r8_add(high, w->margin), r8_min(y0, y1)));
    const unsigned under = lanes & m8_bits(r8_lt(r8_max(y0, y1), r8_sub(low, w->margin)));
    know(w, over | under, under);
    return over | under;
}

// ---- cells ------------------------------------------------------------------------------

// One triangle's plane h + hx x + hz z over the corner (x, z) of a cell, and the height of
// the line above it at t = 0 and as it grows.
struct plane8 {
    struct real8 h, hx, hz, above, slope;
};

LANES_INLINE struct plane8 plane_of(const struct over8 *w, struct real8 h,
                                    struct real8 hx, struct real8 hz, struct real8 x,
                                    struct real8 z)
{
    const struct real8 down =
        r8_add(r8_add(h, r8_mul(hx, r8_sub(w->o.x, x))), r8_mul(hz, r8_sub(w->o.z, z)));
    return (struct plane8){
        h, hx, hz, r8_sub(w->o.y, down),
        r8_sub(w->d.y, r8_add(r8_mul(hx, w->d.x), r8_mul(hz, w->d.z)))};
}

LANES_INLINE struct plane8 choose(struct mask8 m, struct plane8 a, struct plane8 b)
{
    return (struct plane8){r8_select(m, a.h, b.h), r8_select(m, a.hx, b.hx),
                           r8_select(m, a.hz, b.hz), r8_select(m, a.above, b.above),
                           r8_select(m, a.slope, b.slope)};
}

LANES_INLINE unsigned is_below(const struct plane8 *p, struct real8 t)
{
    return m8_bits(r8_lt(r8_add(p->above, r8_mul(t, p->slope)), r8_set(0)));
}

LANES_INLINE void keep(double *to, struct mask8 m, struct real8 v)
{
    r8_store(to, r8_select(m, v, r8_load(to)));
}

// Lanes that pass through a plane between t0 and t1: those of them that are met.
LANES_INLINE unsigned cross(struct over8 *w, const struct plane8 *p, struct real8 t0,
                            struct real8 t1, unsigned lanes, unsigned beyond)
{
    const struct height_field *f = w->f;
    const struct real8 t = r8_max(r8_min(r8_div(r8_neg(p->above), p->slope), t1), t0);
    const struct real8 along = r8_div(r8_add(t, w->shift), w->length);
    const struct real8 y = r8_add(w->o.y, r8_mul(t, w->d.y));
    const unsigned hit =
        lanes & m8_bits(m8_and(m8_and(r8_lt(r8_load(w->rays->t_min), along),
                                      r8_le(along, r8_load(w->rays->t_max))),
                               r8_le(r8_set(f->water * HEIGHT_UNIT), y)));
    if (hit) {
        const struct real8 cells = r8_set(f->h.width - 1. + (f->h.height - 1.));
        const struct real8 reach = r8_add(r8_add(cells, r8_abs(w->o.x)), r8_abs(w->o.z));
        const struct real8 size = r8_add(
            r8_add(r8_mul(reach, r8_add(r8_abs(p->hx), r8_abs(p->hz))), r8_abs(p->h)),
            r8_abs(w->o.y));
        const struct real8 noise =
            r8_div(r8_mul(r8_set(GAMMA(8)), size), r8_abs(p->slope));
        const struct real8 dt =
            r8_div(r8_add(r8_min(noise, r8_sub(t1, t0)), w->error), w->length);
        const struct mask8 m = m8_of(hit);
        keep(w->out->t, m, along);
        keep(w->out->dt, m, dt);
        double i[8], j[8];
        r8_store(i, w->i);
        r8_store(j, w->j);
        const uint32_t columns = (uint32_t)(f->h.width - 1);
        for (unsigned left = hit; left; left &= left - 1) {
            const int l = __builtin_ctz(left);
            w->out->part[l] =
                2 * ((uint32_t)j[l] * columns + (uint32_t)i[l]) + (beyond >> l & 1);
            w->out->u[l] = w->out->v[l] = 0;
            w->out->crossing[l] = w->in >> l & 1 ? CROSS_EXIT : CROSS_ENTER;
        }
    }
    w->in ^= lanes;
    return hit;
}

// The lanes that meet the triangles of their cells.
static unsigned meet_cells(struct over8 *w, const struct leave8 *e, unsigned lanes)
{
    const struct height_field *f = w->f;
    const struct real8 zero = r8_set(0), one = r8_set(1), t0 = w->t, t1 = e->t;
    const struct real8 at =
        r8_select(m8_of(lanes), r8_add(r8_mul(w->j, r8_set(f->h.width)), w->i), zero);
    struct real8 y00, y10, y01, y11;
    r8_gather_floats(f->h.at, at, &y00, &y10);
    r8_gather_floats(f->h.at + f->h.width, at, &y01, &y11);
    const struct real8 fi = r8_add(w->i, one), fj = r8_add(w->j, one);
    const struct plane8 below =
        plane_of(w, y00, r8_sub(y10, y00), r8_sub(y01, y00), w->i, w->j);
    const struct plane8 beyond =
        plane_of(w, y11, r8_sub(y11, y01), r8_sub(y11, y10), fi, fj);
    // x + z over the cell's diagonal
    const struct real8 over =
        r8_sub(r8_add(w->o.x, w->o.z), r8_add(r8_add(w->i, w->j), one));
    const struct real8 rise = r8_add(w->d.x, w->d.z);
    const struct mask8 first = r8_lt(r8_add(over, r8_mul(t0, rise)), zero);
    const struct mask8 last = r8_lt(r8_add(over, r8_mul(t1, rise)), zero);
    const unsigned both = lanes & (m8_bits(first) ^ m8_bits(last));
    const struct real8 turn = r8_max(r8_min(r8_div(r8_neg(over), rise), t1), t0);
    const struct real8 middle = r8_select(m8_of(both), turn, t1);
    const struct plane8 p = choose(first, below, beyond);
    const unsigned fresh = lanes & ~w->started;
    if (fresh) {
        w->started |= fresh;
        w->in |= fresh & is_below(&p, t0);
    }
    unsigned hit = 0, turns = lanes & (w->in ^ is_below(&p, middle));
    if (turns)
        hit = cross(w, &p, t0, middle, turns, ~m8_bits(first));
    const unsigned rest = both & ~hit;
    if (!rest)
        return hit;
    const struct plane8 q = choose(last, below, beyond);
    turns = rest & (w->in ^ is_below(&q, t1));
    if (turns)
        hit |= cross(w, &q, middle, t1, turns, ~m8_bits(last));
    return hit;
}

// ---- from block to block ----------------------------------------------------------------

// To the block behind; one level up for lanes that leave the block's parent.
LANES_INLINE void go_on(struct over8 *w, const struct leave8 *e, unsigned lanes)
{
    const struct real8 one = r8_set(1), half = r8_set(0.5);
    const struct mask8 here = m8_of(lanes);
    w->t = r8_select(here, r8_max(w->t, e->t), w->t);
    w->alive &= ~(lanes & m8_bits(r8_le(w->end, w->t)));
    const struct mask8 x = m8_and(e->x, here), z = m8_and(e->z, here);
    const struct real8 by_x = r8_sub(r8_add(w->ahead_x, w->ahead_x), one);
    const struct real8 by_z = r8_sub(r8_add(w->ahead_z, w->ahead_z), one);
    w->i = r8_select(x, r8_add(w->i, by_x), w->i);
    w->j = r8_select(z, r8_add(w->j, by_z), w->j);
    const struct real8 hi = r8_floor(r8_mul(w->i, half)),
                       hj = r8_floor(r8_mul(w->j, half));
    // The first of two when it goes up, the second when it goes down.
    const struct real8 first_i = r8_sub(w->i, r8_add(hi, hi));
    const struct real8 first_j = r8_sub(w->j, r8_add(hj, hj));
    const struct mask8 out = m8_or(m8_without(x, r8_eq(first_i, w->ahead_x)),
                                   m8_without(z, r8_eq(first_j, w->ahead_z)));
    const struct mask8 up = m8_and(out, r8_lt(w->level, r8_set(w->f->top)));
    w->i = r8_select(up, hi, w->i);
    w->j = r8_select(up, hj, w->j);
    w->level = r8_select(up, r8_add(w->level, one), w->level);
    w->scale = r8_select(up, r8_add(w->scale, w->scale), w->scale);
}

// Which half of its block a lane is in at t, of those along one axis.
LANES_INLINE struct real8 half_at(struct real8 t, struct real8 middle, struct real8 o,
                                  struct real8 inverse, struct real8 ahead)
{
    const struct mask8 before = r8_lt(t, r8_mul(r8_sub(middle, o), inverse));
    return r8_select(before, r8_sub(r8_set(1), ahead), ahead);
}

LANES_INLINE void go_down(struct over8 *w, unsigned lanes)
{
    const struct mask8 here = m8_of(lanes);
    const struct real8 one = r8_set(1), scale = r8_mul(w->scale, r8_set(0.5));
    const struct real8 i = r8_add(w->i, w->i), j = r8_add(w->j, w->j);
    const struct real8 a =
        half_at(w->t, r8_mul(r8_add(i, one), scale), w->o.x, w->ix, w->ahead_x);
    const struct real8 b =
        half_at(w->t, r8_mul(r8_add(j, one), scale), w->o.z, w->iz, w->ahead_z);
    w->i = r8_select(here, r8_add(i, a), w->i);
    w->j = r8_select(here, r8_add(j, b), w->j);
    w->scale = r8_select(here, scale, w->scale);
    w->level = r8_select(here, r8_sub(w->level, one), w->level);
}

static unsigned walk(struct over8 *w)
{
    unsigned met = 0;
    while (w->alive) {
        const struct leave8 e = leave_of(w);
        const unsigned cells = w->alive & m8_bits(r8_eq(w->level, r8_set(0)));
        const unsigned blocks = w->alive & ~cells;
        // Nothing but rounding lies between entry and exit.
        const unsigned none = w->alive & m8_bits(r8_le(e.t, w->t));
        unsigned done = none & blocks;
        if (blocks & ~none)
            done |= pass_by(w, &e, blocks & ~none);
        const unsigned down = blocks & w->alive & ~done;
        if (cells && (!blocks || __builtin_popcount(cells) >= TOGETHER)) {
            const unsigned hit = meet_cells(w, &e, cells & ~none);
            met |= hit;
            w->alive &= ~hit;
            done |= cells;
        }
        go_on(w, &e, done & w->alive);
        if (down)
            go_down(w, down);
    }
    return met;
}

// ---- the beginning ----------------------------------------------------------------------

// The stretch of the line between two planes across an axis.
LANES_INLINE void clip(struct over8 *w, struct real8 o, struct real8 inverse,
                       struct mask8 back, struct real8 from, struct real8 to)
{
    const struct real8 p = r8_mul(r8_sub(from, o), inverse);
    const struct real8 q = r8_mul(r8_sub(to, o), inverse);
    // NaN, of a line in such a plane, changes nothing.
    w->t = r8_max(r8_select(back, q, p), w->t);
    w->end = r8_min(r8_select(back, p, q), w->end);
}

// d, or 0 as by RUNS_ALONG of directions of that size; never -0.
LANES_INLINE struct real8 moving(struct real8 d, struct real8 size)
{
    const struct real8 zero = r8_set(0);
    return r8_select(r8_lt(r8_mul(r8_set(GAMMA(12)), size), r8_abs(d)), d, zero);
}

// As walk_of.
static void set_up(struct over8 *w)
{
    const struct height_field *f = w->f;
    const struct shape_rays *r = w->rays;
    const struct real8 one = r8_set(1), zero = r8_set(0), unit = r8_set(HEIGHT_UNIT);
    const struct vec8 ro = {r8_load(r->o[0]), r8_load(r->o[1]), r8_load(r->o[2])};
    const struct vec8 rd = {r8_load(r->d[0]), r8_load(r->d[1]), r8_load(r->d[2])};
    w->length = r8_sqrt(v8_dot(rd, rd));
    const struct real8 by = r8_div(one, w->length);
    const struct vec8 u = {r8_mul(by, rd.x), r8_mul(by, rd.y), r8_mul(by, rd.z)};
    const struct vec3 middle = vec3(0.5, 0.5 * (f->low + f->high), 0.5);
    w->shift = v8_dot(v8_sub(V8_SET(middle), ro), u);
    const struct vec8 o = v8_mad(ro, w->shift, u);
    const double size = 2 + fabs(f->low) + fabs(f->high);
    const double sx = f->h.width - 1, sz = f->h.height - 1;
    w->o = (struct vec8){r8_mul(r8_set(sx), o.x), r8_mul(unit, o.y),
                         r8_mul(r8_set(sz), o.z)};
    const struct real8 across = r8_max(r8_abs(u.x), r8_abs(u.z));
    const struct real8 most = r8_select(r8_lt(r8_set(GAMMA(12)), across), across, one);
    w->d = (struct vec8){r8_mul(r8_set(sx), moving(u.x, most)),
                         r8_add(r8_mul(unit, u.y), zero),
                         r8_mul(r8_set(sz), moving(u.z, most))};
    w->ix = r8_div(one, w->d.x);
    w->iz = r8_div(one, w->d.z);
    w->error = r8_mul(r8_set(GAMMA(8)),
                      r8_add(r8_add(r8_set(size), r8_abs(w->shift)), v8_max_abs(ro)));
    w->margin =
        r8_mul(r8_set(GAMMA(32)), r8_add(r8_abs(w->o.y), r8_set(size * HEIGHT_UNIT)));
}

// Where the lines are over the square and between the lowest and the highest height.
static void begin(struct over8 *w, unsigned lanes)
{
    const struct height_field *f = w->f;
    const struct real8 one = r8_set(1), zero = r8_set(0);
    const double sx = f->h.width - 1, sz = f->h.height - 1;
    w->t = r8_sub(r8_mul(r8_load(w->rays->t_min), w->length), w->shift);
    w->end = r8_sub(r8_mul(r8_load(w->rays->t_max), w->length), w->shift);
    const struct mask8 back_x = r8_lt(w->d.x, zero), back_z = r8_lt(w->d.z, zero);
    const struct mask8 in_x =
        m8_or(m8_without(m8_of(255), r8_eq(w->d.x, zero)),
              m8_and(r8_le(zero, w->o.x), r8_le(w->o.x, r8_set(sx))));
    const struct mask8 in_z =
        m8_or(m8_without(m8_of(255), r8_eq(w->d.z, zero)),
              m8_and(r8_le(zero, w->o.z), r8_le(w->o.z, r8_set(sz))));
    clip(w, w->o.x, w->ix, back_x, zero, r8_set(sx));
    clip(w, w->o.z, w->iz, back_z, zero, r8_set(sz));
    // A line along the square's last side is in its last cells.
    w->o.x =
        r8_select(r8_eq(w->d.x, zero), r8_min(w->o.x, r8_set(nextafter(sx, 0))), w->o.x);
    w->o.z =
        r8_select(r8_eq(w->d.z, zero), r8_min(w->o.z, r8_set(nextafter(sz, 0))), w->o.z);
    const struct real8 before = w->t, iy = r8_div(one, w->d.y);
    const struct mask8 falls = r8_lt(w->d.y, zero);
    clip(w, w->o.y, iy, falls, r8_sub(r8_set(f->low * HEIGHT_UNIT), w->margin),
         r8_add(r8_set(f->high * HEIGHT_UNIT), w->margin));
    w->alive = lanes & m8_bits(m8_and(m8_and(in_x, in_z), r8_lt(w->t, w->end)));
    w->started = w->alive & m8_bits(r8_lt(before, w->t));
    w->in = w->started & ~m8_bits(falls);
    w->odd = 0;
    const int level = f->top < FIRST_LEVEL ? f->top : FIRST_LEVEL;
    const double scale = 1 << level, inverse = 1 / scale;
    w->level = r8_set(level);
    w->scale = r8_set(scale);
    w->ahead_x = r8_select(back_x, zero, one);
    w->ahead_z = r8_select(back_z, zero, one);
    const struct real8 x = r8_add(w->o.x, r8_mul(w->t, w->d.x));
    const struct real8 z = r8_add(w->o.z, r8_mul(w->t, w->d.z));
    w->i = r8_min(r8_max(r8_floor(r8_mul(x, r8_set(inverse))), zero),
                  r8_set(f->level[level].width - 1));
    w->j = r8_min(r8_max(r8_floor(r8_mul(z, r8_set(inverse))), zero),
                  r8_set(f->level[level].height - 1));
}

unsigned OF_ISA(height_closest8_)(const struct height_field *f,
                                  const struct shape_rays *rays, unsigned lanes, bool any,
                                  struct shape_hits *out)
{
    struct over8 w;
    (void)any;
    w.f = f;
    w.rays = rays;
    w.out = out;
    set_up(&w);
    begin(&w, lanes);
    unsigned met = w.alive ? walk(&w) : 0;
    for (unsigned m = w.odd; m; m &= m - 1)
        met |= shape_lane_alone(&height_field_ops, f, rays, __builtin_ctz(m), out);
    return met;
}
