#ifndef TRACE_ANTIALIAS_H
#define TRACE_ANTIALIAS_H

#include <stdatomic.h>
#include <stdint.h>

#include "math/vec.h"
#include "trace/render.h"

struct arena;

// The tables of spec/lighting.md 2.3: T, a shuffle of 0..4095 written twice, and J.
struct jitter_tables {
    uint16_t shuffle[8192];
    double offset[256];
};
void jitter_tables_init(struct jitter_tables *t);
// Two numbers in -0.5..0.5 that depend on the place alone.
struct vec2 jitter_at(const struct jitter_tables *t, double x, double y);

// Traces sample positions: red, green, blue, transparency of each.
typedef void sample_function(void *user, const struct vec2 *position, uint32_t count,
                             float (*out)[4]);

// Colours as their differences are judged, by the curve of spec/lighting.md 2.2, one array a
// channel with room for eight more. `working`: the gamma of scene numbers, which is undone
// first; 0: none, < 0: sRGB. gamma: the curve's.
typedef void judge_function(double working, double gamma, const float (*color)[4],
                            uint32_t count, float *const out[4]);

// Which of eight judged colours from p on differ by the threshold from those from q on.
typedef unsigned differ_function(float *const judged[4], uint32_t p, uint32_t q,
                                 float threshold);

// The centres of the last column and row of every block of a picture, which the blocks on
// the right and below ask for: a sample depends on its place alone. A block traces those
// itself that are not known yet.
struct antialias_seams {
    uint32_t across, size;         // blocks a row, pixels a side
    float (*column)[4], (*row)[4]; // of block i from i * size on
    atomic_uchar *known;           // NULL: none are kept
};
void antialias_seams_init(struct antialias_seams *s, struct arena *a,
                          const struct render_settings *settings);
// Says that the block was done.
void antialias_seams_known(const struct antialias_seams *s, uint32_t block);

// The pixels [x0, x1) x [y0, y1) of a block by anti-aliasing method 1 or 2
// (spec/lighting.md 2.2) as four floats each, rows first.
struct antialias {
    const struct render_settings *settings;
    const struct jitter_tables *jitter;
    double working;
    judge_function *judge;
    differ_function *differ;
    sample_function *sample;
    sample_function *borrow; // the same for pixels of other blocks, which count it
    void *user;
    const struct antialias_seams *seams; // NULL: none are shared
    uint32_t block;                      // its number there
};
void antialias_block(const struct antialias *a, int x0, int y0, int x1, int y1,
                     float (*out)[4]);

#endif
