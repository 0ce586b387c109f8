#include "trace/render.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/clock.h"
#include "base/memory.h"
#include "base/stack.h"
#include "trace/photons.h"
#include "trace/scratch.h"
#include "trace/tile.h"

const struct render_settings render_settings_default = {
    .width = 320,
    .height = 240,
    .col_end = 320,
    .row_end = 240,
    .tile_size = 32,
    .aa_threshold = 0.3,
    .aa_depth = 3,
    .aa_gamma = 2.5,
    .aa_jitter = true,
    .aa_jitter_amount = 1,
    .quality = 9,
};

struct render {
    const struct job *job;
    const struct render_progress *progress;
    struct image *out;
    struct tile_tables tables;
    uint32_t tiles_total;
    atomic_uint_fast32_t next;
    pthread_mutex_t lock; // of progress calls and of stats
    struct render_stats stats;
};

static bool cancelled(const struct render *r)
{
    return r->progress && r->progress->cancel && *r->progress->cancel;
}

static uint32_t tiles_in(int begin, int end, int size)
{
    return end > begin ? (uint32_t)((end - begin + size - 1) / size) : 0;
}

static int least(int a, int b) { return a < b ? a : b; }

static struct render_tile tile_at(const struct render_settings *s, uint32_t i)
{
    const uint32_t across = tiles_in(s->col_begin, s->col_end, s->tile_size);
    struct render_tile tile = {.index = i,
                               .x0 = s->col_begin + (int)(i % across) * s->tile_size,
                               .y0 = s->row_begin + (int)(i / across) * s->tile_size};
    tile.x1 = least(tile.x0 + s->tile_size, s->col_end);
    tile.y1 = least(tile.y0 + s->tile_size, s->row_end);
    return tile;
}

static uint32_t tile_count(const struct render_settings *s)
{
    return tiles_in(s->col_begin, s->col_end, s->tile_size) *
           tiles_in(s->row_begin, s->row_end, s->tile_size);
}

static void stats_add(struct render_stats *to, const struct tracer *t)
{
    const struct trace_stats *s = trace_scratch_stats(t->scratch);
    to->trace.rays += s->rays;
    to->trace.shadow_rays += s->shadow_rays;
    to->trace.node_visits += s->node_visits;
    to->trace.leaf_tests += s->leaf_tests;
    to->trace.csg_tests += s->csg_tests;
    to->trace.evaluations += s->evaluations;
    to->samples += t->samples;
}

static void tile_done(struct render *r, const struct render_tile *tile)
{
    const struct render_progress *p = r->progress;
    r->stats.pixels += (uint64_t)(tile->x1 - tile->x0) * (uint64_t)(tile->y1 - tile->y0);
    r->stats.tiles_done++;
    if (p && p->keep)
        p->keep(p->keep_user, tile);
    if (p && p->tile)
        p->tile(p->user, r->stats.tiles_done, r->tiles_total);
}

// A tile that a cancel broke off is as one that was never begun.
static void drop(const struct image *out, const struct render_tile *tile)
{
    const size_t row = (size_t)(tile->x1 - tile->x0) * (size_t)out->channels;
    for (int y = tile->y0; y < tile->y1; y++)
        memset(image_at(out, tile->x0, y), 0, row * sizeof *out->pixel);
}

static void work(void *user)
{
    struct render *r = user;
    struct tracer *t = tracer_new(r->job);
    t->scratch->crossings.cancel = r->progress ? r->progress->cancel : NULL;
    while (!cancelled(r)) {
        const uint32_t i = (uint32_t)atomic_fetch_add(&r->next, 1);
        if (i >= r->tiles_total)
            break;
        if (r->progress && r->progress->have && r->progress->have[i])
            continue;
        const struct render_tile tile = tile_at(&r->job->settings, i);
        tile_render(t, &r->tables, &tile, r->out);
        if (t->scratch->crossings.cut) {
            drop(r->out, &tile);
            break;
        }
        pthread_mutex_lock(&r->lock);
        tile_done(r, &tile);
        pthread_mutex_unlock(&r->lock);
    }
    pthread_mutex_lock(&r->lock);
    stats_add(&r->stats, t);
    pthread_mutex_unlock(&r->lock);
    tracer_free(t);
}

static uint32_t thread_count(const struct render_settings *s, uint32_t tiles)
{
    long n = s->threads > 0 ? s->threads : sysconf(_SC_NPROCESSORS_ONLN);
    if (n < 1)
        n = 1;
    return (uint32_t)n < tiles ? (uint32_t)n : tiles;
}

