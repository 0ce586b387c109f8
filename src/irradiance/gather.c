#include "irradiance/gather.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "trace/scratch.h"

// POV-Ray halves the number at every depth. A deeper sample is one of hundreds that a sample
// above it takes the mean of, which takes the mean of their errors, too: past some rays it
// need not be better known. With the root the errors still vanish as count grows.
static uint32_t deeper_count(int count)
{
    static const double least = 48, growth = 1.5;
    return (uint32_t)fmax(least, growth * sqrt((double)count));
}

uint32_t gather_count(const struct irradiance_cache *c, uint32_t depth)
{
    enum { FEWEST = 5 };
    const int count = c->settings->count;
    uint32_t n = depth < 31 ? (uint32_t)count >> depth : 0;
    if (depth > 0 && n > deeper_count(count))
        n = deeper_count(count);
    return n < FEWEST ? FEWEST : n;
}

struct gatherer *gatherer_new(const struct irradiance_cache *c)
{
    struct gatherer *g = must_calloc(1, sizeof *g);
    g->cache = c;
    g->level = must_calloc(c->depths, sizeof *g->level);
    for (uint32_t k = 0; k < c->depths; k++)
        g->level[k] = (struct gather_level){.owner = g, .depth = k};
    return g;
}

void gatherer_free(struct gatherer *g)
{
    for (uint32_t k = 0; k < g->cache->depths; k++) {
        struct gather_level *l = &g->level[k];
        if (l->tracer)
            tracer_free(l->tracer);
        free(l->to);
        free(l->first);
        free(l->quality);
        free(l->waiting);
    }
    free(g->level);
    free(g);
}

uint64_t gatherer_rays(const struct gatherer *g)
{
    uint64_t rays = 0;
    for (uint32_t k = 0; k < g->cache->depths; k++)
        if (g->level[k].tracer)
            rays += trace_scratch_stats(g->level[k].tracer->scratch)->rays;
    return rays;
}

void gatherer_start(struct gatherer *g, uint32_t direction)
{
    g->weight = g->points = 0;
    for (uint32_t k = 0; k < g->cache->depths; k++) {
        struct gather_level *l = &g->level[k];
        l->next = direction % g->cache->direction_count;
        l->asked = (struct store_memo){.cell_count = 0};
    }
}

void *gather_begin(const void *cache)
{
    struct gatherer *g = gatherer_new(cache);
    g->final = true;
    return &g->level[0];
}

void gather_end(void *state) { gatherer_free(((struct gather_level *)state)->owner); }

// How many samples may wait for each other. Where others are taken at depth, the order of rays
// would decide where those lie.
static uint32_t most_waiting(const struct gather_level *l)
{
    const struct irradiance_cache *c = l->owner->cache;
    const uint32_t most = BATCH_SIZE / gather_count(c, l->depth);
    return l->owner->fresh && c->depths == 1 && !c->scout.general && most ? most : 1;
}

static void level_prepare(struct gather_level *l)
{
    const struct irradiance_cache *c = l->owner->cache;
    l->waiting_most = most_waiting(l);
    const uint32_t n = l->waiting_most * gather_count(c, l->depth);
    const bool last = l->depth + 1 == c->depths;
    l->tracer = tracer_new(last ? &c->gather_last : &c->gather);
    if (!last)
        l->tracer->indirect = &l->owner->level[l->depth + 1];
    l->tracer->scratch->crossings.cancel = c->cancel;
    l->to = must_calloc(n, sizeof *l->to);
    l->first = must_calloc(n, sizeof *l->first);
    l->quality = must_calloc(n, sizeof *l->quality);
    l->waiting = must_calloc(l->waiting_most, sizeof *l->waiting);
}

// ---- one sample -------------------------------------------------------------------------

struct frame {
    struct vec3 x, y, z;
};

static struct frame frame_about(struct vec3 n)
{
    static const double upright = 0.999, steep = 0.9;
    if (fabs(n.y) > upright) {
        const double s = n.y > 0 ? 1 : -1;
        return (struct frame){vec3(s, 0, 0), vec3(0, s, 0), vec3(0, 0, s)};
    }
    const struct vec3 e = fabs(n.z) > steep ? vec3(0, 1, 0) : vec3(0, 0, 1);
    const struct vec3 x = vec3_normalize(vec3_cross(n, e));
    return (struct frame){x, n, vec3_cross(x, n)};
}

static struct vec3 next_direction(struct gather_level *l, const struct frame *f)
{
    const struct irradiance_cache *c = l->owner->cache;
    const struct vec3 d = c->direction[l->next];
    l->next = l->next + 1 == c->direction_count ? 0 : l->next + 1;
    return vec3_add(vec3_add(vec3_scale(d.x, f->x), vec3_scale(d.y, f->y)),
                    vec3_scale(d.z, f->z));
}

