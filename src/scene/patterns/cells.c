// cells: a random value for each unit cube

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return noise_random(noise_cell_hash(floor(at.x + PATTERN_EDGE),
                                        floor(at.y + PATTERN_EDGE),
                                        floor(at.z + PATTERN_EDGE)));
}

enum { CELLS_MAX = 64 };

static void bounds(const void *data, const struct interval *in, struct interval *out,
                   struct interval *partial)
{
    (void)data;
    double first[3], last[3], count = 1;
    for (int i = 0; i < 3; i++) {
        first[i] = floor(in[i].lo + PATTERN_EDGE);
        last[i] = floor(in[i].hi + PATTERN_EDGE);
        count *= last[i] - first[i] + 1;
    }
    for (int i = 0; partial && i < 3; i++)
        partial[i] = count == 1 ? interval_point(0) : interval_whole();
    out[0] = interval(0, 1);
    if (!(count <= CELLS_MAX && interval_size(in[0]) < 0x1p50 &&
          interval_size(in[1]) < 0x1p50 && interval_size(in[2]) < 0x1p50))
        return;
    out[0] = interval(1, 0);
    for (double x = first[0]; x <= last[0]; x++)
        for (double y = first[1]; y <= last[1]; y++)
            for (double z = first[2]; z <= last[2]; z++) {
                const double v = noise_random(noise_cell_hash(x, y, z));
                out[0] = interval(fmin(out[0].lo, v), fmax(out[0].hi, v));
            }
}

static const struct tape_extern cells = {
    .name = "cells", .arguments = 3, .width = 1, .bounds = bounds};

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    return formula_extern(f, &cells, NULL, at);
}

const struct pattern_ops cells_pattern_ops = {
    .keyword = "cells", .frequency = 1, .value = value, .formula = formula};
