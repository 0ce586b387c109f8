// Tori by solvers of quartics: closed form, closed form polished, Sturm's sequence, isolation.
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "math/polynomial.h"
#include "quad.h"
#include "scene/shape.h"
#include "scene/shapes/torus.h"

enum { RAYS = 10000 };

// The quartic of a torus along a ray of unit direction about its point nearest to the centre,
// in units of R + r, and where its roots can be.
struct quartic {
    double c[5], size, shift, chord;
};

static bool quartic_of(const struct torus *s, const struct ray *ray, struct quartic *q)
{
    q->size = s->major + s->minor;
    q->shift = -vec3_dot(ray->o, ray->d);
    const struct vec3 o = vec3_scale(1 / q->size, vec3_mad(ray->o, q->shift, ray->d)),
                      u = ray->d;
    const double R = s->major / q->size, r = s->minor / q->size, oo = vec3_dot(o, o);
    if (!(oo < 1))
        return false;
    q->chord = sqrt(1 - oo) + r / 8;
    const double k = oo + (R - r) * (R + r), f = 4 * R * R;
    q->c[0] = k * k - f * (o.x * o.x + o.z * o.z);
    q->c[1] = 4 * k * vec3_dot(o, u) - 2 * f * (o.x * u.x + o.z * u.z);
    q->c[2] = 2 * k - f * (u.x * u.x + u.z * u.z);
    q->c[3] = 0;
    q->c[4] = 1;
    return true;
}

static void add_scaled(const struct quartic *q, const double *root, int n,
                       struct found *out)
{
    for (int i = 0; i < n; i++)
        if (fabs(root[i]) <= q->chord)
            found_add(out, q->size * root[i] + q->shift);
    found_sort(out);
}

// ---- closed form ----------------------------------------------------------------------

// One real root of z^3 + a z^2 + b z + c, the largest (Cardano, Vieta).
static double cubic_root(double a, double b, double c)
{
    const double q = (a * a - 3 * b) / 9, r = (2 * a * a * a - 9 * a * b + 27 * c) / 54;
    const double q3 = q * q * q;
    if (r * r < q3)
        return -2 * sqrt(q) * cos((acos(r / sqrt(q3)) + 6.28318530717958647692) / 3) -
               a / 3;
    const double s = -copysign(cbrt(fabs(r) + sqrt(r * r - q3)), r);
    return s + (s != 0 ? q / s : 0) - a / 3;
}

static int quadratic_roots(double b, double c, double *root)
{
    const double disc = b * b - 4 * c;
    if (!(disc >= 0))
        return 0;
    const double q = -(b + copysign(sqrt(disc), b)) / 2;
    root[0] = q;
    root[1] = q != 0 ? c / q : 0;
    return 2;
}

// t^4 + p t^2 + q t + r as a product of two quadratics (Ferrari).
static int ferrari(const double c[5], double root[4])
{
    const double p = c[2], q = c[1], r = c[0];
    const double z = cubic_root(2 * p, p * p - 4 * r, -q * q); // square of the split
    if (!(z > 0)) {
        double square[2];
        int n = 0;
        for (int i = quadratic_roots(p, r, square) - 1; i >= 0; i--)
            if (square[i] >= 0) {
                root[n++] = sqrt(square[i]);
                root[n++] = -sqrt(square[i]);
            }
        return n;
    }
    const double s = sqrt(z), half = (p + z) / 2, part = q / (2 * s);
    const int n = quadratic_roots(s, half - part, root);
    return n + quadratic_roots(-s, half + part, root + n);
}

static void meet_closed(const void *thing, const struct ray *ray, struct found *out)
{
    struct quartic q;
    double root[4];
    if (quartic_of(thing, ray, &q))
        add_scaled(&q, root, ferrari(q.c, root), out);
}

static void meet_polished(const void *thing, const struct ray *ray, struct found *out)
{
    struct quartic q;
    double root[4];
    if (!quartic_of(thing, ray, &q))
        return;
    const int n = ferrari(q.c, root);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) {
            const double t = root[i], slope = (4 * t * t + 2 * q.c[2]) * t + q.c[1];
            if (slope != 0)
                root[i] -= polynomial_value(q.c, 4, t) / slope;
        }
    add_scaled(&q, root, n, out);
}