// Fills the directions: those behind the bare surface are left out as long as there are
// others (a perturbed normal's); then the surface's own normal serves.
static void choose_directions(struct gather_level *l, const struct indirect_query *q,
                              uint32_t count, struct vec3 *to)
{
    enum { TRIES = 5 };
    struct frame f = frame_about(q->n);
    uint32_t left = TRIES * count;
    for (uint32_t i = 0; i < count;) {
        to[i] = next_direction(l, &f);
        if (vec3_dot(to[i], q->side) > 0 || left == 0) {
            i++;
            continue;
        }
        if (--left == 0)
            f = frame_about(q->side);
    }
}

static float powered(double base, uint32_t exponent)
{
    double p = 1;
    for (uint32_t i = 0; i < exponent; i++)
        p *= base;
    return (float)p;
}

static void make_paths(struct gather_level *l, const struct indirect_query *q,
                       uint32_t first, uint32_t count)
{
    const double half = l->owner->cache->settings->brightness / 2;
    const struct vec3 n = q->at->ng, from[2] = {trace_offset(q->at, n),
                                                trace_offset(q->at, vec3_neg(n))};
    struct path p = {.inside = q->inside,
                     .through = {1, 1, 1},
                     .through_t = 1,
                     .weight = powered(half, l->depth + 1),
                     .level = (uint16_t)(3 * (l->depth + 1) / 2)};
    struct path *path = tracer_paths_room(l->tracer, count);
    for (uint32_t i = 0; i < count; i++) {
        l->quality[first + i] = 1;
        p.d = l->to[first + i];
        p.o = from[vec3_dot(p.d, n) < 0];
        p.sample = first + i;
        p.hash = hash_mix(q->hash, i + 1);
        path[i] = p;
    }
}

static struct rgb limited(struct rgb light, double most)
{
    const float max = rgb_max(light);
    return most > 0 && (double)max > most ? rgb_scale((float)most / max, light) : light;
}

// What ray i of a sample counts for: objects of little importance are seen by the first
// rays only, which stand for the others.
static double ray_weight(const struct gather_level *l, const struct first_hit *met,
                         uint32_t i, uint32_t count)
{
    const struct world *w = l->tracer->job->world;
    if (!l->owner->cache->has_importance || !(met->distance < INFINITY))
        return 1;
    const double importance = (double)w->surface[w->leaf[met->leaf].surface].importance;
    return i <= importance * (count - 1) ? 1 / importance : 0;
}

// Mean light, weighted by how well each part is known.
static void mean_light(const struct gather_level *l, const struct sample_sum *seen,
                       uint32_t first, uint32_t count, struct cache_sample *out)
{
    const double most = l->owner->cache->settings->max_sample;
    double sum[3] = {0, 0, 0}, known = 0, all = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct rgb c = limited(seen[first + i].light, most);
        const double w = ray_weight(l, &l->first[first + i], i, count),
                     q = w * (double)l->quality[first + i];
        all += w;
        known += q;
        sum[0] += q * (double)c.r;
        sum[1] += q * (double)c.g;
        sum[2] += q * (double)c.b;
    }
    if (!(known > 0))
        return;
    out->quality = (float)(known / all);
    out->light =
        rgb((float)(sum[0] / known), (float)(sum[1] / known), (float)(sum[2] / known));
}

static double unit_at(const struct gather_level *l, struct vec3 p)
{
    return vec3_length(vec3_sub(p, l->owner->cache->eye)) * (double)(1u << l->depth);
}

// Fills in radius and nearest surface; false: too close to something to be stored.
static bool distances(const struct gather_level *l, const struct gather_waiting *w,
                      uint32_t first, uint32_t count, struct cache_sample *out)
{
    static const double too_near = 1e-4; // of the largest radius
    const double low = l->owner->cache->settings->minimum_reuse * unit_at(l, w->p);
    double inverse = 0;
    out->nearest = INFINITY;
    for (uint32_t i = first; i < first + count; i++) {
        if (!(l->first[i].distance < INFINITY))
            continue;
        inverse += 1 / l->first[i].distance;
        if (l->first[i].distance < out->nearest) {
            out->nearest = l->first[i].distance;
            out->to = l->to[i];
        }
    }
    const double mean = inverse > 0 ? count / inverse : INFINITY;
    out->radius = fmax(low, fmin(w->high, mean));
    return out->nearest >= too_near * w->high && out->radius > 0;
}

// The widest error bound that is ever asked for at a depth (spec/lighting.md 12.2).
static double widest_bound(const struct irradiance_cache *c, uint32_t depth)
{
    return (c->settings->error_bound + 0.25) * (double)(1u << depth);
}

