#include "irradiance/store.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

void store_init(struct store *s)
{
    *s = (struct store){0};
    for (int i = 0; i < STORE_DEPTHS; i++) {
        s->size_low[i] = INT16_MAX;
        s->size_high[i] = INT16_MIN;
    }
}

void store_free(struct store *s)
{
    free(s->sample);
    free(s->link);
    free(s->cell);
}

// ---- weights ----------------------------------------------------------------------------

// The spec's own constants (spec/lighting.md 12.5).
static const double same_place = 1e-6, behind = -0.05, least_weight = 0.001;

static double falloff(double error, const struct cache_point *at)
{
    const double x = error / at->error_bound;
    if (!at->smooth)
        return 1 - x;
    const double y = x < 0.5 ? 2 * x : 2 * (1 - x);
    return x < 0.5 ? 1 - y * y / 2 : y * y / 2;
}

double cache_weight(const struct cache_sample *s, const struct cache_point *at)
{
    const struct vec3 d = vec3_sub(at->p, s->p);
    // The part of the error that normals make is enough to tell for most.
    const double turned = fabs(1 - vec3_dot(at->n, s->n));
    if (4 * turned >= at->error_bound * at->error_bound)
        return 0;
    const double distance = vec3_length(d);
    if (distance >= s->radius * at->error_bound)
        return 0;
    double radius = s->radius, front = 1;
    if (distance > same_place) {
        const struct vec3 way = vec3_scale(1 / distance, d);
        const double nearing = vec3_dot(s->to, way);
        if (nearing > 0)
            radius = nearing * s->nearest + (1 - nearing) * radius;
        front = vec3_dot(way, vec3_normalize(vec3_add(at->n, s->n)));
    }
    if (distance >= radius * at->error_bound || !(front > behind))
        return 0;
    const double error = distance / radius + 2 * sqrt(turned);
    if (!(error < at->error_bound))
        return 0;
    double weight = falloff(error, at);
    if (front <= 0)
        weight *= 1 - front / behind;
    return weight <= least_weight ? 0 : weight * (double)s->quality;
}

// ---- cells ------------------------------------------------------------------------------

static uint32_t cell_hash(const struct cache_cell *c)
{
    uint32_t h = (uint32_t)c->size * 0x9e3779b9u + c->depth;
    for (int k = 0; k < 3; k++) {
        h ^= (uint32_t)c->place[k];
        h *= 0x85ebca6bu;
        h ^= h >> 15;
    }
    return h * 0xc2b2ae35u;
}

static bool same_cell(const struct cache_cell *a, const struct cache_cell *b)
{
    return a->place[0] == b->place[0] && a->place[1] == b->place[1] &&
           a->place[2] == b->place[2] && a->size == b->size && a->depth == b->depth;
}

// The slot that holds the cell, or the free one where it belongs.
static struct cache_cell *cell_slot(const struct store *s, const struct cache_cell *c)
{
    const uint32_t mask = s->cell_capacity - 1;
    for (uint32_t i = cell_hash(c) >> 7 & mask;; i = (i + 1) & mask)
        if (!s->cell[i].state || same_cell(&s->cell[i], c))
            return &s->cell[i];
}

static void *grown(void *at, uint32_t *capacity, size_t size)
{
    *capacity = *capacity ? 2 * *capacity : 64;
    at = realloc(at, *capacity * size);
    if (!at)
        abort();
    return at;
}

static void cells_grow(struct store *s)
{
    struct store old = *s;
    s->cell_capacity = old.cell_capacity ? 2 * old.cell_capacity : 256;
    s->cell = calloc(s->cell_capacity, sizeof *s->cell);
    if (!s->cell)
        abort();
    for (uint32_t i = 0; i < old.cell_capacity; i++)
        if (old.cell[i].state)
            *cell_slot(s, &old.cell[i]) = old.cell[i];
    free(old.cell);
}

static void cell_put(struct store *s, struct cache_cell at, uint32_t sample)
{
    if (2 * (s->cell_count + 1) > s->cell_capacity)
        cells_grow(s);
    if (s->link_count == s->link_capacity)
        s->link = grown(s->link, &s->link_capacity, sizeof *s->link);
    struct cache_cell *c = cell_slot(s, &at);
    if (!c->state) {
        *c = at;
        c->first = STORE_END;
        c->state = 1;
        s->cell_count++;
    }
    const struct cache_sample *x = &s->sample[sample];
    s->link[s->link_count] = (struct cache_link){x->p, x->radius, sample, c->first};
    c->first = s->link_count++;
}

// Far from the origin, places of small cells leave the range of integers: such cells all
// lie at its end, which costs time only.
static int32_t place_of(double x, int size)
{
    const double p = floor(ldexp(x, -size));
    return p < -2e9 ? -2000000000 : p > 2e9 ? 2000000000 : (int32_t)p;
}

void store_add(struct store *s, const struct cache_sample *sample)
{
    const double reach = sample->reach;
    if (s->count == s->capacity)
        s->sample = grown(s->sample, &s->capacity, sizeof *s->sample);
    s->sample[s->count] = *sample;
    int size;
    frexp(reach, &size);
    if (size < INT16_MIN / 2)
        size = INT16_MIN / 2;
    const uint32_t depth = sample->depth;
    if (size < s->size_low[depth])
        s->size_low[depth] = (int16_t)size;
    if (size > s->size_high[depth])
        s->size_high[depth] = (int16_t)size;
    const struct vec3 r = vec3(reach, reach, reach);
    const struct vec3 a = vec3_sub(sample->p, r), b = vec3_add(sample->p, r);
    for (int32_t z = place_of(a.z, size); z <= place_of(b.z, size); z++)
        for (int32_t y = place_of(a.y, size); y <= place_of(b.y, size); y++)
            for (int32_t x = place_of(a.x, size); x <= place_of(b.x, size); x++)
                cell_put(
                    s,
                    (struct cache_cell){{x, y, z}, (int16_t)size, (uint16_t)depth, 0, 1},
                    s->count);
    s->count++;
}

void store_mean(const struct store *s, const struct cache_point *at,
                struct cache_mean *mean)
{
    for (int size = s->size_low[at->depth]; size <= s->size_high[at->depth]; size++) {
        const struct cache_cell key = {
            {place_of(at->p.x, size), place_of(at->p.y, size), place_of(at->p.z, size)},
            (int16_t)size,
            (uint16_t)at->depth,
            0,
            1};
        const struct cache_cell *c = cell_slot(s, &key);
        if (!c->state)
            continue;
        for (uint32_t i = c->first; i != STORE_END; i = s->link[i].next) {
            const struct cache_link *link = &s->link[i];
            const struct vec3 d = vec3_sub(at->p, link->p);
            const double limit = link->radius * at->error_bound;
            if (vec3_dot(d, d) >= limit * limit)
                continue;
            const struct cache_sample *x = &s->sample[link->sample];
            const double w = cache_weight(x, at);
            if (!(w > 0))
                continue;
            mean->weight += w;
            mean->light[0] += w * (double)x->light.r;
            mean->light[1] += w * (double)x->light.g;
            mean->light[2] += w * (double)x->light.b;
        }
    }
}
