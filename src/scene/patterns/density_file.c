// density_file: samples of a grid that fills the unit cube (spec/textures 5.4)

#include "scene/density_grid.h"
#include "scene/noise_kernel.h"
#include "scene/pattern.h"
#include "scene/pattern_formula.h"

// The cell of a coordinate and the place in it.
struct cell {
    uint32_t at, size;
    double fraction;
};

static struct cell cell_of(double v, uint32_t size)
{
    const double u = v * size;
    uint32_t at = (uint32_t)u;
    if (at >= size) // the product may round up to it
        at = size - 1;
    return (struct cell){at, size, u - at};
}

// The sample before the first is the language's (2^64 - 1) mod size, which is the last
// one only for powers of two.
static uint32_t neighbour(struct cell c, int step)
{
    if (step < 0)
        return c.at ? c.at - 1 : (uint32_t)(UINT64_MAX % c.size);
    const uint32_t at = c.at + (uint32_t)step;
    return at < c.size ? at : at % c.size;
}

// The numbers of the samples from `from` on along each axis, to be added up.
static void places_of(const struct density_grid *g, const struct cell c[3], int from,
                      int count, size_t at[3][4])
{
    for (int i = 0; i < count; i++) {
        at[0][i] = density_grid_place(g, neighbour(c[0], from + i), 0, 0);
        at[1][i] = density_grid_place(g, 0, neighbour(c[1], from + i), 0);
        at[2][i] = density_grid_place(g, 0, 0, neighbour(c[2], from + i));
    }
}

static double linear(const struct density_grid *g, const struct cell c[3])
{
    size_t at[3][4];
    double sum = 0;
    places_of(g, c, 0, 2, at);
    for (int i = 0; i < 8; i++) {
        size_t place = 0;
        double weight = 1;
        for (int k = 0; k < 3; k++) {
            const int next = i >> k & 1;
            place += at[k][next];
            weight *= next ? c[k].fraction : 1 - c[k].fraction;
        }
        sum += weight * density_grid_sample(g, place);
    }
    return sum;
}

// Hermite through b and c, with the slopes of their neighbours.
static float hermite(float t, const float v[4])
{
    const float m0 = (v[2] - v[0]) / 2, m1 = (v[3] - v[1]) / 2;
    const float e = 2 * (v[1] - v[2]) + m0 + m1;
    const float f = -3 * (v[1] - v[2]) - 2 * m0 - m1;
    return ((e * t + f) * t + m0) * t + v[1];
}

static double cubic(const struct density_grid *g, const struct cell c[3])
{
    float line[4], row[4], column[4];
    size_t at[3][4];
    places_of(g, c, -1, 4, at);
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            for (int k = 0; k < 4; k++)
                column[k] = (float)density_grid_sample(g, at[0][i] + at[1][j] + at[2][k]);
            row[j] = hermite((float)c[2].fraction, column);
        }
        line[i] = hermite((float)c[1].fraction, row);
    }
    const float v = hermite((float)c[0].fraction, line);
    return v < 0 ? 0 : (double)v;
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *context)
{
    (void)context;
    const struct density_grid *g = p->density;
    if (!g || !(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1 && at.z >= 0 && at.z < 1))
        return 0;
    const struct cell c[3] = {cell_of(at.x, g->size[0]), cell_of(at.y, g->size[1]),
                              cell_of(at.z, g->size[2])};
    switch (p->integer[0] % 10) {
    case 0:
        return density_grid_sample(g, density_grid_place(g, c[0].at, c[1].at, c[2].at));
    case 1: return linear(g, c);
    default: return cubic(g, c);
    }
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    if (p->density && p->integer[0] % 10 == 1) {
        k->grid(p->density, at, out);
        return;
    }
    for (int i = 0; i < 8; i++)
        out[i] = value(p, vec3(at[0][i], at[1][i], at[2][i]), NULL);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    // Cubic curves overshoot by a quarter along each axis.
    return formula_unknown(f, 0, p->integer[0] % 10 <= 1 ? 1 : 2, at);
}

const struct pattern_ops density_file_pattern_ops = {.keyword = "density_file",
                                                     .frequency = 1,
                                                     .value = value,
                                                     .values = values,
                                                     .formula = formula};
