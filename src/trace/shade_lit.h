#ifndef TRACE_SHADE_LIT_H
#define TRACE_SHADE_LIT_H

// What eight surfaces make of the light from one direction.
#include "trace/shade.h"
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"

// highlight_power in the lanes of `bits`; 0 elsewhere.
LANES_INLINE struct float8 powers8(struct real8 q, double n, unsigned bits)
{
    static const double dark = 40, by_squares = 4096;
    bits &= m8_bits(r8_le(r8_mul(r8_set(n), r8_sub(r8_set(1), q)), r8_set(dark)));
    struct real8 power = r8_set(bits ? 1 : 0);
    if (bits && n == floor(n) && n >= 0 && n <= by_squares) {
        for (uint32_t k = (uint32_t)n; k; k >>= 1) {
            if (k & 1)
                power = r8_mul(power, q);
            q = r8_mul(q, q);
        }
    } else if (bits) {
        power = r8_pow_single(r8_select(m8_of(bits), q, r8_set(1)), n);
    }
    return f8_of(r8_select(m8_of(bits), power, r8_set(0)));
}

// The sum of phong and specular (highlights of trace/shade_light.c).
LANES_INLINE struct float8 highlights8(const struct finish *f, struct vec8 d,
                                       struct vec8 n, struct vec8 to, unsigned live)
{
    struct float8 sum = f8_set(0);
    if (f->phong != 0) {
        const double least = f->phong_size < 60 ? 0 : 0.0008;
        const struct vec8 r = v8_mad(d, r8_mul(r8_set(-2), v8_dot(d, n)), n);
        const struct real8 q = v8_dot(r, to);
        const unsigned bits = live & m8_bits(r8_lt(r8_set(least), q));
        if (bits)
            sum = f8_add(
                sum, f8_mul(f8_set(f->phong), powers8(q, (double)f->phong_size, bits)));
    }
    if (f->specular != 0) {
        const struct vec8 h = v8_sub(to, d);
        const struct real8 q = v8_dot(h, n), length = r8_sqrt(v8_dot(h, h));
        const unsigned bits =
            live & m8_bits(m8_and(r8_lt(r8_set(0), q), r8_lt(r8_set(0), length)));
        if (bits)
            sum = f8_add(sum,
                         f8_mul(f8_set(f->specular),
                                powers8(r8_div(q, length), (double)f->roughness, bits)));
    }
    return sum;
}

// A layer at eight points, as it is lit.
struct lit_layer {
    const struct finish *finish;
    const double (*d)[8], (*n)[8]; // of the ray; of the layer, towards the ray
    const float (*color)[8];       // red, green, blue
    const float *att;
    const float *crand; // the random number of each lane, if the finish has crand
};

// Metals tint their highlights.
LANES_INLINE struct rgb8 tinted(const struct lit_layer *l, struct float8 sum,
                                struct real8 facing)
{
    const struct float8 o = f8_set(0);
    if ((f8_le(sum, o) & f8_le(o, sum)) == 255)
        return (struct rgb8){o, o, o};
    return metal_tint8((struct rgb8){sum, sum, sum}, rgb8_load(l->color),
                       l->finish->metallic, facing);
}

// layer_lit; dull: without highlights. Takes lanes that get nothing out of *live.
LANES_INLINE struct rgb8 lit8(const struct lit_layer *l, bool side_test, bool dull,
                              struct vec8 to, unsigned *live)
{
    const struct finish *f = l->finish;
    const struct vec8 n = v8_load(l->n);
    const struct real8 facing = v8_dot(n, to);
    unsigned back = 0;
    if (side_test) {
        back = *live & m8_bits(r8_lt(facing, r8_set(NEAR_ZERO)));
        if (f->diffuse_back == 0) {
            *live &= ~back;
            back = 0;
        }
    }
    struct rgb8 c = rgb8_set((struct rgb){0, 0, 0});
    if (!*live)
        return c;
    if (f->diffuse > 0 || back) {
        struct real8 cosine = r8_abs(facing);
        if (f->brilliance != 1)
            cosine = r8_pow_single(cosine, (double)f->brilliance);
        const struct float8 strength =
            f8_select(back, f8_set(f->diffuse_back > 0 ? f->diffuse_back : 0),
                      f8_set(f->diffuse > 0 ? f->diffuse : 0));
        struct float8 i = f8_mul(f8_of(cosine), f8_mul(strength, f8_load(l->att)));
        if (f->crand > 0) {
            const struct float8 less =
                f8_sub(i, f8_mul(f8_set(f->crand), f8_load(l->crand)));
            i = f8_select(f8_le(strength, f8_set(0)), i, less);
        }
        c = rgb8_scale(i, rgb8_load(l->color));
    }
    if (!dull) {
        const struct float8 sum = highlights8(f, v8_load(l->d), n, to, *live & ~back);
        if (f->metallic != 0)
            c = rgb8_add(c, tinted(l, sum, facing));
        else
            c = rgb8_add(c, (struct rgb8){sum, sum, sum});
    }
    return c;
}

#endif
