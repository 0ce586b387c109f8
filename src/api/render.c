// Tracing what was loaded.
#include "api/context.h"
#include "api/gi.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "api/photon_file.h"
#include "api/state.h"
#include "trace/photons.h"
#include "trace/render.h"

// A first and a last row or column (spec/language 7.5) as a half-open range.
static bool region(const struct lambert_context *ctx, const char *first, const char *last,
                   int size, int *begin, int *end)
{
    double a = option_number(ctx, first), b = option_number(ctx, last);
    *begin = 0;
    *end = size;
    if (lambert_option_is_set(ctx, first))
        *begin = a < 1 ? (int)(size * a) : (int)a - 1;
    if (lambert_option_is_set(ctx, last))
        *end = b <= 1 ? (int)(size * b) : (int)b;
    if (*end > size)
        *end = size;
    return *begin < *end && *begin < size;
}

static bool settings_of(const struct lambert_context *ctx, struct render_settings *s)
{
    *s = render_settings_default;
    s->width = (int)option_number(ctx, "width");
    s->height = (int)option_number(ctx, "height");
    s->threads = (int)option_number(ctx, "threads");
    s->tile_size = (int)option_number(ctx, "tile-size");
    s->antialias =
        option_flag(ctx, "antialias") ? (int)option_number(ctx, "antialias-method") : 0;
    s->aa_threshold = option_number(ctx, "antialias-threshold");
    if (s->aa_threshold > 1)
        s->aa_threshold = 1;
    s->aa_depth = (int)option_number(ctx, "antialias-depth");
    s->aa_gamma = option_number(ctx, "antialias-gamma");
    s->aa_jitter_amount = option_number(ctx, "jitter-amount");
    s->aa_jitter = option_flag(ctx, "jitter") && s->aa_jitter_amount > 0;
    s->quality = (int)option_number(ctx, "quality");
    if (s->quality > 9)
        s->quality = 9;
    s->output_alpha = option_flag(ctx, "alpha");
    return region(ctx, "start-column", "end-column", s->width, &s->col_begin,
                  &s->col_end) &&
           region(ctx, "start-row", "end-row", s->height, &s->row_begin, &s->row_end);
}

static void tile_done(void *user, uint32_t done, uint32_t total)
{
    struct lambert_context *ctx = user;
    if (ctx->progress && !ctx->progress(ctx->progress_user, done, total))
        ctx->cancel = true;
}

static void keep_stats(struct lambert_context *ctx, const struct render_stats *r)
{
    struct lambert_stats *s = &ctx->stats;
    s->trace_seconds = r->seconds;
    s->trace_cpu_seconds = r->cpu_seconds;
    s->pixels = r->pixels;
    s->samples = r->samples;
    s->rays = r->trace.rays;
    s->shadow_rays = r->trace.shadow_rays;
    s->node_visits = r->trace.node_visits;
    s->leaf_tests = r->trace.leaf_tests;
    s->csg_tests = r->trace.csg_tests;
    s->function_evaluations = r->trace.evaluations;
    s->tiles_done = r->tiles_done;
    s->tiles_total = r->tiles_total;
    struct rusage usage;
    if (getrusage(RUSAGE_SELF, &usage) == 0)
        s->memory_peak = (uint64_t)usage.ru_maxrss * 1024;
}

static void set_working_space(struct lambert_image *image, const struct settings *s)
{
    switch (s->gamma_mode) {
    case GAMMA_NONE: image->unmanaged = true; break;
    case GAMMA_SRGB: image->working.kind = TRANSFER_SRGB; break;
    case GAMMA_POWER:
        if (s->assumed_gamma < 0.99 || s->assumed_gamma > 1.01)
            image->working = (struct transfer){TRANSFER_POWER, s->assumed_gamma};
        break;
    }
}

enum { GIB = 1 << 30 };

// 0: unknown. The system promises more memory than it has and ends who takes it.
static double physical_memory(void)
{
    long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    return pages > 0 && size > 0 ? (double)pages * (double)size : 0;
}

void lambert_set_state_file(struct lambert_context *ctx, const char *path)
{
    ctx->state_path = path ? arena_strndup(ctx->arena, path, strlen(path)) : NULL;
}

static enum state_mode state_mode_of(const struct lambert_context *ctx)
{
    if (option_flag(ctx, "continue"))
        return STATE_RESUME;
    return option_flag(ctx, "save-state") ? STATE_KEEP : STATE_AT_END;
}

// A picture of `channels` for these settings, or why there is none.
static enum lambert_status new_picture(struct lambert_context *ctx,
                                       const struct render_settings *s, int channels,
                                       struct lambert_image **out)
{
    const double need = (double)s->width * s->height * channels * sizeof(float);
    const double have = physical_memory();
    if (have > 0 && need > have)
        return context_fail(ctx, LAMBERT_ERROR_MEMORY,
                            "a picture of %d x %d needs %.1f GiB of memory, there are "
                            "%.1f",
                            s->width, s->height, need / GIB, have / GIB);
    struct lambert_image *image = calloc(1, sizeof *image);
    if (!image || !image_init(&image->im, s->width, s->height, channels)) {
        free(image);
        return context_fail(ctx, LAMBERT_ERROR_MEMORY, "no memory for the picture");
    }
    set_working_space(image, &ctx->scene.settings);
    *out = image;
    return LAMBERT_OK;
}

// Returns whether the picture is whole.
static bool trace(struct lambert_context *ctx, const struct render_settings *settings,
                  struct image *image)
{
    struct render_stats stats = {0};
    struct render_progress progress = {
        .tile = tile_done, .user = ctx, .cancel = &ctx->cancel};
    struct render_state state;
    if (ctx->state_path) {
        render_state_open(&state, ctx, state_mode_of(ctx), settings, image);
        render_state_attach(&state, &progress);
    }
    const bool whole = render_world(ctx->world, settings, &progress, image, &stats);
    if (ctx->state_path)
        render_state_close(&state, whole);
    keep_stats(ctx, &stats);
    if (stats.photons_left_out)
        diag_at(&ctx->diags, DIAG_BLOCK_WARNING, (struct span){0}, "photons",
                "a map holds %d; the others are left out (a larger spacing or a smaller "
                "count leaves fewer)",
                PHOTONS_MOST);
    return whole;
}

enum lambert_status lambert_render(struct lambert_context *ctx,
                                   struct lambert_image **out)
{
    struct render_settings settings;
    *out = NULL;
    if (!ctx->world)
        return context_fail(ctx, LAMBERT_ERROR_ARGUMENT, "no scene is loaded");
    if (!settings_of(ctx, &settings))
        return context_fail(ctx, LAMBERT_ERROR_OPTION,
                            "the first row or column lies beyond the last");
    struct lambert_image *image = NULL;
    struct photons *photons = NULL;
    struct gi *gi = NULL;
    enum lambert_status status =
        new_picture(ctx, &settings, settings.output_alpha ? 4 : 3, &image);
    if (status == LAMBERT_OK)
        status = photon_files_use(ctx, &settings, &photons);
    if (status == LAMBERT_OK)
        status = gi_prepare(ctx, &settings, &gi);
    const bool ready = status == LAMBERT_OK;
    if (ready && !trace(ctx, &settings, &image->im))
        status = context_fail(ctx, LAMBERT_CANCELLED, "stopped on request");
    gi_free(gi);
    photons_free(photons);
    ctx->cancel = false;
    if (ready)
        *out = image;
    else
        lambert_image_free(image);
    return status;
}
