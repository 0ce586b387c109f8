#include "truth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "trace/intersect.h"

struct bin bin[BINS_MOST];
int bins;

void truth_read(const char *path)
{
    char line[1024];
    FILE *file = fopen(path, "r");
    if (!file) {
        perror(path);
        exit(1);
    }
    bins = 0;
    while (fgets(line, sizeof line, file) && bins < BINS_MOST) {
        struct bin *x = &bin[bins];
        if (line[0] == '#')
            continue;
        if (sscanf(line,
                   "%31s %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf "
                   "%*f %*f %*f %lf",
                   x->name, &x->p.x, &x->p.y, &x->p.z, &x->a.x, &x->a.y, &x->a.z, &x->b.x,
                   &x->b.y, &x->b.z, &x->rho[0], &x->rho[1], &x->rho[2], &x->h[0],
                   &x->h[1], &x->h[2], &x->e) != 17) {
            fprintf(stderr, "%s: not understood: %s", path, line);
            exit(1);
        }
        bins++;
    }
    fclose(file);
}

void error_add(struct error_sum *s, double area, const double rho[3], const double got[3],
               const double truth[3])
{
    for (int c = 0; c < 3; c++) {
        const double d = rho[c] * (got[c] - truth[c]);
        s->off += area * d * d;
        s->all += area * rho[c] * rho[c] * truth[c] * truth[c];
    }
}

double error_of(const struct error_sum *s) { return sqrt(s->off / s->all); }

double furnace_error(const struct radiosity *r, bool print)
{
    static const double one[3] = {1, 1, 1};
    struct error_sum s = {0, 0};
    const struct patches *p = r->patches;
    for (uint32_t i = 0; i < p->element_count; i++) {
        double rho[3];
        element_reflectance(&p->element[i], rho);
        error_add(&s, p->element[i].area, rho, r->solution.h[i], one);
        if (print)
            fprintf(stderr, "%u\t%g\t%.4g %.4g %.4g\t%.3g\t%s\t%+.2f %%\n",
                    p->element[i].surface, rho[0], p->element[i].centre.x,
                    p->element[i].centre.y, p->element[i].centre.z, p->element[i].area,
                    p->element[i].partial ? "partial" : "whole",
                    100 * (r->solution.h[i][0] - 1));
    }
    return error_of(&s);
}

// The mean irradiance of the patches at points of a bin, for a light of radiosity 1.
static void bin_value(const struct radiosity *r, struct trace_scratch *scratch,
                      const struct bin *x, double light, bool interpolate, double h[3])
{
    enum { SIDE = 6 };
    const struct vec3 up = vec3_normalize(vec3_cross(x->a, x->b));
    const double height = .05 * vec3_length(x->a);
    h[0] = h[1] = h[2] = 0;
    for (int k = 0; k < SIDE * SIDE; k++) {
        const struct vec3 p = vec3_mad(vec3_mad(x->p, (k % SIDE + .5) / SIDE, x->a),
                                       (k / SIDE + .5) / SIDE, x->b);
        const struct ray_query q = {{vec3_mad(p, height, up), vec3_neg(up), 0, INFINITY},
                                    OBJECT_NO_RADIOSITY};
        const struct hit hit = trace_closest_1(r->patches->job->world, scratch, &q);
        uint32_t e[4], n = 0;
        double weight[4] = {1};
        if (hit.b.t < 2 * height && interpolate) {
            struct interaction at;
            trace_interaction(r->patches->job->world, &q.ray, &hit, &at);
            n = patch_around(r->patches, scratch, &q.ray, &hit, &at, e, weight);
        } else if (hit.b.t < 2 * height)
            n = (e[0] = patch_of_hit(r->patches, scratch, &q.ray, &hit)) != ELEMENT_NONE;
        for (uint32_t i = 0; i < n; i++)
            for (int c = 0; c < 3; c++)
                h[c] += weight[i] * r->solution.h[e[i]][c] / light / (SIDE * SIDE);
    }
}

double truth_error(const struct radiosity *r, bool interpolate, bool print)
{
    struct error_sum sum = {0, 0};
    struct trace_scratch *scratch = trace_scratch_new(r->patches->job->world);
    double light = 0;
    for (uint32_t i = 0; i < r->patches->element_count; i++)
        light = fmax(light, (double)r->patches->element[i].emission.r);
    for (int k = 0; k < bins; k++) {
        double h[3];
        bin_value(r, scratch, &bin[k], light, interpolate, h);
        error_add(&sum, vec3_length(vec3_cross(bin[k].a, bin[k].b)), bin[k].rho, h,
                  bin[k].h);
        if (print)
            fprintf(stderr, "%s\t%.4g %.4g %.4g\t%+.2f %%\t%+.2f %%\t%+.2f %%\n",
                    bin[k].name, bin[k].p.x, bin[k].p.y, bin[k].p.z,
                    100 * (h[0] / bin[k].h[0] - 1), 100 * (h[1] / bin[k].h[1] - 1),
                    100 * (h[2] / bin[k].h[2] - 1));
    }
    trace_scratch_free(scratch);
    return error_of(&sum);
}
