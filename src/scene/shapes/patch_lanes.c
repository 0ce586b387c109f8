// Eight lines against the sub-patches of a Bezier patch (patch.h), for the first point they
// meet. ISA names the instruction set.
//
// Seen along a line a sub-patch is a map of the plane. Multiplied by the inverse of its mean
// derivative it differs from the identity by a map whose derivative is at most `off`. Where
// that is less than 1 there is one zero at most, and from any point x of the piece, whose
// image under the product is -r, it lies at x + r, to within off/(1 - off) |r|: Newton's
// method finds it, or such a box lies outside the piece. Pieces on which `off` is too large
// for a line are halved when a line first comes there (patch_halves).
#include <math.h>

#include "math/gamma.h"
#include "math/isa.h"
#include "math/lanes.h"
#include "scene/shapes/patch.h"
#include "scene/shapes/patch_lanes.h"

static const double OFF_MAX = 0.4;
// Newton's step, as a share of the piece, after which the next would be lost in rounding:
// what is left is about the product of its square and of `off`.
static const double LAST_STEP = 0x1p-25;
enum { STEPS_MAX = 10, HALVES_MAX = 3 };

struct lines8 {
    const struct patch *p;
    const struct shape_rays *rays;
    struct vec8 o, d, inverse;
    struct vec8 near, far; // the origins, moved for the faces of boxes
    struct mask8 back[3];
    struct real8 noise; // of a coordinate of a point of the patch, seen from the origin
    struct real8 d_max; // largest component of d
    struct real8 t_min, limit; // boxes that begin beyond need not be looked at
    struct real8 best;
    unsigned met, alive;
    bool any;
    struct shape_hits *out;
};

LANES_INLINE void keep(double *to, struct mask8 m, struct real8 v)
{
    r8_store(to, r8_select(m, v, r8_load(to)));
}

LANES_INLINE struct vec8 cross(struct vec8 a, struct vec8 b)
{
    return (struct vec8){r8_sub(r8_mul(a.y, b.z), r8_mul(a.z, b.y)),
                         r8_sub(r8_mul(a.z, b.x), r8_mul(a.x, b.z)),
                         r8_sub(r8_mul(a.x, b.y), r8_mul(a.y, b.x))};
}

// ---- boxes ------------------------------------------------------------------------------

LANES_INLINE void slab(struct real8 near, struct real8 far, struct real8 inverse,
                       struct mask8 back, double min, double max, struct real8 *enter,
                       struct real8 *leave)
{
    const struct real8 lo = r8_set(min), hi = r8_set(max);
    const struct real8 a = r8_mul(r8_sub(r8_select(back, hi, lo), near), inverse);
    const struct real8 b = r8_mul(r8_sub(r8_select(back, lo, hi), far), inverse);
    *enter = r8_max(a, *enter); // NaN, of a line in a face, changes nothing
    *leave = r8_min(b, *leave);
}

// As slabs_meet.
LANES_INLINE unsigned enter_box(const struct lines8 *w, const struct aabb *box,
                                struct real8 *enter)
{
    struct real8 leave = w->limit;
    *enter = w->t_min;
    slab(w->near.x, w->far.x, w->inverse.x, w->back[0], box->min.x, box->max.x, enter,
         &leave);
    slab(w->near.y, w->far.y, w->inverse.y, w->back[1], box->min.y, box->max.y, enter,
         &leave);
    slab(w->near.z, w->far.z, w->inverse.z, w->back[2], box->min.z, box->max.z, enter,
         &leave);
    const struct real8 slack =
        r8_mul(r8_set(GAMMA(6)), r8_add(r8_abs(*enter), r8_abs(leave)));
    return m8_bits(m8_or(r8_le(*enter, leave), r8_le(r8_sub(*enter, leave), slack)));
}

// ---- points -----------------------------------------------------------------------------

struct point8 {
    struct vec8 at, du, dv;
};

