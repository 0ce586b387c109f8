#include "trace/tile.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "trace/shade_kernel.h"

// Every other bit of a Morton code, from bit 0: one coordinate.
static uint32_t morton_part(uint32_t code)
{
    code &= 0x55555555u;
    code = (code | (code >> 1)) & 0x33333333u;
    code = (code | (code >> 2)) & 0x0f0f0f0fu;
    code = (code | (code >> 4)) & 0x00ff00ffu;
    return (code | (code >> 8)) & 0x0000ffffu;
}

static int least(int a, int b) { return a < b ? a : b; }

// Rows are a counting sort: places of a row are in order already.
static void sort_rows(const struct tile_place *place, uint32_t count, uint32_t *begin,
                      int height, uint16_t *by_row)
{
    memset(begin, 0, ((size_t)height + 1) * sizeof *begin);
    for (uint32_t k = 0; k < count; k++)
        begin[place[k].y + 1]++;
    for (int y = 1; y <= height; y++)
        begin[y] += begin[y - 1];
    for (uint32_t k = 0; k < count; k++)
        by_row[begin[place[k].y]++] = (uint16_t)k;
}

static uint32_t batch_of(const struct tile_tables *t, uint32_t first)
{
    const uint32_t left = t->place_count - first;
    return left < BATCH_SIZE ? left : BATCH_SIZE;
}

void tile_tables_init(struct tile_tables *t, struct arena *a, const struct job *job)
{
    enum { BLOCK = 32 }; // of pixels in Morton order
    const struct render_settings *s = &job->settings;
    const int width = least(s->tile_size, s->col_end - s->col_begin);
    const int height = least(s->tile_size, s->row_end - s->row_begin);
    if (s->antialias || camera_has_lens(job->camera))
        jitter_tables_init(&t->jitter);
    if (s->antialias == 1 && !camera_has_lens(job->camera))
        antialias_seams_init(&t->seams, a, s);
    if (camera_has_lens(job->camera))
        lens_init(&t->lens, a, job->camera, &t->jitter);
    t->place_count = 0;
    if (width <= 0 || height <= 0)
        return;
    t->place = arena_new_array(a, struct tile_place, (size_t)width * (size_t)height);
    for (int y0 = 0; y0 < height; y0 += BLOCK) {
        for (int x0 = 0; x0 < width; x0 += BLOCK) {
            for (uint32_t code = 0; code < BLOCK * BLOCK; code++) {
                const int x = x0 + (int)morton_part(code);
                const int y = y0 + (int)morton_part(code >> 1);
                if (x < width && y < height)
                    t->place[t->place_count++] =
                        (struct tile_place){(uint16_t)x, (uint16_t)y};
            }
        }
    }
    t->by_row = arena_new_array(a, uint16_t, t->place_count);
    uint32_t *begin = arena_new_array(a, uint32_t, (size_t)height + 1);
    for (uint32_t i = 0; i < t->place_count; i += BATCH_SIZE)
        sort_rows(t->place + i, batch_of(t, i), begin, height, t->by_row + i);
}

// The color is red, green, blue and transparency.
static inline void store(const struct image *out, float *pixel, const float c[4])
{
    memcpy(pixel, c, 3 * sizeof *c);
    if (out->channels == 4)
        pixel[3] = 1 - c[3];
}

static void sample(void *user, const struct vec2 *position, uint32_t count,
                   float (*out)[4])
{
    tracer_samples(user, position, count, out);
}

static void borrow(void *user, const struct vec2 *position, uint32_t count,
                   float (*out)[4])
{
    struct tracer *t = user;
    const struct trace_stats stats = t->scratch->stats;
    const uint64_t samples = t->samples;
    tracer_samples(t, position, count, out);
    t->scratch->stats = stats;
    t->samples = samples;
}

// Pixels of a tile that are traced together, and their samples.
struct plain_batch {
    struct vec2 position[BATCH_SIZE];
    struct tile_place place[BATCH_SIZE];
    float color[BATCH_SIZE][4]; // of cameras with several rays a sample
};

// by_row: the places in the order of their pixels; NULL: as they come.
static inline void store_places(const struct render_tile *tile,
                                const struct tile_place *place, const uint16_t *by_row,
                                uint32_t count, const float *color, struct image *out)
{
    float *const corner = image_at(out, tile->x0, tile->y0);
    const int width = out->width, channels = out->channels;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t k = by_row ? by_row[i] : i;
        const struct tile_place p = place[k];
        store(out, corner + ((ptrdiff_t)p.y * width + p.x) * channels, color + 4 * k);
    }
}

static void plain_trace(struct tracer *t, const struct render_tile *tile,
                        const struct tile_place *place, const uint16_t *by_row,
                        uint32_t count, struct plain_batch *b, struct image *out)
{
    const float *color = b->color[0]; // red, green, blue, transparency
    for (uint32_t k = 0; k < count; k++)
        b->position[k] =
            (struct vec2){tile->x0 + place[k].x + 0.5, tile->y0 + place[k].y + 0.5};
    if (t->job->camera->mesh)
        tracer_samples(t, b->position, count, b->color);
    else
        color = &tracer_batch(t, b->position, NULL, count)->light.r;
    store_places(tile, place, by_row, count, color, out);
}

