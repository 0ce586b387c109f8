#include "trace/paint.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "scene/image_map.h"
#include "scene/pigment_tape.h"
#include "trace/indirect_lanes.h"
#include "trace/shade.h"
#include "trace/shade_kernel.h"

// ---- hits -----------------------------------------------------------------------------

enum { END = UINT16_MAX };

void paint_init(struct tracer *t)
{
    const uint32_t count = t->job->paint_count;
    if (!count)
        return;
    struct paint_scratch *s = t->paint = must_align(64, 1, sizeof *t->paint);
    s->head = must_malloc(count, sizeof *s->head);
    s->tail = must_malloc(count, sizeof *s->tail);
    for (uint32_t i = 0; i < count; i++)
        s->head[i] = END;
    s->seen_count = s->group_count = s->sheet_count = s->coat_count = 0;
    s->asks = t->job->collects ? must_calloc(BATCH_SIZE, sizeof *s->asks) : NULL;
}

void paint_end(struct tracer *t)
{
    if (!t->paint)
        return;
    free(t->paint->head);
    free(t->paint->tail);
    free(t->paint->asks);
    free(t->paint);
}

bool paint_take(struct tracer *t, uint32_t k)
{
    const struct job *job = t->job;
    struct paint_scratch *s = t->paint;
    if (!job->paint)
        return false;
    const uint32_t surface = job->world->leaf[t->hit->leaf[k]].surface;
    const struct paint_surface *p = &job->paint[surface];
    if (!p->top)
        return false;
    if (s->head[p->number] == END) {
        s->seen[s->seen_count++] = surface;
        s->head[p->number] = (uint16_t)k;
    } else {
        s->link[s->tail[p->number]] = (uint16_t)k;
    }
    s->tail[p->number] = (uint16_t)k;
    s->link[k] = END;
    return true;
}

// Hits of one surface.
struct brush {
    struct tracer *t;
    const struct surface *surface;
    const struct paint_surface *paint;
    struct paint_group *group;
    const struct transform *moved; // of the texture that is being painted
    double seen[3][8];             // what slope sees
    struct rgb *pass; // of each lane: what is let through; NULL: hits are shaded
};

// Where a texture is looked up, as struct texture_point and struct texture_chain.
struct spot {
    double place[3][8], normal[3][8];
    const struct spot *outer;
    const struct texture *map; // around it; NULL: the outermost
};

static const struct surface_kernels *kernels_of(const struct brush *b)
{
    return b->t->job->kernels->surface;
}

static struct pattern_packet packet_of(const struct brush *b)
{
    const struct simple_group *h = &b->group->hits;
    return (struct pattern_packet){
        (const double(*)[8])h->p, (const double(*)[8])b->seen, (const double(*)[8])h->d,
        b->surface->wants_uv ? (const double(*)[8])h->uv : NULL};
}

static void lanes_copy(double to[3][8], const double from[3][8], unsigned lanes)
{
    if (lanes == 255) {
        memcpy(to, from, 3 * sizeof *to);
        return;
    }
    for (; lanes; lanes &= lanes - 1)
        for (int k = 0, i = __builtin_ctz(lanes); k < 3; k++)
            to[k][i] = from[k][i];
}

// normal_seen() of layers.c without maps, where no_bump_scale leaves the length.
static void see_length(struct brush *b, const double v[3][8], unsigned live)
{
    const bool uv = b->surface->flags & OBJECT_UV_MAPPING;
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        struct vec3 n = vec3(v[0][i], v[1][i], v[2][i]);
        if (!uv)
            n = transform_normal(b->moved, n);
        b->seen[0][i] = n.x, b->seen[1][i] = n.y, b->seen[2][i] = n.z;
    }
}

// The perturbed normals of a layer, of which `seen` keeps what slope sees.
static void layer_normals(struct brush *b, const struct spot *spot,
                          const struct normal *normal, unsigned live, double n[3][8])
{
    const struct surface_kernels *k = kernels_of(b);
    const struct pattern_packet packet = packet_of(b);
    memcpy(n, spot->normal, sizeof spot->normal);
    k->perturb(normal, &packet, (const double(*)[8])spot->place, live, n);
    if (spot->map)
        lanes_copy(b->seen, (const double(*)[8])n, live);
    else if (normal->no_bump_scale)
        see_length(b, (const double(*)[8])n, live);
    for (const struct spot *s = spot; s->map; s = s->outer)
        if (s->map->kind != TEXTURE_UV)
            k->normal_out(s->map->pattern, n);
    b->t->job->kernels->world_normals(b->surface, b->moved, n);
    if (!spot->map && !normal->no_bump_scale)
        lanes_copy(b->seen, (const double(*)[8])n, live);
}

