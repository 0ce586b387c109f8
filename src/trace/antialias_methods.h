#ifndef TRACE_ANTIALIAS_METHODS_H
#define TRACE_ANTIALIAS_METHODS_H

// What both methods of anti-aliasing ask for. Within the module antialias*.c.
#include <math.h>

#include "base/memory.h"
#include "trace/antialias.h"

// Colours as differences are judged, one array a channel, with room for eight more.
struct judged {
    float *c[4];
};

static inline void judge(const struct antialias *a, const float (*color)[4],
                         uint32_t count, const struct judged *out)
{
    a->judge(a->working, a->settings->aa_gamma, color, count, out->c);
}

// The threshold for differences, which are floats.
static inline float judged_threshold(const struct antialias *a)
{
    const float t = (float)a->settings->aa_threshold;
    return (double)t < a->settings->aa_threshold ? nextafterf(t, INFINITY) : t;
}

// Which of the eight colours from p on differ from those from q on.
static inline unsigned differ8(const struct antialias *a, const struct judged *j, int p,
                               int q)
{
    return a->differ(j->c, (uint32_t)p, (uint32_t)q, judged_threshold(a));
}

static inline void sample_batch(const struct antialias *a, const struct vec2 *position,
                                uint32_t count, float (*out)[4])
{
    a->sample(a->user, position, count, out);
}

static inline void judged_begin(struct judged *j, size_t count)
{
    j->c[0] = must_calloc(4 * (count + 8), sizeof *j->c[0]);
    for (int k = 1; k < 4; k++)
        j->c[k] = j->c[k - 1] + count + 8;
}

// As antialias_block.
void antialias_method_1(const struct antialias *a, int x0, int y0, int x1, int y1,
                        float (*out)[4]);
void antialias_method_2(const struct antialias *a, int x0, int y0, int x1, int y1,
                        float (*out)[4]);

#endif
