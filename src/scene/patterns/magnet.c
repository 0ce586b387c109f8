// magnet 1|2 mandel|julia: the two maps of magnetic phase transitions (Peitgen and
// Richter, The Beauty of Fractals, 1986)

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

// ---- eight points, to the bit -----------------------------------------------------------
LANES_INLINE struct complex8 complex8_div(struct complex8 z, struct complex8 w)
{
    const struct real8 d = complex8_square(w);
    return (struct complex8){r8_div(r8_add(r8_mul(z.a, w.a), r8_mul(z.b, w.b)), d),
                             r8_div(r8_sub(r8_mul(z.b, w.a), r8_mul(z.a, w.b)), d)};
}

static struct complex8 steps_1(struct complex8 z, struct complex8 c)
{
    const struct real8 two = r8_set(2);
    struct complex8 n = complex8_mul(z, z);
    n.a = r8_add(n.a, r8_sub(c.a, r8_set(1)));
    n.b = r8_add(n.b, c.b);
    const struct complex8 d = {r8_sub(r8_add(r8_mul(two, z.a), c.a), two),
                               r8_add(r8_mul(two, z.b), c.b)};
    const struct complex8 q = complex8_div(n, d);
    return complex8_mul(q, q);
}

static struct complex8 steps_2(struct complex8 z, struct complex8 c)
{
    const struct real8 one = r8_set(1), three = r8_set(3);
    const struct complex8 c1 = {r8_sub(c.a, one), c.b},
                          c2 = {r8_sub(c.a, r8_set(2)), c.b};
    const struct complex8 c12 = complex8_mul(c1, c2), zz = complex8_mul(z, z);
    const struct complex8 zzz = complex8_mul(zz, z);
    const struct complex8 u = complex8_mul(c1, z), v = complex8_mul(c2, z);
    const struct complex8 n = {r8_add(r8_add(zzz.a, r8_mul(three, u.a)), c12.a),
                               r8_add(r8_add(zzz.b, r8_mul(three, u.b)), c12.b)};
    const struct complex8 d = {
        r8_add(r8_add(r8_add(r8_mul(three, zz.a), r8_mul(three, v.a)), c12.a), one),
        r8_add(r8_add(r8_mul(three, zz.b), r8_mul(three, v.b)), c12.b)};
    const struct complex8 q = complex8_div(n, d);
    return complex8_mul(q, q);
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    (void)k;
    const struct real8 one = r8_set(1);
    struct complex8 z = {r8_set(0), r8_set(0)}, c = {r8_load(at[0]), r8_load(at[1])};
    struct real8 least = r8_set(10000);
    unsigned live = 255;
    if (p->integer[2]) {
        z = c;
        c = (struct complex8){r8_set(p->vector.x), r8_set(p->vector.y)};
        least = complex8_square(z);
    }
    for (int step = 0; live && step < p->integer[0]; step++) {
        z = p->integer[1] == 2 ? steps_2(z, c) : steps_1(z, c);
        const struct real8 d = complex8_square(z);
        least = r8_select(r8_lt(d, least), d, least);
        const struct real8 off = r8_sub(z.a, one);
        const struct real8 near = r8_add(r8_mul(off, off), r8_mul(z.b, z.b));
        const struct mask8 ends =
            m8_or(r8_lt(r8_set(10000), d), r8_lt(near, r8_set(1 / 10000.0)));
        const unsigned gone = live & m8_bits(ends);
        if (gone)
            fractal_exteriors(p, step, gone, z, out);
        live &= ~gone;
    }
    fractal_interiors(p, live, least, z, out);
}

const struct pattern_ops magnet_pattern_ops = {.keyword = "magnet",
                                               .frequency = 1,
                                               .init = fractal_init,
                                               .value = value,
                                               .values = values};