// Each on a stack of its own: patterns and objects may be nested as deep as the
// language allows.
static void *work_deep(void *user)
{
    stack_run(work, user);
    return NULL;
}

static void work_in_threads(struct render *r)
{
    const uint32_t count = thread_count(&r->job->settings, r->tiles_total);
    pthread_t *thread = must_calloc(count + 1, sizeof *thread);
    uint32_t started = 0;
    // This thread works too; if the system refuses a thread, the others do its share.
    while (started + 1 < count &&
           pthread_create(&thread[started], NULL, work_deep, r) == 0)
        started++;
    work_deep(r);
    for (uint32_t i = 0; i < started; i++)
        pthread_join(thread[i], NULL);
    free(thread);
}

static void settings_check(struct render_settings *s)
{
    if (s->col_end <= 0 || s->col_end > s->width)
        s->col_end = s->width;
    if (s->row_end <= 0 || s->row_end > s->height)
        s->row_end = s->height;
    if (s->col_begin < 0)
        s->col_begin = 0;
    if (s->row_begin < 0)
        s->row_begin = 0;
    if (s->tile_size < 1)
        s->tile_size = render_settings_default.tile_size;
    if (s->aa_depth < 1)
        s->aa_depth = 1;
    if (s->aa_depth > 9)
        s->aa_depth = 9;
}

uint32_t render_tile_count(const struct render_settings *settings)
{
    struct render_settings s = *settings;
    settings_check(&s);
    return tile_count(&s);
}

struct render_tile render_tile_at(const struct render_settings *settings, uint32_t i)
{
    struct render_settings s = *settings;
    settings_check(&s);
    return tile_at(&s, i);
}

struct shooting {
    const struct job *job;
    const struct photon_store *store;
    const volatile bool *cancel;
    struct photons *photons;
};

// On a deep stack, as what renders.
static void shoot(void *user)
{
    struct shooting *s = user;
    s->photons = photons_shoot(s->job, s->store, s->cancel);
}

static struct photons *shot(const struct job *job, const struct photon_store *store,
                            const volatile bool *cancel)
{
    struct shooting s = {job, store, cancel, NULL};
    if (job->shoots)
        stack_run(shoot, &s);
    return s.photons;
}

struct photons *render_photons(const struct world *w,
                               const struct render_settings *settings,
                               const struct photon_store *store,
                               const volatile bool *cancel)
{
    struct render_settings s = *settings;
    struct job job;
    settings_check(&s);
    if (!w->scene->settings.photons.on)
        return NULL;
    struct arena *arena = arena_new(4096);
    job_init(&job, arena, w, &s);
    struct photons *p = shot(&job, store, cancel);
    arena_free(arena);
    return p;
}

bool render_world(const struct world *w, const struct render_settings *settings,
                  const struct render_progress *progress, struct image *out,
                  struct render_stats *stats)
{
    struct render_settings s = *settings;
    settings_check(&s);
    if (!out->pixel && !image_init(out, s.width, s.height, 4))
        out_of_memory();
    struct arena *arena = arena_new(4096);
    struct job job;
    job_init(&job, arena, w, &s);
    struct render r = {.job = &job, .progress = progress, .out = out};
    tile_tables_init(&r.tables, arena, &job);
    r.tiles_total = tile_count(&s);
    for (uint32_t i = 0; progress && progress->have && i < r.tiles_total; i++)
        r.stats.tiles_done += progress->have[i];
    pthread_mutex_init(&r.lock, NULL);
    const double begin = clock_seconds(CLOCK_MONOTONIC),
                 cpu_begin = clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
    struct photons *photons = NULL;
    if (r.tiles_total && !job.photons)
        job.photons = photons = shot(&job, NULL, progress ? progress->cancel : NULL);
    if (r.tiles_total)
        work_in_threads(&r);
    r.stats.seconds = clock_seconds(CLOCK_MONOTONIC) - begin;
    r.stats.cpu_seconds = clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu_begin;
    r.stats.tiles_total = r.tiles_total;
    r.stats.photons_left_out =
        job.photons && (job.photons->surface.full || job.photons->media.full);
    pthread_mutex_destroy(&r.lock);
    photons_free(photons);
    arena_free(arena);
    if (stats)
        *stats = r.stats;
    return r.stats.tiles_done == r.tiles_total;
}
