// Which surfaces are painted, and their textures for trace/paint.c.
#include <string.h>

#include "base/arena.h"
#include "scene/pigment_tape.h"
#include "trace/paint.h"
#include "trace/simple.h"

// ---- what sees the normal of the layer before -----------------------------------------
// Textures after the first of a map see the normal of the layer that was evaluated last.
// Below another layer it may be another one here: layers that hardly count are not left out.

static bool pattern_sees(const struct pattern *p);

static bool pigment_sees(const struct pigment *p)
{
    if (p->pattern && pattern_sees(p->pattern))
        return true;
    const bool mapped =
        p->kind == PIGMENT_MAP || p->kind == PIGMENT_AVERAGE || p->kind == PIGMENT_UV;
    for (uint32_t i = 0; mapped && i < p->map->count; i++)
        if (pigment_sees(p->map->entry[i]))
            return true;
    return false;
}

static bool pattern_sees(const struct pattern *p)
{
    return p->ops == &slope_pattern_ops || (p->pigment && pigment_sees(p->pigment));
}

static bool normal_sees(const struct normal *n)
{
    if (pattern_sees(&n->pattern))
        return true;
    const bool mapped =
        n->kind == NORMAL_MAP || n->kind == NORMAL_AVERAGE || n->kind == NORMAL_UV;
    for (uint32_t i = 0; mapped && i < n->map->count; i++)
        if (normal_sees(n->map->entry[i]))
            return true;
    return false;
}

// ---- textures -------------------------------------------------------------------------

// The most that one hit takes of it.
struct paint_size {
    uint32_t parts, layers;
};

struct build {
    const struct job *job;
    struct pigment_compiler pigments;
    bool mapped;      // below a map
    bool sees;        // a map in a map sees the normal of the layer before
    bool lower_bumps; // layers below others have normals
};

enum { LEVELS_MAX = 4 };

static bool texture_compile(struct build *b, const struct texture *x, int level,
                            struct paint_texture *out, struct paint_size *size);

static bool plain_compile(struct build *b, const struct texture *x,
                          struct paint_texture *out, struct paint_size *size)
{
    const struct pigment_tape **tape =
        arena_new_array(b->pigments.arena, const struct pigment_tape *, x->layer_count);
    for (uint32_t i = 0; i < x->layer_count; i++) {
        const struct texture_layer *l = &x->layer[i];
        tape[i] = NULL;
        if (b->mapped && b->job->normals && l->normal && normal_sees(l->normal))
            return false;
        b->lower_bumps |= l->normal && i + 1 < x->layer_count;
        if (l->pigment->kind == PIGMENT_SOLID)
            continue;
        tape[i] = pigment_compile(&b->pigments, l->pigment);
        if (!tape[i])
            return false;
    }
    out->tape = tape;
    *size = (struct paint_size){1, x->layer_count};
    return true;
}

static uint32_t larger(uint32_t a, uint32_t b) { return a > b ? a : b; }

static bool map_compile(struct build *b, const struct texture *x, int level,
                        struct paint_texture *out, struct paint_size *size)
{
    const uint32_t count = x->kind == TEXTURE_UV ? 1 : x->map->count;
    struct paint_texture *entry =
        arena_new_array(b->pigments.arena, struct paint_texture, count);
    b->sees |= level > 0 && x->pattern && pattern_sees(x->pattern);
    b->mapped = true;
    *size = (struct paint_size){0, 0};
    for (uint32_t i = 0; i < count; i++) {
        struct paint_size one;
        if (!texture_compile(b, x->map->entry[i], level + 1, &entry[i], &one))
            return false;
        if (x->kind == TEXTURE_AVERAGE)
            *size =
                (struct paint_size){size->parts + one.parts, size->layers + one.layers};
        else
            *size = (struct paint_size){larger(size->parts, one.parts),
                                        larger(size->layers, one.layers)};
    }
    if (x->kind == TEXTURE_MAP) // between two
        *size = (struct paint_size){2 * size->parts, 2 * size->layers};
    out->entry = entry;
    return true;
}

static bool texture_compile(struct build *b, const struct texture *x, int level,
                            struct paint_texture *out, struct paint_size *size)
{
    *out = (struct paint_texture){.texture = x};
    if (level > LEVELS_MAX)
        return false;
    return (x->kind == TEXTURE_PLAIN ? plain_compile(b, x, out, size)
                                     : map_compile(b, x, level, out, size)) &&
           size->parts <= PAINT_PARTS && size->layers <= PAINT_LAYERS;
}

// ---- surfaces -------------------------------------------------------------------------

// Layers of one colour each leave nothing to do but to be lit.
static bool has_work(const struct job *job, const struct texture *x)
{
    for (uint32_t i = 0; i < x->layer_count; i++) {
        const enum pigment_kind kind = x->layer[i].pigment->kind;
        if ((kind != PIGMENT_SOLID && kind != PIGMENT_NONE) ||
            (x->layer[i].normal && job->normals))
            return true;
    }
    return x->kind != TEXTURE_PLAIN;
}

static const struct paint_texture *side_compile(struct build *b, const struct texture *x)
{
    struct paint_texture *out = arena_new_struct(b->pigments.arena, struct paint_texture);
    struct paint_size size;
    b->mapped = b->sees = b->lower_bumps = false;
    return texture_compile(b, x, 0, out, &size) && !(b->sees && b->lower_bumps) ? out
                                                                                : NULL;
}

static struct paint_surface surface_compile(struct build *b, const struct surface *s)
{
    const struct texture *x = s->texture, *back = s->interior_texture;
    struct paint_surface p = {.lit = paint_lights_surface(b->job, s) &&
                                     paint_lights_texture(b->job, x) &&
                                     (!back || paint_lights_texture(b->job, back))};
    const bool works = has_work(b->job, x) || (back && has_work(b->job, back));
    // Hit by hit, the order of those that ask for light by way of others would be lost.
    if (s->parts || s->cutaway || !(p.lit || (works && !b->job->collects)))
        return p;
    if (back && !(p.back = side_compile(b, back)))
        return p;
    p.top = side_compile(b, x);
    return p;
}

// Simple surfaces are painted by others; what they focus is worked out here.
static bool is_painted(const struct job *job, uint32_t i)
{
    const struct surface *s = &job->world->surface[i];
    return !s->in_contact && (!job->simple || job->simple[i].class == SIMPLE_NONE ||
                              (s->interior->caustics != 0 && !s->opaque));
}

void paint_compile(struct job *job, struct arena *a)
{
    const struct world *w = job->world;
    // Below 0, what lies under opaque layers would count; from 1 on, no layer does.
    if (job->general || !job->pigments || !job->lights ||
        !(job->adc_bailout >= 0 && job->adc_bailout < 1))
        return;
    struct build b = {.job = job, .pigments = {.arena = a}};
    struct paint_surface *all = NULL, last = {0};
    for (uint32_t i = 0; i < w->surface_count; i++) {
        const struct surface *s = &w->surface[i];
        if (!is_painted(job, i))
            continue;
        // Neighbours often share their texture.
        const struct surface *before = i ? &w->surface[i - 1] : NULL;
        if (!before || !last.top || before->texture != s->texture ||
            before->light_group != s->light_group || before->photons != s->photons ||
            s->parts || s->cutaway || s->interior_texture || last.back)
            last = surface_compile(&b, s);
        if (!last.top)
            continue;
        if (!all) {
            all = arena_new_array(a, struct paint_surface, w->surface_count);
            memset(all, 0, w->surface_count * sizeof *all);
        }
        all[i] = last;
        all[i].number = job->paint_count++;
    }
    job->paint = all;
}
