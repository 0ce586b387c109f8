// As many patches as are wanted: a coarse trial tells at which size of cells.
#include "radiosity/patches.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

// What a coarse trial says about the number of elements at other sizes of cells.
struct forecast {
    const struct patches *trial;
    double *whole; // by chart: elements of a cell, both sides
    double *cut;   // and cells that exist in part
    double scale;  // of what was built to what was expected
};

static void forecast_init(struct forecast *f, const struct patches *trial)
{
    *f = (struct forecast){trial, must_calloc(trial->chart_count + 1, sizeof *f->whole),
                           must_calloc(trial->chart_count + 1, sizeof *f->cut), 1};
    for (uint32_t i = 0; i < trial->element_count; i++) {
        const uint32_t c = trial->cell[trial->element_cell[i] / 2].chart;
        f->whole[c] += trial->element[i].area / trial->chart[c].area;
        f->cut[c] += trial->element[i].partial;
    }
}

static double forecast_count(const struct forecast *f, double size)
{
    // A cut cell is quartered twice: so many elements more than one of its area.
    static const double more = 4.5;
    double count = 0;
    for (uint32_t i = 0; i < f->trial->chart_count; i++) {
        uint32_t grid[2];
        patches_grid(&f->trial->chart[i], size, grid);
        count +=
            f->whole[i] * grid[0] * grid[1] + more * f->cut[i] * f->trial->size / size;
    }
    return f->scale * count;
}

// The largest size of cells that gives as many elements.
static double forecast_size(const struct forecast *f, double count)
{
    enum { STEPS = 40 };
    double few = f->trial->size, many = few, area = 0;
    // Cells of the size of all there is are more than coarse.
    for (uint32_t i = 0; i < f->trial->element_count; i++)
        area += f->trial->element[i].area;
    few = fmax(few, sqrt(area));
    if (forecast_count(f, few) > count)
        return few;
    for (int k = 0; k < STEPS && forecast_count(f, many) < count; k++)
        many /= 2;
    for (int k = 0; k < STEPS; k++) {
        const double middle = sqrt(few * many);
        if (forecast_count(f, middle) < count)
            few = middle;
        else
            many = middle;
    }
    return many;
}

enum { TRIAL = 400 }; // elements

// One cell a chart where that makes as many elements as are wanted, or more: then there is
// nothing to try. NULL: it does not, or that would take long to find out.
static struct patches *build_coarsest(const struct job *job,
                                      const struct patch_settings *s)
{
    struct patches *p = patches_charts(job, s);
    double longest = 0;
    for (uint32_t i = 0; i < p->chart_count; i++)
        longest = fmax(longest, fmax(p->chart[i].side[0], p->chart[i].side[1]));
    if (2.0 * p->chart_count < s->count) {
        patches_free(p);
        return NULL;
    }
    p = patches_cut(p, longest);
    if (p && p->element_count < s->count && !watch_cancelled(s->watch)) {
        patches_free(p);
        return NULL;
    }
    return p;
}

// As many elements as are wanted, about; cells that are quartered and small charts make
// more than was counted on.
struct patches *patches_counted(const struct job *job, const struct patch_settings *s)
{
    enum { RETRIES = 3 };
    static const double most = 1.15; // elements, of those wanted
    struct patch_settings settings = *s;
    struct patches *const coarsest = s->count <= TRIAL ? build_coarsest(job, s) : NULL;
    if (coarsest)
        return coarsest;
    settings.count = fmin(s->count, TRIAL);
    settings.depth = 0;
    settings.trial = true;
    struct patches *p = NULL, *trial = patches_cut_by(job, &settings);
    if (!trial || !trial->element_count) {
        patches_free(trial);
        return NULL;
    }
    struct forecast f;
    forecast_init(&f, trial);
    settings = *s;
    settings.size = forecast_size(&f, s->count);
    for (int k = 0; k <= RETRIES && !watch_cancelled(s->watch); k++) {
        const double before = p ? p->element_count : 0;
        patches_free(p);
        p = patches_cut_by(job, &settings);
        if (!p || p->element_count <= most * s->count ||
            (k && p->element_count > .9 * before))
            break;
        f.scale *= p->element_count / forecast_count(&f, settings.size);
        const double size = forecast_size(&f, s->count);
        if (size <= settings.size)
            break;
        settings.size = size;
    }
    free(f.whole);
    free(f.cut);
    patches_free(trial);
    return p;
}