static void even_color(const struct rgbft *c, float out[5][8])
{
    for (int i = 0; i < 8; i++) {
        out[0][i] = c->r, out[1][i] = c->g, out[2][i] = c->b;
        out[3][i] = c->filter, out[4][i] = c->transmit;
    }
}

static void layer_colors(struct brush *b, const struct paint_texture *x,
                         const struct spot *spot, uint32_t number, struct paint_sheet *s)
{
    const struct pigment_tape *tape = x->tape[number];
    s->found = s->lanes;
    if (!tape) {
        even_color(&s->layer->pigment->color, s->color);
        return;
    }
    const struct pattern_packet packet = packet_of(b);
    s->found = kernels_of(b)->colors(tape, &packet, (const double(*)[8])spot->place,
                                     s->lanes, s->color);
    if (tape->channels == 5)
        return;
    memset(s->color + 3, 0, 2 * sizeof *s->color);
    // As image_map_color where it does not reach.
    for (unsigned bare = s->lanes & ~s->found; bare; bare &= bare - 1)
        s->color[4][__builtin_ctz(bare)] = 1;
}

// One layer in the lanes of `live`; returns those that let light through.
static unsigned paint_layer(struct brush *b, const struct paint_texture *x,
                            const struct spot *spot, uint32_t number, unsigned live,
                            struct paint_coat *coat)
{
    const struct job *job = b->t->job;
    struct paint_sheet *s = &b->t->paint->sheet[b->t->paint->sheet_count++];
    float mirror[3][8];
    s->layer = &x->texture->layer[number];
    s->lanes = live;
    if (s->layer->normal && job->normals)
        layer_normals(b, spot, s->layer->normal, live, s->n);
    else
        memcpy(s->n, b->group->hits.n, sizeof s->n);
    layer_colors(b, x, spot, number, s);
    // Hit by hit, mirrors are asked when the light is found.
    const bool conserves = s->layer->finish->conserve_energy && b->paint->lit;
    if (conserves)
        paint_mirror(b->t, b->group, s, s->found, mirror);
    return job->kernels->sheet_pass(job, s, conserves ? (const float(*)[8])mirror : NULL,
                                    coat);
}

// What fake caustics of the surface add to what a layer lets through, of which the normals are
// put into the sheet; returns whether there are any.
static bool caustics_of(struct brush *b, const struct spot *spot, struct paint_sheet *s,
                        float more[8])
{
    const struct job *job = b->t->job;
    const double caustics = b->surface->interior->caustics;
    const struct simple_group *h = &b->group->hits;
    if (caustics == 0)
        return false;
    if (s->layer->normal && job->normals)
        layer_normals(b, spot, s->layer->normal, s->lanes, s->n);
    else
        memcpy(s->n, h->n, sizeof s->n);
    job->kernels->focus((const double(*)[8])s->n, (const double(*)[8])h->d, caustics,
                        more);
    return true;
}

// As occluder_plain of trace/shadow.c.
static void pass_plain(struct brush *b, const struct paint_texture *x,
                       const struct spot *spot, unsigned live, const double weight[8])
{
    struct rgb pass[8];
    for (int i = 0; i < 8; i++)
        pass[i] = rgb(1, 1, 1);
    for (uint32_t k = x->texture->layer_count; k-- > 0;) {
        struct paint_sheet s; // of its colours, and for caustics its normals
        float more[8];
        s.layer = &x->texture->layer[k];
        s.lanes = live;
        const bool focuses = caustics_of(b, spot, &s, more);
        layer_colors(b, x, spot, k, &s);
        for (unsigned left = live & s.found; left; left &= left - 1) {
            const int i = __builtin_ctz(left);
            const struct painted color = {.color = {s.color[0][i], s.color[1][i],
                                                    s.color[2][i], s.color[3][i],
                                                    s.color[4][i]}};
            struct layer l;
            layer_painted(b->t, s.layer, &color, &l);
            pass[i] = rgb_mul(pass[i], l.pass);
        }
        for (int i = 0; focuses && i < 8; i++)
            pass[i] = rgb_scale(more[i], pass[i]);
    }
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        b->pass[i] = rgb_add(b->pass[i], rgb_scale((float)weight[i], pass[i]));
    }
}

