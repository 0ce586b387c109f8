// Media between the beginnings of the wave's rays and what they hit.
#include "base/arena.h"
#include "scene/effects.h"
#include "trace/inside.h"
#include "trace/media_march.h"
#include "trace/sky.h"

// Adds what a way brings, and filters its ray.
static void way_end(struct tracer *t, const struct media_way *way,
                    const struct media_result *r)
{
    struct wavefront *w = &t->wave;
    const float light[3] = {(float)r->light.x, (float)r->light.y, (float)r->light.z};
    const float pass[3] = {(float)r->pass.x, (float)r->pass.y, (float)r->pass.z};
    for (int c = 0; c < 3; c++) {
        float *through = &w->through[c][way->slot];
        w->own[c][way->slot] += *through * light[c];
        *through *= pass[c];
    }
    w->through_t[way->slot] *= rgb_luminance(rgb(pass[0], pass[1], pass[2]));
}

// Ways that have been prepared and wait for others.
struct march_batch {
    struct media_march march;
    struct media_interval *interval; // most of them
    uint32_t most;
    struct media_walker walker[BATCH_SIZE];
    uint32_t first[BATCH_SIZE + 1];
};

static void march_end(struct march_batch *b)
{
    struct media_march *m = &b->march;
    struct media_result result[BATCH_SIZE];
    if (!m->walker_count)
        return;
    m->interval_count = b->first[m->walker_count];
    media_walk_together(m, b->first, result);
    for (uint32_t i = 0; i < m->walker_count; i++)
        way_end(m->t, m->walker[i].way, &result[i]);
    m->walker_count = 0;
}

// Walks a way, or lets it wait.
static void march_add(struct march_batch *b, const struct media_way *way, bool together,
                      const uint8_t *missed, uint8_t lane)
{
    struct media_march *m = &b->march;
    struct media_walker w = media_walker(m->t, way, missed, lane);
    uint32_t count;
    struct media_interval *own =
        media_intervals(m->scratch->arena, m->mix, way->s, w.lamp, w.lamp_count, &count);
    if (!together || count > media_stride(m->mix)) {
        struct media_march alone = *m;
        alone.walker = &w;
        alone.walker_count = 1;
        alone.interval = own;
        alone.interval_count = count;
        const struct media_result r = media_walk(&alone);
        way_end(m->t, way, &r);
        return;
    }
    if (m->walker_count && b->first[m->walker_count] + count > b->most)
        march_end(b);
    const uint32_t i = m->walker_count++;
    b->walker[i] = w;
    for (uint32_t k = 0; k < count; k++) {
        own[k].walker = i;
        b->interval[b->first[i] + k] = own[k];
    }
    b->first[i + 1] = b->first[i] + count;
}

// Walks ways through one mix that end at the same light group.
static void ways_walk(struct tracer *t, const struct media_mix *mix,
                      const struct media_way *way, uint32_t count)
{
    enum { SEVERAL = 8 }; // times what is found together: what is refined is fewer
    struct media_scratch *s = &t->media[WAY_EYE];
    const bool together = media_goes_together(mix, false);
    struct march_batch b;
    b.march = (struct media_march){.t = t, .scratch = s, .mix = mix, .walker = b.walker};
    b.first[0] = 0;
    b.most = SEVERAL * media_stride(mix);
    b.interval = arena_new_array(s->arena, struct media_interval, b.most);
    b.march.interval = b.interval;
    uint8_t *missed =
        arena_new_array(s->arena, uint8_t, t->job->lamps[way->group].count + 1);
    for (uint32_t i = 0; i < count; i++) {
        if (i % 8 == 0)
            media_lamps_missed(t->job, &way[i], count - i, missed);
        march_add(&b, &way[i], together, missed, (uint8_t)(1u << i % 8));
    }
    march_end(&b);
}

static struct media_way way_of(const struct tracer *t, uint32_t k, double s,
                               uint32_t group)
{
    const uint32_t slot = t->wave.slot[k];
    const struct path p = wave_path(t, slot);
    return (struct media_way){p.o, p.d, s, p.inside, group, p.hash, slot};
}

static uint32_t group_of(const struct tracer *t, uint32_t k)
{
    const struct world *w = t->job->world;
    return w->surface[w->leaf[t->hit->leaf[k]].surface].light_group;
}

// Takes those out of `way` that go with the first: the same light group and, unless they are
// all in the air, the same media. Keeps the order; returns how many are left.
static uint32_t ways_split(struct media_way *way, uint32_t count, bool air,
                           struct media_way *out, uint32_t *taken)
{
    const struct media_way first = way[0];
    uint32_t left = 0;
    *taken = 0;
    for (uint32_t i = 0; i < count; i++)
        if (way[i].group == first.group &&
            (air || media_same(way[i].inside, first.inside)))
            out[(*taken)++] = way[i];
        else
            way[left++] = way[i];
    return left;
}

void media_air_wave(struct tracer *t)
{
    const struct scene *scene = t->job->scene;
    struct media_way way[BATCH_SIZE], same[BATCH_SIZE];
    uint32_t count = 0, taken;
    for (uint32_t k = 0; k < t->wave.count; k++) {
        const bool hit = t->hit->t[k] < INFINITY;
        struct media_way w =
            way_of(t, k, hit ? t->hit->t[k] : air_far, hit ? group_of(t, k) : 0);
        w.hash = hash_mix(w.hash, MEDIA_AIR_HASH);
        if (inside_hollow(w.inside))
            way[count++] = w;
    }
    const struct media_mix mix = media_mix_of(scene->media, scene->media_count);
    while (count) {
        arena_reset(t->media[WAY_EYE].arena);
        count = ways_split(way, count, true, same, &taken);
        ways_walk(t, &mix, same, taken);
    }
}

void media_wave(struct tracer *t)
{
    struct media_way way[BATCH_SIZE], same[BATCH_SIZE];
    uint32_t count = 0, taken;
    for (uint32_t k = 0; k < t->wave.count; k++)
        if (t->hit->t[k] < INFINITY && media_inside(wave_inside(t, t->wave.slot[k])))
            way[count++] = way_of(t, k, t->hit->t[k], group_of(t, k));
    while (count) {
        count = ways_split(way, count, false, same, &taken);
        const struct media_mix mix = media_mix_inside(t, same[0].inside);
        ways_walk(t, &mix, same, taken);
    }
}
