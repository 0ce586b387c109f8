#ifndef SCENE_PATTERNS_FRACTAL_H
#define SCENE_PATTERNS_FRACTAL_H

#include "scene/pattern_math.h"

// mandel, julia and magnet (spec/textures 5.6). Parameters: integer[0] iterations,
// vector c of julia; magnet: integer[1] type, integer[2] whether it is a julia set.

struct complex_number {
    double a, b;
};

static inline struct complex_number complex_mul(struct complex_number z,
                                                struct complex_number w)
{
    return (struct complex_number){z.a * w.a - z.b * w.b, z.a * w.b + z.b * w.a};
}

static inline void fractal_init(struct pattern *p)
{
    p->exterior_type = 1;
    p->exterior_factor = 1;
    p->interior_type = 0;
    p->interior_factor = 1;
    p->fractal_exponent = 2;
}

static inline double fractal_steps(int step, double period, double factor)
{
    const unsigned n = period >= 1 && period < 4294967296.0 ? (unsigned)period : 0;
    return n ? (unsigned)step % n / factor : 0;
}

static inline double fractal_exterior(const struct pattern *p, int step,
                                      struct complex_number z)
{
    const double f = p->exterior_factor;
    switch (p->exterior_type) {
    case 0: return f;
    case 1: return (double)step / p->integer[0];
    case 2: return z.a * f;
    case 3: return z.b * f;
    case 4: return z.a * z.a * f;
    case 5: return z.b * z.b * f;
    case 6: return sqrt(z.a * z.a + z.b * z.b) * f;
    case 7: return fractal_steps(step, f, f);
    case 8: return fractal_steps(step, 1 + f, f);
    default: return 0;
    }
}

// `least` is the smallest squared modulus on the way.
static inline double fractal_interior(const struct pattern *p, double least,
                                      struct complex_number z)
{
    const double f = p->interior_factor;
    switch (p->interior_type) {
    case 0: return f;
    case 1: return sqrt(least) * f;
    case 2: return z.a * f;
    case 3: return z.b * f;
    case 4: return z.a * z.a * f;
    case 5: return z.b * z.b * f;
    case 6: return z.a * z.a + z.b * z.b * f; // the factor is for b alone
    default: return 0;
    }
}

static inline struct complex_number complex_power(struct complex_number z, int e)
{
    struct complex_number w = z;
    if (e == 4) {
        w = complex_mul(z, z);
        return complex_mul(w, w);
    }
    for (int i = 1; i < e; i++)
        w = complex_mul(w, z);
    return w;
}

// z <- z^e + c from z, until it leaves the circle of radius 2.
static inline double fractal_value(const struct pattern *p, struct complex_number z,
                                   struct complex_number c)
{
    double least = z.a * z.a + z.b * z.b;
    for (int step = 0; step < p->integer[0]; step++) {
        z = complex_power(z, p->fractal_exponent);
        z.a += c.a;
        z.b += c.b;
        const double d = z.a * z.a + z.b * z.b;
        if (d < least)
            least = d;
        if (d > 4)
            return fractal_exterior(p, step, z);
    }
    return fractal_interior(p, least, z);
}

#endif
