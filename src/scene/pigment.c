// Pigments: a colour for a point (spec/textures 8, 10).

#include "base/arena.h"
#include "scene/image_map.h"
#include "scene/pigment_tape.h"
#include "scene/surface_eval.h"

static bool color_at(const struct pigment *p, struct vec3 place,
                     const struct texture_point *at, struct rgbft *out);

// Blended in single precision, as colours are stored.
static inline float blend(float a, float b, double f) { return a + (float)(f * (b - a)); }

static struct rgbft blend_colors(struct rgbft a, struct rgbft b, double f)
{
    return (struct rgbft){blend(a.r, b.r, f), blend(a.g, b.g, f), blend(a.b, b.b, f),
                          blend(a.filter, b.filter, f), blend(a.transmit, b.transmit, f)};
}

static struct rgbft map_color(const struct color_map *m, double v)
{
    uint32_t a, b;
    double f;
    map_find(m->key, m->count, v, &a, &b, &f);
    return a == b ? m->color[b] : blend_colors(m->color[a], m->color[b], f);
}

static bool blend_pigments(const struct pigment *p, double v, struct vec3 place,
                           const struct texture_point *at, struct rgbft *out)
{
    const struct pigment_map *m = p->map;
    uint32_t a, b;
    double f;
    map_find(m->key, m->count, v, &a, &b, &f);
    bool found = color_at(m->entry[b], place, at, out);
    if (a == b)
        return found;
    struct rgbft low;
    found |= color_at(m->entry[a], place, at, &low);
    *out = blend_colors(low, *out, f);
    return found;
}

static bool average_pigments(const struct pigment_map *m, struct vec3 place,
                             const struct texture_point *at, struct rgbft *out)
{
    struct rgbft sum = {0};
    float total = 0;
    bool found = false;
    for (uint32_t i = 0; i < m->count; i++) {
        struct rgbft c;
        const float w = m->key[i];
        found |= color_at(m->entry[i], place, at, &c);
        sum.r += w * c.r;
        sum.g += w * c.g;
        sum.b += w * c.b;
        sum.filter += w * c.filter;
        sum.transmit += w * c.transmit;
        total += w;
    }
    *out = (struct rgbft){sum.r / total, sum.g / total, sum.b / total, sum.filter / total,
                          sum.transmit / total};
    return found;
}

static bool color_at(const struct pigment *p, struct vec3 place,
                     const struct texture_point *at, struct rgbft *out)
{
    struct pattern_context c;
    switch (p->kind) {
    case PIGMENT_NONE: break;
    case PIGMENT_SOLID: *out = p->color; return true;
    case PIGMENT_COLORS:
        c = pattern_context_of(at);
        *out = map_color(p->colors, pattern_value(p->pattern, place, &c));
        return true;
    case PIGMENT_MAP:
        c = pattern_context_of(at);
        place = pattern_warp(p->pattern, place);
        return blend_pigments(p, pattern_value_at(p->pattern, place, &c), place, at, out);
    case PIGMENT_AVERAGE:
        return average_pigments(p->map, pattern_warp(p->pattern, place), at, out);
    case PIGMENT_IMAGE:
        return image_map_color(p->image, pattern_warp(p->pattern, place), out);
    case PIGMENT_UV: return color_at(p->map->entry[0], uv_point(at), at, out);
    }
    *out = (struct rgbft){0};
    return true;
}

bool pigment_color(const struct pigment *p, const struct texture_point *at,
                   struct rgbft *out)
{
    if (p->kind == PIGMENT_SOLID) {
        *out = p->color;
        return true;
    }
    return color_at(p, texture_place(at), at, out);
}

const struct pigment *pigment_transform(struct arena *a, const struct pigment *p,
                                        const struct transform *t)
{
    if (p->kind == PIGMENT_SOLID || p->kind == PIGMENT_NONE || p->kind == PIGMENT_UV)
        return p;
    struct pigment *copy = arena_new_struct(a, struct pigment);
    *copy = *p;
    copy->pattern = pattern_moved(a, p->pattern, t);
    return copy;
}
