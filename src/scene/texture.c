// Textures of textures: which of them count at a point (spec/textures 12).

#include "scene/texture.h"

#include "base/arena.h"
#include "scene/image_map.h"
#include "scene/pigment_tape.h"
#include "scene/surface_eval.h"

// A colour that lets less than this through is opaque (spec/lighting 7.1).
#define OPAQUE_LIMIT 1e-10f

static int select_two(const struct texture *x, const struct texture_point *at,
                      const struct texture **entry, double *weight, int max)
{
    const struct pattern_context c = pattern_context_of(at);
    const struct texture_map *m = x->map;
    uint32_t a, b;
    double f;
    map_find(m->key, m->count, pattern_value(x->pattern, texture_place(at), &c), &a, &b,
             &f);
    if (max < 1)
        return 0;
    entry[0] = m->entry[b];
    weight[0] = 1;
    if (a == b || max < 2)
        return 1;
    weight[0] = f;
    entry[1] = m->entry[a];
    weight[1] = 1 - f;
    return 2;
}

static int select_all(const struct texture_map *m, const struct texture **entry,
                      double *weight, int max)
{
    double total = 0;
    int count = 0;
    for (uint32_t i = 0; i < m->count; i++)
        total += m->key[i];
    for (uint32_t i = 0; i < m->count && count < max; i++) {
        if (m->key[i] == 0)
            continue;
        entry[count] = m->entry[i];
        weight[count++] = m->key[i] / total;
    }
    return count;
}

int texture_select(const struct texture *x, const struct texture_point *at,
                   const struct texture **entry, double *weight, int max)
{
    switch (x->kind) {
    case TEXTURE_MAP: return select_two(x, at, entry, weight, max);
    case TEXTURE_AVERAGE: return select_all(x->map, entry, weight, max);
    case TEXTURE_UV:
        entry[0] = x->map->entry[0];
        weight[0] = 1;
        return 1;
    case TEXTURE_MATERIAL:
        entry[0] = x->map->entry[image_map_entry(
            x->image, pattern_warp(x->pattern, texture_place(at)), x->map->count)];
        weight[0] = 1;
        return 1;
    case TEXTURE_PLAIN: break;
    }
    return 0;
}

struct texture_point texture_entry_point(const struct texture *x,
                                         const struct texture_point *at)
{
    struct texture_point inner = *at;
    inner.uv_mapping = false;
    if (x->kind == TEXTURE_UV) {
        inner.p = uv_point(at);
        return inner;
    }
    inner.p = pattern_warp(x->pattern, texture_place(at));
    inner.normal = pattern_normal_in(x->pattern, at->normal, false);
    return inner;
}

struct vec3 texture_entry_normal(const struct texture *x, struct vec3 n)
{
    return x->kind == TEXTURE_UV ? n : pattern_normal_out(x->pattern, n, false);
}

static bool color_is_opaque(struct rgbft c)
{
    return fabsf(c.filter) < OPAQUE_LIMIT && fabsf(c.transmit) < OPAQUE_LIMIT;
}

static bool color_is_clear(struct rgbft c)
{
    static const float rounding = 1e-6f; // of the sum
    return c.filter + c.transmit >= 1 - rounding;
}

// Whether all colours of the pigment are so; black, where it has none. An image is known only
// to be opaque.
static bool pigment_is(const struct pigment *p, bool (*color_is)(struct rgbft))
{
    static const struct rgbft black = {0};
    switch (p->kind) {
    case PIGMENT_NONE: return color_is(black);
    case PIGMENT_SOLID: return color_is(p->color);
    case PIGMENT_COLORS:
        for (uint32_t i = 0; i < p->colors->count; i++)
            if (!color_is(p->colors->color[i]))
                return false;
        return true;
    case PIGMENT_MAP:
    case PIGMENT_AVERAGE:
    case PIGMENT_UV:
        for (uint32_t i = 0; i < p->map->count; i++)
            if (!pigment_is(p->map->entry[i], color_is))
                return false;
        return true;
    case PIGMENT_IMAGE: return p->image->opaque && color_is(black);
    }
    return false;
}

bool texture_is_opaque(const struct texture *x)
{
    if (x->kind == TEXTURE_PLAIN) {
        for (uint32_t i = 0; i < x->layer_count; i++)
            if (pigment_is(x->layer[i].pigment, color_is_opaque))
                return true;
        return false;
    }
    for (uint32_t i = 0; i < x->map->count; i++)
        if (!texture_is_opaque(x->map->entry[i]))
            return false;
    return true;
}

bool texture_is_clear(const struct texture *x)
{
    if (x->kind == TEXTURE_PLAIN) {
        for (uint32_t i = 0; i < x->layer_count; i++)
            if (!pigment_is(x->layer[i].pigment, color_is_clear))
                return false;
        return x->layer_count > 0;
    }
    for (uint32_t i = 0; i < x->map->count; i++)
        if (!texture_is_clear(x->map->entry[i]))
            return false;
    return true;
}

const struct texture *texture_transform(struct arena *a, const struct texture *x,
                                        const struct transform *t)
{
    struct texture *copy = arena_new_struct(a, struct texture);
    *copy = *x;
    if (x->kind != TEXTURE_PLAIN) {
        copy->pattern = pattern_moved(a, x->pattern, t);
        return copy;
    }
    struct texture_layer *layer =
        arena_new_array(a, struct texture_layer, x->layer_count);
    for (uint32_t i = 0; i < x->layer_count; i++) {
        layer[i] = x->layer[i];
        layer[i].pigment = pigment_transform(a, layer[i].pigment, t);
        if (layer[i].normal)
            layer[i].normal = normal_transform(a, layer[i].normal, t);
    }
    copy->layer = layer;
    return copy;
}

bool texture_wants_uv(const struct texture *x)
{
    bool wants = x->kind == TEXTURE_UV || (x->pattern && x->pattern->pigment);
    for (uint32_t i = 0; i < x->layer_count && !wants; i++)
        wants = pigment_wants_uv(x->layer[i].pigment) ||
                (x->layer[i].normal && normal_wants_uv(x->layer[i].normal));
    for (uint32_t i = 0; x->map && i < x->map->count && !wants; i++)
        wants = texture_wants_uv(x->map->entry[i]);
    return wants;
}
