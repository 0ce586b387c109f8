// Light by way of other surfaces, as scene and options ask for it.
#include "api/gi.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "api/sample_file.h"
#include "base/arena.h"
#include "irradiance/cache.h"
#include "radiosity/radiosity.h"
#include "scene/texture.h"
#include "trace/photons.h"

struct gi {
    struct arena *arena;
    struct job job;
    struct radiosity *radiosity;
    struct irradiance_cache *cache;
    struct photons *photons;
};

static const char *text_of(const struct lambert_context *ctx, const char *name)
{
    return lambert_option_text(ctx, name);
}

// A fraction, or a percentage with its sign; < 0: neither.
static double error_of(const char *text)
{
    char *end;
    if (!text)
        return 0;
    const double v = strtod(text, &end);
    if (end == text || !(v > 0))
        return -1;
    if (strcmp(end, "%") == 0)
        return v / 100;
    return *end || v >= 1 ? -1 : v;
}

static uint32_t word_number(const char *word, const char *const *words)
{
    uint32_t i = 0;
    while (words[i] && strcmp(words[i], word) != 0)
        i++;
    return i;
}

static struct radiosity_options options_of(const struct lambert_context *ctx)
{
    static const char *const emitters[] = {"auto", "mesh", NULL};
    static const char *const closures[] = {"auto", "enforce", "report", NULL};
    struct radiosity_options o = radiosity_defaults;
    const int threads = (int)option_number(ctx, "threads");
    const uint32_t seed = (uint32_t)option_number(ctx, "gi-seed");
    o.patches.count = option_number(ctx, "gi-patches");
    o.patches.size = option_number(ctx, "gi-patch-size");
    o.factors.method = text_of(ctx, "gi-method");
    o.factors.points = (int)option_number(ctx, "gi-points");
    o.factors.shadow_rays = (int)option_number(ctx, "gi-shadow-rays");
    o.factors.rays = (int)option_number(ctx, "gi-factor-rays");
    o.factors.resolution = (int)option_number(ctx, "gi-resolution");
    o.solver.solver = text_of(ctx, "gi-solver");
    o.solver.tolerance = option_number(ctx, "gi-tolerance");
    o.solver.rays = (uint64_t)option_number(ctx, "gi-rays");
    o.patches.threads = o.factors.threads = o.solver.threads = threads;
    o.factors.seed = o.solver.seed = seed;
    o.gather = (uint32_t)option_number(ctx, "gi-gather");
    o.memory = option_number(ctx, "gi-memory") * 1048576;
    o.emitters = (enum emitters)word_number(text_of(ctx, "gi-emitters"), emitters);
    o.closure = (enum closure)word_number(text_of(ctx, "gi-closure"), closures);
    return o;
}

static void tell(struct lambert_context *ctx, const char *text)
{
    if (!ctx->message)
        return;
    struct lambert_message m = {.kind = LAMBERT_NOTE, .text = text, .rendered = NULL};
    char *line = arena_printf(ctx->scene_arena, "%s\n", text);
    m.rendered = line;
    ctx->message(ctx->message_user, &m);
}

static void report(struct lambert_context *ctx, const struct radiosity *r)
{
    const struct radiosity_report *p = &r->report;
    char text[512], more[160] = "";
    if (p->error >= 0)
        snprintf(more, sizeof more, ", error about %.2g %%%s", 100 * p->error,
                 p->converged ? "" : " (more than asked for)");
    if (p->loaded)
        snprintf(text, sizeof text, "radiosity: %u patches, solution read from a file",
                 p->elements);
    else
        snprintf(text, sizeof text,
                 "radiosity: %u patches, %s, %s, %u steps, %.3g rays, %.3g MB, %.2f s%s; "
                 "energy off by %.1g, rows %.4f to %.4f%s",
                 p->elements, p->method, p->solver, p->steps, (double)p->rays,
                 p->bytes / 1e6, p->seconds, more, p->defect, p->row_sum_least,
                 p->row_sum_most, p->balanced ? " (balanced)" : "");
    tell(ctx, text);
}

// In thousandths; tiles are counted anew afterwards.
static void tell_progress(void *user, double share)
{
    enum { WHOLE = 1000 };
    struct lambert_context *ctx = user;
    if (ctx->progress &&
        !ctx->progress(ctx->progress_user, (uint32_t)(WHOLE * share), WHOLE))
        ctx->cancel = true;
}

const char *gi_solution(const struct lambert_context *ctx, bool in)
{
    const char *own = text_of(ctx, in ? "gi-load" : "gi-save");
    const char *file = text_of(ctx, "radiosity-file");
    if (own || !file ||
        !option_flag(ctx, in ? "radiosity-from-file" : "radiosity-to-file"))
        return own;
    return in && access(file, F_OK) ? NULL : file; // POV-Ray goes on without, too
}

