// magnet 1|2 mandel|julia: the two maps of magnetic phase transitions (Peitgen and
// Richter, The Beauty of Fractals, 1986)

#include "scene/noise_kernel.h"
#include "scene/patterns/fractal.h"

static struct complex_number complex_div(struct complex_number z, struct complex_number w)
{
    const double d = w.a * w.a + w.b * w.b;
    return (struct complex_number){(z.a * w.a + z.b * w.b) / d,
                                   (z.b * w.a - z.a * w.b) / d};
}

// ((z^2 + c - 1) / (2z + c - 2))^2
static struct complex_number step_1(struct complex_number z, struct complex_number c)
{
    struct complex_number n = complex_mul(z, z);
    n.a += c.a - 1;
    n.b += c.b;
    const struct complex_number d = {2 * z.a + c.a - 2, 2 * z.b + c.b};
    const struct complex_number q = complex_div(n, d);
    return complex_mul(q, q);
}

// ((z^3 + 3(c-1)z + (c-1)(c-2)) / (3z^2 + 3(c-2)z + (c-1)(c-2) + 1))^2
static struct complex_number step_2(struct complex_number z, struct complex_number c)
{
    const struct complex_number c1 = {c.a - 1, c.b}, c2 = {c.a - 2, c.b};
    const struct complex_number c12 = complex_mul(c1, c2), zz = complex_mul(z, z);
    const struct complex_number zzz = complex_mul(zz, z);
    const struct complex_number u = complex_mul(c1, z), v = complex_mul(c2, z);
    const struct complex_number n = {zzz.a + 3 * u.a + c12.a, zzz.b + 3 * u.b + c12.b};
    const struct complex_number d = {3 * zz.a + 3 * v.a + c12.a + 1,
                                     3 * zz.b + 3 * v.b + c12.b};
    const struct complex_number q = complex_div(n, d);
    return complex_mul(q, q);
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *context)
{
    (void)context;
    const bool julia = p->integer[2] != 0;
    struct complex_number z = {0, 0}, c = {at.x, at.y};
    double least = 10000;
    if (julia) {
        z = c;
        c = (struct complex_number){p->vector.x, p->vector.y};
        least = z.a * z.a + z.b * z.b;
    }
    for (int step = 0; step < p->integer[0]; step++) {
        z = p->integer[1] == 2 ? step_2(z, c) : step_1(z, c);
        const double d = z.a * z.a + z.b * z.b;
        if (d < least)
            least = d;
        const double near = (z.a - 1) * (z.a - 1) + z.b * z.b;
        if (d > 10000 || near < 1 / 10000.0)
            return fractal_exterior(p, step, z);
    }
    return fractal_interior(p, least, z);
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    k->fractal(p, FRACTAL_MAGNET, at, out);
}

const struct pattern_ops magnet_pattern_ops = {.keyword = "magnet",
                                               .frequency = 1,
                                               .init = fractal_init,
                                               .value = value,
                                               .values = values};
