// An error target: patches, factors and iterations are refined together.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "radiosity/radiosity.h"

enum { LEVELS_MOST = 8, FIRST_ELEMENTS = 150 };

// The reflected radiosity of the coarse solution where element i of the fine one is.
static bool coarse_value(const struct radiosity *fine, const struct patches *p,
                         double (*reflected)[3], uint32_t i, double out[3])
{
    const struct cell *c = &fine->patches->cell[fine->patches->element_cell[i] / 2];
    const struct chart *chart = &p->chart[c->chart];
    if (!chart->nu)
        return false;
    const double u = c->u + c->du / 2, v = c->v + c->dv / 2;
    uint32_t iu = (uint32_t)(u * chart->nu), iv = (uint32_t)(v * chart->nv);
    uint32_t k = chart->first_cell + (iv < chart->nv ? iv : chart->nv - 1) * chart->nu +
                 (iu < chart->nu ? iu : chart->nu - 1);
    while (p->cell[k].child) {
        const struct cell *x = &p->cell[k];
        k = x->child + (u >= x->u + x->du / 2 ? 1 : 0) + (v >= x->v + x->dv / 2 ? 2 : 0);
    }
    const uint32_t e = p->cell[k].element[fine->patches->element_cell[i] & 1];
    if (e == ELEMENT_NONE)
        return false;
    memcpy(out, reflected[e], 3 * sizeof *out);
    return true;
}

static void reflected_light(const struct radiosity *r, double (*out)[3])
{
    for (uint32_t i = 0; i < r->patches->element_count; i++) {
        double rho[3];
        element_reflectance(&r->patches->element[i], rho);
        for (int c = 0; c < 3; c++)
            out[i][c] = rho[c] * (r->solution.h[i][c] + r->lamps[i][c]);
    }
}

// Relative rms difference of the means over the coarse elements: what a coarse element
// does wrong as a whole. Within an element light varies, which the picture interpolates.
static double difference(const struct radiosity *fine, double (*light)[3],
                         const struct patches *p, double (*coarse)[3])
{
    double off = 0, all = 0;
    double(*mean)[3] = solver_alloc(p->element_count, sizeof *mean);
    double *area = solver_alloc(p->element_count, sizeof *area);
    double probe[3], (*index)[3] = solver_alloc(p->element_count, sizeof *index);
    for (uint32_t e = 0; e < p->element_count; e++)
        index[e][0] = e;
    for (uint32_t i = 0; i < fine->patches->element_count; i++) {
        if (!coarse_value(fine, p, index, i, probe))
            continue;
        const uint32_t e = (uint32_t)probe[0];
        const double a = fine->patches->element[i].area;
        area[e] += a;
        for (int c = 0; c < 3; c++)
            mean[e][c] += a * light[i][c];
    }
    for (uint32_t e = 0; e < p->element_count; e++) {
        for (int c = 0; c < 3 && area[e] > 0; c++) {
            const double b = mean[e][c] / area[e], d = b - coarse[e][c];
            off += area[e] * d * d;
            all += area[e] * b * b;
        }
    }
    free(mean);
    free(area);
    free(index);
    return all > 0 ? sqrt(off / all) : 0;
}

// The level before, kept for comparison.
struct level {
    struct patches *patches;
    double (*reflected)[3];
};

static void level_free(struct level *l)
{
    patches_free(l->patches);
    free(l->reflected);
    *l = (struct level){0};
}

bool radiosity_to_error(struct radiosity *r, const struct job *job, char *error,
                        size_t error_size)
{
    // Errors fall with the size of elements to a power between 1 (edges of shadows) and
    // 1.8 (smooth light; research on the cube); the first is what may be relied on.
    static const double order_least = 1, order_most = 1.8;
    const double target = r->settings.error;
    double count = FIRST_ELEMENTS, before = 0;
    struct level last = {0};
    r->settings.patches.size = 0;
    r->settings.solver.tolerance = target / 4;
    for (uint32_t level = 0; level < LEVELS_MOST; level++, count *= 4) {
        r->settings.patches.count = count;
        // How many levels there will be is not known: each is half of what is left.
        const double begin = 1 - exp2(-(double)level), end = 1 - exp2(-(double)level - 1);
        watch_part(r->settings.watch, begin, begin + .1 * (end - begin));
        if (level)
            radiosity_level_free(r);
        r->patches = patches_build(job, &r->settings.patches);
        if (!r->patches || !r->patches->element_count) {
            snprintf(error, error_size,
                     "no surface of the scene can be cut into patches");
            level_free(&last);
            return false;
        }
        r->lamps = solver_alloc(r->patches->element_count, sizeof *r->lamps);
        lamps_gather(r->patches, r->settings.lamp_rays, r->settings.solver.threads,
                     r->lamps);
        watch_part(r->settings.watch, begin + .15 * (end - begin), end);
        if (!radiosity_level(r, error, error_size)) {
            level_free(&last);
            return false;
        }
        r->report.levels = level + 1;
        double(*light)[3] = solver_alloc(r->patches->element_count, sizeof *light);
        reflected_light(r, light);
        if (last.patches) {
            const double d = difference(r, light, last.patches, last.reflected);
            double order = order_least;
            if (before > d && d > 0)
                order = fmin(fmax(log2(before / d), order_least), order_most);
            const double mesh = d / (exp2(order) - 1);
            const double rest = fmax(r->solution.error, 0);
            r->report.error = sqrt(mesh * mesh + rest * rest);
            before = d;
        } else {
            r->report.error = 1;
        }
        level_free(&last);
        r->report.converged = r->report.error <= target;
        if (r->report.converged || level + 1 == LEVELS_MOST) {
            free(light);
            break;
        }
        last = (struct level){r->patches, light};
        r->patches = NULL;
    }
    r->key = radiosity_key(r);
    return true;
}
