// quadric { <xx, yy, zz>, <xy, xz, yz>, <x, y, z>, constant }

#include "scene/shapes/quadric.h"

#include <math.h>

#include "math/gamma.h"
#include "scene/args.h"
#include "scene/shape.h"

// Q v, Q the symmetric matrix of the second-order terms.
static struct vec3 times(const struct quadric *s, struct vec3 v)
{
    return vec3(s->xx * v.x + 0.5 * (s->xy * v.y + s->xz * v.z),
                s->yy * v.y + 0.5 * (s->xy * v.x + s->yz * v.z),
                s->zz * v.z + 0.5 * (s->xz * v.x + s->yz * v.y));
}

// Powers of two only, so that no digit is lost: T27.
static void normalize(struct quadric *s)
{
    double *const c[] = {&s->xx, &s->yy,       &s->zz,       &s->xy,       &s->xz,
                         &s->yz, &s->linear.x, &s->linear.y, &s->linear.z, &s->constant};
    double big = 0;
    for (int i = 0; i < 9; i++)
        big = fmax(big, fabs(*c[i]));
    if (!(big > 0) || !isfinite(big))
        return;
    int e;
    frexp(big, &e);
    for (int i = 0; i < 10; i++)
        *c[i] = ldexp(*c[i], 1 - e);
}

// Moves the origin to the centre: 2 Q c = -linear, axis by axis where nothing is mixed,
// by Cramer's rule where Q has an inverse. Paraboloids keep their linear part.
static void find_centre(struct quadric *s)
{
    if (s->xy == 0 && s->xz == 0 && s->yz == 0) {
        double *const l[] = {&s->linear.x, &s->linear.y, &s->linear.z};
        double *const o[] = {&s->centre.x, &s->centre.y, &s->centre.z};
        const double q[] = {s->xx, s->yy, s->zz};
        for (int i = 0; i < 3; i++)
            if (q[i] != 0 && *l[i] != 0) {
                *o[i] = -*l[i] / (2 * q[i]);
                s->constant += *l[i] * *o[i] / 2;
                *l[i] = 0;
            }
        return;
    }
    const struct vec3 a = times(s, vec3(1, 0, 0)), b = times(s, vec3(0, 1, 0)),
                      c = times(s, vec3(0, 0, 1));
    const double det = vec3_dot(a, vec3_cross(b, c));
    if (fabs(det) < 0x1p-40 || vec3_dot(s->linear, s->linear) == 0)
        return;
    const struct vec3 l = vec3_scale(-0.5, s->linear);
    s->centre =
        vec3(vec3_dot(l, vec3_cross(b, c)) / det, vec3_dot(a, vec3_cross(l, c)) / det,
             vec3_dot(a, vec3_cross(b, l)) / det);
    s->constant += 0.5 * vec3_dot(s->linear, s->centre);
    s->linear = vec3(0, 0, 0);
}

static bool build(void *shape, struct args *args)
{
    struct quadric *s = shape;
    struct vec3 square, mixed;
    if (!args_vec3(args, "squares", &square) || !args_vec3(args, "mixed terms", &mixed) ||
        !args_vec3(args, "linear terms", &s->linear) ||
        !args_float(args, "constant", &s->constant))
        return false;
    s->xx = square.x;
    s->yy = square.y;
    s->zz = square.z;
    s->xy = mixed.x;
    s->xz = mixed.y;
    s->yz = mixed.z;
    normalize(s);
    find_centre(s);
    return true;
}

// A pure translation moves the centre and nothing else.
static bool absorb(void *shape, const struct transform *t)
{
    struct quadric *s = shape;
    const struct mat3 *m = &t->linear;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (m->m[i][j] != (i == j))
                return false;
    s->centre = vec3_add(s->centre, t->offset);
    return true;
}

// Finite along an axis where the set is an ellipsoid or an elliptic cylinder across it.
static struct aabb bounds(const void *shape)
{
    const struct quadric *s = shape;
    struct aabb b = aabb_infinite();
    if (s->xy != 0 || s->xz != 0 || s->yz != 0)
        return b;
    const double q[] = {s->xx, s->yy, s->zz};
    double *const lo[] = {&b.min.x, &b.min.y, &b.min.z};
    double *const hi[] = {&b.max.x, &b.max.y, &b.max.z};
    if (q[0] < 0 || q[1] < 0 || q[2] < 0 || vec3_dot(s->linear, s->linear) != 0)
        return b;
    if (s->constant > 0)
        return aabb_empty();
    for (int i = 0; i < 3; i++)
        if (q[i] > 0) {
            const double r = sqrt(-s->constant / q[i]), c = vec3_axis(s->centre, i);
            *lo[i] = c - r;
            *hi[i] = c + r;
        }
    return aabb_pad(b);
}

// The least of k x^2 + l x (one of them is 0) for x from lo to hi.
static double least_term(double k, double l, double lo, double hi)
{
    if (k > 0)
        return lo <= 0 && hi >= 0 ? 0 : k * fmin(lo * lo, hi * hi);
    if (k < 0)
        return k * fmax(lo * lo, hi * hi);
    return l == 0 ? 0 : fmin(l * lo, l * hi);
}