// An animation's first picture has no file to read; who only reads has misspelt it.
static void warn_missing(struct lambert_context *ctx)
{
    const char *file = text_of(ctx, "radiosity-file");
    if (option_flag(ctx, "radiosity-from-file") && !gi_solution(ctx, true) &&
        !option_flag(ctx, "radiosity-to-file"))
        diag_at(&ctx->diags, DIAG_BLOCK_WARNING, (struct span){0}, "Radiosity_From_File",
                arena_printf(ctx->scene_arena,
                             "there is no file '%s': all light is computed anew", file));
}

static enum lambert_status write_files(struct lambert_context *ctx, const struct gi *g)
{
    const char *save = gi_solution(ctx, false), *ply = text_of(ctx, "gi-ply");
    char *e = ctx->error;
    if (save && !radiosity_save(g->radiosity, save, e, sizeof ctx->error))
        return LAMBERT_ERROR_OUTPUT;
    if (ply && !radiosity_write_ply(g->radiosity, ply, e, sizeof ctx->error))
        return LAMBERT_ERROR_OUTPUT;
    return LAMBERT_OK;
}

// The radiosity of what each pixel's middle sees, element by element.
static enum lambert_status write_aov(struct lambert_context *ctx, const struct gi *g,
                                     const char *path)
{
    const struct job *job = &g->job;
    const int width = job->settings.width, height = job->settings.height;
    struct image im = {0};
    if (!image_init(&im, width, height, 3))
        return context_fail(ctx, LAMBERT_ERROR_MEMORY, "no memory for the picture");
    struct trace_scratch *s = trace_scratch_new(job->world);
    for (int i = 0; i < width * height && !ctx->cancel; i++) {
        struct ray_query q = {.hidden_by = OBJECT_NO_IMAGE};
        if (!camera_ray(job->camera, i % width + .5, i / width + .5, width, height,
                        &q.ray))
            continue;
        const struct hit hit = trace_closest_1(job->world, s, &q);
        if (!(hit.b.t < INFINITY))
            continue;
        const struct rgb c = radiosity_of_hit(g->radiosity, s, &q.ray, &hit);
        float *pixel = image_at(&im, i % width, i / width);
        pixel[0] = c.r;
        pixel[1] = c.g;
        pixel[2] = c.b;
    }
    trace_scratch_free(s);
    const struct image_write_options o = {.type = IMAGE_EXR, .bits = 32};
    const bool ok = image_write(&im, path, &o, ctx->error, sizeof ctx->error);
    image_free(&im);
    return ok ? LAMBERT_OK : LAMBERT_ERROR_OUTPUT;
}

static void report_cache(struct lambert_context *ctx, const struct irradiance_report *r,
                         const struct samples_read *read)
{
    char text[200], found[64] = "";
    if (read->count)
        snprintf(found, sizeof found, " beside %u from a file", read->count);
    snprintf(text, sizeof text,
             "irradiance cache: %u samples%s in %u passes, %.3g rays, %.2f s", r->samples,
             found, r->passes, (double)r->rays, r->seconds);
    tell(ctx, text);
}

static enum lambert_status cache_prepare(struct lambert_context *ctx,
                                         struct render_settings *settings,
                                         struct gi **out)
{
    struct watch watch = {&ctx->cancel, tell_progress, ctx, 0, 1, 0};
    struct gi *g = calloc(1, sizeof *g);
    if (!g)
        return context_fail(ctx, LAMBERT_ERROR_MEMORY, "no memory");
    struct irradiance_report r = {0};
    struct samples_read read;
    ctx->phase = LAMBERT_PHASE_RADIOSITY;
    // Surfaces that gathering rays see show their caustics too.
    if (!settings->photons)
        settings->photons = g->photons =
            render_photons(ctx->world, settings, NULL, &ctx->cancel);
    g->cache = irradiance_cache_new(ctx->world, settings, &ctx->cancel);
    enum lambert_status status = samples_load(ctx, g->cache, &read);
    if (status == LAMBERT_OK && !read.complete &&
        !irradiance_cache_fill(g->cache, settings, &watch, &r))
        status = context_fail(ctx, LAMBERT_CANCELLED, "stopped on request");
    if (status == LAMBERT_OK)
        status = samples_save(ctx, g->cache);
    ctx->phase = LAMBERT_PHASE_TILES;
    if (status != LAMBERT_OK) {
        gi_free(g);
        return status;
    }
    report_cache(ctx, &r, &read);
    settings->indirect = irradiance_cache_indirect(g->cache);
    *out = g;
    return LAMBERT_OK;
}

static bool has_subsurface(const struct texture *x)
{
    for (uint32_t i = 0; x->kind == TEXTURE_PLAIN && i < x->layer_count; i++)
        if (x->layer[i].finish->has_subsurface)
            return true;
    for (uint32_t i = 0; x->kind != TEXTURE_PLAIN && i < x->map->count; i++)
        if (has_subsurface(x->map->entry[i]))
            return true;
    return false;
}

