#include "trace/paint.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "scene/pigment_tape.h"
#include "trace/layers.h"
#include "trace/shade.h"
#include "trace/shade_kernel.h"
#include "trace/simple.h"

// ---- which surfaces -------------------------------------------------------------------

// Layers of one colour each leave nothing to do.
static bool has_work(const struct job *job, const struct texture *x)
{
    for (uint32_t i = 0; i < x->layer_count; i++) {
        const enum pigment_kind kind = x->layer[i].pigment->kind;
        if ((kind != PIGMENT_SOLID && kind != PIGMENT_NONE) ||
            (x->layer[i].normal && job->normals))
            return true;
    }
    return false;
}

static bool surface_compile(const struct job *job, struct pigment_compiler *c,
                            const struct surface *s, struct paint_surface *out)
{
    const struct texture *x = s->texture;
    if (x->kind != TEXTURE_PLAIN || x->layer_count > PAINT_LAYERS || s->parts ||
        s->cutaway || s->interior_texture || !has_work(job, x))
        return false;
    const struct pigment_tape **tape =
        arena_new_array(c->arena, const struct pigment_tape *, x->layer_count);
    for (uint32_t i = 0; i < x->layer_count; i++) {
        tape[i] = NULL;
        if (x->layer[i].pigment->kind == PIGMENT_SOLID)
            continue;
        tape[i] = pigment_compile(c, x->layer[i].pigment);
        if (!tape[i])
            return false;
    }
    out->tape = tape;
    out->layer_count = x->layer_count;
    return true;
}

void paint_compile(struct job *job, struct arena *a)
{
    const struct world *w = job->world;
    if (job->general || !job->pigments || !job->lights)
        return;
    struct pigment_compiler compiler = {.arena = a};
    struct paint_surface *all = NULL;
    for (uint32_t i = 0; i < w->surface_count; i++) {
        if (job->simple && job->simple[i].class != SIMPLE_NONE)
            continue;
        struct paint_surface one = {.number = job->paint_count};
        if (!surface_compile(job, &compiler, &w->surface[i], &one))
            continue;
        if (!all) {
            all = arena_new_array(a, struct paint_surface, w->surface_count);
            memset(all, 0, w->surface_count * sizeof *all);
        }
        all[i] = one;
        job->paint_count++;
    }
    job->paint = all;
}

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
    if (!p->layer_count)
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
    struct painted layer[8][PAINT_LAYERS];
    double p[3][8], d[3][8], n[3][8], uv[2][8]; // n: of the surface, towards the ray
    double place[3][8], normal[3][8];           // in the space of the texture
    double seen[3][8];                          // the normal of the layer before
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

static void brush_lane(struct brush *b, int i)
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
    set_lane(b->place, i,
             b->surface->flags & OBJECT_UV_MAPPING ? vec3(at->uv.u, at->uv.v, 0)
                                                   : transform_inverse_point(m, at->p));
    set_lane(b->normal, i, transform_inverse_normal(m, n));
}

static void layer_normals(struct brush *b, const struct normal *normal, unsigned live)
{
    const struct surface_kernels *k = b->t->job->kernels->surface;
    const struct pattern_packet packet = {
        (const double(*)[8])b->p, (const double(*)[8])b->seen, (const double(*)[8])b->d,
        (const double(*)[8])b->uv};
    double v[3][8];
    memcpy(v, b->normal, sizeof v);
    k->perturb(normal, &packet, (const double(*)[8])b->place, live, v);
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        set_lane(b->seen, i,
                 vec3_normalize(transform_normal(brush_transform(b), lane_of(v, i))));
    }
}

static unsigned layer_colors(struct brush *b, const struct pigment_tape *tape,
                             unsigned live, float color[5][8])
{
    const struct pattern_packet packet = {
        (const double(*)[8])b->p, (const double(*)[8])b->seen, (const double(*)[8])b->d,
        (const double(*)[8])b->uv};
    memset(color, 0, 5 * sizeof color[0]);
    return b->t->job->kernels->surface->colors(tape, &packet, (const double(*)[8])b->place,
                                               live, color);
}

// One layer in the lanes of `live`; returns those that let light through.
static unsigned paint_layer(struct brush *b, uint32_t number, unsigned live)
{
    const struct texture_layer *l = &b->surface->texture->layer[number];
    const struct pigment_tape *tape = b->paint->tape[number];
    float color[5][8];
    unsigned found = live, clear = 0;
    if (l->normal && b->t->job->normals)
        layer_normals(b, l->normal, live);
    else
        memcpy(b->seen, b->n, sizeof b->seen);
    if (tape)
        found = layer_colors(b, tape, live, color);
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        struct painted *p = &b->layer[i][number];
        if (!(found >> i & 1)) { // rare: an image that does not reach there
            clear |= 1u << i;
            continue;
        }
        *p = (struct painted){.n = lane_of(b->seen, i),
                              .color = l->pigment->color,
                              .known = true};
        if (tape)
            p->color = (struct rgbft){color[0][i], color[1][i], color[2][i], color[3][i],
                                      color[4][i]};
        const struct rgb pass = rgbft_pass(p->color);
        if (pass.r != 0 || pass.g != 0 || pass.b != 0)
            clear |= 1u << i;
    }
    return clear;
}

static void brush_shade(struct brush *b)
{
    struct tracer *t = b->t;
    for (int i = 0; i < b->count; i++) {
        b->hit[i] = hit_batch_at(t->hit, b->ray[i]);
        b->path[i] = wave_path(t, t->wave.slot[b->ray[i]]);
        const struct ray ray = {b->path[i].o, b->path[i].d, 0, INFINITY};
        trace_interaction(t->job->world, &ray, &b->hit[i], &b->at[i]);
        brush_lane(b, i);
        for (uint32_t k = 0; k < b->paint->layer_count; k++)
            b->layer[i][k].known = false;
    }
    for (int i = b->count; i < 8; i++) {
        b->path[i] = b->path[0];
        b->at[i] = b->at[0];
        brush_lane(b, i);
    }
    unsigned live = (1u << b->count) - 1;
    for (uint32_t k = b->paint->layer_count; k-- > 0 && live;)
        live = paint_layer(b, k, live);
    for (int i = 0; i < b->count; i++) {
        t->slot = t->wave.slot[b->ray[i]];
        shade_painted(t, &b->path[i], &b->hit[i], &b->at[i], b->layer[i]);
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
