// What is seen between points, in lanes: each operation is that of the scalar form.
#include "radiosity/sight_kernel.h"

#include "math/isa.h"
#include "math/lanes_vec.h"
#include "math/pi.h"
#include "math/quick_lanes.h"

// ---- shafts ------------------------------------------------------------------------
// Cuts [t0, t1] down to where a + t (b - a) < 0, to nothing or less where another cut
// left none of it. Returns the lanes in which that is nowhere in 0 to 1.
static struct mask8 clip(struct real8 a, struct real8 b, struct real8 *t0,
                         struct real8 *t1)
{
    const struct real8 zero = r8_set(0), t = r8_div(a, r8_sub(a, b));
    const struct mask8 after = r8_le(zero, a), before = r8_le(zero, b);
    *t0 = r8_select(after, r8_max(*t0, t), *t0);
    *t1 = r8_select(m8_without(before, after), r8_min(*t1, t), *t1);
    return m8_and(after, before);
}

// The lanes whose boxes the box between the boxes of both elements, moved from one to the
// other, does not run into: it holds every way from one to the other.
static struct mask8 clear_of(const struct shaft_boxes *boxes, uint32_t first,
                             const struct shaft *a, const struct shaft *b)
{
    struct real8 t0 = r8_set(0), t1 = r8_set(1);
    struct mask8 clear = m8_of(0);
    for (int k = 0; k < 3; k++) {
        const struct real8 ca = r8_set(vec3_axis(a->centre, k)),
                           cb = r8_set(vec3_axis(b->centre, k));
        const struct real8 ha = r8_set(vec3_axis(a->half, k)),
                           hb = r8_set(vec3_axis(b->half, k));
        const struct real8 low = r8_load(boxes->low[k] + first),
                           high = r8_load(boxes->high[k] + first);
        // Bounds are padded; what only touches, all the way, does not hide.
        const struct real8 pad = r8_mul(
            r8_set(1e-9),
            r8_add(r8_add(r8_add(r8_abs(low), r8_abs(high)), r8_abs(ca)), r8_abs(cb)));
        struct real8 k0 = r8_set(0), k1 = r8_set(1);
        const struct mask8 past =
            clip(r8_add(r8_sub(r8_sub(ca, ha), high), pad),
                 r8_add(r8_sub(r8_sub(cb, hb), high), pad), &k0, &k1);
        const struct mask8 below =
            clip(r8_sub(r8_sub(r8_add(low, pad), ca), ha),
                 r8_sub(r8_sub(r8_add(low, pad), cb), hb), &k0, &k1);
        // Nothing flat goes through something flat but at one time.
        t0 = r8_max(t0, r8_min(k0, k1));
        t1 = r8_min(t1, r8_max(k0, k1));
        clear = m8_or(clear, m8_or(m8_or(past, below), r8_lt(t1, t0)));
    }
    return clear;
}

static uint64_t between(const struct shaft_boxes *boxes, const struct shaft *a,
                        const struct shaft *b, uint64_t some)
{
    uint64_t found = 0;
    some &= boxes->solid;
    for (uint32_t first = 0; first < SHAFT_OBJECTS && some >> first; first += 8)
        if (some >> first & 255)
            found |= (uint64_t)(255 & ~m8_bits(clear_of(boxes, first, a, b))) << first;
    return found & some;
}

// ---- hulls -------------------------------------------------------------------------
#define ROWS(x) v8_load((const double(*)[8])(x))
static const double touching =
    1e-9; // of the coordinates: what only touches does not hide

// Whether points lie on the far side of a plane through the origin, a and b, as seen from
// `inner`.
static bool beyond(const struct vec8 *p, struct vec3 a, struct vec3 b, struct vec3 inner,
                   double pad)
{
    struct vec3 n = vec3_cross(a, b);
    const double height = vec3_dot(n, inner);
    if (height < 0)
        n = vec3_neg(n);
    const double slack = pad * vec3_max_abs(n);
    return height != 0 && m8_bits(r8_le(v8_dot(*p, V8_SET(n)), r8_set(slack))) == 255;
}

