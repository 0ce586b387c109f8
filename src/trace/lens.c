#include "trace/lens.h"

#include "base/arena.h"
#include "math/chi_square.h"
#include "math/elementary.h"
#include "math/halton.h"
#include "math/larger.h"
#include "math/pi.h"
#include "scene/noise.h"
#include "scene/texture.h"

// Points of a triangular grid inside the lens, in steps of (a, b).
static const signed char points_4[][2] = {{-1, 1}, {1, 1}, {-1, -1}, {1, -1}};
static const signed char points_7[][2] = {{-2, 0},  {0, 0}, {2, 0}, {-1, 1},
                                          {-1, -1}, {1, 1}, {1, -1}};
static const signed char points_19[][2] = {{-2, 2},  {-2, -2}, {2, 2},  {2, -2}, {4, 0},
                                           {-4, 0},  {0, 0},   {0, 2},  {0, -2}, {-3, 1},
                                           {-3, -1}, {3, 1},   {3, -1}, {-1, 1}, {-1, -1},
                                           {1, 1},   {1, -1},  {-2, 0}, {2, 0}};
static const signed char points_37[][2] = {
    {0, 0},   {-3, 3},  {3, -3}, {-3, -3}, {3, 3},   {-6, 0}, {6, 0},  {-2, 2},
    {2, -2},  {-2, -2}, {2, 2},  {-4, 0},  {4, 0},   {-1, 1}, {1, -1}, {-1, -1},
    {1, 1},   {-2, 0},  {2, 0},  {-5, 1},  {-5, -1}, {5, 1},  {5, -1}, {-4, 2},
    {-4, -2}, {4, 2},   {4, -2}, {-1, 3},  {-1, -3}, {1, 3},  {1, -3}, {-3, 1},
    {-3, -1}, {3, 1},   {3, -1}, {0, 2},   {0, -2}};

static double round_6(double v) { return floor(v * 1e6 + 0.5) / 1e6; }

static int points_fixed(struct lens *l)
{
    const signed char(*p)[2] = points_4;
    int n = 4;
    double a = 0.25, b = 0.25;
    if (l->count >= 37) {
        p = points_37;
        n = 37;
        b = 0.125;
    } else if (l->count >= 19) {
        p = points_19;
        n = 19;
        b = 1.0 / 6;
    } else if (l->count >= 7) {
        p = points_7;
        n = 7;
    }
    if (n > 4)
        a = b / sqrt(3);
    if (n > l->count)
        n = l->count;
    for (int i = 0; i < n; i++)
        l->point[i] = (struct vec2){round_6(p[i][0] * a), round_6(p[i][1] * b)};
    return n;
}

static int cell(struct vec2 p, int side)
{
    int x = (int)floor((p.u + 0.5) * side), y = (int)floor((p.v + 0.5) * side);
    x = x < side ? x : side - 1;
    y = y < side ? y : side - 1;
    return y * side + x;
}

// Places that a bokeh may draw for all its samples: dark pigments of many samples end.
enum { BOKEH_DRAWS = 1 << 22 };

// Places all over the square of the lens, as thick as the pigment is light (spec/lighting
// 1.4): the more have been drawn, the less is refused.
static void points_bokeh(struct lens *l, const struct pigment *bokeh)
{
    const double most = smaller((double)l->count * l->count, BOKEH_DRAWS);
    int drawn = 0;
    for (int i = 0; i < l->count; i++) {
        double chance, least;
        do {
            struct vec2 *p = &l->point[i];
            *p = (struct vec2){halton((uint32_t)drawn + 1, 2) - 0.5,
                               halton((uint32_t)drawn + 1, 3) - 0.5};
            const struct texture_point at = {.p = {p->u + 0.5, p->v + 0.5, 0}};
            struct rgbft c;
            drawn++;
            pigment_color(bokeh, &at, &c);
            chance = (double)rgb_luminance(rgbft_rgb(c)) + drawn / most;
            least = noise_random((unsigned)drawn);
        } while (!(chance >= least) && drawn < most);
    }
}

