#include "tess/map_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { CELLS_MAX = 2048, ROUND_MIN = 8, TRIALS = 16 };

// Points of an edge closer than this, relative to the piece, are one point.
static const double same_point = 1e-12;

struct piece {
    const struct tess_map *map;
    const void *shape;
    const struct transform *t;
    uint32_t index;
    uint32_t nu, nv;
    double size;
};

static struct vec3 point(const struct piece *p, double u, double v)
{
    struct map_point at;
    p->map->at(p->shape, p->index, u, v, &at);
    return transform_point(p->t, at.p);
}

// The longest of some curves along u (or v) of the piece.
static double longest(const struct piece *p, bool along_u)
{
    double most = 0;
    for (int i = 0; i <= TRIALS; i++) {
        double length = 0;
        for (int k = 0; k < TRIALS; k++) {
            const double a = (double)k / TRIALS, b = (k + 1.0) / TRIALS;
            const double c = (double)i / TRIALS;
            length += along_u ? vec3_length(vec3_sub(point(p, b, c), point(p, a, c)))
                              : vec3_length(vec3_sub(point(p, c, b), point(p, c, a)));
        }
        most = fmax(most, length);
    }
    return most;
}

static uint32_t cells(double length, double step, uint32_t least)
{
    const double n = fmin(fmax(ceil(length / step), least), CELLS_MAX);
    return n > 0 ? (uint32_t)n : least;
}

static bool shrinks(const struct piece *p, double v)
{
    const struct vec3 first = point(p, 0, v);
    for (int k = 1; k <= TRIALS; k++)
        if (vec3_length(vec3_sub(point(p, (double)k / TRIALS, v), first)) >
            same_point * p->size)
            return false;
    return true;
}

static void add_row(const struct piece *p, uint32_t j, uint32_t *row,
                    struct tess_mesh *out)
{
    const double v = (double)j / p->nv;
    const bool one = (j == 0 || j == p->nv) && shrinks(p, v);
    const bool around = p->map->wraps & MAP_WRAPS_U;
    for (uint32_t i = 0; i <= p->nu; i++)
        row[i] = (i > 0 && one) || (i == p->nu && around)
                     ? row[0]
                     : tess_mesh_add_vertex(out, point(p, (double)i / p->nu, v));
}

static void add_triangle(const uint32_t v[3], bool turned, struct tess_mesh *out)
{
    if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0])
        tess_mesh_add_triangle(out, v[0], turned ? v[2] : v[1], turned ? v[1] : v[2]);
}

// Whether du x dv runs against the normal, in the world.
static bool faces_back(const struct piece *p, double u, double v)
{
    struct map_point at;
    p->map->at(p->shape, p->index, u, v, &at);
    const struct vec3 up =
        vec3_cross(transform_vector(p->t, at.du), transform_vector(p->t, at.dv));
    return vec3_dot(up, transform_normal(p->t, at.n)) < 0;
}

static void add_cells(const struct piece *p, uint32_t j, const uint32_t *low,
                      const uint32_t *high, struct tess_mesh *out)
{
    for (uint32_t i = 0; i < p->nu; i++) {
        const bool turned = faces_back(p, (i + 0.5) / p->nu, (j + 0.5) / p->nv);
        const uint32_t a[3] = {low[i], low[i + 1], high[i + 1]};
        const uint32_t b[3] = {low[i], high[i + 1], high[i]};
        add_triangle(a, turned, out);
        add_triangle(b, turned, out);
    }
}

static void add_piece(struct piece *p, double step, struct tess_mesh *out)
{
    const double u = longest(p, true), v = longest(p, false);
    p->size = u + v;
    if (!(p->size > 0))
        return;
    p->nu = cells(u, step, p->map->wraps & MAP_WRAPS_U ? ROUND_MIN : 1);
    p->nv = cells(v, step, p->map->wraps & MAP_WRAPS_V ? ROUND_MIN : 1);
    uint32_t *low = must_malloc(p->nu + 1, sizeof *low);
    uint32_t *high = must_malloc(p->nu + 1, sizeof *high);
    uint32_t *first = must_malloc(p->nu + 1, sizeof *first);
    add_row(p, 0, low, out);
    memcpy(first, low, (p->nu + 1) * sizeof *first);
    for (uint32_t j = 0; j < p->nv; j++) {
        if (j + 1 == p->nv && (p->map->wraps & MAP_WRAPS_V))
            memcpy(high, first, (p->nu + 1) * sizeof *first);
        else
            add_row(p, j + 1, high, out);
        add_cells(p, j, low, high, out);
        uint32_t *swap = low;
        low = high;
        high = swap;
    }
    free(low);
    free(high);
    free(first);
}

void tess_map_mesh(const struct tess_map *map, const void *shape,
                   const struct transform *t, double step, struct tess_mesh *out)
{
    const uint32_t count = map->count(shape);
    for (uint32_t i = 0; i < count; i++) {
        struct piece p = {.map = map, .shape = shape, .t = t, .index = i};
        add_piece(&p, step, out);
    }
}
