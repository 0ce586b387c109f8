// Eight rays and a profile that is turned, compiled once per instruction set: which segments
// each line may meet. The rest is the one ray's (revolve.c).
#include "scene/shapes/lanes.h"
#include "scene/shapes/revolve.h"

// What rounding makes of those sums: ROUNDED of their terms, and the square of FAR of the
// origin's size. An origin off by e moves the distance R from the axis by as much, and R e is
// no more than a 2^-28-th of R^2 and 2^28 e^2.
#define ROUNDED 0x1p-28
#define FAR_2   0x1p-60

// The lines as struct line of revolve.c has them, from their points nearest to the axis.
struct turn8 {
    struct real8 q, y, dy, p; // |D_xz|^2; y and the squared distance there
    struct real8 far2;        // of the origin, squared
};

// The polynomial of a segment (revolve.h), q (h - y)^2 + dy^2 (p - r^2), is above zero outside.
// Says in which lanes all its Bernstein coefficients are above zero, or all below, by more
// than rounding.
static void sides8(const struct turn8 *l, const struct revolve_segment *s,
                   unsigned *outside, unsigned *inside)
{
    const struct real8 two_y = r8_add(l->y, l->y), dy2 = r8_mul(l->dy, l->dy);
    const struct real8 rest = r8_add(r8_mul(l->q, r8_mul(l->y, l->y)), r8_mul(dy2, l->p));
    struct real8 least = r8_set(INFINITY), most = r8_set(-INFINITY);
    for (int i = 0; i <= s->degree; i++) {
        const struct real8 h =
            r8_sub(r8_set(s->hull[1][i]), r8_mul(two_y, r8_set(s->hull[0][i])));
        const struct real8 b =
            r8_add(r8_sub(r8_mul(l->q, h), r8_mul(dy2, r8_set(s->hull[2][i]))), rest);
        least = r8_min(least, b);
        most = r8_max(most, b);
    }
    const struct real8 size =
        r8_add(r8_mul(l->q, r8_add(r8_set(s->most[1]),
                                   r8_mul(r8_abs(two_y), r8_set(s->most[0])))),
               r8_add(r8_mul(dy2, r8_set(s->most[2])), rest));
    const struct real8 noise = r8_add(r8_mul(r8_set(ROUNDED), size),
                                      r8_mul(r8_mul(r8_set(FAR_2), dy2), l->far2));
    *outside = m8_bits(r8_lt(noise, least));
    *inside = m8_bits(r8_lt(most, r8_neg(noise)));
}

unsigned OF_ISA(revolve_closest8_)(const struct revolve *s, const struct shape_rays *rays,
                                   unsigned lanes, bool any, struct shape_hits *out,
                                   unsigned *odd)
{
    const struct vec8 o = v8_load(rays->o), d = v8_load(rays->d);
    struct turn8 l = {.dy = d.y};
    uint32_t near[8][REVOLVE_FIRST_MAX], count[8] = {0};
    l.q = r8_add(r8_mul(d.x, d.x), r8_mul(d.z, d.z));
    const struct real8 m = r8_add(r8_mul(d.x, o.x), r8_mul(d.z, o.z));
    const struct real8 nearest = r8_div(r8_neg(m), l.q);
    // Nearly flat lines, and those along the axis, are not for these sums.
    const struct mask8 steep =
        r8_lt(r8_mul(r8_set(REVOLVE_NEARLY_FLAT), r8_sqrt(l.q)), r8_abs(d.y));
    const struct mask8 slanted =
        r8_lt(r8_mul(r8_set(0x1p-20), r8_abs(d.y)), r8_sqrt(l.q));
    *odd = lanes & ~m8_bits(m8_and(steep, slanted));
    lanes &= ~*odd;
    const struct real8 x = r8_add(o.x, r8_mul(nearest, d.x));
    const struct real8 z = r8_add(o.z, r8_mul(nearest, d.z));
    l.p = r8_add(r8_mul(x, x), r8_mul(z, z));
    l.y = r8_add(o.y, r8_mul(nearest, d.y));
    l.far2 = r8_mul(v8_max_abs(o), v8_max_abs(o));
    unsigned some = 0; // lanes that are not outside of all
    for (uint32_t i = 0; i < s->count; i++) {
        unsigned outside, inside;
        sides8(&l, &s->segment[i], &outside, &inside);
        some |= lanes & ~outside;
        for (unsigned left = lanes & ~outside & ~inside; left; left &= left - 1) {
            const int k = __builtin_ctz(left);
            if (count[k] < REVOLVE_FIRST_MAX)
                near[k][count[k]++] = i;
            else
                *odd |= 1u << k;
        }
    }
    unsigned met = 0;
    for (unsigned left = some & ~*odd; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        const struct ray ray = shape_rays_lane(rays, k);
        struct boundary b;
        if (!revolve_first(s, &ray, near[k], count[k], any, &b))
            continue;
        shape_hits_put(out, k, &b);
        met |= 1u << k;
    }
    return met;
}