LANES_INLINE void evaluate_axis(const double c[4][4], struct real8 s, struct real8 t,
                                struct real8 *at, struct real8 *du, struct real8 *dv)
{
    struct real8 row[4], slope[4];
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++) {
        const struct real8 c3 = r8_set(c[i][3]), c2 = r8_set(c[i][2]),
                           c1 = r8_set(c[i][1]);
        const struct real8 high = r8_add(r8_mul(c3, t), c2);
        const struct real8 mid = r8_add(r8_mul(high, t), c1);
        row[i] = r8_add(r8_mul(mid, t), r8_set(c[i][0]));
        // The derivative by the same steps: (high + c3 t) t + mid.
        slope[i] = r8_add(r8_mul(r8_add(high, r8_mul(c3, t)), t), mid);
    }
    const struct real8 high = r8_add(r8_mul(row[3], s), row[2]);
    const struct real8 mid = r8_add(r8_mul(high, s), row[1]);
    *at = r8_add(r8_mul(mid, s), row[0]);
    *du = r8_add(r8_mul(r8_add(high, r8_mul(row[3], s)), s), mid);
    *dv = r8_add(
        r8_mul(r8_add(r8_mul(r8_add(r8_mul(slope[3], s), slope[2]), s), slope[1]), s),
        slope[0]);
}

LANES_INLINE void evaluate(const struct patch *p, struct real8 u, struct real8 v,
                           struct point8 *x)
{
    const struct real8 half = r8_set(0.5), s = r8_sub(u, half), t = r8_sub(v, half);
    evaluate_axis(p->power[0], s, t, &x->at.x, &x->du.x, &x->dv.x);
    evaluate_axis(p->power[1], s, t, &x->at.y, &x->du.y, &x->dv.y);
    evaluate_axis(p->power[2], s, t, &x->at.z, &x->du.z, &x->dv.z);
}

// ---- pieces -----------------------------------------------------------------------------

// A piece seen along the lines.
struct view8 {
    struct real8 facing; // 1 / n.d
    struct real8 off;
    struct real8 s, t;  // where the plane of the mean derivatives is met, from the middle
    struct real8 slack; // rounding of these
};

LANES_INLINE struct real8 largest(struct vec3 a, struct vec3 b)
{
    return r8_set(fmax(vec3_max_abs(a), vec3_max_abs(b)));
}

LANES_INLINE struct view8 view_of(const struct lines8 *w, const struct patch_leaf *l)
{
    struct view8 x;
    const struct vec8 q = cross(v8_sub(V8_SET(l->middle), w->o), w->d);
    x.facing = r8_div(r8_set(1), v8_dot(V8_SET(l->n), w->d));
    const struct real8 tilt_u = r8_abs(r8_mul(v8_dot(V8_SET(l->n_dv), w->d), x.facing));
    const struct real8 tilt_v = r8_abs(r8_mul(v8_dot(V8_SET(l->du_n), w->d), x.facing));
    const struct real8 across = r8_set(l->bend[2]);
    x.off = r8_max(r8_add(r8_set(l->bend[0]), r8_mul(across, tilt_u)),
                   r8_add(r8_set(l->bend[1]), r8_mul(across, tilt_v)));
    x.s = r8_mul(v8_dot(V8_SET(l->dv), q), x.facing);
    x.t = r8_neg(r8_mul(v8_dot(V8_SET(l->du), q), x.facing));
    x.slack = r8_add(r8_mul(r8_mul(r8_mul(r8_set(8), w->noise), w->d_max),
                            r8_mul(largest(l->du, l->dv), r8_abs(x.facing))),
                     r8_set(0x1p-44));
    return x;
}

LANES_INLINE struct real8 clamp(struct real8 x, double lo, double hi)
{
    return r8_min(r8_max(x, r8_set(lo)), r8_set(hi));
}

// Lanes that this crossing is the first of so far. Of two pieces with a common edge either
// may be asked first: of equal t the one with the better bound or at the lesser u is kept.
LANES_INLINE unsigned first_of(const struct lines8 *w, unsigned lanes, struct real8 t,
                               struct real8 dt, struct real8 u)
{
    const struct real8 best_dt = r8_load(w->out->dt), best_u = r8_load(w->out->u);
    const struct mask8 better =
        m8_or(r8_lt(dt, best_dt), m8_and(r8_eq(dt, best_dt), r8_lt(u, best_u)));
    const unsigned same = ~w->met | m8_bits(better);
    return lanes & m8_bits(r8_lt(w->t_min, t)) &
           (m8_bits(r8_lt(t, w->best)) | (same & m8_bits(r8_eq(t, w->best))));
}

