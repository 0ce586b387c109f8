// Samples of a grid at eight points, for scene/patterns/density_file.c: each expression is the
// one there. Compiled once per instruction set: ISA names it.
#include "math/isa.h"
#include "math/lanes_vec.h"
#include "scene/density_grid.h"
#include "scene/noise_kernel.h"

// The cells of coordinates, those behind them and the place in them, along one axis.
struct cells8 {
    struct real8 at, next, fraction;
};

LANES_INLINE struct cells8 cells_of(struct real8 v, uint32_t size)
{
    const struct real8 n = r8_set(size), one = r8_set(1), u = r8_mul(v, n);
    struct cells8 c;
    c.at = r8_min(r8_floor(u), r8_sub(n, one));
    c.fraction = r8_sub(u, c.at);
    const struct real8 next = r8_add(c.at, one);
    c.next = r8_select(r8_lt(next, n), next, r8_set(0));
    return c;
}

LANES_INLINE void store_whole8(uint64_t out[8], struct real8 x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    _mm512_storeu_si512(out, _mm512_cvttpd_epi64(x.a));
#else
    double v[8];
    r8_store(v, x);
    for (int i = 0; i < 8; i++)
        out[i] = (uint64_t)v[i];
#endif
}

// The samples of these numbers, 0 to 1.
LANES_INLINE struct real8 samples_at(const struct density_grid *g, struct real8 number)
{
    uint64_t at[8];
    double v[8];
    store_whole8(at, number);
    if (g->width == 1) {
        for (int i = 0; i < 8; i++)
            v[i] = g->level[g->sample[at[i]]];
        return r8_load(v);
    }
    for (int i = 0; i < 8; i++)
        v[i] = density_grid_raw(g, at[i]);
    return r8_div(r8_load(v), r8_set(density_grid_most(g)));
}

void OF_ISA(noise_grid_)(const struct density_grid *g, const double p[3][8],
                         double out[8])
{
    const struct real8 none = r8_set(0), one = r8_set(1);
    struct mask8 in = m8_of(255);
    for (int k = 0; k < 3; k++)
        in = m8_and(in, m8_and(r8_le(none, r8_load(p[k])), r8_lt(r8_load(p[k]), one)));
    const struct real8 row = r8_set(g->size[0]),
                       plane = r8_set((double)g->size[0] * g->size[1]);
    struct real8 place[3][2], weight[3][2], sum = none;
    for (int k = 0; k < 3; k++) {
        const struct cells8 c = cells_of(r8_select(in, r8_load(p[k]), none), g->size[k]);
        const struct real8 step = k == 0 ? one : k == 1 ? row : plane;
        place[k][0] = r8_mul(step, c.at);
        place[k][1] = r8_mul(step, c.next);
        weight[k][0] = r8_sub(one, c.fraction);
        weight[k][1] = c.fraction;
    }
    for (int i = 0; i < 8; i++) {
        const int x = i & 1, y = i >> 1 & 1, z = i >> 2;
        const struct real8 number = r8_add(r8_add(place[0][x], place[1][y]), place[2][z]);
        const struct real8 w = r8_mul(r8_mul(weight[0][x], weight[1][y]), weight[2][z]);
        sum = r8_add(sum, r8_mul(w, samples_at(g, number)));
    }
    r8_store(out, r8_select(in, sum, none));
}
