// Eight rays through the cells of an isosurface side by side (isosurface.h), for the first
// surface they meet: isosurface_walk.c in lanes. ISA names the instruction set.
//
// Rays whose directions have the same signs go through the cells in one order. Where the
// bounds of a cell's gradient make f monotone along a ray, signs decide; a lane that has
// found the bracket of its root waits, and all roots are refined together. A stretch that
// bounds over it do not settle is cut into eight, which are looked at together.
#include "scene/shapes/isosurface_lane_roots.h"
#include "scene/shapes/isosurface_lane_values.h"

// ---- brackets ---------------------------------------------------------------------------

static void bracket(struct walk8 *w, unsigned lanes, struct real8 a, struct real8 fa,
                    struct real8 b, struct real8 fb, struct real8 slope)
{
    const struct mask8 m = m8_of(lanes);
    keep(w->a, m, a);
    keep(w->fa, m, fa);
    keep(w->b, m, b);
    keep(w->fb, m, fb);
    keep(w->slope, m, slope);
    w->found |= lanes;
    w->alive &= ~lanes;
}

struct piece {
    double a, fa, b, fb, lo, hi; // lo, hi: the derivative along the ray
};

static void bracket_1(struct walk8 *w, int lane, const struct piece *s, double slope)
{
    w->a[lane] = s->a;
    w->fa[lane] = s->fa;
    w->b[lane] = s->b;
    w->fb[lane] = s->fb;
    w->slope[lane] = slope;
    w->found |= 1u << lane;
    w->alive &= ~(1u << lane);
}

// As is_excluded of isosurface_walk.c.
LANES_INLINE struct mask8 excluded(struct real8 a, struct real8 fa, struct real8 b,
                                   struct real8 fb, struct real8 lo, struct real8 hi)
{
    const struct real8 zero = r8_set(0);
    const struct mask8 above = r8_lt(zero, fa);
    const struct real8 up = r8_max(r8_select(above, hi, r8_neg(lo)), zero);
    const struct real8 down = r8_max(r8_select(above, r8_neg(lo), hi), zero);
    const struct real8 room = r8_add(r8_mul(r8_abs(fa), up), r8_mul(r8_abs(fb), down));
    const struct real8 most =
        r8_mul(r8_mul(r8_mul(up, down), r8_sub(b, a)), r8_set(1 + GAMMA(16)));
    return m8_and(r8_lt(most, room), r8_lt(r8_add(up, down), r8_set(INFINITY)));
}

// ---- one stretch in eight -----------------------------------------------------------------

struct eighths {
    double t[9], f[9], lo[8], hi[8], slope_lo[8], slope_hi[8];
};

static void look_at_eighths(struct walk8 *w, int lane, const struct piece *s,
                            struct eighths *e)
{
    double x[3][8], d[3][8];
    r8_store(x[0], w->o.x);
    r8_store(x[1], w->o.y);
    r8_store(x[2], w->o.z);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 8; k++)
            d[i][k] = w->dirs[i][lane];
    for (int k = 0; k < 8; k++)
        e->t[k] = s->a + (s->b - s->a) * (k * 0.125);
    e->t[8] = s->b;
    const struct vec8 o = {r8_set(x[0][lane]), r8_set(x[1][lane]), r8_set(x[2][lane])};
    const struct vec8 dir = {r8_load(d[0]), r8_load(d[1]), r8_load(d[2])};
    const struct real8 from = r8_load(e->t), to = r8_load(e->t + 1);
    struct tape_boxes box;
    stretch_box(o, dir, from, to, r8_set(0), 255, &box);
    const struct over8 v = over(w, &box, (const double(*)[8])d, 255);
    r8_store(e->f, value_at_points(w, v8_mad(o, from, dir), 255));
    e->f[0] = s->fa;
    e->f[8] = s->fb;
    r8_store(e->lo, v.lo);
    r8_store(e->hi, v.hi);
    r8_store(e->slope_lo, r8_max(v.slope_lo, r8_set(s->lo)));
    r8_store(e->slope_hi, r8_min(v.slope_hi, r8_set(s->hi)));
    w->evaluations += 8;
    w->spent[lane] += 16;
}