// One ray a pixel, in Morton order, so that rays of a packet stay close together.
static void plain(struct tracer *t, const struct tile_tables *tables,
                  const struct render_tile *tile, struct image *out)
{
    struct plain_batch b;
    const int width = tile->x1 - tile->x0, height = tile->y1 - tile->y0;
    const uint32_t places = tables->place_count;
    if ((uint32_t)(width * height) == places) { // all of them
        for (uint32_t i = 0; i < places; i += BATCH_SIZE)
            plain_trace(t, tile, tables->place + i, tables->by_row + i,
                        batch_of(tables, i), &b, out);
        return;
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < places; i++) {
        const struct tile_place p = tables->place[i];
        if (p.x >= width || p.y >= height)
            continue;
        b.place[count++] = p;
        if (count == BATCH_SIZE) {
            plain_trace(t, tile, b.place, NULL, count, &b, out);
            count = 0;
        }
    }
    if (count)
        plain_trace(t, tile, b.place, NULL, count, &b, out);
}

static double working_gamma(const struct settings *s)
{
    return s->gamma_mode == GAMMA_SRGB    ? -1
           : s->gamma_mode == GAMMA_POWER ? s->assumed_gamma
                                          : 0;
}

static void smoothed(struct tracer *t, const struct tile_tables *tables,
                     const struct render_tile *tile, struct image *out)
{
    const struct job *job = t->job;
    const int width = tile->x1 - tile->x0, height = tile->y1 - tile->y0;
    float(*color)[4] = must_malloc((size_t)width * height, sizeof *color);
    const struct antialias a = {.settings = &job->settings,
                                .jitter = &tables->jitter,
                                .working = working_gamma(&job->scene->settings),
                                .judge = job->kernels->judge,
                                .differ = job->kernels->differ,
                                .sample = sample,
                                .borrow = borrow,
                                .user = t,
                                .seams = &tables->seams,
                                .block = tile->index};
    antialias_block(&a, tile->x0, tile->y0, tile->x1, tile->y1, color);
    if (!t->scratch->crossings.cut)
        antialias_seams_known(&tables->seams, tile->index);
    for (int i = 0; i < width * height; i++)
        store(out, image_at(out, tile->x0 + i % width, tile->y0 + i / width), color[i]);
    free(color);
}

// ---- focal blur ----------------------------------------------------------
struct blurred {
    double sum[4], square[4];
    int done; // samples taken
    bool open;
};

static bool has_enough(const struct lens *lens, const struct camera *c,
                       const struct blurred *b)
{
    if (b->done < c->blur_samples_min)
        return false;
    for (int k = 0; k < 4; k++) {
        const double mean = b->sum[k] / b->done;
        const double spread = (b->square[k] / b->done - mean * mean) / b->done;
        if (spread >= lens->threshold[b->done])
            return false;
    }
    return true;
}

// Rays through the lens of several pixels, to be traced together.
struct lens_rays {
    struct vec2 position[BATCH_SIZE], on_lens[BATCH_SIZE];
    struct blurred *pixel[BATCH_SIZE];
    uint32_t count;
};

static void lens_trace(struct tracer *t, struct lens_rays *r)
{
    const struct sample_sum *sum = tracer_batch(t, r->position, r->on_lens, r->count);
    for (uint32_t i = 0; i < r->count; i++) {
        struct blurred *b = r->pixel[i];
        const float color[4] = {sum[i].light.r, sum[i].light.g, sum[i].light.b, sum[i].t};
        for (int k = 0; k < 4; k++) {
            const double c = (double)color[k];
            b->sum[k] += c;
            b->square[k] += c * c;
        }
        b->done++;
    }
    r->count = 0;
}

// Traces the next batch of every pixel that still needs one; returns how many do.
static int blur_round(struct tracer *t, const struct tile_tables *tables,
                      const struct render_tile *tile, struct blurred *pixel,
                      struct lens_rays *r)
{
    const struct job *job = t->job;
    const struct lens *lens = &tables->lens;
    const int width = tile->x1 - tile->x0, count = width * (tile->y1 - tile->y0);
    int open = 0;
    for (int i = 0; i < count; i++) {
        struct blurred *b = &pixel[i];
        const int n = b->open ? lens_batch(lens, b->done) : 0;
        if (r->count + (uint32_t)n > BATCH_SIZE)
            lens_trace(t, r);
        for (int s = 0; s < n; s++) {
            lens_sample(lens, &tables->jitter, job->camera, tile->x0 + i % width,
                        tile->y0 + i / width, b->done + s, &r->position[r->count],
                        &r->on_lens[r->count]);
            r->pixel[r->count++] = b;
        }
    }
    lens_trace(t, r);
    for (int i = 0; i < count; i++) {
        struct blurred *b = &pixel[i];
        b->open = b->open && b->done < lens->count && !has_enough(lens, job->camera, b);
        open += b->open;
    }
    return open;
}

static void blurred(struct tracer *t, const struct tile_tables *tables,
                    const struct render_tile *tile, struct image *out)
{
    const int width = tile->x1 - tile->x0, count = width * (tile->y1 - tile->y0);
    struct blurred *pixel = must_calloc((size_t)count, sizeof *pixel);
    struct lens_rays *rays = must_malloc(1, sizeof *rays);
    rays->count = 0;
    for (int i = 0; i < count; i++)
        pixel[i].open = true;
    while (!tracer_gives_up(t) && blur_round(t, tables, tile, pixel, rays))
        ;
    for (int i = 0; i < count; i++) {
        float mean[4];
        for (int k = 0; k < 4; k++)
            mean[k] = (float)(pixel[i].sum[k] / pixel[i].done);
        store(out, image_at(out, tile->x0 + i % width, tile->y0 + i / width), mean);
    }
    free(pixel);
    free(rays);
}

void tile_render(struct tracer *t, const struct tile_tables *tables,
                 const struct render_tile *tile, struct image *out)
{
    if (camera_has_lens(t->job->camera))
        blurred(t, tables, tile, out); // the samples lie all over a pixel: smooth too
    else if (t->job->settings.antialias)
        smoothed(t, tables, tile, out);
    else
        plain(t, tables, tile, out);
}
