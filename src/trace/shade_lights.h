#ifndef TRACE_SHADE_LIGHTS_H
#define TRACE_SHADE_LIGHTS_H

// The light of lamps on groups of hits: what they add at once, and the shadow rays and places
// of area lights that wait.
#include "math/lanes_pack.h"
#include "trace/area.h"
#include "trace/photons.h"
#include "trace/projected.h"
#include "trace/shade_lightlets.h"
#include "trace/shade_lit.h"
#include "trace/shade_sheets.h"

LANES_INLINE void add_own(struct tracer *t, const struct simple_group *g, unsigned live,
                          struct rgb8 c)
{
    float(*own)[BATCH_ROW] = t->wave.own;
    if (g->in_row && live == 255) {
        float *r = &own[0][g->slot[0]], *s = &own[1][g->slot[0]],
              *u = &own[2][g->slot[0]];
        f8_store(r, f8_add(f8_load(r), c.r));
        f8_store(s, f8_add(f8_load(s), c.g));
        f8_store(u, f8_add(f8_load(u), c.b));
        return;
    }
    float v[3][8];
    f8_store(v[0], c.r);
    f8_store(v[1], c.g);
    f8_store(v[2], c.b);
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        for (int k = 0; k < 3; k++)
            own[k][g->slot[i]] += v[k][i];
    }
}

// What shade_lamp asks of the lamp alone.
struct shaded_lamp {
    const struct lamp *lamp;
    bool even, shadowed, area, lightlets;
    uint8_t photons; // photons_instead
};

static struct shaded_lamp shaded_lamp(const struct tracer *t, const struct lamp *lamp,
                                      bool collects)
{
    const struct light *l = lamp->light;
    const bool shadowed = t->job->shadows && (!l->shadowless || lamp->window);
    return (struct shaded_lamp){
        lamp,
        !lamp_has_lightlets(t->job, l) && l->kind == LIGHT_POINT &&
            !(l->fade_power > 0 && l->fade_distance != 0),
        shadowed,
        shadowed && !l->shadowless && l->area && t->job->area_lights,
        lamp_has_lightlets(t->job, l),
        photons_instead(t->job, collects, l)};
}

// Queues the shadow rays of the lanes (trace_offset).
LANES_INLINE uint32_t queue8(struct tracer *t, const struct shaded_lamp *lamp,
                             const struct simple_group *g, unsigned live,
                             const struct light8 *v, struct rgb8 value, uint32_t queued)
{
    struct shadow_batch *b = &t->simple;
    memset(b->air + queued, air_counts(t->job, lamp->lamp->index), 8);
    memset(b->photons + queued, lamp->photons, 8);
    const struct vec8 ng = v8_load((const double(*)[8])g->ng);
    const struct real8 side =
        r8_select(r8_lt(v8_dot(v->to, ng), r8_set(0)), r8_set(-1), r8_set(1));
    const struct real8 by = r8_mul(r8_mul(r8_set(2), side), r8_load(g->error));
    const struct vec8 o = v8_mad(v8_load((const double(*)[8])g->p), by, ng);
    r8_pack(b->rays->o[0] + queued, live, o.x);
    r8_pack(b->rays->o[1] + queued, live, o.y);
    r8_pack(b->rays->o[2] + queued, live, o.z);
    r8_pack(b->rays->d[0] + queued, live, v->to.x);
    r8_pack(b->rays->d[1] + queued, live, v->to.y);
    r8_pack(b->rays->d[2] + queued, live, v->to.z);
    r8_pack(b->rays->t_max + queued, live, v->distance);
    f8_pack(b->value[0] + queued, live, value.r);
    f8_pack(b->value[1] + queued, live, value.g);
    f8_pack(b->value[2] + queued, live, value.b);
    for (; live; live &= live - 1)
        b->slot[queued++] = g->slot[__builtin_ctz(live)];
    return queued;
}

// Keeps the lanes as places of an area light.
static void area_add8(struct tracer *t, const struct shaded_lamp *shaded,
                      const struct simple_group *g, unsigned live, struct rgb8 value)
{
    const struct lamp *lamp = shaded->lamp;
    float c[3][8];
    f8_store(c[0], value.r);
    f8_store(c[1], value.g);
    f8_store(c[2], value.b);
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        area_add(t, &(struct area_request){
                        .lamp = lamp,
                        .p = {g->p[0][i], g->p[1][i], g->p[2][i]},
                        .ng = {g->ng[0][i], g->ng[1][i], g->ng[2][i]},
                        .error = g->error[i],
                        .value = {c[0][i], c[1][i], c[2][i]},
                        .slot = g->slot[i],
                        .hash = lamp->light->jitter ? wave_hash(t, g->slot[i]) : 0,
                        .photons = shaded->photons});
    }
}