static void paint_plain(struct brush *b, const struct paint_texture *x,
                        const struct spot *spot, unsigned live, const double weight[8])
{
    if (b->pass) {
        pass_plain(b, x, spot, live, weight);
        return;
    }
    struct paint_scratch *s = b->t->paint;
    struct paint_coat *coat = &s->coat[s->coat_count++];
    coat->texture = x->texture;
    coat->lanes = live;
    coat->any = 0;
    coat->sheet = s->sheet_count;
    memcpy(coat->weight, weight, sizeof coat->weight);
    for (int i = 0; i < 8; i++) {
        coat->trans[i] = 1;
        for (int k = 0; k < 3; k++) {
            coat->passed[k][i] = 1;
            coat->filter[k][i] = (float)weight[i];
        }
    }
    for (uint32_t k = x->texture->layer_count; k-- > 0 && live;)
        live = paint_layer(b, x, spot, k, live, coat);
    coat->open = live;
    coat->sheet_count = s->sheet_count - coat->sheet;
}

static void paint_texture(struct brush *b, const struct paint_texture *x,
                          const struct spot *spot, unsigned live, const double weight[8]);

// Each lane's entry, with its share of the weight; lanes without a share have none.
static void paint_entries(struct brush *b, const struct paint_texture *x,
                          const struct spot *spot, unsigned live, const double weight[8],
                          const uint32_t entry[8], const double share[8])
{
    double part[8] = {0};
    for (unsigned left = live; left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        part[i] = weight[i] * share[i];
        if (share[i] == 0)
            live &= ~(1u << i);
    }
    while (live) {
        const uint32_t one = entry[__builtin_ctz(live)];
        unsigned lanes = 0;
        for (int i = 0; i < 8; i++)
            lanes |= (unsigned)(entry[i] == one) << i;
        lanes &= live;
        live &= ~lanes;
        paint_texture(b, &x->entry[one], spot, lanes, part);
    }
}

// The two entries around the value, that above it first, as texture_select.
static void paint_map(struct brush *b, const struct paint_texture *x,
                      const struct spot *inner, unsigned live, const double weight[8])
{
    const struct texture_map *m = x->texture->map;
    const struct pattern_packet packet = packet_of(b);
    double value[8], high[8] = {0}, low[8] = {0};
    uint32_t above[8] = {0}, below[8] = {0};
    kernels_of(b)->values(x->texture->pattern, &packet, (const double(*)[8])inner->place,
                          live, value);
    for (unsigned left = live; left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        double f;
        map_find(m->key, m->count, value[i], &below[i], &above[i], &f);
        high[i] = below[i] == above[i] ? 1 : f;
        low[i] = below[i] == above[i] ? 0 : 1 - f;
    }
    paint_entries(b, x, inner, live, weight, above, high);
    paint_entries(b, x, inner, live, weight, below, low);
}

static void paint_average(struct brush *b, const struct paint_texture *x,
                          const struct spot *inner, unsigned live, const double weight[8])
{
    const struct texture_map *m = x->texture->map;
    double total = 0, share[8];
    uint32_t entry[8];
    for (uint32_t i = 0; i < m->count; i++)
        total += m->key[i];
    for (uint32_t i = 0; i < m->count; i++) {
        if (m->key[i] == 0)
            continue;
        for (int k = 0; k < 8; k++) {
            entry[k] = i;
            share[k] = m->key[i] / total;
        }
        paint_entries(b, x, inner, live, weight, entry, share);
    }
}

