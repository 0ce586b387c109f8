// The internal functions that take more than a formula.

#include "eval/internal_math.h"

#define WRITTEN(name)                                                                    \
    double internal_##name(struct vec3 at, const double *p,                              \
                           const struct pattern_defaults *d)
#define POINT(q)                                                                         \
    const double x = (q).x, y = (q).y, z = (q).z, A = x * x, B = y * y, C = z * z;       \
    (void)x, (void)y, (void)z, (void)A, (void)B, (void)C, (void)p, (void)d

// They overlap long before.
enum { TUBES_MAX = 100000 };

static inline double limited(double v) { return bounded(v, 10); }

// Not the sign of its three relatives.
WRITTEN(algbr_cyl1)
{
    POINT(revolved(at, p + 2));
    return -bounded(p[0] * -(A * fabs(x) - A + B), p[1]);
}

WRITTEN(blob)
{
    POINT(at);
    const double h = p[0] / 2;
    double a = smaller(1, (square(x + h) + B + C) * p[2] * p[2]);
    double b = smaller(1, (square(x - h) + B + C) * p[4] * p[4]);
    return -(p[1] * square(1 - a) + p[3] * square(1 - b));
}

WRITTEN(boy_surface)
{
    POINT(at);
    const double g = 1 - z, h = A + B, root2 = sqrt(2);
    double a = 64 * cube(g) * cube(z);
    double b = 48 * g * g * C * (3 * h + 2 * C);
    double c = 27 * h * h - 24 * C * h + 36 * root2 * y * z * (B - 3 * A) + 4 * C * C;
    double e = -81 * h * h - 72 * C * h + 108 * root2 * x * z * (A - 3 * B) + 4 * C * C;
    return limited(p[0] * p[1] * (a - b + 12 * g * z * c + (9 * h - 2 * C) * e));
}

WRITTEN(comma)
{
    at.x = off_axis(at, 1e-4);
    POINT(at);
    double t = det_atan2(z, x), r = sqrt(square(x + p[0] / 4) + C);
    double a = smaller(z, det_cos(t / 2) * p[0] / 2 - sqrt(square(r - 0.75 * p[0]) + B));
    double b = p[0] / 2 - sqrt(square(x - p[0] / 2) + B + C);
    return -larger(a, b);
}

struct lobes {
    double z, y, x;
};

// Three ellipsoids of density, along each axis.
static struct lobes lobes_at(struct vec3 at, const double *p)
{
    const double A = at.x * at.x, B = at.y * at.y, C = at.z * at.z;
    return (struct lobes){.z = det_exp(-p[1] * (p[0] * A + p[0] * B + C)),
                          .y = det_exp(-p[1] * (p[0] * A + B + p[0] * C)),
                          .x = det_exp(-p[1] * (A + p[0] * B + p[0] * C))};
}

WRITTEN(cross_ellipsoids)
{
    (void)d;
    struct lobes e = lobes_at(at, p);
    return p[3] - p[2] * larger(e.z, larger(e.y, e.x));
}

WRITTEN(isect_ellipsoids)
{
    (void)d;
    struct lobes e = lobes_at(at, p);
    return p[3] - p[2] * smaller(e.z, smaller(e.y, e.x));
}

WRITTEN(flange_cover)
{
    (void)d;
    struct lobes e = lobes_at(at, p);
    return p[3] - p[2] * (e.z + e.y + e.x);
}

WRITTEN(spikes)
{
    POINT(at);
    struct lobes e = lobes_at(at, p);
    return -p[2] * (p[4] * det_exp(-p[3] * (A + B + C)) - e.z - e.y - e.x);
}

WRITTEN(dupin_cyclid)
{
    POINT(at);
    const double r = p[5] * p[5], h = p[2] * p[2], t = p[4] * p[4];
    const double m = (h - t - square(p[3] + p[1])) * (h - t - square(p[3] - p[1]));
    double a = m * (A * A + B * B + C * C) + 2 * m * (A * B + A * C + B * C);
    double b = (h + p[1] * p[1] - t - p[3] * p[3]) * (2 * x * p[3] + 2 * y * p[4] - r) -
               4 * p[4] * h * y;
    double c = 4 * r * r * (p[3] * x + p[4] * y) * (p[4] * y + p[3] * x - r);
    double e = 4 * r * r * p[1] * p[1] * B + r * r * r * r;
    return limited(p[0] * -(a + 2 * r * b * (A + B + C) + c + e));
}

// The constant terms of the surface are lost, as the reference loses them.
WRITTEN(enneper)
{
    POINT(at);
    const double v = fabs(z) < 0.2 ? 0.2 : z;
    double a = (B - A) / (2 * v) + 2 * C / 9, b = (B - A) / (4 * v);
    return limited(p[0] * -(cube(a) - 6 * b * b));
}

WRITTEN(helical_torus)
{
    const double s = sqrt(at.x * at.x + at.z * at.z);
    at.x = off_axis(at, 1e-6);
    POINT(at);
    double around = det_atan2(x, z), r = sqrt(square(s - p[0]) + B);
    double turn = positive_mod(around * p[1] + det_atan2(s - p[0], y) * p[2],
                               2 * INTERNAL_PI) -
                  INTERNAL_PI;
    double v = det_cos(det_atan2(turn * p[8], r - p[5]) * p[7] + around * p[9]) * p[3] +
               p[4] - smaller(sqrt(square(r - p[5]) + turn * turn * p[6]), r + p[5]);
    return -larger(p[4] + p[5] - p[0] - s, v);
}