// ---- Sturm's sequence -----------------------------------------------------------------

struct sturm {
    double p[5][5];
    int degree[5], count;
};

static void sturm_build(struct sturm *s, const double c[5])
{
    memcpy(s->p[0], c, 5 * sizeof *c);
    s->degree[0] = 4;
    for (int i = 1; i <= 4; i++)
        s->p[1][i - 1] = i * c[i];
    s->degree[1] = 3;
    s->count = 2;
    while (s->count < 5 && s->degree[s->count - 1] > 0) { // remainders, turned
        const double *d = s->p[s->count - 1];
        double *r = s->p[s->count];
        int deg = s->degree[s->count - 2];
        const int by = s->degree[s->count - 1];
        memcpy(r, s->p[s->count - 2], 5 * sizeof *r);
        for (; deg >= by; deg--)
            for (int i = 0; i < by; i++)
                r[deg - by + i] -= r[deg] / d[by] * d[i];
        while (deg >= 0 && fabs(r[deg]) < 1e-15)
            deg--;
        if (deg < 0)
            break;
        for (int i = 0; i <= deg; i++)
            r[i] = -r[i];
        s->degree[s->count++] = deg;
    }
}

static int changes(const struct sturm *s, double t)
{
    int n = 0;
    double last = 0;
    for (int i = 0; i < s->count; i++) {
        const double v = polynomial_value(s->p[i], s->degree[i], t);
        n += v * last < 0;
        last = v != 0 ? v : last;
    }
    return n;
}

static double bisect(const double c[5], double lo, double hi)
{
    const bool rising = polynomial_value(c, 4, hi) > 0;
    for (int i = 0; i < 60 && hi - lo > 0x1p-48; i++) {
        const double mid = (lo + hi) / 2, v = polynomial_value(c, 4, mid);
        *((v > 0) == rising ? &hi : &lo) = mid;
    }
    return (lo + hi) / 2;
}

static int sturm_roots(const struct sturm *s, double lo, int at_lo, double hi, int at_hi,
                       int depth, double *root)
{
    if (at_lo <= at_hi)
        return 0;
    if (at_lo - at_hi == 1 || depth == 50) {
        const double a = polynomial_value(s->p[0], 4, lo);
        const double b = polynomial_value(s->p[0], 4, hi);
        if (a * b > 0 && depth < 50)
            goto halve;
        root[0] = a * b > 0 ? (lo + hi) / 2 : bisect(s->p[0], lo, hi);
        return 1;
    }
halve:;
    const double mid = (lo + hi) / 2;
    const int at_mid = changes(s, mid);
    const int n = sturm_roots(s, lo, at_lo, mid, at_mid, depth + 1, root);
    return n + sturm_roots(s, mid, at_mid, hi, at_hi, depth + 1, root + n);
}

static void meet_sturm(const void *thing, const struct ray *ray, struct found *out)
{
    struct quartic q;
    struct sturm s;
    double root[8];
    if (!quartic_of(thing, ray, &q))
        return;
    sturm_build(&s, q.c);
    const int n = sturm_roots(&s, -q.chord, changes(&s, -q.chord), q.chord,
                              changes(&s, q.chord), 0, root);
    add_scaled(&q, root, n < 4 ? n : 4, out);
}

// ---- what the renderer does -------------------------------------------------------------

static void meet_isolated(const void *thing, const struct ray *ray, struct found *out)
{
    struct quartic q;
    struct polynomial_root root[4];
    if (!quartic_of(thing, ray, &q))
        return;
    const int n = polynomial_roots(q.c, 4, -q.chord, q.chord, 8, root);
    for (int i = 0; i < n; i++)
        found_add(out, q.size * root[i].t + q.shift);
}