static bool is_excluded_1(const struct piece *s)
{
    const double up = fmax(s->fa > 0 ? s->hi : -s->lo, 0);
    const double down = fmax(s->fa > 0 ? -s->lo : s->hi, 0);
    const double room = fabs(s->fa) * up + fabs(s->fb) * down;
    return room > up * down * (s->b - s->a) * (1 + GAMMA(16)) && up + down < INFINITY;
}

// The bounds of f are no wider than its own rounding.
static bool is_rounding(struct walk8 *w, int lane, const struct piece *s, double width)
{
    double o[3][8];
    r8_store(o[0], w->o.x);
    r8_store(o[1], w->o.y);
    r8_store(o[2], w->o.z);
    struct interval in[3];
    const struct interval t = interval_point(0.5 * (s->a + s->b));
    for (int i = 0; i < 3; i++)
        in[i] = interval_add(interval_point(o[i][lane]),
                             interval_multiply(t, interval_point(w->dirs[i][lane])));
    w->evaluations++;
    return width <= 4 * interval_width(tape_bounds(w->s->f, in));
}

static double chord_of(const struct walk8 *w, int lane)
{
    double chord[8];
    r8_store(chord, w->chord);
    return chord[lane];
}

// Whether an eighth is done with; a root that it may have is in its bracket then.
static bool is_settled(struct walk8 *w, int lane, const struct piece *s, double lo,
                       double hi)
{
    const bool changes = (s->fa <= 0) != (s->fb <= 0);
    if (lo > 0 || hi < 0 || (!changes && is_excluded_1(s)))
        return true;
    const double slope = s->lo > 0 ? s->lo : s->hi < 0 ? -s->hi : 0;
    const double chord = chord_of(w, lane), length = s->b - s->a;
    const bool bounded = s->hi - s->lo < INFINITY;
    const double least = fmax((bounded ? ISO_SHORTEST : ISO_SHORTEST_JUMP) * chord,
                              8 * ROUNDOFF * fabs(s->b));
    if (!(slope > 0 || length <= least || w->spent[lane] > ISO_EVALUATIONS_MAX ||
          (length < 0x1p-12 * chord && is_rounding(w, lane, s, hi - lo))))
        return false;
    if (changes)
        bracket_1(w, lane, s, slope);
    return true;
}

// The first root in a stretch of one ray, its bracket.
static void isolate(struct walk8 *w, int lane, const struct piece *all)
{
    struct eighths e;
    look_at_eighths(w, lane, all, &e);
    for (int i = 0; i < 8 && !(w->found >> lane & 1); i++) {
        if (shape_hits_give_up(w->out))
            return;
        const struct piece s = {e.t[i],     e.f[i],        e.t[i + 1],
                                e.f[i + 1], e.slope_lo[i], e.slope_hi[i]};
        if (!is_settled(w, lane, &s, e.lo[i], e.hi[i]))
            isolate(w, lane, &s);
    }
}

// ---- leaves -------------------------------------------------------------------------------

struct stretch8 {
    struct real8 a, fa, b, fb, lo, hi;
};

// The derivative along the rays by the bounds of the cell's gradient.
LANES_INLINE void add_slope(struct real8 d, const float slope[2], struct real8 *lo,
                            struct real8 *hi, struct real8 *size)
{
    const struct mask8 still = r8_eq(d, r8_set(0));
    const struct real8 p = r8_mul(d, r8_set(slope[0])), q = r8_mul(d, r8_set(slope[1]));
    const struct real8 low = r8_select(still, r8_set(0), r8_min(p, q));
    const struct real8 high = r8_select(still, r8_set(0), r8_max(p, q));
    *lo = r8_add(*lo, low);
    *hi = r8_add(*hi, high);
    *size = r8_add(*size, r8_add(r8_abs(low), r8_abs(high)));
}

