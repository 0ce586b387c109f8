// Eight rays and a sphere sweep, compiled once per instruction set: which segments each may
// meet in its range, and from where on. The rest is the one ray's (sphere_sweep.c).
#include "scene/shapes/lanes.h"
#include "scene/shapes/sphere_sweep.h"

// Segments that a ray may meet; a ray with more goes alone.
enum { NEAR = 64 };

struct near8 {
    uint32_t count[8];
    struct sweep_near at[8][NEAR];
};

// Lanes whose line stays away from all balls of a straight segment: the Bernstein coefficients
// of r^2 - d^2, d the distance of the centre from the line, are below zero by far more than
// rounding.
static unsigned passes_by(const struct sweep_segment *g, struct vec8 to, struct vec8 u,
                          struct real8 shift)
{
    // From the line to the centres at the ends.
    const struct vec8 along = V8_SET(g->c[1]);
    const struct vec8 middle = V8_SET(vec3_sub(g->c[0], g->around.c));
    const struct vec8 a0 = v8_add(to, middle);
    const struct vec8 p = v8_mad(a0, r8_neg(v8_dot(a0, u)), u);
    const struct vec8 q = v8_mad(along, r8_neg(v8_dot(along, u)), u);
    const double r0 = g->r[0], r1 = g->r[1], size = g->around.r;
    const struct real8 w0 = r8_sub(r8_set(r0 * r0), v8_dot(p, p));
    const struct real8 w1 = r8_sub(r8_set(r0 * r1), v8_dot(p, q)); // half of it
    const struct real8 w2 = r8_sub(r8_set(r1 * r1), v8_dot(q, q));
    const struct real8 b1 = r8_add(w0, w1), b2 = r8_add(r8_add(b1, w1), w2);
    const struct real8 noise =
        r8_add(r8_set(0x1p-30 * size * size),
               r8_mul(r8_set(GAMMA(64) * size),
                      r8_add(r8_abs(shift), r8_set(vec3_max_abs(g->around.c) + size))));
    return m8_bits(r8_lt(r8_max(w0, r8_max(b1, b2)), r8_neg(noise)));
}

// As meet_segment: whether a line meets the ball around.
static void look(const struct sweep *s, const struct lines8 *l, struct vec8 o,
                 unsigned lanes, struct near8 *out, unsigned *odd)
{
    for (uint32_t i = 0; i < s->segments; i++) {
        const struct sweep_segment *g = &s->segment[i];
        if (g->empty)
            continue;
        const double r = g->around.r;
        const struct vec8 to = v8_sub(V8_SET(g->around.c), o);
        const struct real8 shift = v8_dot(to, l->u);
        const struct vec8 off = v8_mad(to, r8_neg(shift), l->u);
        const struct real8 most = r8_add(r8_set(r * r * (1 + 0x1p-30)),
                                         r8_mul(r8_set(GAMMA(16)), v8_dot(to, to)));
        const struct real8 rest = r8_sub(most, v8_dot(off, off));
        unsigned near = lanes & ~m8_bits(r8_lt(rest, r8_set(0)));
        if (!near)
            continue;
        const struct real8 reach = r8_mul(r8_set(1 + 0x1p-30), r8_sqrt(rest));
        const struct real8 from = r8_div(r8_sub(shift, reach), l->length);
        const struct real8 last = r8_div(r8_add(shift, reach), l->length);
        near &= m8_bits(m8_and(r8_le(l->lo, last), r8_le(from, l->hi)));
        if (near && g->degree == 1)
            near &= ~passes_by(g, off, l->u, shift);
        double t[8];
        r8_store(t, from);
        for (; near; near &= near - 1) {
            const int k = __builtin_ctz(near);
            if (out->count[k] < NEAR)
                out->at[k][out->count[k]++] = (struct sweep_near){i, t[k]};
            else
                *odd |= 1u << k;
        }
    }
}

unsigned OF_ISA(sweep_closest8_)(const struct sweep *s, const struct shape_rays *rays,
                                 unsigned lanes, struct shape_hits *out, unsigned *odd)
{
    const struct vec8 o = v8_load(rays->o), d = v8_load(rays->d);
    struct lines8 l = {.length = r8_sqrt(v8_dot(d, d)),
                       .lo = r8_load(rays->t_min),
                       .hi = r8_load(rays->t_max)};
    const struct real8 scale = r8_div(r8_set(1), l.length);
    l.u = (struct vec8){r8_mul(scale, d.x), r8_mul(scale, d.y), r8_mul(scale, d.z)};
    struct near8 near;
    for (int i = 0; i < 8; i++)
        near.count[i] = 0;
    *odd = 0;
    look(s, &l, o, lanes, &near, odd);
    unsigned met = 0;
    for (unsigned m = lanes & ~*odd; m; m &= m - 1) {
        const int k = __builtin_ctz(m);
        if (!near.count[k])
            continue;
        const struct ray ray = shape_rays_lane(rays, k);
        struct boundary b;
        bool many = false;
        if (sweep_first(s, &ray, near.at[k], near.count[k], &b, &many)) {
            shape_hits_put(out, k, &b);
            met |= 1u << k;
        }
        *odd |= many ? 1u << k : 0;
    }
    return met;
}
