// What subsurface.c asks of eight numbers at a time, compiled once per instruction set: ISA
// names it.
#include "trace/subsurface_kernel.h"
#include "math/isa.h"
#include "math/lanes_vec.h"
#include "math/pi.h"
#include "math/power_lanes.h"
#include "math/trig_lanes.h"

// What a half space sends back of light that falls on it, by its albedo.
LANES_INLINE struct real8 half_space(struct real8 albedo, double a)
{
    const struct real8 one = r8_set(1),
                       q = r8_sqrt(r8_mul(r8_set(3), r8_sub(one, albedo))),
                       k = r8_mul(r8_set(-4.0 / 3 * a), q);
    return r8_mul(r8_mul(r8_mul(albedo, r8_set(0.5)), r8_add(one, det_exp8(k))),
                  det_exp8(r8_neg(q)));
}

static void albedos(const double color[8], double a, double out[8])
{
    const struct real8 wanted = r8_load(color), half = r8_set(0.5);
    struct real8 low = r8_set(0), high = r8_set(1);
    for (int i = 0; i < 40; i++) {
        const struct real8 middle = r8_mul(r8_add(low, high), half);
        const struct mask8 less = r8_lt(half_space(middle, a), wanted);
        low = r8_select(less, middle, low);
        high = r8_select(less, high, middle);
    }
    r8_store(out, r8_mul(r8_add(low, high), half));
}

LANES_INLINE struct real8 pole(double z, double sigma_tr, struct real8 r2)
{
    const struct real8 d2 = r8_add(r8_set(z * z), r2), d = r8_sqrt(d2);
    const struct real8 k =
        r8_mul(r8_set(z), r8_add(r8_set(sigma_tr), r8_div(r8_set(1), d)));
    return r8_div(r8_mul(k, det_exp8(r8_mul(r8_set(-sigma_tr), d))), d2);
}

static void dipoles(const struct sss_channel *c, const double *r2, uint32_t count,
                    double *out)
{
    for (uint32_t i = 0; i < count; i += 8) {
        const struct real8 at = r8_load(r2 + i);
        const struct real8 sum =
            r8_add(r8_add(r8_set(0), pole(c->z_real, c->sigma_tr, at)),
                   pole(c->z_virtual, c->sigma_tr, at));
        r8_store(out + i, r8_mul(r8_set(c->albedo / (4 * PI)), sum));
    }
}

// The fraction of a number from 0 to 2.
LANES_INLINE struct real8 turned(struct real8 v, double by)
{
    const struct real8 x = r8_add(v, r8_set(by));
    return r8_sub(x, r8_floor(x));
}

static void ways(const double *u, const double *v, double by_u, double by_v,
                 uint32_t count, double *const d[3])
{
    for (uint32_t i = 0; i < count; i += 8) {
        const struct real8 one = r8_set(1),
                           y = r8_sub(one,
                                      r8_mul(r8_set(2), turned(r8_load(u + i), by_u))),
                           rest = r8_sub(one, r8_mul(y, y)),
                           r = r8_sqrt(r8_max(r8_set(0), rest)),
                           w = r8_mul(r8_set(2 * PI), turned(r8_load(v + i), by_v));
        r8_store(d[0] + i, r8_mul(r, det_cos8(w)));
        r8_store(d[1] + i, y);
        r8_store(d[2] + i, r8_mul(r, det_sin8(w)));
    }
}

const struct subsurface_kernels OF_ISA(subsurface_kernels_) = {albedos, dipoles, ways};