static void put(struct lines8 *w, unsigned lanes, struct real8 t, struct real8 dt,
                struct real8 u, struct real8 v)
{
    u = clamp(u, 0, 1);
    v = clamp(v, 0, 1);
    lanes = first_of(w, lanes, t, dt, u);
    if (!lanes)
        return;
    const struct mask8 m = m8_of(lanes);
    keep(w->out->t, m, t);
    keep(w->out->dt, m, dt);
    keep(w->out->u, m, u);
    keep(w->out->v, m, v);
    w->met |= lanes;
    w->best = r8_select(m, t, w->best);
    // A neighbouring piece that has the same point may have it a little nearer.
    w->limit = r8_select(m, r8_add(t, r8_mul(r8_set(8), dt)), w->limit);
    if (w->any)
        w->alive &= ~lanes;
}

// By the one line's way, for lanes that Newton's method does not settle.
static void meet_alone(struct lines8 *w, const struct patch_leaf *l, unsigned lanes)
{
    const struct shape_rays *r = w->rays;
    for (; lanes; lanes &= lanes - 1) {
        const int k = __builtin_ctz(lanes);
        const struct ray ray = {.o = vec3(r->o[0][k], r->o[1][k], r->o[2][k]),
                                .d = vec3(r->d[0][k], r->d[1][k], r->d[2][k])};
        const struct patch_ray line = patch_ray_of(&ray);
        struct patch_hit hit[PATCH_HITS];
        const int count = patch_meet_leaf(l, &line, hit);
        for (int i = 0; i < count; i++)
            put(w, 1u << k & w->alive, r8_set(hit[i].t), r8_set(hit[i].dt),
                r8_set(hit[i].u), r8_set(hit[i].v));
    }
}

// One step, from the point x of the piece: s, t are the step, r_s, r_t the one by the mean
// derivative; both as shares of the piece.
struct step8 {
    struct real8 s, t, r_s, r_t, slack;
    struct real8 along, error; // where the tangent plane is met
};

LANES_INLINE struct step8 step_from(const struct lines8 *w, const struct patch_leaf *l,
                                    const struct view8 *view, struct real8 u,
                                    struct real8 v)
{
    const double wu = l->u[1] - l->u[0], wv = l->v[1] - l->v[0];
    struct point8 x;
    struct step8 r;
    evaluate(w->p, u, v, &x);
    const struct vec8 q = v8_sub(x.at, w->o), n = cross(x.du, x.dv);
    const struct vec8 c = cross(q, w->d);
    const struct real8 facing = r8_div(r8_set(1), v8_dot(n, w->d));
    const struct real8 inverse_u = r8_set(1 / wu), inverse_v = r8_set(1 / wv);
    r.s = r8_mul(r8_mul(v8_dot(x.dv, c), facing), inverse_u);
    r.t = r8_neg(r8_mul(r8_mul(v8_dot(x.du, c), facing), inverse_v));
    r.r_s = r8_mul(v8_dot(V8_SET(l->dv), c), view->facing);
    r.r_t = r8_neg(r8_mul(v8_dot(V8_SET(l->du), c), view->facing));
    const struct real8 size = r8_abs(facing);
    const struct real8 longer =
        r8_max(r8_mul(v8_max_abs(x.dv), inverse_u), r8_mul(v8_max_abs(x.du), inverse_v));
    r.slack = r8_add(
        r8_mul(r8_mul(r8_mul(r8_set(8), w->noise), w->d_max), r8_mul(longer, size)),
        r8_set(0x1p-44));
    r.along = r8_mul(v8_dot(n, q), facing);
    r.error = r8_add(r8_mul(r8_mul(r8_mul(r8_set(12), w->noise), v8_max_abs(n)), size),
                     r8_mul(r8_set(GAMMA(4)), r8_abs(r.along)));
    return r;
}

// Whether the place a step leads to, give or take the room for its error, is outside.
LANES_INLINE struct mask8 is_outside(struct real8 x, double lo, double hi,
                                     struct real8 step, struct real8 room)
{
    const struct real8 inverse = r8_set(1 / (hi - lo));
    const struct real8 to = r8_mul(r8_sub(x, r8_set(lo)), inverse);
    const struct real8 from = r8_mul(r8_sub(r8_set(hi), x), inverse);
    const struct real8 outside = r8_neg(room);
    return m8_or(r8_lt(r8_add(to, step), outside), r8_lt(r8_sub(from, step), outside));
}

