#include "trace/paint.h"

#include <stdlib.h>
#include <string.h>

#include "scene/image_map.h"
#include "scene/pigment_tape.h"
#include "trace/shade.h"
#include "trace/shade_kernel.h"

// ---- hits -----------------------------------------------------------------------------

enum { END = UINT16_MAX };

void paint_init(struct tracer *t)
{
    const uint32_t count = t->job->paint_count;
    if (!count)
        return;
    t->paint_head = malloc(count * sizeof *t->paint_head);
    t->paint_seen = malloc(BATCH_SIZE * sizeof *t->paint_seen);
    t->paint_link = malloc(BATCH_SIZE * sizeof *t->paint_link);
    if (!t->paint_head || !t->paint_seen || !t->paint_link)
        abort();
    for (uint32_t i = 0; i < count; i++)
        t->paint_head[i] = END;
}

void paint_end(struct tracer *t)
{
    free(t->paint_head);
    free(t->paint_seen);
    free(t->paint_link);
}

bool paint_take(struct tracer *t, uint32_t k)
{
    const struct job *job = t->job;
    if (!job->paint)
        return false;
    const uint32_t surface = job->world->leaf[t->hit->leaf[k]].surface;
    const struct paint_surface *p = &job->paint[surface];
    if (!p->top)
        return false;
    if (t->paint_head[p->number] == END)
        t->paint_seen[t->paint_count++] = surface;
    t->paint_link[k] = t->paint_head[p->number];
    t->paint_head[p->number] = (uint16_t)k;
    return true;
}

// Hits of one surface; lanes past `count` repeat the first.
struct brush {
    struct tracer *t;
    const struct surface *surface;
    const struct paint_surface *paint;
    int count;
    uint16_t ray[8];
    struct path path[8];
    struct hit hit[8];
    struct interaction at[8];
    struct painted layer[8][PAINT_LAYERS]; // of all parts
    struct paint_part part[8][PAINT_PARTS];
    uint32_t layer_count[8], part_count[8];
    double p[3][8], d[3][8], n[3][8], uv[2][8]; // n: of the surface, towards the ray
    double seen[3][8];                          // the normal of the layer before
};

// Where a texture is looked up, as struct texture_point and struct texture_chain.
struct spot {
    double place[3][8], normal[3][8];
    const struct spot *outer;
    const struct texture *map; // around it; NULL: the outermost
};

static void set_lane(double v[3][8], int i, struct vec3 x)
{
    v[0][i] = x.x, v[1][i] = x.y, v[2][i] = x.z;
}

static struct vec3 lane_of(double v[3][8], int i)
{
    return vec3(v[0][i], v[1][i], v[2][i]);
}

static const struct transform *brush_transform(const struct brush *b)
{
    // Textures of a uv mapped object are not moved with it.
    return b->surface->flags & OBJECT_UV_MAPPING ? &transform_identity
                                                 : &b->surface->texture_transform;
}

static void brush_lane(struct brush *b, struct spot *spot, int i)
{
    const struct interaction *at = &b->at[i];
    const struct vec3 d = b->path[i].d;
    const struct vec3 n = vec3_dot(at->ns, d) > 0 ? vec3_neg(at->ns) : at->ns;
    const struct transform *m = brush_transform(b);
    set_lane(b->p, i, at->p);
    set_lane(b->d, i, d);
    set_lane(b->n, i, n);
    set_lane(b->seen, i, n);
    b->uv[0][i] = at->uv.u;
    b->uv[1][i] = at->uv.v;
    set_lane(spot->place, i,
             b->surface->flags & OBJECT_UV_MAPPING ? vec3(at->uv.u, at->uv.v, 0)
                                                   : transform_inverse_point(m, at->p));
    set_lane(spot->normal, i, transform_inverse_normal(m, n));
}

static const struct surface_kernels *kernels_of(const struct brush *b)
{
    return b->t->job->kernels->surface;
}

static struct pattern_packet packet_of(const struct brush *b)
{
    return (struct pattern_packet){(const double(*)[8])b->p, (const double(*)[8])b->seen,
                                   (const double(*)[8])b->d, (const double(*)[8])b->uv};
}