LANES_INLINE void slope_in(const struct walk8 *w, const struct iso_cell *c,
                           struct stretch8 *s)
{
    struct real8 size = r8_set(0);
    s->lo = s->hi = size;
    add_slope(w->d.x, c->slope[0], &s->lo, &s->hi, &size);
    add_slope(w->d.y, c->slope[1], &s->lo, &s->hi, &size);
    add_slope(w->d.z, c->slope[2], &s->lo, &s->hi, &size);
    const struct real8 slack = r8_mul(size, r8_set(GAMMA(8)));
    const struct real8 lo = r8_sub(s->lo, slack), hi = r8_add(s->hi, slack);
    const struct mask8 good = r8_le(lo, hi);
    s->lo = r8_select(good, lo, r8_set(-INFINITY));
    s->hi = r8_select(good, hi, r8_set(INFINITY));
}

// What neither signs nor the cell's slopes decide: by bounds over what the slopes leave.
static void look_closer(struct walk8 *w, unsigned lanes, unsigned changes,
                        struct stretch8 *s)
{
    const struct real8 zero = r8_set(0), margin = r8_set(0.999);
    const struct mask8 above = r8_lt(zero, s->fa), beyond = r8_lt(zero, s->fb);
    const struct real8 from =
        r8_div(r8_abs(s->fa), r8_select(above, r8_neg(s->lo), s->hi));
    const struct real8 to =
        r8_div(r8_abs(s->fb), r8_select(beyond, s->hi, r8_neg(s->lo)));
    struct real8 a = r8_add(s->a, r8_mul(margin, from));
    struct real8 b = r8_sub(s->b, r8_mul(margin, to));
    const struct mask8 good = m8_and(m8_and(r8_le(s->a, a), r8_le(b, s->b)), r8_lt(a, b));
    a = r8_select(good, a, s->a);
    b = r8_select(good, b, s->b);
    struct tape_boxes box;
    stretch_box(w->o, w->d, a, b, zero, lanes, &box);
    const struct over8 v = over(w, &box, (const double(*)[8])w->dirs, lanes);
    lanes &= ~m8_bits(m8_or(r8_lt(zero, v.lo), r8_lt(v.hi, zero)));
    const struct real8 slope =
        least_size(r8_max(s->lo, v.slope_lo), r8_min(s->hi, v.slope_hi));
    const unsigned one = lanes & m8_bits(r8_lt(zero, slope));
    bracket(w, one & changes, s->a, s->fa, s->b, s->fb, slope);
    lanes &= ~one;
    if (!lanes)
        return;
    double v8[6][8];
    r8_store(v8[0], s->a);
    r8_store(v8[1], s->fa);
    r8_store(v8[2], s->b);
    r8_store(v8[3], s->fb);
    r8_store(v8[4], s->lo);
    r8_store(v8[5], s->hi);
    for (; lanes; lanes &= lanes - 1) {
        const int l = __builtin_ctz(lanes);
        const struct piece p = {v8[0][l], v8[1][l], v8[2][l],
                                v8[3][l], v8[4][l], v8[5][l]};
        isolate(w, l, &p);
    }
}

// Lanes whose state is not known yet begin so.
LANES_INLINE void begin(struct walk8 *w, unsigned lanes, unsigned inside)
{
    lanes &= ~w->started;
    w->started |= lanes;
    w->inside |= lanes & inside;
    if (!w->s->open) {
        const unsigned face = lanes & inside & ~w->late;
        w->face |= face;
        w->alive &= ~face;
    }
}

// Lanes whose state is other than was followed so far: a root was lost in rounding.
LANES_INLINE void check(struct walk8 *w, unsigned lanes, unsigned inside)
{
    const unsigned odd = lanes & w->alive & (w->inside ^ inside);
    w->odd |= odd;
    w->alive &= ~odd;
}

