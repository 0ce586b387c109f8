#include "trace/antialias_methods.h"

#include <string.h>

#include "base/arena.h"

void jitter_tables_init(struct jitter_tables *t)
{
    enum { N = 4096 };
    for (int i = 0; i < N; i++)
        t->shuffle[i] = (uint16_t)i;
    uint32_t s = 0;
    for (int i = N - 1; i >= 0; i--) {
        s = s * 1812433253u + 12345u;
        const int j = (int)((s >> 16) & 32767) % N;
        const uint16_t swap = t->shuffle[i];
        t->shuffle[i] = t->shuffle[j];
        t->shuffle[j] = swap;
    }
    memcpy(t->shuffle + N, t->shuffle, N * sizeof *t->shuffle);
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t crc = i; // the byte table of CRC-16, reflected polynomial A001h
        for (int k = 0; k < 8; k++)
            crc = crc & 1 ? (crc >> 1) ^ 0xa001u : crc >> 1;
        const double v = (double)((2 * crc) % 65536) / 65536 - 0.5;
        t->offset[i] = floor(v * 1e6 + 0.5) / 1e6;
    }
}

static double jitter_axis(const struct jitter_tables *t, double a, double b)
{
    const int64_t x = (int64_t)a, y = (int64_t)b; // towards zero
    const uint32_t inner = t->shuffle[x & 4095];
    return t->offset[t->shuffle[(inner ^ (uint32_t)y) & 4095] & 255];
}

struct vec2 jitter_at(const struct jitter_tables *t, double x, double y)
{
    return (struct vec2){jitter_axis(t, 1021 * x, 1019 * y),
                         jitter_axis(t, 1019 * x, 1021 * y)};
}

void antialias_seams_init(struct antialias_seams *s, struct arena *a,
                          const struct render_settings *settings)
{
    const int width = settings->col_end - settings->col_begin;
    const size_t blocks = render_tile_count(settings);
    s->size = (uint32_t)settings->tile_size;
    s->across = ((uint32_t)width + s->size - 1) / s->size;
    s->column = arena_alloc(a, blocks * s->size * sizeof *s->column);
    s->row = arena_alloc(a, blocks * s->size * sizeof *s->row);
    s->known = arena_new_array(a, atomic_uchar, blocks);
}

void antialias_seams_known(const struct antialias_seams *s, uint32_t block)
{
    if (s->known)
        atomic_store_explicit(&s->known[block], 1, memory_order_release);
}

void antialias_block(const struct antialias *a, int x0, int y0, int x1, int y1,
                     float (*out)[4])
{
    if (a->settings->antialias == 2)
        antialias_method_2(a, x0, y0, x1, y1, out);
    else
        antialias_method_1(a, x0, y0, x1, y1, out);
}