static bool apart(const struct shaft_hull *h, const struct horizon_polygon *to)
{
    const struct vec8 n = ROWS(h->n), p = v8_sub(ROWS(h->p), V8_SET(to->o));
    const double pad = touching * (vec3_max_abs(to->o) + vec3_max_abs(to->corner[0]));
    const struct real8 top =
        r8_sub(r8_sub(r8_load(h->top), v8_dot(n, V8_SET(to->o))), r8_set(pad)); // above o
    unsigned over = m8_bits(r8_le(top, r8_set(0)));
    struct vec3 all = {0, 0, 0};
    if (m8_bits(r8_le(v8_dot(p, V8_SET(to->n)), r8_set(pad))) == 255)
        return true;
    for (uint32_t i = 0; i < to->count; i++) {
        over &= m8_bits(r8_le(top, v8_dot(n, V8_SET(to->corner[i]))));
        all = vec3_add(all, to->corner[i]);
    }
    if (over)
        return true;
    for (uint32_t i = 0; i < to->count; i++)
        if (beyond(&p, to->corner[i], to->corner[i + 1 < to->count ? i + 1 : 0], all,
                   pad))
            return true;
    return false;
}

// Whether all corners lie on the side of the normal of a plane through a point, or in it.
static bool all_over(const struct facing_polygons *x, struct vec3 at, struct vec3 n,
                     double slack)
{
    for (int s = 0; s < 2; s++)
        for (uint32_t i = 0; i < x->count[s]; i++)
            if (vec3_dot(vec3_sub(x->corner[s][i], at), n) < -slack)
                return false;
    return true;
}

// Whether a plane through an edge of polygon s and a corner of the other parts them from
// the points.
static bool tangent_parts(const struct facing_polygons *x, int s, const struct vec8 *p,
                          double pad)
{
    const struct vec3 *a = x->corner[s], *b = x->corner[1 - s];
    for (uint32_t i = 0; i < x->count[s]; i++) {
        const struct vec3 along = vec3_sub(a[i + 1 < x->count[s] ? i + 1 : 0], a[i]);
        for (uint32_t k = 0; k < x->count[1 - s]; k++) {
            struct vec3 n = vec3_cross(along, vec3_sub(b[k], a[i]));
            const double most = vec3_max_abs(n), slack = pad * most;
            if (!all_over(x, a[i], n, slack)) {
                n = vec3_neg(n);
                if (!all_over(x, a[i], n, slack))
                    continue;
            }
            const struct real8 over = v8_dot(v8_sub(*p, V8_SET(a[i])), V8_SET(n));
            if (most > 0 && m8_bits(r8_le(over, r8_set(slack))) == 255)
                return true;
        }
    }
    return false;
}

static bool beside(const struct shaft_hull *h, const struct facing_polygons *x)
{
    const struct vec8 n = ROWS(h->n), p = ROWS(h->p);
    const double pad =
        touching * (vec3_max_abs(x->corner[0][0]) + vec3_max_abs(x->corner[1][0]));
    const struct real8 top = r8_sub(r8_load(h->top), r8_set(pad));
    unsigned over = 255;
    for (int s = 0; s < 2; s++) {
        const struct real8 above =
            v8_dot(v8_sub(p, V8_SET(x->corner[s][0])), V8_SET(x->n[s]));
        if (m8_bits(r8_le(above, r8_set(pad))) == 255)
            return true;
        for (uint32_t i = 0; i < x->count[s]; i++)
            over &= m8_bits(r8_le(top, v8_dot(n, V8_SET(x->corner[s][i]))));
    }
    return over || tangent_parts(x, 0, &p, pad) || tangent_parts(x, 1, &p, pad);
}