static void meet_shape(const void *thing, const struct ray *ray, struct found *out)
{
    struct boundary_list *l = bench_list();
    torus_ops.intersect(thing, ray, l);
    for (uint32_t i = 0; i < l->count; i++)
        found_add(out, l->at[i].t);
}

// ---- rays and truths --------------------------------------------------------------------

static void find_truth(const struct torus *s, const struct ray *ray, struct found *out)
{
    const quad o[3] = {ray->o.x, ray->o.y, ray->o.z},
               d[3] = {ray->d.x, ray->d.y, ray->d.z};
    quad oo = 0, od = 0, dd = 0;
    for (int i = 0; i < 3; i++) {
        oo += o[i] * o[i];
        od += o[i] * d[i];
        dd += d[i] * d[i];
    }
    const quad R = s->major, r = s->minor, k = oo + R * R - r * r, f = 4 * R * R;
    const quad c[5] = {k * k - f * (o[0] * o[0] + o[2] * o[2]),
                       4 * k * od - 2 * f * (o[0] * d[0] + o[2] * d[2]),
                       4 * od * od + 2 * k * dd - f * (d[0] * d[0] + d[2] * d[2]),
                       4 * dd * od, dd * dd};
    quad root[4];
    const int n = quad_roots(c, 4, -20, 20, root);
    for (int i = 0; i < n; i++)
        found_add(out, (double)root[i]);
}

// Touching within `depth` of the tube's radius, inside or outside.
static struct ray grazing(const struct torus *s, double depth, uint64_t *state)
{
    const double a = 6.28318530717958647692 * bench_random(state),
                 b = 6.28318530717958647692 * bench_random(state),
                 r = s->minor * (1 + (bench_random(state) < .5 ? -depth : depth));
    const struct vec3 ring = vec3(cos(a), 0, sin(a)),
                      n = vec3_add(vec3_scale(cos(b), ring), vec3(0, sin(b), 0)),
                      p = vec3_mad(vec3_scale(s->major, ring), r, n);
    const struct vec3 d = vec3_normalize(vec3_cross(n, bench_in_cube(state)));
    return (struct ray){vec3_mad(p, -4, d), d, 0, INFINITY};
}

// Along x, just under the crest of the tube: the quartic is even, or nearly.
static struct ray below_crest(const struct torus *s, double depth, uint64_t *state)
{
    const double z = (2 * bench_random(state) - 1) * s->major;
    return (struct ray){vec3(-4, s->minor * (1 - depth), z), vec3(1, 0, 0), 0, INFINITY};
}

enum rays { RANDOM, GRAZING, CREST };

static void run(enum rays kind, const struct torus *s, double knob)
{
    static const char *const set[] = {"random", "grazing", "crest"};
    struct ray *ray = bench_memory(RAYS * sizeof *ray);
    struct found *truth = bench_memory(RAYS * sizeof *truth);
    uint64_t state = 17;
    for (int i = 0; i < RAYS; i++) {
        ray[i] = kind == RANDOM    ? bench_chord(&state)
                 : kind == GRAZING ? grazing(s, knob, &state)
                                   : below_crest(s, knob, &state);
        find_truth(s, &ray[i], &truth[i]);
    }
    const struct trial t = {"quartic", set[kind], ray, truth, RAYS, 1e-4};
    bench_method(&t, "closed form", knob, meet_closed, s);
    bench_method(&t, "closed form, polished", knob, meet_polished, s);
    bench_method(&t, "Sturm", knob, meet_sturm, s);
    bench_method(&t, "isolation", knob, meet_isolated, s);
    bench_method(&t, "lambert", knob, meet_shape, s);
    free(ray);
    free(truth);
}

void bench_quartics(void)
{
    static const double minor[] = {.25, .1, .03, .01, .003, .001};
    for (int i = 0; i < 6; i++)
        run(RANDOM, &(struct torus){.75, minor[i]}, minor[i]);
    for (int k = 1; k <= 6; k++) {
        run(GRAZING, &(struct torus){.75, .25}, pow(10, -2 * k));
        run(CREST, &(struct torus){.75, .25}, pow(10, -2 * k));
    }
}
