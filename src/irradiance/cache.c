#include "irradiance/cache.h"

#include <math.h>

#include "base/arena.h"
#include "base/clock.h"
#include "irradiance/fill.h"
#include "irradiance/gather.h"
#include "math/elementary.h"
#include "math/halton.h"
#include "math/pi.h"
#include "trace/accel.h"
#include "trace/packet.h"

// About y, with density proportional to the cosine (spec/lighting.md 12.3).
static void directions_init(struct irradiance_cache *c)
{
    static const double turn = 2 * PI;
    const struct radiosity_settings *s = c->settings;
    const int most = s->count > s->count_directions ? s->count : s->count_directions;
    c->direction_count = (uint32_t)most;
    c->direction = arena_new_array(c->arena, struct vec3, (size_t)most);
    for (uint32_t k = 0; k < c->direction_count; k++) {
        const double h = halton(k + 1, 2), angle = turn * halton(k + 1, 3);
        const double r = sqrt(h);
        c->direction[k] = vec3(r * det_cos(angle), sqrt(1 - h), r * det_sin(angle));
    }
}

struct indirect irradiance_cache_indirect(const struct irradiance_cache *c)
{
    const struct world *w = c->scout.world;
    return (struct indirect){
        .data = c,
        .begin = gather_begin,
        .end = gather_end,
        .irradiance = gather_irradiance,
        .known = gather_known,
        .least = (float)c->settings->adc_bailout,
        .layer_normals = c->settings->normal,
        .both_sides = true,
        .no_ambient = w->scene->settings.version >= 370,
    };
}

// Jobs of the camera's rays and of those that gather: all but the last ask for the next
// depth.
static void jobs_init(struct irradiance_cache *c, const struct world *w,
                      const struct render_settings *settings)
{
    struct render_settings s = *settings;
    c->scout.world = w;
    s.indirect = irradiance_cache_indirect(c);
    s.indirect.begin = NULL;
    s.indirect.end = NULL;
    s.output_alpha = false;
    s.purpose = RENDER_SCOUT;
    s.indirect.settled = gather_settled;
    job_init(&c->scout, c->arena, w, &s);
    s.indirect.settled = NULL;
    s.purpose = RENDER_GATHER;
    job_init(&c->gather, c->arena, w, &s);
    s.indirect.data = NULL;
    s.indirect.both_sides = false;
    job_init(&c->gather_last, c->arena, w, &s);
}

struct irradiance_cache *irradiance_cache_new(const struct world *w,
                                              const struct render_settings *settings,
                                              const volatile bool *cancel)
{
    struct arena *a = arena_new(64 * 1024);
    struct irradiance_cache *c = arena_new_struct(a, struct irradiance_cache);
    c->arena = a;
    c->cancel = cancel;
    c->settings = &w->scene->settings.radiosity_settings;
    c->depths = (uint32_t)c->settings->recursion_limit;
    c->eye = w->scene->has_camera ? w->scene->camera.location : camera_default.location;
    store_init(&c->store, w->accel->kernels->name);
    directions_init(c);
    jobs_init(c, w, settings);
    for (uint32_t i = 0; i < w->surface_count; i++)
        c->has_importance |= w->surface[i].importance != 1;
    return c;
}

bool irradiance_cache_fill(struct irradiance_cache *c,
                           const struct render_settings *settings, struct watch *watch,
                           struct irradiance_report *report)
{
    const double begin = clock_seconds(CLOCK_MONOTONIC);
    const uint32_t before = c->store.count;
    *report = (struct irradiance_report){0};
    if (!irradiance_fill(c, settings, watch, report))
        return false;
    report->samples = c->store.count - before;
    report->seconds = clock_seconds(CLOCK_MONOTONIC) - begin;
    return true;
}

const struct cache_sample *irradiance_cache_samples(const struct irradiance_cache *c,
                                                    uint32_t *count)
{
    *count = c->store.count;
    return c->store.sample;
}

bool irradiance_cache_add(struct irradiance_cache *c, const struct cache_sample *sample)
{
    static const double unit_within = 1e-3; // how far a normal may be from length 1
    struct cache_sample s = *sample;
    const double light = (double)s.light.r + (double)s.light.g + (double)s.light.b;
    // `to` is nought where nothing was seen.
    const double sum = s.p.x + s.p.y + s.p.z + s.to.x + s.to.y + s.to.z + light;
    if (s.depth >= STORE_DEPTHS || !isfinite(sum) || !(s.nearest > 0) ||
        !(s.quality >= 0 && s.quality <= 1) ||
        !(fabs(vec3_length(s.n) - 1) < unit_within) ||
        !(s.radius > 0 && s.radius < INFINITY))
        return false;
    s.reach = gather_reach(c, &s);
    if (!(s.reach < cache_reach_most))
        return false;
    store_add(&c->store, &s);
    return true;
}

void irradiance_cache_free(struct irradiance_cache *c)
{
    if (!c)
        return;
    store_free(&c->store);
    arena_free(c->arena);
}