static void newton(struct lines8 *w, const struct patch_leaf *l, const struct view8 *view,
                   unsigned lanes)
{
    const double wu = l->u[1] - l->u[0], wv = l->v[1] - l->v[0];
    const struct real8 width_u = r8_set(wu), width_v = r8_set(wv);
    const struct real8 share = r8_div(view->off, r8_sub(r8_set(1), view->off)); // of |r|
    struct real8 u =
        clamp(r8_add(r8_set(0.5 * (l->u[0] + l->u[1])), r8_mul(view->s, width_u)),
              l->u[0], l->u[1]);
    struct real8 v =
        clamp(r8_add(r8_set(0.5 * (l->v[0] + l->v[1])), r8_mul(view->t, width_v)),
              l->v[0], l->v[1]);
    for (int i = 0; i < STEPS_MAX && lanes; i++) {
        const struct step8 x = step_from(w, l, view, u, v);
        const struct real8 room =
            r8_add(r8_mul(share, r8_max(r8_abs(x.r_s), r8_abs(x.r_t))),
                   r8_add(x.slack, view->slack));
        lanes &= ~m8_bits(m8_or(is_outside(u, l->u[0], l->u[1], x.r_s, room),
                                is_outside(v, l->v[0], l->v[1], x.r_t, room)));
        const struct real8 size = r8_max(r8_abs(x.s), r8_abs(x.t));
        const struct real8 at_u = r8_add(u, r8_mul(x.s, width_u));
        const struct real8 at_v = r8_add(v, r8_mul(x.t, width_v));
        const unsigned there =
            lanes & m8_bits(r8_le(size, r8_max(r8_set(LAST_STEP), x.slack)));
        if (there) {
            // Whatever is beyond the piece's edge by more than rounding is another's.
            const struct real8 off_u = r8_mul(x.slack, width_u);
            const struct real8 off_v = r8_mul(x.slack, width_v);
            const struct mask8 in_u = m8_and(r8_le(r8_sub(r8_set(l->u[0]), off_u), at_u),
                                             r8_le(at_u, r8_add(r8_set(l->u[1]), off_u)));
            const struct mask8 in_v = m8_and(r8_le(r8_sub(r8_set(l->v[0]), off_v), at_v),
                                             r8_le(at_v, r8_add(r8_set(l->v[1]), off_v)));
            put(w, there & m8_bits(m8_and(in_u, in_v)), x.along, x.error, at_u, at_v);
            lanes &= ~there;
        }
        u = clamp(at_u, l->u[0], l->u[1]);
        v = clamp(at_v, l->v[0], l->v[1]);
    }
    if (lanes)
        meet_alone(w, l, lanes);
}

// Lanes that pass through the box around the piece along its own frame, which is thin where
// the piece is flat: a line that runs along it seldom does.
static unsigned meet_own_box(const struct lines8 *w, const struct patch_leaf *l,
                             unsigned lanes)
{
    const struct vec8 o = v8_sub(w->o, V8_SET(l->middle));
    const struct vec3 axis[3] = {l->n_dv, l->du_n, l->n};
    struct real8 enter = w->t_min, leave = w->limit;
    for (int k = 0; k < 3; k++) {
        const struct vec8 a = V8_SET(axis[k]);
        const struct real8 at = v8_dot(a, o),
                           inverse = r8_div(r8_set(1), v8_dot(a, w->d));
        const struct real8 slack = r8_mul(w->noise, r8_set(5 * vec3_max_abs(axis[k])));
        const struct mask8 back = r8_lt(inverse, r8_set(0));
        const struct real8 lo = r8_sub(r8_set(l->own[k][0]), slack);
        const struct real8 hi = r8_add(r8_set(l->own[k][1]), slack);
        const struct real8 p = r8_mul(r8_sub(r8_select(back, hi, lo), at), inverse);
        const struct real8 q = r8_mul(r8_sub(r8_select(back, lo, hi), at), inverse);
        enter = r8_max(p, enter);
        leave = r8_min(q, leave);
    }
    const struct real8 slack =
        r8_mul(r8_set(GAMMA(12)), r8_add(r8_abs(enter), r8_abs(leave)));
    return lanes &
           m8_bits(m8_or(r8_le(enter, leave), r8_le(r8_sub(enter, leave), slack)));
}