// The term of each axis may be as large as the least of the others' leave it to be.
struct aabb quadric_bounds_within(const struct quadric *s, struct aabb box, double slack)
{
    if (s->xy != 0 || s->xz != 0 || s->yz != 0)
        return box;
    const double k[] = {s->xx, s->yy, s->zz},
                 l[] = {s->linear.x, s->linear.y, s->linear.z};
    double *const min[] = {&box.min.x, &box.min.y, &box.min.z};
    double *const max[] = {&box.max.x, &box.max.y, &box.max.z};
    for (int i = 0; i < 6; i++) { // twice: the first axis may gain by the last
        double room = -s->constant, size = fabs(s->constant);
        for (int j = 1; j < 3; j++) {
            const int a = (i + j) % 3;
            const double c = vec3_axis(s->centre, a);
            const double least = least_term(k[a], l[a], *min[a] - c, *max[a] - c);
            room -= least;
            size += fabs(least) + fabs(k[a]) * c * c + fabs(l[a] * c);
        }
        const int a = i % 3;
        const double c = vec3_axis(s->centre, a);
        room += slack * size;
        if (!(room < INFINITY) || k[a] < 0 || (k[a] == 0 && l[a] == 0))
            continue;
        if (room < 0 && k[a] > 0)
            return aabb_empty();
        const double end = k[a] > 0 ? sqrt(room / k[a]) : room / l[a];
        const double more = slack * (fabs(end) + fabs(c));
        if (k[a] > 0 || l[a] > 0)
            *max[a] = fmin(*max[a], c + end + more);
        if (k[a] > 0)
            *min[a] = fmax(*min[a], c - end - more);
        else if (l[a] < 0)
            *min[a] = fmax(*min[a], c + end - more);
    }
    return box;
}

// An ellipsoid is a ball scaled by its half axes.
static struct aabb placed_bounds(const void *shape, const struct transform *t)
{
    const struct quadric *s = shape;
    const struct aabb own = bounds(shape);
    if (!aabb_is_finite(own))
        return aabb_pad(aabb_transform(own, t));
    const struct vec3 r = vec3_scale(0.5, vec3_sub(own.max, own.min));
    double e[3];
    for (int i = 0; i < 3; i++) {
        const double x = r.x * t->linear.m[0][i], y = r.y * t->linear.m[1][i],
                     z = r.z * t->linear.m[2][i];
        e[i] = sqrt(x * x + y * y + z * z);
    }
    return aabb_around(s->centre, e, t);
}

static double value_at(const struct quadric *s, struct vec3 q)
{
    return vec3_dot(q, times(s, q)) + vec3_dot(s->linear, q) + s->constant;
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct quadric *s = shape;
    return value_at(s, vec3_sub(p, s->centre)) <= 0;
}

// o = origin - centre moved by `shift` to the point of the line nearest to the centre;
// a = d.Qd, b = d.Qo + linear.d/2, c = o.Qo + linear.o + constant; roots by
// q = -(b + sign(b) sqrt(b^2 - a c)): q/a and c/q (no cancellation; T28).
static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct quadric *s = shape;
    const struct vec3 d = ray->d;
    const struct vec3 oc = vec3_sub(ray->o, s->centre);
    const double dd = vec3_dot(d, d), shift = -vec3_dot(oc, d) / dd;
    const struct vec3 o = vec3_mad(oc, shift, d);
    const struct vec3 qd = times(s, d), qo = times(s, o);
    const double a = vec3_dot(d, qd);
    const double b = vec3_dot(d, qo) + 0.5 * vec3_dot(s->linear, d);
    const double c = vec3_dot(o, qo) + vec3_dot(s->linear, o) + s->constant;
    const double disc = b * b - a * c;
    if (!(disc > 0))
        return;
    const double root = sqrt(disc), q = -(b + copysign(root, b));
    double t[2] = {q / a, c / q};
    if (t[0] > t[1]) {
        const double swap = t[0];
        t[0] = t[1];
        t[1] = swap;
    }
    // How wrong f may be at a root, over its slope there (2 root).
    const double e_p = GAMMA(8) * (vec3_max_abs(ray->o) + vec3_max_abs(s->centre));
    const double size = vec3_max_abs(o);
    const double slope = 6 * size + vec3_max_abs(s->linear);
    const double e_f = GAMMA(24) * (6 * size * size + slope * size + fabs(s->constant)) +
                       e_p * (2 * slope + 6 * e_p);
    const double dt = e_f / fmax(2 * root, sqrt(fabs(a) * e_f));
    for (int i = 0; i < 2; i++) {
        if (!isfinite(t[i]))
            continue;
        // f falls through the first root of a > 0 and rises through the second.
        const bool entering = a != 0 ? (i == 0) == (a > 0) : b < 0;
        boundary_list_add(out, t[i] + shift, dt + GAMMA(4) * (fabs(t[i]) + fabs(shift)),
                          entering ? CROSS_ENTER : CROSS_EXIT, 0);
    }
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    const struct quadric *s = shape;
    const struct vec3 q = vec3_sub(p, s->centre);
    struct vec3 n = vec3_normalize(vec3_add(vec3_scale(2, times(s, q)), s->linear));
    if (vec3_dot(n, n) == 0)
        n = vec3(1, 0, 0); // the tip of a cone
    out->p = p;
    out->ng = out->ns = n;
}

static void print(const void *shape, FILE *out)
{
    const struct quadric *s = shape;
    const struct vec3 c = s->centre, l = s->linear;
    fputs("quadric { ", out);
    shape_print_vec3(out, vec3(s->xx, s->yy, s->zz));
    fputs(", ", out);
    shape_print_vec3(out, vec3(s->xy, s->xz, s->yz));
    fputs(", ", out);
    shape_print_vec3(out, vec3_sub(l, vec3_scale(2, times(s, c))));
    fputs(", ", out);
    shape_print_number(out, vec3_dot(c, times(s, c)) - vec3_dot(l, c) + s->constant);
}

const struct shape_ops quadric_ops = {
    .keyword = "quadric",
    .size = sizeof(struct quadric),
    .flags = SHAPE_SOLID | SHAPE_BOUND_BOX,
    .build = build,
    .absorb = absorb,
    .bounds = bounds,
    .placed_bounds = placed_bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .print = print,
};