WRITTEN(helix1)
{
    const double r = sqrt(at.x * at.x + at.z * at.z);
    at.x = off_axis(at, 1e-6);
    POINT(at);
    double turn = positive_mod(det_atan2(z, x) * p[0] + y * p[1] * p[0], 2 * INTERNAL_PI);
    double v = (turn - INTERNAL_PI) / p[4] / (p[1] * p[0]), u = r - p[3];
    double q = section(u, v, 1);
    if (p[5] != 1) {
        double t = p[6] * INTERNAL_PI / 180, c = det_cos(t), s = det_sin(t);
        q = section(u * c - v * s, u * s + v * c, p[5]);
    }
    return smaller(p[3] + r, q) - p[2];
}

WRITTEN(helix2)
{
    POINT(at);
    double c = det_cos(y * p[1]), s = det_sin(y * p[1]);
    double a = x - p[3] * c, b = z - p[3] * s;
    return section(a * c + b * s, b * c - a * s, p[5]) - p[2];
}

struct hexagon {
    double a, b;
    bool near_side; // within 30 degrees of the side across x
};

static struct hexagon hexagon_at(struct vec3 at)
{
    const double root3 = sqrt(3);
    double a = fabs(fmod(fabs(at.x), root3) - root3 / 2);
    double b = fabs(fmod(fabs(at.y), 3) - 1.5);
    double c = root3 / 2 - a, e = 1.5 - b;
    if (a * a + b * b > c * c + e * e) {
        a = c;
        b = e;
    }
    return (struct hexagon){a, b, det_atan2(b, a) < INTERNAL_PI / 6};
}

WRITTEN(hex_x)
{
    (void)p, (void)d;
    struct hexagon h = hexagon_at(at);
    return h.near_side ? h.a : h.a / 2 + h.b * (sqrt(3) / 2);
}

WRITTEN(hex_y)
{
    (void)p, (void)d;
    struct hexagon h = hexagon_at(at);
    return h.near_side ? h.b : fabs(h.b / 2 - h.a * (sqrt(3) / 2));
}

WRITTEN(hyperbolic_torus)
{
    POINT(at);
    const double h = p[1] * p[1], t = p[2] * p[2];
    return limited(p[0] * -(A * A + 2 * A * B - 2 * A * C - 2 * (h + t) * A + B * B -
                            2 * B * C + 2 * (h - t) * B + C * C + 2 * (h + t) * C +
                            square(h - t)));
}

WRITTEN(parabolic_torus)
{
    POINT(at);
    const double h = p[1] * p[1], t = p[2] * p[2];
    return limited(p[0] * -(A * A + 2 * A * B - 2 * A * z - (h + t) * A + B * B -
                            2 * B * z + (h - t) * B + C + (h + t) * z + square(h - t)));
}

WRITTEN(torus2)
{
    POINT(at);
    const double h = p[1] * p[1], t = p[2] * p[2];
    return limited(p[0] * -(square(A + B + C) - 2 * (h + t) * A + 2 * (h - t) * B -
                            2 * (h + t) * C + square(h - t)));
}

WRITTEN(klein_bottle)
{
    POINT(at);
    const double w = A + B + C, v = w - 2 * y - 1;
    return limited(p[0] * -((w + 2 * y - 1) * (v * v - 8 * C) + 16 * x * z * v));
}

// The distance from a wire that sways along y.
static double wire(double along, double spacing, double y, double sway, const double *p)
{
    double off = fabs(positive_mod(along, 2 * spacing) - spacing) * p[2];
    return sqrt(square((y - sway * p[3]) * p[4]) + off * off);
}

WRITTEN(mesh1)
{
    POINT(at);
    double cz = det_cos(z * INTERNAL_PI / p[1]), cx = det_cos(x * INTERNAL_PI / p[0]);
    double a = wire(x, p[0], y, cz, p), b = wire(x - p[0], p[0], y, -cz, p);
    double c = wire(z, p[1], y, -cx, p), e = wire(z - p[1], p[1], y, cx, p);
    return smaller(smaller(a, b), smaller(c, e));
}

WRITTEN(piriform)
{
    POINT(at);
    return -limited(p[0] * -(A * A - A * x + B + C));
}

WRITTEN(polytubes)
{
    POINT(at);
    double r = p[1] + p[2] * y + p[3] * B + p[4] * B * y + p[5] * B * B, v = 10000;
    for (int i = 0; i + 1 <= p[0] && i < TUBES_MAX; i++) {
        double t = 2 * INTERNAL_PI * i / p[0];
        v = smaller(v, sqrt(square(x - r * det_sin(t)) + square(z - r * det_cos(t))));
    }
    return v;
}

WRITTEN(quantum)
{
    at.x = off_axis(at, 1e-6);
    POINT(at);
    double c = det_cos(det_atan2(sqrt(A + C), y)), r = 2 * sqrt(A + B + C);
    double q = r * r * det_exp(-0.33333333 * r) * (3 * c * c - 1);
    return -0.1 * (q * q - 12);
}

WRITTEN(rounded_box)
{
    POINT(at);
    double a = larger(0, fabs(x) - (p[1] - p[0])), b = larger(0, fabs(y) - (p[2] - p[0]));
    double c = larger(0, fabs(z) - (p[3] - p[0]));
    return sqrt(a * a + b * b + c * c) - p[0] - 1e-6;
}

WRITTEN(spiral)
{
    const double r = sqrt(at.x * at.x + at.z * at.z);
    at.x = off_axis(at, 1e-6);
    POINT(at);
    double q = fmod(r + p[0] * det_atan2(z, x) / (2 * INTERNAL_PI), p[0]) - p[0] / 2;
    double s = sqrt(A + B + C);
    return -smaller(p[2] - s, p[1] - smaller(section(q, y, p[5]), s));
}
