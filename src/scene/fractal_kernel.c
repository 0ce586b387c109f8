// mandel, julia and magnet at eight points, for scene/patterns/fractal.h: each expression is
// the one there and in patterns/magnet.c. Compiled once per instruction set: ISA names it.
#include "math/isa.h"
#include "math/lanes.h"
#include "scene/noise_kernel.h"
#include "scene/patterns/fractal.h"

struct complex8 {
    struct real8 a, b;
};

LANES_INLINE struct complex8 complex8_mul(struct complex8 z, struct complex8 w)
{
    return (struct complex8){r8_sub(r8_mul(z.a, w.a), r8_mul(z.b, w.b)),
                             r8_add(r8_mul(z.a, w.b), r8_mul(z.b, w.a))};
}

LANES_INLINE struct real8 complex8_square(struct complex8 z)
{
    return r8_add(r8_mul(z.a, z.a), r8_mul(z.b, z.b));
}

LANES_INLINE struct complex8 complex8_div(struct complex8 z, struct complex8 w)
{
    const struct real8 d = complex8_square(w);
    return (struct complex8){r8_div(r8_add(r8_mul(z.a, w.a), r8_mul(z.b, w.b)), d),
                             r8_div(r8_sub(r8_mul(z.b, w.a), r8_mul(z.a, w.b)), d)};
}

LANES_INLINE struct complex8 power_step(struct complex8 z, struct complex8 c, int e)
{
    struct complex8 w = z;
    if (e == 4) {
        w = complex8_mul(z, z);
        w = complex8_mul(w, w);
    } else {
        for (int i = 1; i < e; i++)
            w = complex8_mul(w, z);
    }
    return (struct complex8){r8_add(w.a, c.a), r8_add(w.b, c.b)};
}

// power_step with 2; the squares of z's parts are known.
LANES_INLINE struct complex8 square_step(struct complex8 z, struct complex8 squares,
                                         struct complex8 c)
{
    const struct real8 ab = r8_mul(z.a, z.b);
    return (struct complex8){r8_add(r8_sub(squares.a, squares.b), c.a),
                             r8_add(r8_add(ab, ab), c.b)};
}

LANES_INLINE struct complex8 magnet_step_1(struct complex8 z, struct complex8 c)
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

LANES_INLINE struct complex8 magnet_step_2(struct complex8 z, struct complex8 c)
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

// The lanes of `gone` escape at this step.
static void exteriors(const struct pattern *p, int step, unsigned gone, struct complex8 z,
                      double out[8])
{
    double a[8], b[8];
    r8_store(a, z.a);
    r8_store(b, z.b);
    for (; gone; gone &= gone - 1) {
        const int i = __builtin_ctz(gone);
        out[i] = fractal_exterior(p, step, (struct complex_number){a[i], b[i]});
    }
}

// Those of `kept` never do.
static void interiors(const struct pattern *p, unsigned kept, struct real8 least,
                      struct complex8 z, double out[8])
{
    double a[8], b[8], smallest[8];
    r8_store(a, z.a);
    r8_store(b, z.b);
    r8_store(smallest, least);
    for (; kept; kept &= kept - 1) {
        const int i = __builtin_ctz(kept);
        out[i] = fractal_interior(p, smallest[i], (struct complex_number){a[i], b[i]});
    }
}

enum map { SQUARE, CUBE, POWER, MAGNET_1, MAGNET_2 };

LANES_INLINE struct complex8 step_of(enum map map, const struct pattern *p,
                                     struct complex8 z, struct complex8 squares,
                                     struct complex8 c)
{
    return map == SQUARE     ? square_step(z, squares, c)
           : map == CUBE     ? power_step(z, c, 3)
           : map == POWER    ? power_step(z, c, p->fractal_exponent)
           : map == MAGNET_1 ? magnet_step_1(z, c)
                             : magnet_step_2(z, c);
}

LANES_INLINE unsigned ending(enum map map, struct complex8 z, struct real8 square)
{
    if (map < MAGNET_1)
        return m8_bits(r8_lt(r8_set(4), square));
    const struct real8 off = r8_sub(z.a, r8_set(1));
    const struct real8 near = r8_add(r8_mul(off, off), r8_mul(z.b, z.b));
    return m8_bits(m8_or(r8_lt(r8_set(10000), square), r8_lt(near, r8_set(1 / 10000.0))));
}

// Points of the Mandelbrot set's cardioid and of its largest disc never escape. The edge left
// out is wide against roundings: an orbit comes nearer to its cycle by about that share of the
// distance a step, so that roundings of 2^-52 never carry it farther than 2^-52 / INNER_EDGE.
#define INNER_EDGE 1e-6
LANES_INLINE unsigned mandel_inner(struct complex8 c)
{
    const struct real8 quarter = r8_set(0.25), x = r8_sub(c.a, quarter),
                       yy = r8_mul(c.b, c.b), q = r8_add(r8_mul(x, x), yy);
    const struct real8 u = r8_add(c.a, r8_set(1));
    const struct mask8 cardioid =
        r8_lt(r8_mul(q, r8_add(q, x)), r8_sub(r8_mul(quarter, yy), r8_set(INNER_EDGE)));
    return m8_bits(
        m8_or(cardioid, r8_lt(r8_add(r8_mul(u, u), yy), r8_set(0.0625 - INNER_EDGE))));
}

// Those of `live`.
LANES_INLINE void iterate(enum map map, const struct pattern *p, unsigned live,
                          struct complex8 z, struct complex8 c, struct real8 least,
                          double out[8])
{
    struct complex8 squares = {r8_mul(z.a, z.a), r8_mul(z.b, z.b)};
    for (int step = 0; live && step < p->integer[0]; step++) {
        z = step_of(map, p, z, squares, c);
        squares = (struct complex8){r8_mul(z.a, z.a), r8_mul(z.b, z.b)};
        const struct real8 square = r8_add(squares.a, squares.b);
        least = r8_min(square, least);
        const unsigned gone = live & ending(map, z, square);
        if (gone) {
            exteriors(p, step, gone, z, out);
            live &= ~gone;
        }
    }
    interiors(p, live, least, z, out);
}

void OF_ISA(noise_fractal_)(const struct pattern *p, enum fractal_kind kind,
                            const double at[3][8], double out[8])
{
    const struct complex8 point = {r8_load(at[0]), r8_load(at[1])};
    struct complex8 z = point, c = point;
    const bool magnet = kind == FRACTAL_MAGNET;
    if (kind == FRACTAL_JULIA || (magnet && p->integer[2]))
        c = (struct complex8){r8_set(p->vector.x), r8_set(p->vector.y)};
    else if (magnet)
        z = (struct complex8){r8_set(0), r8_set(0)};
    struct real8 least = complex8_square(z);
    if (magnet && !p->integer[2])
        least = r8_set(10000);
    unsigned live = 255;
    if (kind == FRACTAL_MANDEL && p->fractal_exponent == 2 && p->interior_type == 0) {
        const unsigned inner = mandel_inner(c);
        interiors(p, inner, least, z, out);
        live &= ~inner;
    }
    if (magnet && p->integer[1] == 2)
        iterate(MAGNET_2, p, live, z, c, least, out);
    else if (magnet)
        iterate(MAGNET_1, p, live, z, c, least, out);
    else if (p->fractal_exponent == 2)
        iterate(SQUARE, p, live, z, c, least, out);
    else if (p->fractal_exponent == 3)
        iterate(CUBE, p, live, z, c, least, out);
    else
        iterate(POWER, p, live, z, c, least, out);
}