double gather_reach(const struct irradiance_cache *c, const struct cache_sample *s)
{
    enum {
        CLOSER = 5
    }; // deeper samples are found by points that are about so much nearer
    const double reach = s->radius * widest_bound(c, s->depth);
    return s->depth ? reach / CLOSER : reach;
}

// A sample's rays wait.
static void sample_put(struct gather_level *l, const struct indirect_query *q)
{
    if (!l->tracer)
        level_prepare(l);
    const struct irradiance_cache *c = l->owner->cache;
    const uint32_t count = gather_count(c, l->depth), first = l->waiting_count * count;
    choose_directions(l, q, count, l->to + first);
    make_paths(l, q, first, count);
    l->waiting[l->waiting_count++] = (struct gather_waiting){
        q->at->p, q->n, c->settings->maximum_reuse * unit_at(l, q->at->p)};
}

// Takes the samples that wait, in their order; returns the last.
static struct cache_sample samples_take(struct gather_level *l)
{
    const uint32_t count = gather_count(l->owner->cache, l->depth);
    const struct sample_sum *seen = tracer_paths(l->tracer, l->first);
    struct cache_sample s = {0};
    for (uint32_t k = 0; k < l->waiting_count; k++) {
        const struct gather_waiting *w = &l->waiting[k];
        s = (struct cache_sample){.p = w->p, .n = w->n, .depth = l->depth};
        mean_light(l, seen, k * count, count, &s);
        const bool lasting = distances(l, w, k * count, count, &s);
        s.reach = gather_reach(l->owner->cache, &s);
        if (lasting && s.reach < cache_reach_most && l->owner->fresh)
            store_add(l->owner->fresh, &s);
    }
    l->waiting_count = 0;
    return s;
}

void gatherer_flush(struct gatherer *g)
{
    for (uint32_t k = 0; k < g->cache->depths; k++)
        if (g->level[k].waiting_count)
            samples_take(&g->level[k]);
}

// Whether a sample that waits may say something there, however large its radius turns out.
static bool waiting_counts(const struct gather_level *l, const struct cache_point *at)
{
    for (uint32_t k = 0; k < l->waiting_count; k++) {
        const struct gather_waiting *w = &l->waiting[k];
        if (cache_may_count(w->p, w->n, w->high, at))
            return true;
    }
    return false;
}

// ---- queries ----------------------------------------------------------------------------

static double error_bound(const struct gatherer *g, uint32_t depth, float weight)
{
    static const double light_weight = 0.25;
    const struct radiosity_settings *s = g->cache->settings;
    double bound = s->error_bound;
    if (!g->final)
        bound *= s->low_error_factor;
    if ((double)weight < light_weight)
        bound += light_weight - (double)weight;
    return bound * (double)(1u << depth);
}

static double required(const struct gatherer *g, uint32_t depth)
{
    const double n = g->cache->settings->nearest_count;
    return depth == 0 ? n : depth == 1 ? fmin(2, n) : 1;
}

// Four samples in the right place count as one of weight 4.
static const double sample_weight = 4;

bool gather_is_settled(const struct gatherer *g)
{
    enum { FEWEST = 9 };
    return g->points >= FEWEST &&
           sample_weight * g->weight >= g->points * g->cache->settings->nearest_adaptive;
}

// The least sum of weights with which no sample is taken.
static double enough(const struct gatherer *g, uint32_t depth)
{
    if (g->final && !g->cache->settings->always_sample)
        return DBL_TRUE_MIN;
    return required(g, depth) / sample_weight;
}

bool gather_is_wanted(const struct irradiance_cache *c, const struct cache_sample *s)
{
    const struct gatherer before = {.cache = c};
    const double least = enough(&before, s->depth);
    const struct cache_point at = {s->p,     s->n,  error_bound(&before, s->depth, 1),
                                   s->depth, false, least};
    struct cache_mean mean = {0};
    if (c->store.count)
        store_mean(&c->store, &at, &mean);
    return mean.weight < least;
}

static struct rgb shown(const struct radiosity_settings *s, const struct cache_mean *mean)
{
    if (!(mean->weight > 0))
        return rgb(0, 0, 0);
    const struct rgb c = rgb((float)(mean->light[0] / mean->weight),
                             (float)(mean->light[1] / mean->weight),
                             (float)(mean->light[2] / mean->weight));
    const float gray = (float)s->gray_threshold;
    const struct rgb mixed =
        rgb_add(rgb_scale(1 - gray, c), rgb_even(gray * rgb_luminance(c)));
    return rgb_scale((float)s->brightness, mixed);
}

