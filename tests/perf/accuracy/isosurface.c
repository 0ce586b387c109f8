// Isosurfaces: sampling that trusts max_gradient, and bounds by intervals. Both evaluate the
// same function.
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "loaded.h"
#include "scene/shapes/isosurface.h"

enum { RAYS = 2000 };

struct sampled {
    const struct isosurface *s;
    double max_gradient, accuracy;
};

// The stretch of the line in the unit cube's double, from -1 to 1.
static bool clip(const struct ray *ray, double *lo, double *hi)
{
    *lo = -INFINITY;
    *hi = INFINITY;
    for (int i = 0; i < 3; i++) {
        const double o = vec3_axis(ray->o, i), d = vec3_axis(ray->d, i);
        const double a = (-1 - o) / d, b = (1 - o) / d;
        *lo = fmax(*lo, fmin(a, b));
        *hi = fmin(*hi, fmax(a, b));
    }
    return *lo < *hi;
}

static double value(const struct isosurface *s, const struct ray *ray, double t)
{
    return iso_value(s, ray_at(ray, t));
}

// Halves while the two ends, for their slope, could be on either side of zero; the middle
// of what is shorter than `accuracy` with two signs is a crossing.
static void sample(const struct sampled *m, const struct ray *ray, double a, double fa,
                   double b, double fb, struct found *out)
{
    if ((fa > 0) == (fb > 0) && fabs(fa) + fabs(fb) >= m->max_gradient * (b - a))
        return;
    if (b - a < m->accuracy) {
        if ((fa > 0) != (fb > 0))
            found_add(out, (a + b) / 2);
        return;
    }
    const double mid = (a + b) / 2, fm = value(m->s, ray, mid);
    sample(m, ray, a, fa, mid, fm, out);
    sample(m, ray, mid, fm, b, fb, out);
}

static void meet_sampled(const void *thing, const struct ray *ray, struct found *out)
{
    const struct sampled *m = thing;
    double lo, hi;
    if (clip(ray, &lo, &hi))
        sample(m, ray, lo, value(m->s, ray, lo), hi, value(m->s, ray, hi), out);
}

static void meet_intervals(const void *thing, const struct ray *ray, struct found *out)
{
    struct boundary_list *l = bench_list();
    iso_walk(thing, ray, l);
    for (uint32_t i = 0; i < l->count; i++)
        if (l->at[i].part == ISO_SURFACE)
            found_add(out, l->at[i].t);
}

// Halving with a slope that is known to be enough, then bisection to the last bit.
static void find_truth(const struct isosurface *s, double steepest, const struct ray *ray,
                       struct found *out)
{
    const struct sampled m = {s, steepest, 1e-7};
    meet_sampled(&m, ray, out);
    for (int i = 0; i < out->count; i++) {
        double a = out->t[i] - 1e-7, b = out->t[i] + 1e-7;
        const bool before = value(s, ray, a) > 0;
        for (int k = 0; k < 60; k++) {
            const double mid = (a + b) / 2;
            *((value(s, ray, mid) > 0) == before ? &a : &b) = mid;
        }
        out->t[i] = (a + b) / 2;
    }
}

static void run(const char *set, const char *function, double steepest)
{
    struct loaded l;
    load(&l, "isosurface { function { %s } contained_by { box { -1, 1 } } }\n", function);
    const struct isosurface *s = l.world->leaf[0].shape;
    struct ray *ray = bench_memory(RAYS * sizeof *ray);
    struct found *truth = bench_memory(RAYS * sizeof *truth);
    uint64_t state = 23;
    for (int i = 0; i < RAYS; i++) {
        ray[i] = bench_chord(&state);
        find_truth(s, steepest, &ray[i], &truth[i]);
    }
    const struct trial t = {"isosurface", set, ray, truth, RAYS, 1e-2};
    for (int k = 3; k <= 6; k++) {
        static const double share[] = {.0625, .125, .25, .5, 1};
        static const char *const name[] = {
            "sampling, accuracy 1e-3", "sampling, accuracy 1e-4",
            "sampling, accuracy 1e-5", "sampling, accuracy 1e-6"};
        for (int i = 0; i < 5; i++) {
            const struct sampled m = {s, share[i] * steepest, pow(10, -k)};
            bench_method(&t, name[k - 3], share[i], meet_sampled, &m);
        }
    }
    bench_method(&t, "lambert", 1, meet_intervals, s);
    free(ray);
    free(truth);
    unload(&l);
}

void bench_isosurfaces(void)
{
    // |grad| of the gyroid is at most 5 sqrt 3 (each part 5 (|cos cos| + |sin sin|)).
    run("gyroid", "sin(5*x)*cos(5*y) + sin(5*y)*cos(5*z) + sin(5*z)*cos(5*x)", 8.67);
    // A torus with a seam: 4 rho (rho^2 + ...) at most on the cube.
    run("torus", "pow(x*x + y*y + z*z + .24, 2) - x*x - z*z", 26);
    run("thin shell", "abs(x*x + y*y + z*z - .5) - .002", 3.47);
}
