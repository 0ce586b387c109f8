// An ellipsoid further and further away: coefficients in world coordinates, or about its centre.
#include <stdlib.h>

#include "bench.h"
#include "quad.h"
#include "scene/shape.h"
#include "scene/shapes/quadric.h"

enum { RAYS = 20000 };

static const struct vec3 squares = {1, 2, 3};

// xx, yy, zz, then the linear part, then the constant.
struct folded {
    double q[3], l[3], c;
};

static void terms(const struct folded *f, const struct ray *ray, double *a, double *b,
                  double *c)
{
    const double o[3] = {ray->o.x, ray->o.y, ray->o.z},
                 d[3] = {ray->d.x, ray->d.y, ray->d.z};
    *a = *b = 0;
    *c = f->c;
    for (int i = 0; i < 3; i++) {
        *a += d[i] * f->q[i] * d[i];
        *b += d[i] * (f->q[i] * o[i] + f->l[i] / 2);
        *c += o[i] * (f->q[i] * o[i] + f->l[i]);
    }
}

static void meet_folded(const void *thing, const struct ray *ray, struct found *out)
{
    double a, b, c;
    terms(thing, ray, &a, &b, &c);
    const double disc = b * b - a * c;
    if (!(disc > 0))
        return;
    found_add(out, (-b - sqrt(disc)) / a);
    found_add(out, (-b + sqrt(disc)) / a);
}

// The same with q/a and c/q, which loses less of the nearer root.
static void meet_stable(const void *thing, const struct ray *ray, struct found *out)
{
    double a, b, c;
    terms(thing, ray, &a, &b, &c);
    const double disc = b * b - a * c;
    if (!(disc > 0))
        return;
    const double q = -(b + copysign(sqrt(disc), b));
    found_add(out, q / a);
    found_add(out, c / q);
    found_sort(out);
}

static void meet_about_centre(const void *thing, const struct ray *ray, struct found *out)
{
    const struct quadric *s = thing;
    struct ray near = *ray;
    near.o = vec3_sub(ray->o, s->centre);
    const double shift = -vec3_dot(near.o, ray->d);
    near.o = vec3_mad(near.o, shift, ray->d);
    meet_stable(&(struct folded){{s->xx, s->yy, s->zz}, {0}, s->constant}, &near, out);
    for (int i = 0; i < out->count; i++)
        out->t[i] += shift;
}

static void meet_shape(const void *thing, const struct ray *ray, struct found *out)
{
    struct boundary_list *l = bench_list();
    quadric_ops.intersect(thing, ray, l);
    for (uint32_t i = 0; i < l->count; i++)
        found_add(out, l->at[i].t);
}

static void find_truth(struct vec3 centre, const struct ray *ray, struct found *out)
{
    const quad q[3] = {squares.x, squares.y, squares.z};
    const quad o[3] = {(quad)ray->o.x - centre.x, (quad)ray->o.y - centre.y,
                       (quad)ray->o.z - centre.z};
    const quad d[3] = {ray->d.x, ray->d.y, ray->d.z};
    quad a = 0, b = 0, c = -1;
    for (int i = 0; i < 3; i++) {
        a += d[i] * q[i] * d[i];
        b += d[i] * q[i] * o[i];
        c += o[i] * q[i] * o[i];
    }
    const quad disc = b * b - a * c, root = quad_sqrt(disc);
    if (!(disc > 0))
        return;
    found_add(out, (double)((-b - root) / a));
    found_add(out, (double)((-b + root) / a));
}

static void run(double offset)
{
    const struct vec3 centre = vec3_scale(offset, vec3(.7312345, .4567891, .8123457));
    struct ray *ray = bench_memory(RAYS * sizeof *ray);
    struct found *truth = bench_memory(RAYS * sizeof *truth);
    uint64_t state = 5;
    for (int i = 0; i < RAYS; i++) {
        ray[i] = bench_chord(&state);
        ray[i].o = vec3_add(ray[i].o, centre);
        find_truth(centre, &ray[i], &truth[i]);
    }
    const double q[3] = {squares.x, squares.y, squares.z},
                 o[3] = {centre.x, centre.y, centre.z};
    struct folded f = {.c = -1};
    for (int i = 0; i < 3; i++) {
        f.q[i] = q[i];
        f.l[i] = -2 * q[i] * o[i];
        f.c += q[i] * o[i] * o[i];
    }
    const struct quadric s = {
        .xx = q[0], .yy = q[1], .zz = q[2], .constant = -1, .centre = centre};
    const struct trial t = {"quadric", "offset", ray, truth, RAYS, 1e-4};
    bench_method(&t, "world coefficients", offset, meet_folded, &f);
    bench_method(&t, "world coefficients, stable roots", offset, meet_stable, &f);
    bench_method(&t, "about the centre", offset, meet_about_centre, &s);
    bench_method(&t, "lambert", offset, meet_shape, &s);
    free(ray);
    free(truth);
}

void bench_quadrics(void)
{
    for (int k = 0; k <= 7; k++)
        run(pow(10, k));
}
