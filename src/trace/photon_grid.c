#include "trace/photon_grid.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "math/larger.h"

enum {
    HINT_NONE,
    HINT_SPARSE,
    HINT_FIRST, // the distance is the radius, or nearly
    HINT_MOST = UINT8_MAX,
    HINT_SHIFT = 21 // of the bits of floats: steps of a quarter to a seventh
};

// ---- building ------------------------------------------------------------------------

// Cells across so that a photon as far as `wide` is never farther than that many cells.
static double cells_within(double wide, double side) { return floor(wide / side) + 1; }

// Lays cells of that side over the photons and what lies around them; returns how many.
static double lay(struct photon_grid *g, const double low[3], const double high[3],
                  double wide, double side)
{
    const double around = cells_within(wide, side);
    double cells = 1;
    for (int a = 0; a < 3; a++) {
        const double n = floor((high[a] - low[a]) / side) + 1 + 2 * around;
        g->low[a] = low[a] - around * side;
        g->count[a] = n < INT32_MAX ? (uint32_t)n : INT32_MAX;
        cells *= n;
    }
    g->cells_per_unit = 1 / side;
    return cells;
}

// Sets those of n marks, `step` apart, that are at most `around` from a set one; line: room.
static void spread_line(uint8_t *mark, size_t step, uint32_t n, uint32_t around,
                        uint8_t *line)
{
    uint32_t before = 0, behind = 0; // how many more cells the last set one reaches
    for (uint32_t i = 0; i < n; i++) {
        before = mark[i * step] ? around + 1 : before - (before > 0);
        line[i] = before > 0;
    }
    for (uint32_t i = n; i-- > 0;) {
        behind = mark[i * step] ? around + 1 : behind - (behind > 0);
        line[i] |= behind > 0;
    }
    for (uint32_t i = 0; i < n; i++)
        mark[i * step] = line[i];
}

static void spread(uint8_t *mark, const uint32_t count[3], uint32_t around)
{
    const size_t cells = (size_t)count[0] * count[1] * count[2];
    size_t step = 1;
    for (int a = 0; a < 3; step *= count[a++]) {
        uint8_t *line = must_calloc(count[a], 1);
        for (size_t i = 0; i < cells; i++)
            if (i / step % count[a] == 0)
                spread_line(mark + i, step, count[a], around, line);
        free(line);
    }
}

// The cell of a place; false: it is outside.
static bool cell_of(const struct photon_grid *g, const double p[3], int32_t *cell)
{
    int32_t k = 0;
    for (int a = 2; a >= 0; a--) {
        const double at = (p[a] - g->low[a]) * g->cells_per_unit;
        if (!(at >= 0 && at < g->count[a]))
            return false;
        k = k * (int32_t)g->count[a] + (int32_t)at;
    }
    *cell = k;
    return true;
}

static uint32_t bits_of(double distance2)
{
    const float f = (float)distance2;
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    return bits >> HINT_SHIFT;
}

static const float *place_at(const float *places, uint32_t i, size_t stride)
{
    return (const float *)((const char *)places + i * stride);
}

void photon_grid_build(struct photon_grid *g, const float *places, uint32_t count,
                       size_t stride, double radius, double wide)
{
    static const double first_side = 0.5, growth = 1.25; // of the radius; of the side
    enum { LEAST_CELLS = 4096, CELLS_MOST = 1 << 21, CELLS_A_PHOTON = 4 };
    double low[3] = {INFINITY, INFINITY, INFINITY},
           high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < count; i++) {
        for (int a = 0; a < 3; a++) {
            const double x = (double)place_at(places, i, stride)[a];
            low[a] = smaller(x, low[a]);
            high[a] = larger(x, high[a]);
        }
    }
    const double largest =
        fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    if (!count || !(radius > FLT_MIN && wide < FLT_MAX && largest < FLT_MAX))
        return;
    const double most = fmin(CELLS_MOST, LEAST_CELLS + (double)CELLS_A_PHOTON * count);
    double side = fmax(first_side * radius, largest / CELLS_MOST);
    while (lay(g, low, high, wide, side) > most)
        side *= growth;
    const size_t cells = (size_t)g->count[0] * g->count[1] * g->count[2];
    g->near = must_calloc(cells, 1);
    g->seen = must_calloc(3 * cells, sizeof *g->seen);
    g->radius_bits = bits_of(radius * radius);
    for (uint32_t i = 0; i < count; i++) {
        const float *at = place_at(places, i, stride);
        int32_t cell;
        if (cell_of(g, (const double[3]){(double)at[0], (double)at[1], (double)at[2]},
                    &cell))
            g->near[cell] = 1;
    }
    spread(g->near, g->count, (uint32_t)cells_within(wide, side));
}

void photon_grid_end(struct photon_grid *g)
{
    free(g->near);
    free(g->seen);
}

// ---- asking --------------------------------------------------------------------------

static int axis_of(struct vec3 n)
{
    const double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

int32_t photon_grid_place(const struct photon_grid *g, struct vec3 p, struct vec3 normal)
{
    int32_t cell;
    if (!g->near)
        return PHOTON_PLACE_UNKNOWN;
    if (!cell_of(g, (const double[3]){p.x, p.y, p.z}, &cell) || !g->near[cell])
        return PHOTON_PLACE_EMPTY;
    return 3 * cell + axis_of(normal);
}

struct photon_hint photon_grid_recall(const struct photon_grid *g, int32_t place)
{
    struct photon_hint hint = {.sparse = false};
    if (place < 0)
        return hint;
    const uint8_t seen = atomic_load_explicit(&g->seen[place], memory_order_relaxed);
    hint.sparse = seen == HINT_SPARSE;
    if (seen >= HINT_FIRST && g->radius_bits > seen) {
        const uint32_t bits = (g->radius_bits + HINT_FIRST - seen + 1) << HINT_SHIFT;
        float f;
        memcpy(&f, &bits, sizeof f);
        hint.likely2 = (double)f;
    }
    return hint;
}

static uint8_t seen_of(const struct photon_grid *g, struct photon_hint hint)
{
    if (hint.sparse)
        return HINT_SPARSE;
    if (!(hint.likely2 > 0))
        return HINT_NONE;
    const uint32_t bits = bits_of(hint.likely2);
    if (bits >= g->radius_bits)
        return HINT_FIRST;
    const uint32_t less = g->radius_bits - bits;
    return less < HINT_MOST - HINT_FIRST ? (uint8_t)(HINT_FIRST + less) : HINT_MOST;
}

void photon_grid_remember(const struct photon_grid *g, int32_t place,
                          struct photon_hint hint)
{
    if (place < 0)
        return;
    // Threads ask alike places: what is there already is not written again.
    const uint8_t seen = seen_of(g, hint);
    if (atomic_load_explicit(&g->seen[place], memory_order_relaxed) != seen)
        atomic_store_explicit(&g->seen[place], seen, memory_order_relaxed);
}
