// Rings at eight points, for scene/patterns/rings.h: each expression is the one there.
// Compiled once per instruction set: ISA names it.
#include "math/isa.h"
#include "math/lanes_vec.h"
#include "scene/noise.h"
#include "scene/noise_kernel.h"
#include "scene/pattern_lanes.h"

struct ring8 {
    struct vec8 from;
    struct real8 length, sine;
    double frequency;
};

LANES_INLINE struct ring8 ring8_at(const struct noise_rings *r, int i, struct vec8 at)
{
    const struct vec3 source = noise_wave_source(i);
    struct ring8 x = {.from = v8_sub(at, V8_SET(source)),
                      .frequency = r->own_widths ? noise_wave_frequency(i) : 1};
    const struct real8 length = r8_sqrt(v8_dot(x.from, x.from));
    x.length = r8_select(r8_eq(length, r8_set(0)), r8_set(1), length);
    x.sine = cycloidal8(
        r8_add(r8_mul(r8_mul(x.length, r8_set(r->frequency)), r8_set(x.frequency)),
               r8_set(r->phase)));
    return x;
}

void OF_ISA(noise_rings_)(const double p[3][8], const struct noise_rings *r,
                          double out[8])
{
    const struct vec8 at = v8_load(p);
    struct real8 sum = r8_set(0);
    for (int i = 0; i < r->count; i++) {
        const struct ring8 x = ring8_at(r, i, at);
        sum = r8_add(sum, r8_div(x.sine, r8_set(x.frequency)));
    }
    r8_store(out, r8_div(sum, r8_set(r->count)));
}

void OF_ISA(noise_ring_slopes_)(const double p[3][8], const struct noise_rings *r,
                                float amount, double n[3][8])
{
    const struct vec8 at = v8_load(p);
    struct vec8 sum = v8_load((const double(*)[8])n);
    for (int i = 0; i < r->count; i++) {
        const struct ring8 x = ring8_at(r, i, at);
        const struct real8 s = r8_mul(x.sine, r8_set(amount / x.frequency));
        sum = v8_mad(sum, r8_div(s, r8_mul(x.length, r8_set(r->count))), x.from);
    }
    v8_store(n, sum);
}