static void leaf(struct walk8 *w, const struct iso_cell *c, unsigned lanes,
                 struct real8 a, struct real8 b)
{
    const unsigned fresh = lanes & ~m8_bits(r8_eq(a, w->last_t));
    struct stretch8 s = {.a = a, .b = b, .fa = w->last_f};
    if (fresh)
        s.fa = r8_select(m8_of(fresh), value(w, a, fresh), s.fa);
    const unsigned in = not_positive(s.fa);
    begin(w, lanes, in);
    check(w, lanes, in);
    lanes &= w->alive;
    if (!lanes)
        return;
    s.fb = value(w, b, lanes);
    const struct mask8 here = m8_of(lanes);
    w->last_t = r8_select(here, b, w->last_t);
    w->last_f = r8_select(here, s.fb, w->last_f);
    const unsigned changes = lanes & (in ^ not_positive(s.fb));
    slope_in(w, c, &s);
    const struct real8 slope = least_size(s.lo, s.hi);
    const unsigned monotone = lanes & m8_bits(r8_lt(r8_set(0), slope));
    if (monotone & changes)
        bracket(w, monotone & changes, s.a, s.fa, s.b, s.fb, slope);
    lanes &= ~monotone;
    if (lanes)
        lanes &= changes | ~m8_bits(excluded(s.a, s.fa, s.b, s.fb, s.lo, s.hi));
    if (lanes)
        look_closer(w, lanes, changes, &s);
}

// ---- cells ----------------------------------------------------------------------------------

static void visit_children(struct walk8 *w, struct iso_cell *c, const struct aabb *box,
                           int depth, unsigned lanes, struct real8 a, struct real8 b)
{
    uint32_t made = 0;
    struct iso_cell *child = iso_children(w->s, c, box, depth, &made);
    w->evaluations += made;
    const struct vec3 m = vec3_scale(0.5, vec3_add(box->min, box->max));
    const struct real8 x = r8_mul(r8_sub(r8_set(m.x), w->o.x), w->inverse.x);
    const struct real8 y = r8_mul(r8_sub(r8_set(m.y), w->o.y), w->inverse.y);
    const struct real8 z = r8_mul(r8_sub(r8_set(m.z), w->o.z), w->inverse.z);
    for (unsigned k = 0; k < 8; k++) {
        struct iso_cell *at = &child[k ^ w->mirror];
        if (at->kind == CELL_OUTSIDE)
            continue;
        struct real8 from = k & 1 ? r8_max(x, a) : a, to = k & 1 ? b : r8_min(x, b);
        from = k & 2 ? r8_max(y, from) : from;
        to = k & 2 ? to : r8_min(y, to);
        from = k & 4 ? r8_max(z, from) : from;
        to = k & 4 ? to : r8_min(z, to);
        const unsigned bits =
            lanes & w->alive & m8_bits(m8_and(r8_lt(from, to), r8_le(from, w->limit)));
        if (!bits)
            continue;
        if (shape_hits_give_up(w->out))
            return;
        if (at->kind == CELL_LEAF) {
            leaf(w, at, bits, from, to);
        } else if (at->kind == CELL_INSIDE) {
            begin(w, bits, bits);
            check(w, bits, bits);
        } else {
            const struct aabb part = iso_child_box(box, &m, (int)(k ^ w->mirror));
            visit_children(w, at, &part, depth + 1, bits, from, to);
        }
    }
}

// ---- the container ----------------------------------------------------------------------

