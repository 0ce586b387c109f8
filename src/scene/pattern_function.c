#include "scene/pattern_function.h"

#include <string.h>

#include "base/arena.h"
#include "scene/noise_kernel.h"
#include "scene/pattern_formula.h"
#include "scene/pigment_tape.h"
#include "scene/tape_kernel.h"
#include "scene/tape_steps.h"

struct function {
    const struct pattern *pattern;
    const struct pigment *pigment;
    const struct pigment_tape *colors; // NULL: nested too deeply
    const struct tape *formula;        // NULL: too large
};

// A formula's steps are rounded otherwise than the function's.
#define BOX_SLACK 0x1p-50

// ---- bounds ---------------------------------------------------------------------------

static void bounds(const void *data, const struct interval *in, struct interval *out,
                   struct interval *partial)
{
    const struct function *f = data;
    struct tape_slope at[3] = {0}, r[TAPE_WIDTH_MAX];
    for (int i = 0; i < 3; i++) {
        at[i].v = interval_widened(in[i].lo, in[i].hi, BOX_SLACK);
        at[i].d[i] = interval_point(1);
    }
    if (!f->formula) {
        const int width = f->pattern ? 1 : 5;
        for (int i = 0; i < width; i++)
            out[i] = interval_whole();
        for (int i = 0; partial && i < 3 * width; i++)
            partial[i] = interval_whole();
        return;
    }
    if (!partial && f->formula->width == 1) {
        const struct interval box[3] = {at[0].v, at[1].v, at[2].v};
        out[0] = tape_bounds(f->formula, box);
        return;
    }
    tape_bounds_all(f->formula, at, partial ? 3 : 0, r);
    for (int i = 0; i < f->formula->width; i++) {
        out[i] = r[i].v;
        for (int k = 0; partial && k < 3; k++)
            partial[3 * i + k] = r[i].d[k];
    }
}

static bool bounds8(const struct noise_kernels *k, const void *data,
                    const struct tape_range8 *in, struct tape_range8 *out,
                    struct tape_range8 *partial)
{
    const struct function *f = data;
    struct tape_boxes box;
    struct tape_slopes r[TAPE_WIDTH_MAX];
    if (!f->formula || !tape_has_lanes(f->formula))
        return false;
    for (int i = 0; i < 3; i++)
        for (int l = 0; l < TAPE_LANES; l++) {
            const struct interval v =
                interval_widened(in[i].lo[l], in[i].hi[l], BOX_SLACK);
            box.lo[i][l] = v.lo;
            box.hi[i][l] = v.hi;
        }
    k->tapes->bounds(f->formula, &box, partial != NULL, r);
    for (int i = 0; i < f->formula->width; i++) {
        memcpy(out[i].lo, r[i].lo, sizeof r[i].lo);
        memcpy(out[i].hi, r[i].hi, sizeof r[i].hi);
        for (int a = 0; partial && a < 3; a++) {
            memcpy(partial[3 * i + a].lo, r[i].slope_lo[a], sizeof r[i].slope_lo[a]);
            memcpy(partial[3 * i + a].hi, r[i].slope_hi[a], sizeof r[i].slope_hi[a]);
        }
    }
    return true;
}

static bool opaque(const void *data)
{
    const struct function *f = data;
    return !f->formula || tape_is_opaque(f->formula);
}

// ---- values ---------------------------------------------------------------------------

static void pattern_at(const void *data, const double *in, double *out)
{
    const struct function *f = data;
    const struct vec3 p = vec3(in[0], in[1], in[2]);
    const struct pattern_context none = {.p_world = p, .uv = {p.x, p.y}};
    out[0] = pattern_value(f->pattern, p, &none);
}

// No surface is there: slopes are 0.
static void pigment_at(const void *data, const double *in, double *out)
{
    const struct function *f = data;
    const struct vec3 p = vec3(in[0], in[1], in[2]);
    const struct texture_point at = {.p = p, .p_world = p, .uv = {p.x, p.y}};
    struct rgbft c = {0};
    pigment_color(f->pigment, &at, &c);
    out[0] = c.r;
    out[1] = c.g;
    out[2] = c.b;
    out[3] = c.filter;
    out[4] = c.transmit;
}

static const double nowhere[3][8];

static void pattern_at8(const struct noise_kernels *k, const void *data,
                        const double (*in)[TAPE_LANES], double (*out)[TAPE_LANES])
{
    const struct function *f = data;
    const struct pattern_packet packet = {in, nowhere, nowhere, in};
    double at[3][8];
    memcpy(at, in, sizeof at);
    k->surface->warp(f->pattern, at);
    k->surface->values(f->pattern, &packet, (const double(*)[8])at, 255, *out);
}

static void pigment_at8(const struct noise_kernels *k, const void *data,
                        const double (*in)[TAPE_LANES], double (*out)[TAPE_LANES])
{
    const struct function *f = data;
    const struct pattern_packet packet = {in, nowhere, nowhere, in};
    float c[5][8] = {0};
    const unsigned found =
        f->colors ? k->surface->colors(f->colors, &packet, in, 255, c) : 0;
    for (int l = 0; l < TAPE_LANES; l++) {
        if (!(found >> l & 1)) {
            double one[5];
            pigment_at(data, (const double[]){in[0][l], in[1][l], in[2][l]}, one);
            for (int i = 0; i < 5; i++)
                out[i][l] = one[i];
            continue;
        }
        for (int i = 0; i < 5; i++)
            out[i][l] = c[i][l];
    }
}

const struct tape_extern pattern_extern = {.name = "pattern",
                                           .arguments = 3,
                                           .width = 1,
                                           .value = pattern_at,
                                           .values = pattern_at8,
                                           .bounds = bounds,
                                           .bounds8 = bounds8,
                                           .opaque = opaque};
const struct tape_extern pigment_extern = {.name = "pigment",
                                           .arguments = 3,
                                           .width = 5,
                                           .value = pigment_at,
                                           .values = pigment_at8,
                                           .bounds = bounds,
                                           .bounds8 = bounds8,
                                           .opaque = opaque};

const void *pattern_function(struct arena *a, struct arena *work, const struct pattern *p)
{
    struct function *f = arena_new_struct(a, struct function);
    f->pattern = p;
    f->formula = pattern_formula(a, work, p);
    return f;
}

const void *pigment_function(struct arena *a, struct arena *work, const struct pigment *p)
{
    struct function *f = arena_new_struct(a, struct function);
    struct pigment_compiler c = {.arena = a};
    f->pigment = p;
    f->colors = pigment_compile(&c, p);
    f->formula = pigment_formula(a, work, p);
    return f;
}