static void paint_material(struct brush *b, const struct paint_texture *x,
                           struct spot *inner, unsigned live, const double weight[8])
{
    static const double all[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    uint32_t entry[8] = {0};
    for (unsigned left = live; left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        entry[i] = image_map_entry(
            x->texture->image,
            vec3(inner->place[0][i], inner->place[1][i], inner->place[2][i]),
            x->texture->map->count);
    }
    paint_entries(b, x, inner, live, weight, entry, all);
}

static void paint_texture(struct brush *b, const struct paint_texture *x,
                          const struct spot *spot, unsigned live, const double weight[8])
{
    static const double all[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    static const uint32_t first[8] = {0};
    if (x->texture->kind == TEXTURE_PLAIN) {
        paint_plain(b, x, spot, live, weight);
        return;
    }
    struct spot inner = *spot;
    inner.outer = spot;
    inner.map = x->texture;
    if (x->texture->kind == TEXTURE_UV) {
        memcpy(inner.place, b->group->hits.uv, sizeof b->group->hits.uv);
        memset(inner.place[2], 0, sizeof inner.place[2]);
        paint_entries(b, x, &inner, live, weight, first, all);
        return;
    }
    kernels_of(b)->warp(x->texture->pattern, inner.place);
    kernels_of(b)->normal_in(x->texture->pattern, inner.normal);
    switch (x->texture->kind) {
    case TEXTURE_MAP: paint_map(b, x, &inner, live, weight); break;
    case TEXTURE_AVERAGE: paint_average(b, x, &inner, live, weight); break;
    case TEXTURE_MATERIAL: paint_material(b, x, &inner, live, weight); break;
    case TEXTURE_UV:
    case TEXTURE_PLAIN: break;
    }
}

// ---- light ----------------------------------------------------------------------------

// Shades a lane by the general rule.
static void shade_lane(struct tracer *t, const struct paint_group *g, int i,
                       const struct rgb *known)
{
    struct painted layer[PAINT_LAYERS], *end = layer;
    struct paint_part part[PAINT_PARTS];
    uint32_t parts = 0;
    for (uint32_t k = g->coat; k < g->coat + g->coat_count; k++) {
        const struct paint_coat *c = &t->paint->coat[k];
        if (!(c->lanes >> i & 1))
            continue;
        part[parts++] = (struct paint_part){c->texture, c->weight[i], end};
        uint32_t number = c->texture->layer_count;
        for (uint32_t l = c->sheet; l < c->sheet + c->sheet_count; l++) {
            const struct paint_sheet *s = &t->paint->sheet[l];
            end[--number] =
                (struct painted){{s->n[0][i], s->n[1][i], s->n[2][i]},
                                 {s->color[0][i], s->color[1][i], s->color[2][i],
                                  s->color[3][i], s->color[4][i]},
                                 s->found >> i & 1};
        }
        end += c->texture->layer_count;
    }
    const struct hit hit = hit_batch_at(t->hit, g->hits.ray[i]);
    const struct path path = wave_path(t, g->hits.slot[i]);
    const struct ray ray = {path.o, path.d, 0, INFINITY};
    struct interaction at;
    trace_interaction(t->job->world, &ray, &hit, &at);
    t->slot = g->hits.slot[i];
    shade_painted(t, &path, &hit, &at, part, parts, known);
}

static bool is_matt(const struct tracer *t, const struct paint_group *g)
{
    bool matt = false;
    for (uint32_t i = g->sheet; i < g->sheet + g->sheet_count; i++)
        matt |= t->paint->sheet[i].layer->finish->matt > 0;
    return matt;
}

static void shade_group(struct tracer *t, const struct paint_group *g)
{
    struct rgb light[8];
    const unsigned known = is_matt(t, g) ? indirect_known(t, &g->hits, light) : 0;
    for (unsigned live = g->hits.live; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        shade_lane(t, g, i, known >> i & 1 ? &light[i] : NULL);
    }
}

// Lights what waits.
static void brush_flush(struct brush *b)
{
    struct paint_scratch *s = b->t->paint;
    if (b->paint->lit && s->group_count)
        paint_light(b->t, s->group, s->group_count);
    for (uint32_t i = 0; i < s->group_count && !b->paint->lit; i++)
        shade_group(b->t, &s->group[i]);
    s->group_count = s->sheet_count = s->coat_count = 0;
}

// Paints the lanes of `live` with a texture of the surface.
static void paint_side(struct brush *b, const struct paint_texture *x,
                       const struct transform *moved, unsigned live)
{
    static const double whole[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    struct spot spot = {.map = NULL};
    b->moved = moved;
    b->t->job->kernels->texture_space(b->surface, moved, &b->group->hits, spot.place,
                                      spot.normal);
    paint_texture(b, x, &spot, live, whole);
}

// Paints up to eight hits of the batch.
static void paint_sides(struct brush *b, const uint16_t *ray, uint32_t count)
{
    struct paint_group *g = b->group;
    const struct surface *surface = b->surface;
    b->t->job->kernels->points(b->t, ray, count, surface->wants_uv, &g->hits);
    memcpy(b->seen, g->hits.n, sizeof b->seen);
    const unsigned live = g->hits.live, back = b->paint->back ? live & g->hits.turned : 0;
    if (live & ~back)
        paint_side(b, b->paint->top, &surface->texture_transform, live & ~back);
    if (back)
        paint_side(b, b->paint->back, &surface->interior_texture_transform, back);
}

static void brush_paint(struct brush *b, const uint16_t *ray, uint32_t count)
{
    struct paint_scratch *s = b->t->paint;
    if (s->group_count == PAINT_GROUPS ||
        s->sheet_count + 8 * PAINT_LAYERS > PAINT_SHEETS ||
        s->coat_count + 8 * PAINT_PARTS > PAINT_COATS)
        brush_flush(b);
    struct paint_group *g = b->group = &s->group[s->group_count++];
    g->surface = b->surface;
    g->sheet = s->sheet_count;
    g->coat = s->coat_count;
    paint_sides(b, ray, count);
    g->sheet_count = s->sheet_count - g->sheet;
    g->coat_count = s->coat_count - g->coat;
}

void paint_shade(struct tracer *t)
{
    struct paint_scratch *s = t->paint;
    struct brush b = {.t = t};
    for (uint32_t n = 0; s && n < s->seen_count; n++) {
        b.surface = &t->job->world->surface[s->seen[n]];
        b.paint = &t->job->paint[s->seen[n]];
        uint16_t k = s->head[b.paint->number];
        s->head[b.paint->number] = END;
        while (k != END) {
            uint16_t ray[8];
            uint32_t count = 0;
            for (; count < 8 && k != END; k = s->link[k])
                ray[count++] = k;
            if (count)
                brush_paint(&b, ray, count);
        }
        brush_flush(&b);
    }
    if (s)
        s->seen_count = 0;
}

static bool is_painted(const struct job *job, uint32_t surface)
{
    return job->paint[surface].top &&
           !(job->simple && job->simple[surface].class != SIMPLE_NONE);
}

void paint_first(struct tracer *t)
{
    const struct world *w = t->job->world;
    for (uint32_t k = 0; k < t->wave.count && t->paint; k++) {
        if (!(t->hit->t[k] < INFINITY) || (t->settled && t->settled[k]) ||
            !is_painted(t->job, w->leaf[t->hit->leaf[k]].surface))
            continue;
        t->paint->asks[k].any = false;
        paint_take(t, k);
    }
    paint_shade(t);
}

bool paint_ask(struct tracer *t, uint32_t k)
{
    const struct job *job = t->job;
    if (!t->paint || !is_painted(job, job->world->leaf[t->hit->leaf[k]].surface))
        return false;
    if (t->paint->asks[k].any)
        indirect_ask_kept(t, k, &t->paint->asks[k]);
    return true;
}

// ---- shadow rays ------------------------------------------------------------------------

bool paint_filters(const struct job *job, uint32_t surface)
{
    return job->paint && job->paint[surface].top;
}

void paint_pass(struct tracer *t, uint32_t surface, const uint16_t *ray, uint32_t count,
                struct rgb pass[8])
{
    struct paint_group g;
    struct brush b = {.t = t,
                      .surface = &t->job->world->surface[surface],
                      .paint = &t->job->paint[surface],
                      .group = &g,
                      .pass = pass};
    struct ray_batch *const rays = t->rays;
    struct hit_batch *const hit = t->hit;
    t->rays = t->walk_rays;
    t->hit = t->walk_hit;
    for (int i = 0; i < 8; i++)
        pass[i] = rgb(0, 0, 0);
    paint_sides(&b, ray, count);
    t->rays = rays;
    t->hit = hit;
}