static void layer_normals(struct brush *b, const struct spot *spot,
                          const struct normal *normal, unsigned live)
{
    const struct surface_kernels *k = kernels_of(b);
    const struct pattern_packet packet = packet_of(b);
    double v[3][8];
    memcpy(v, spot->normal, sizeof v);
    k->perturb(normal, &packet, (const double(*)[8])spot->place, live, v);
    for (const struct spot *s = spot; s->map; s = s->outer)
        if (s->map->kind != TEXTURE_UV)
            k->normal_out(s->map->pattern, v);
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        set_lane(b->seen, i,
                 vec3_normalize(transform_normal(brush_transform(b), lane_of(v, i))));
    }
}

// One layer in the lanes of `live`; returns those that let light through.
static unsigned paint_layer(struct brush *b, const struct paint_texture *x,
                            const struct spot *spot, uint32_t number, unsigned live,
                            struct painted *const to[8])
{
    const struct texture_layer *l = &x->texture->layer[number];
    const struct pigment_tape *tape = x->tape[number];
    const struct pattern_packet packet = packet_of(b);
    float color[5][8] = {{0}};
    unsigned found = live, clear = 0;
    if (l->normal && b->t->job->normals)
        layer_normals(b, spot, l->normal, live);
    else
        for (unsigned left = live; left; left &= left - 1)
            set_lane(b->seen, __builtin_ctz(left), lane_of(b->n, __builtin_ctz(left)));
    if (tape)
        found = kernels_of(b)->colors(tape, &packet, (const double(*)[8])spot->place,
                                      live, color);
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        struct painted *p = &to[i][number];
        *p = (struct painted){lane_of(b->seen, i), l->pigment->color, found >> i & 1};
        if (tape)
            p->color = (struct rgbft){color[0][i], color[1][i], color[2][i], color[3][i],
                                      color[4][i]};
        if (!p->found &&
            tape->channels == 3) // as image_map_color where it does not reach
            p->color.transmit = 1;
        const struct rgb pass = rgbft_pass(p->color);
        if (!p->found || pass.r != 0 || pass.g != 0 || pass.b != 0)
            clear |= 1u << i;
    }
    return clear;
}

static void paint_plain(struct brush *b, const struct paint_texture *x,
                        const struct spot *spot, unsigned live, const double weight[8])
{
    struct painted *to[8] = {NULL};
    for (unsigned left = live; left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        to[i] = &b->layer[i][b->layer_count[i]];
        b->layer_count[i] += x->texture->layer_count;
        b->part[i][b->part_count[i]++] =
            (struct paint_part){x->texture, weight[i], to[i]};
    }
    for (uint32_t k = x->texture->layer_count; k-- > 0 && live;)
        live = paint_layer(b, x, spot, k, live, to);
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
        entry[i] = image_map_entry(x->texture->image, lane_of(inner->place, i),
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
        memcpy(inner.place, b->uv, sizeof b->uv);
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

static void brush_shade(struct brush *b)
{
    static const double whole[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    struct tracer *t = b->t;
    struct spot spot = {.map = NULL};
    for (int i = 0; i < b->count; i++) {
        b->hit[i] = hit_batch_at(t->hit, b->ray[i]);
        b->path[i] = wave_path(t, t->wave.slot[b->ray[i]]);
        const struct ray ray = {b->path[i].o, b->path[i].d, 0, INFINITY};
        trace_interaction(t->job->world, &ray, &b->hit[i], &b->at[i]);
        brush_lane(b, &spot, i);
        b->layer_count[i] = b->part_count[i] = 0;
    }
    for (int i = b->count; i < 8; i++) {
        b->path[i] = b->path[0];
        b->at[i] = b->at[0];
        brush_lane(b, &spot, i);
    }
    paint_texture(b, b->paint->top, &spot, (1u << b->count) - 1, whole);
    for (int i = 0; i < b->count; i++) {
        t->slot = t->wave.slot[b->ray[i]];
        shade_painted(t, &b->path[i], &b->hit[i], &b->at[i], b->part[i],
                      b->part_count[i]);
    }
}

void paint_shade(struct tracer *t)
{
    const struct world *w = t->job->world;
    struct brush b = {.t = t};
    for (uint32_t s = 0; s < t->paint_count; s++) {
        b.surface = &w->surface[t->paint_seen[s]];
        b.paint = &t->job->paint[t->paint_seen[s]];
        uint16_t k = t->paint_head[b.paint->number];
        t->paint_head[b.paint->number] = END;
        while (k != END) {
            for (b.count = 0; b.count < 8 && k != END; k = t->paint_link[k])
                b.ray[b.count++] = k;
            brush_shade(&b);
        }
    }
    t->paint_count = 0;
}