static void meet_piece(struct lines8 *w, struct patch_leaf *l, unsigned lanes, int depth)
{
    const struct view8 x = view_of(w, l);
    const unsigned plain = lanes & m8_bits(r8_lt(x.off, r8_set(OFF_MAX)));
    const struct real8 reach =
        r8_add(r8_mul(r8_set(0.5), r8_add(r8_set(1), x.off)), x.slack);
    const unsigned near =
        plain & m8_bits(m8_and(r8_le(r8_abs(x.s), reach), r8_le(r8_abs(x.t), reach)));
    if (near)
        newton(w, l, &x, near);
    unsigned rough = lanes & ~plain & w->alive;
    if (rough)
        rough = meet_own_box(w, l, rough);
    if (!rough)
        return;
    if (depth == HALVES_MAX) {
        meet_alone(w, l, rough);
        return;
    }
    struct patch_half *half = patch_halves(l);
    for (int k = 0; k < 2; k++) {
        struct real8 enter;
        const unsigned bits = rough & w->alive & enter_box(w, &half[k].box, &enter);
        if (bits)
            meet_piece(w, &half[k].leaf, bits, depth + 1);
    }
}

// ---- the tree ---------------------------------------------------------------------------

static void visit(struct lines8 *w, uint32_t at, unsigned lanes)
{
    const struct patch_node *n = &w->p->node[at];
    if (!n->other) {
        meet_piece(w, &w->p->leaf[n->leaf], lanes, 0);
        return;
    }
    struct real8 enter[2];
    const uint32_t child[2] = {at + 1, n->other};
    unsigned bits[2];
    double first[2][8];
    for (int k = 0; k < 2; k++) {
        bits[k] = lanes & enter_box(w, &w->p->node[child[k]].box, &enter[k]);
        r8_store(first[k], enter[k]);
    }
    const unsigned both = bits[0] & bits[1];
    const int lane = both ? __builtin_ctz(both) : 0;
    const int near = both && first[1][lane] < first[0][lane];
    if (bits[near])
        visit(w, child[near], bits[near]);
    bits[!near] &= w->alive & m8_bits(r8_le(enter[!near], w->limit));
    if (bits[!near])
        visit(w, child[!near], bits[!near]);
}

static void set_up(struct lines8 *w)
{
    const struct patch *p = w->p;
    const struct shape_rays *r = w->rays;
    const struct real8 zero = r8_set(0), one = r8_set(1);
    w->o = (struct vec8){r8_load(r->o[0]), r8_load(r->o[1]), r8_load(r->o[2])};
    w->d = (struct vec8){r8_load(r->d[0]), r8_load(r->d[1]), r8_load(r->d[2])};
    w->inverse =
        (struct vec8){r8_div(one, w->d.x), r8_div(one, w->d.y), r8_div(one, w->d.z)};
    w->back[0] = r8_lt(w->inverse.x, zero); // of the inverse: a direction may be -0
    w->back[1] = r8_lt(w->inverse.y, zero);
    w->back[2] = r8_lt(w->inverse.z, zero);
    w->noise = r8_mul(r8_set(GAMMA(32)), r8_add(v8_max_abs(w->o), r8_set(p->size)));
    const struct real8 less = r8_neg(w->noise), *more = &w->noise;
    w->near = (struct vec8){r8_add(w->o.x, r8_select(w->back[0], less, *more)),
                            r8_add(w->o.y, r8_select(w->back[1], less, *more)),
                            r8_add(w->o.z, r8_select(w->back[2], less, *more))};
    w->far = (struct vec8){r8_add(w->o.x, r8_select(w->back[0], *more, less)),
                           r8_add(w->o.y, r8_select(w->back[1], *more, less)),
                           r8_add(w->o.z, r8_select(w->back[2], *more, less))};
    w->d_max = v8_max_abs(w->d);
    w->t_min = r8_load(r->t_min);
    w->best = w->limit = r8_load(r->t_max);
}

unsigned OF_ISA(patch_closest8_)(const struct patch *p, const struct shape_rays *rays,
                                 unsigned lanes, bool any, struct shape_hits *out)
{
    struct lines8 w;
    struct real8 enter;
    w.p = p;
    w.rays = rays;
    w.out = out;
    w.any = any;
    w.met = 0;
    set_up(&w);
    w.alive = lanes & enter_box(&w, &p->bounds, &enter);
    if (w.alive)
        visit(&w, 0, w.alive);
    for (unsigned m = w.met; m; m &= m - 1) {
        const int l = __builtin_ctz(m);
        out->part[l] = 0;
        out->crossing[l] = CROSS_TOUCH;
    }
    return w.met;
}