// Says, once each, what of the scene has no part in the light of patches.
static void warn_unlit(struct lambert_context *ctx)
{
    const struct world *w = ctx->world;
    const struct scene *scene = w->scene;
    bool media = scene->media_count > 0, below = false;
    struct span at_media = {0}, at_below = {0};
    for (uint32_t i = 0; i < w->leaf_count; i++) {
        const struct surface *s = &w->surface[w->leaf[i].surface];
        const struct span where = w->object[w->leaf[i].object].source->where;
        if (!media && s->interior->media_count) {
            media = true;
            at_media = where;
        }
        if (!below && scene->settings.subsurface.on && has_subsurface(s->texture)) {
            below = true;
            at_below = where;
        }
    }
    if (media)
        diag_at(&ctx->diags, DIAG_BLOCK_WARNING, at_media, "media",
                "with --gi=radiosity media neither dim the light between patches nor "
                "light them");
    if (below)
        diag_at(&ctx->diags, DIAG_BLOCK_WARNING, at_below, "subsurface",
                "with --gi=radiosity the light of light_sources alone goes below "
                "surfaces; that of patches is reflected as by a matt surface");
}

static enum lambert_status patches_prepare(struct lambert_context *ctx,
                                           struct render_settings *settings,
                                           struct gi **out)
{
    struct radiosity_options o = options_of(ctx);
    o.error = error_of(text_of(ctx, "error"));
    if (o.error < 0)
        return context_fail(ctx, LAMBERT_ERROR_OPTION,
                            "'%s' is no value for --error; it takes a percentage such as "
                            "1%%, or a fraction below 1",
                            text_of(ctx, "error"));
    struct watch watch = {&ctx->cancel, tell_progress, ctx, 0, 1, 0};
    o.watch = &watch;
    struct gi *g = calloc(1, sizeof *g);
    if (!g)
        return context_fail(ctx, LAMBERT_ERROR_MEMORY, "no memory");
    g->arena = arena_new(4096);
    job_init(&g->job, g->arena, ctx->world, settings);
    ctx->phase = LAMBERT_PHASE_RADIOSITY;
    g->radiosity =
        radiosity_new(&g->job, &o, gi_solution(ctx, true), ctx->error, sizeof ctx->error);
    ctx->phase = LAMBERT_PHASE_TILES;
    enum lambert_status status = LAMBERT_OK;
    if (!g->radiosity)
        status = gi_solution(ctx, true) ? LAMBERT_ERROR_INPUT : LAMBERT_ERROR_MEMORY;
    const char *aov = text_of(ctx, "gi-aov");
    if (status == LAMBERT_OK) {
        report(ctx, g->radiosity);
        status = write_files(ctx, g);
    }
    if (status == LAMBERT_OK && aov)
        status = write_aov(ctx, g, aov);
    if (ctx->cancel)
        status = context_fail(ctx, LAMBERT_CANCELLED, "stopped on request");
    if (status != LAMBERT_OK) {
        gi_free(g);
        return status;
    }
    settings->indirect = radiosity_indirect(g->radiosity);
    *out = g;
    return LAMBERT_OK;
}

// Files of a light that nobody asks for.
static enum lambert_status without(struct lambert_context *ctx)
{
    static const char *const files[] = {"gi-load", "gi-save", "gi-ply", "gi-aov"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (lambert_option_is_set(ctx, files[i]))
            diag_at(&ctx->diags, DIAG_BLOCK_WARNING, (struct span){0},
                    arena_printf(ctx->scene_arena, "--%s", files[i]),
                    "the scene has no radiosity { }, and --gi asks for no light by way "
                    "of other surfaces: the file has no part in this picture");
    return LAMBERT_OK;
}

enum lambert_status gi_prepare(struct lambert_context *ctx,
                               struct render_settings *settings, struct gi **out)
{
    enum { BEST_QUALITY = 9 }; // below, POV-Ray's radiosity { } is off
    const char *method = text_of(ctx, "gi");
    const bool asked = strcmp(method, "irradiance_cache") == 0;
    const bool patches = strcmp(method, "radiosity") == 0;
    *out = NULL;
    if (!patches && !asked &&
        !(strcmp(method, "auto") == 0 && ctx->world->scene->settings.radiosity &&
          settings->quality >= BEST_QUALITY))
        return without(ctx);
    warn_missing(ctx);
    if (patches)
        warn_unlit(ctx);
    return patches ? patches_prepare(ctx, settings, out)
                   : cache_prepare(ctx, settings, out);
}

void gi_free(struct gi *g)
{
    if (!g)
        return;
    radiosity_free(g->radiosity);
    irradiance_cache_free(g->cache);
    photons_free(g->photons);
    if (g->arena)
        arena_free(g->arena);
    free(g);
}