// ---- polygons ----------------------------------------------------------------------
static void edges(const struct polygon_edges *e, struct vec3 o, struct vec3 n,
                  double *term, double *height)
{
    const struct vec8 from = V8_SET(o), up = V8_SET(n);
    for (uint32_t i = 0; i < e->count; i += 8) {
        const struct vec8 a =
            v8_sub((struct vec8){r8_load(e->a[0] + i), r8_load(e->a[1] + i),
                                 r8_load(e->a[2] + i)},
                   from);
        const struct vec8 b =
            v8_sub((struct vec8){r8_load(e->b[0] + i), r8_load(e->b[1] + i),
                                 r8_load(e->b[2] + i)},
                   from);
        const struct vec8 c = {
            r8_sub(r8_mul(a.y, b.z), r8_mul(a.z, b.y)),
            r8_sub(r8_mul(a.z, b.x), r8_mul(a.x, b.z)),
            r8_sub(r8_mul(a.x, b.y), r8_mul(a.y, b.x)),
        };
        const struct real8 sine = r8_sqrt(v8_dot(c, c));
        const struct real8 one =
            r8_mul(quick_atan2_8(sine, v8_dot(a, b)), r8_div(v8_dot(c, up), sine));
        r8_store(term + i, r8_select(r8_lt(r8_set(0), sine), one, r8_set(0)));
        r8_store(height + i, v8_dot(a, up));
    }
}

// ---- points of emitters --------------------------------------------------------------
static void put(double to[3][8], uint32_t lane, struct vec3 v)
{
    to[0][lane] = v.x;
    to[1][lane] = v.y;
    to[2][lane] = v.z;
}

// Charts of eight emitters; bits of those of triangles.
struct flat8 {
    double o[3][8], a[3][8], b[3][8], n[3][8], u[8], du[8], v[8], dv[8];
    unsigned triangles;
};

static void load(const struct flat_emitter *const of[8], struct flat8 *out)
{
    out->triangles = 0;
    for (uint32_t i = 0; i < 8; i++) {
        put(out->o, i, of[i]->o);
        put(out->a, i, of[i]->a);
        put(out->b, i, of[i]->b);
        put(out->n, i, of[i]->n);
        out->u[i] = of[i]->u;
        out->du[i] = of[i]->du;
        out->v[i] = of[i]->v;
        out->dv[i] = of[i]->dv;
        out->triangles |= (unsigned)of[i]->triangle << i;
    }
}

static void aim(struct emitter_aims *x)
{
    const struct vec8 o = V8_SET(x->o), n = V8_SET(x->n);
    struct flat8 of;
    for (uint32_t first = 0; first < EMITTER_RAYS; first += 8) {
        load(x->of + first, &of);
        const struct mask8 triangle = m8_of(of.triangles);
        struct real8 u =
            r8_add(r8_load(of.u), r8_mul(r8_load(x->u + first), r8_load(of.du)));
        struct real8 v =
            r8_add(r8_load(of.v), r8_mul(r8_load(x->v + first), r8_load(of.dv)));
        const struct real8 s = r8_sqrt(u);
        u = r8_select(triangle, r8_mul(s, r8_sub(r8_set(1), v)), u);
        v = r8_select(triangle, r8_mul(s, v), v);
        const struct vec8 p = v8_mad(v8_mad(ROWS(of.o), u, ROWS(of.a)), v, ROWS(of.b));
        const struct vec8 d = v8_sub(p, o);
        const struct real8 ca = v8_dot(d, n), cb = r8_neg(v8_dot(d, ROWS(of.n)));
        const struct real8 r2 = v8_dot(d, d), zero = r8_set(0);
        const struct real8 kernel =
            r8_div(r8_mul(ca, cb), r8_mul(r8_mul(r8_set(PI), r2), r2));
        r8_store(x->kernel + first,
                 r8_select(m8_and(r8_lt(zero, ca), r8_lt(zero, cb)), kernel, zero));
        r8_store(x->d[0] + first, d.x);
        r8_store(x->d[1] + first, d.y);
        r8_store(x->d[2] + first, d.z);
    }
}

const struct sight_kernels OF_ISA(sight_kernels_) = {ISA_TEXT, between, apart,
                                                     beside,   edges,   aim};