LANES_INLINE void slab(struct real8 o, struct real8 d, double min, double max,
                       struct real8 *enter, struct real8 *leave)
{
    const struct real8 inverse = r8_div(r8_set(1), d);
    const struct real8 p = r8_mul(r8_sub(r8_set(min), o), inverse);
    const struct real8 q = r8_mul(r8_sub(r8_set(max), o), inverse);
    // Of the inverse, since a direction may be -0.
    const struct mask8 back = r8_lt(inverse, r8_set(0));
    // NaN, of a ray in a face, changes nothing.
    *enter = r8_max(r8_select(back, q, p), *enter);
    *leave = r8_min(r8_select(back, p, q), *leave);
}

// Where the rays, their origins nearest to the middle, are in the container.
static void contain(const struct walk8 *w, struct real8 *enter, struct real8 *leave)
{
    const struct container *c = &w->s->container;
    if (c->ops == &box_ops) {
        const struct box *b = &c->shape.box;
        *enter = r8_set(-INFINITY);
        *leave = r8_set(INFINITY);
        slab(w->o.x, w->d.x, b->min.x, b->max.x, enter, leave);
        slab(w->o.y, w->d.y, b->min.y, b->max.y, enter, leave);
        slab(w->o.z, w->d.z, b->min.z, b->max.z, enter, leave);
        return;
    }
    const struct sphere *s = &c->shape.sphere;
    const struct vec8 oc = v8_sub(w->o, V8_SET(s->centre));
    const struct real8 dd = v8_dot(w->d, w->d), at = r8_div(v8_dot(w->d, oc), dd);
    const struct vec8 near = v8_mad(oc, r8_neg(at), w->d);
    const struct real8 rest = r8_sub(r8_set(s->radius * s->radius), v8_dot(near, near));
    const struct real8 reach = r8_sqrt(r8_div(r8_max(rest, r8_set(0)), dd));
    *enter = r8_sub(r8_neg(at), reach);
    *leave = r8_sub(reach, at);
}

// The container's crossing that a lane enters or leaves by.
static unsigned face_of(const struct walk8 *w, const struct shape_rays *rays, int lane,
                        bool leaves, struct shape_hits *out)
{
    struct boundary room[8];
    struct boundary_list list = {.at = room, .capacity = 8};
    const struct ray ray = {
        .o = vec3(rays->o[0][lane], rays->o[1][lane], rays->o[2][lane]),
        .d = vec3(rays->d[0][lane], rays->d[1][lane], rays->d[2][lane]),
        .t_min = rays->t_min[lane],
        .t_max = rays->t_max[lane]};
    w->s->container.ops->intersect(&w->s->container.shape, &ray, &list);
    if (list.count != 2)
        return 0;
    const struct boundary *b = &list.at[leaves];
    out->t[lane] = b->t;
    out->dt[lane] = b->dt;
    out->u[lane] = b->u;
    out->v[lane] = b->v;
    out->part[lane] = ISO_CONTAINER + b->part;
    out->crossing[lane] = b->crossing;
    return b->t > ray.t_min && b->t <= ray.t_max ? 1u << lane : 0;
}

// ---- eight rays -----------------------------------------------------------------------------

LANES_INLINE struct real8 steep(struct real8 d)
{
    const struct real8 most = r8_set(STEEPEST), least = r8_set(-STEEPEST);
    const struct real8 v = r8_max(r8_min(r8_div(r8_set(1), d), most), least);
    return r8_select(r8_eq(d, r8_set(0)), most, v);
}

// Rays whose directions have the same signs, together.
static void walk_all(struct walk8 *w, struct real8 a, struct real8 b)
{
    const struct real8 zero = r8_set(0);
    const unsigned x = m8_bits(r8_lt(w->d.x, zero)), y = m8_bits(r8_lt(w->d.y, zero));
    const unsigned z = m8_bits(r8_lt(w->d.z, zero));
    for (unsigned left = w->alive; left;) {
        const int l = __builtin_ctz(left);
        unsigned same = left;
        same &= x >> l & 1 ? x : ~x;
        same &= y >> l & 1 ? y : ~y;
        same &= z >> l & 1 ? z : ~z;
        w->mirror = (x >> l & 1) | (y >> l & 1) << 1 | (z >> l & 1) << 2;
        visit_children(w, w->s->root, &w->s->bounds, 0, same, a, b);
        left &= ~same;
    }
}