static void points_init(struct lens *l, struct arena *a)
{
    const int n = l->count, draws = 10 * n;
    const int side = 2 * (int)ceil(sqrt(n / PI)) + 1;
    bool *taken = arena_new_array(a, bool, (size_t)(side * side));
    int drawn = 0;
    int i = points_fixed(l);
    for (int k = 0; k < i; k++)
        taken[cell(l->point[k], side)] = true;
    for (; i < n; i++) {
        struct vec2 p;
        bool bad;
        do {
            const int k = drawn++ % draws;
            const double r = sqrt(halton((uint32_t)k + 1, 2) / 4),
                         angle = 2 * PI * halton((uint32_t)k + 1, 3);
            p = (struct vec2){r * det_cos(angle), r * det_sin(angle)};
            bad = taken[cell(p, side)] || p.u * p.u + p.v * p.v > 0.25;
        } while (bad && draws - drawn > n - i);
        taken[cell(p, side)] = true;
        l->point[i] = p;
    }
}

static void spread_init(struct lens *l, const struct jitter_tables *jitter)
{
    for (int i = 0; i < 256; i++) {
        struct vec2 d = {(2 * (i % 16) + 1) / 32.0 - 0.5,
                         (2 * (i / 16) + 1) / 32.0 - 0.5};
        const struct vec2 j = jitter_at(jitter, d.u, d.v);
        d.u += (j.u - 0.5) / 16;
        d.v += (j.v - 0.5) / 16;
        l->spread[i] = d;
    }
}

void lens_init(struct lens *l, struct arena *a, const struct camera *c,
               const struct jitter_tables *jitter)
{
    spread_init(l, jitter);
    const int n = c->blur_samples;
    l->count = n;
    l->point = arena_new_array(a, struct vec2, (size_t)n);
    l->threshold = arena_new_array(a, double, (size_t)n + 1);
    l->shake = n == 7    ? 0.144338
               : n == 19 ? 0.096225
               : n == 37 ? 0.0721688
                         : 0.5 / sqrt(n);
    if (c->bokeh)
        points_bokeh(l, c->bokeh);
    else
        points_init(l, a);
    if (c->variance > 0)
        chi_square_thresholds(c->confidence, c->variance, n, n, l->threshold);
}

// Of many samples the first batches are as large as the rings of the fixed places
// (spec/lighting 1.4), all others are of four.
int lens_batch(const struct lens *l, int done)
{
    static const int batch[] = {7, 6, 6, 4, 4, 4, 4, 2};
    const int lead = l->count >= 37 ? 8 : l->count >= 19 ? 3 : l->count >= 7 ? 1 : 0;
    int sum = 0, next = 4;
    for (int i = 0; i < lead; i++) {
        if (sum == done)
            next = batch[i];
        sum += batch[i];
    }
    return next < l->count - done ? next : l->count - done;
}

void lens_sample(const struct lens *l, const struct jitter_tables *jitter,
                 const struct camera *c, int px, int py, int s, struct vec2 *place,
                 struct vec2 *on_lens)
{
    const int seed = 313 * px + 11 + 311 * py + 17 + s;
    const int cx = jitter->shuffle[seed & 4095] % 16;
    const int cy = jitter->shuffle[(seed + 1) & 4095] % 16;
    const struct vec2 d = l->spread[16 * cy + cx];
    *place = (struct vec2){px + 0.5 + d.u, py + 0.5 + d.v};
    const struct vec2 k = jitter_at(jitter, px + d.u + 0.5, py + d.v - 0.5);
    on_lens->u = c->aperture / 2 * (l->point[s].u + 2 * l->shake * k.u);
    on_lens->v = c->aperture / 2 * (l->point[s].v + 2 * l->shake * k.v);
}