// Tells the depth above how well the light of one of its rays is known.
static void tell_quality(const struct gather_level *l, const struct indirect_query *q,
                         double weight)
{
    if (l->depth == 0)
        return;
    struct gather_level *above = &l->owner->level[l->depth - 1];
    if (q->level == above->tracer->first_level + 1)
        above->quality[q->sample] =
            (float)fmin(1, sample_weight * weight / required(l->owner, l->depth));
}

// What the samples of all squares say, and where that is less than `least` those of this
// square, too.
static struct cache_mean mean_known(const struct gather_level *l,
                                    const struct cache_point *at, double least)
{
    const struct store *known = &l->owner->cache->store, *fresh = l->owner->fresh;
    struct cache_mean mean = {0};
    if (known->count)
        store_mean(known, at, &mean);
    if (fresh && fresh->count && mean.weight < least)
        store_mean(fresh, at, &mean);
    return mean;
}

struct rgb gather_irradiance(const void *cache, void *state, struct tracer *t,
                             const struct indirect_query *q)
{
    const struct irradiance_cache *c = cache;
    struct gather_level *l = state;
    struct gatherer *g = l->owner;
    (void)t;
    // Before the picture nobody looks at what the camera sees: samples are all it asks for.
    const bool scouts = g->fresh && l->depth == 0,
               weighs = scouts && c->settings->nearest_adaptive > 0;
    const double least = enough(g, l->depth);
    const struct cache_point at = {q->at->p,
                                   q->n,
                                   error_bound(g, l->depth, q->weight),
                                   l->depth,
                                   g->final && l->depth == 0,
                                   scouts && !weighs ? least : INFINITY};
    const double wanted = weighs ? INFINITY : least;
    struct cache_mean mean = mean_known(l, &at, wanted);
    if ((weighs || mean.weight < least) && waiting_counts(l, &at)) {
        gatherer_flush(g);
        mean = mean_known(l, &at, wanted);
    }
    if (weighs) {
        g->weight += mean.weight;
        g->points++;
    }
    // After a cancel nobody looks at the light; a sample may take many seconds.
    if (mean.weight < least && !(c->cancel && *c->cancel)) {
        if (!g->fresh)
            l->next = q->hash % c->direction_count;
        sample_put(l, q);
        if (scouts && l->waiting_count < l->waiting_most)
            return rgb(0, 0, 0);
        const struct cache_sample fresh = samples_take(l);
        const double w = fresh.quality;
        mean.weight += w;
        mean.light[0] += w * (double)fresh.light.r;
        mean.light[1] += w * (double)fresh.light.g;
        mean.light[2] += w * (double)fresh.light.b;
    }
    tell_quality(l, q, mean.weight);
    return shown(c->settings, &mean);
}

// What the samples of all squares say of eight points.
static void means_at(const struct irradiance_cache *c, struct gather_level *l,
                     const struct indirect_eight *q, double enough_of,
                     struct cache_means *mean)
{
    struct cache_points at = {.lanes = q->lanes,
                              .depth = l->depth,
                              .smooth = l->owner->final && l->depth == 0,
                              .enough = enough_of};
    memcpy(at.p, q->p, sizeof at.p);
    memcpy(at.n, q->n, sizeof at.n);
    for (int i = 0; i < 8; i++)
        at.error_bound[i] = error_bound(l->owner, l->depth, q->weight[i]);
    store_means(&c->store, &at, &l->asked, mean);
}

unsigned gather_known(const void *cache, void *state, const struct indirect_eight *q,
                      struct rgb out[8])
{
    const struct irradiance_cache *c = cache;
    struct gather_level *l = state;
    const double least = enough(l->owner, l->depth);
    struct cache_means mean = {0};
    unsigned known = 0;
    if (l->owner->fresh || !c->store.count)
        return 0;
    means_at(c, l, q, INFINITY, &mean);
    for (unsigned lanes = q->lanes; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        if (mean.weight[i] < least)
            continue;
        const struct cache_mean m = {
            mean.weight[i], {mean.light[0][i], mean.light[1][i], mean.light[2][i]}};
        out[i] = shown(c->settings, &m);
        known |= 1u << i;
    }
    return known;
}

unsigned gather_settled(const void *cache, void *state, const struct indirect_eight *q)
{
    const struct irradiance_cache *c = cache;
    struct gather_level *l = state;
    const double least = enough(l->owner, l->depth);
    struct cache_means mean = {0};
    unsigned settled = 0;
    // A second number of nearest_count wants all weights.
    if (!c->store.count || c->settings->nearest_adaptive > 0)
        return 0;
    means_at(c, l, q, least, &mean);
    for (unsigned lanes = q->lanes; lanes; lanes &= lanes - 1)
        if (mean.weight[__builtin_ctz(lanes)] >= least)
            settled |= lanes & -lanes;
    return settled;
}