static void set_up(struct walk8 *w, const struct isosurface *s,
                   const struct shape_rays *rays)
{
    const struct vec3 middle = vec3_scale(0.5, vec3_add(s->bounds.min, s->bounds.max));
    const struct vec8 o = {r8_load(rays->o[0]), r8_load(rays->o[1]), r8_load(rays->o[2])};
    w->s = s;
    w->d = (struct vec8){r8_load(rays->d[0]), r8_load(rays->d[1]), r8_load(rays->d[2])};
    w->shift = r8_div(v8_dot(v8_sub(V8_SET(middle), o), w->d), v8_dot(w->d, w->d));
    w->o = v8_mad(o, w->shift, w->d);
    w->inverse = (struct vec8){steep(w->d.x), steep(w->d.y), steep(w->d.z)};
    w->limit = r8_sub(r8_load(rays->t_max), w->shift);
    w->last_t = r8_set(NAN);
    w->last_f = r8_set(0);
    r8_store(w->dirs[0], w->d.x);
    r8_store(w->dirs[1], w->d.y);
    r8_store(w->dirs[2], w->d.z);
    w->started = w->inside = w->face = w->found = w->odd = 0;
    w->evaluations = 0;
    for (int l = 0; l < 8; l++) {
        w->spent[l] = 0;
        w->a[l] = w->fa[l] = w->b[l] = w->fb[l] = w->slope[l] = 0;
    }
}

static unsigned faces(const struct walk8 *w, const struct shape_rays *rays,
                      struct shape_hits *out)
{
    unsigned hit = 0;
    for (unsigned m = w->face; m; m &= m - 1)
        hit |= face_of(w, rays, __builtin_ctz(m), false, out);
    // Inside to the end.
    for (unsigned m = w->s->open ? 0 : w->alive & w->inside; m; m &= m - 1)
        hit |= face_of(w, rays, __builtin_ctz(m), true, out);
    return hit;
}

static unsigned closest(const struct isosurface *s, const struct shape_rays *rays,
                        unsigned lanes, bool any, struct shape_hits *out)
{
    struct walk8 w;
    struct real8 enter, leave;
    w.out = out;
    set_up(&w, s, rays);
    contain(&w, &enter, &leave);
    const struct real8 t_min = r8_sub(r8_load(rays->t_min), w.shift);
    w.chord = r8_sub(leave, enter);
    w.late = m8_bits(r8_lt(enter, t_min));
    const struct real8 from = r8_max(t_min, enter);
    w.alive = lanes & m8_bits(m8_and(m8_and(r8_lt(enter, leave), r8_lt(from, leave)),
                                     r8_le(from, w.limit)));
    if (!w.alive)
        return 0;
    walk_all(&w, from, leave);
    for (unsigned m = w.found; m; m &= m - 1) {
        const int l = __builtin_ctz(m);
        out->part[l] = ISO_SURFACE;
        out->crossing[l] = w.inside >> l & 1 ? CROSS_EXIT : CROSS_ENTER;
        out->u[l] = out->v[l] = 0;
    }
    unsigned hit = faces(&w, rays, out);
    const unsigned told = any ? settle_any(&w, rays, out) : 0;
    if (w.found & ~told)
        hit |= settle_roots(&w, rays, w.found & ~told, out);
    out->evaluations += w.evaluations;
    for (unsigned m = w.odd; m; m &= m - 1)
        hit |= shape_lane_alone(&isosurface_ops, s, rays, __builtin_ctz(m), out);
    return hit | told;
}

unsigned OF_ISA(iso_closest8_)(const struct isosurface *s, const struct shape_rays *rays,
                               unsigned lanes, bool any, struct shape_hits *out)
{
    return closest(s, rays, lanes, any, out);
}