// The rest of shade_lamp, once it is known what the surfaces make of the light.
LANES_INLINE uint32_t lamp_add(struct tracer *t, const struct shaded_lamp *lamp,
                               const struct simple_group *g, unsigned live,
                               const struct light8 *v, struct rgb8 sum, uint32_t queued)
{
    struct rgb8 value =
        rgb8_mul(v->color, rgb8_add(rgb8_set((struct rgb){0, 0, 0}), sum));
    live &= ~black8(value);
    if (!live)
        return queued;
    value = rgb8_mul(value, rgb8_load((const float(*)[8])g->through));
    const unsigned bare =
        lamp->shadowed ? live & m8_bits(r8_le(v->distance, r8_set(0))) : live;
    if (bare)
        add_own(t, g, bare, value);
    live &= ~bare;
    if (live && lamp->area) {
        area_add8(t, lamp, g, live, value);
        return queued;
    }
    if (!live)
        return queued;
    if (queued + 8 > BATCH_SIZE) {
        shadow_flush_simple(t, queued);
        queued = 0;
    }
    const uint32_t end = queue8(t, lamp, g, live, v, value, queued);
    return lamp->lamp->window ? window_take(t, lamp->lamp, queued, end) : end;
}

// Surfaces that lamps shine on: of a simple class or, if that is NULL, painted.
struct lit_hits {
    const struct simple_class *class;
    const struct simple_group *hits;
    const struct paint_sheet *sheet; // those of the group
    uint32_t sheet_count;
    bool side_test;
};

// layers_lit; takes lanes that get nothing out of *live, where the light is of no use.
LANES_INLINE struct rgb8 layers8(const struct tracer *t, const struct lit_hits *x,
                                 const struct lamp *lamp, struct vec8 to, unsigned *live)
{
    const struct simple_group *g = x->hits;
    if (x->class) {
        const struct lit_layer l = {x->class->finish,
                                    (const double(*)[8])g->d,
                                    (const double(*)[8])g->n,
                                    (const float(*)[8])g->color,
                                    g->att,
                                    NULL};
        return lit8(&l, x->side_test, lamp->dull, to, live);
    }
    struct rgb8 sum = rgb8_set((struct rgb){0, 0, 0});
    unsigned lit = 0;
    for (uint32_t i = 0; i < x->sheet_count && *live; i++)
        lit |= sheet_lit(t, &x->sheet[i], g, x->side_test, lamp, to, *live, &sum);
    *live = lit;
    return sum;
}

// area_lit; returns the lanes that get something.
static unsigned lightlets_lit(const struct tracer *t, const struct lit_hits *x,
                              const struct lamp *lamp, struct rgb8 *out)
{
    const uint32_t count = (uint32_t)(lamp->light->size1 * lamp->light->size2);
    struct rgb8 sum = rgb8_set((struct rgb){0, 0, 0});
    struct area_eight e;
    uint32_t hash[8] = {0};
    unsigned any = 0;
    lightlets_of(t, lamp, x->hits, &e, hash);
    for (uint32_t i = 0; i < count; i++) {
        unsigned live = x->hits->live;
        const struct light8 v = lightlet8(lamp, i, hash, &e, &live);
        if (!live)
            continue;
        const struct rgb8 c = rgb8_mul(v.color, layers8(t, x, lamp, v.to, &live));
        sum.r = f8_select(live, f8_add(sum.r, c.r), sum.r);
        sum.g = f8_select(live, f8_add(sum.g, c.g), sum.g);
        sum.b = f8_select(live, f8_add(sum.b, c.b), sum.b);
        any |= live;
    }
    *out = rgb8_scale(f8_set(1.0f / (float)count), sum);
    return any;
}

// shade_lamp.
LANES_INLINE uint32_t lamp_light(struct tracer *t, const struct shaded_lamp *shaded,
                                 const struct lit_hits *x, uint32_t queued)
{
    const struct simple_group *g = x->hits;
    struct light8 v = direction8(shaded->lamp, v8_load((const double(*)[8])g->p));
    struct rgb8 sum;
    unsigned live;
    if (shaded->lightlets) {
        live = lightlets_lit(t, x, shaded->lamp, &sum);
        v.color = rgb8_set((struct rgb){1, 1, 1});
    } else {
        live = shaded->even ? g->live : attenuate(shaded->lamp, g, &v);
        if (!live)
            return queued;
        sum = layers8(t, x, shaded->lamp, v.to, &live);
    }
    return live ? lamp_add(t, shaded, g, live, &v, sum, queued) : queued;
}

static uint32_t light(struct tracer *t, const struct simple_class *c,
                      const struct lamp *lamp, const struct simple_group *g,
                      uint32_t groups, uint32_t queued)
{
    const struct shaded_lamp shaded = shaded_lamp(t, lamp, c->collects);
    struct lit_hits x = {.class = c, .side_test = c->side_test};
    if (shaded.even && is_black(lamp->light->color))
        return queued;
    for (const struct simple_group *end = g + groups; g < end; g++) {
        x.hits = g;
        queued = lamp_light(t, &shaded, &x, queued);
    }
    return queued;
}

// The same for the layers of painted hits.
static uint32_t light_sheets(struct tracer *t, bool side_test, const struct lamp *lamp,
                             const struct paint_group *g, uint32_t groups,
                             uint32_t queued)
{
    const struct shaded_lamp shaded = shaded_lamp(t, lamp, photons_collect(g->surface));
    struct lit_hits x = {.side_test = side_test};
    if (shaded.even && is_black(lamp->light->color))
        return queued;
    for (const struct paint_group *end = g + groups; g < end; g++) {
        x.hits = &g->hits;
        x.sheet = t->paint->sheet + g->sheet;
        x.sheet_count = g->sheet_count;
        queued = lamp_light(t, &shaded, &x, queued);
    }
    return queued;
}

#endif
