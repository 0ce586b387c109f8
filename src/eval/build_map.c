#include "eval/build.h"

#include <string.h>

// The maps (spec/language 4.8, spec/textures 8). Keys are single precision.

enum { ENTRIES_MAX = 256 };

// Grows while a map is read; the finished arrays are copied out at their size.
struct entries {
    uint32_t count;
    float key[ENTRIES_MAX + 1];
    const void *item[ENTRIES_MAX + 1];
};

static bool next_key(struct args *a, struct args *entry, double *key, bool optional)
{
    *entry = args_list(a->b, a->at->list, a->at, a->name, a);
    args_next(a);
    if (optional) {
        *key = 1;
        return args_optional(entry, key);
    }
    return args_float(entry, "value of the entry", key);
}

// True at `[`; anything else is reported and passed over.
static bool at_entry(struct args *a)
{
    if (a->at->kind == AST_ENTRY)
        return true;
    args_unknown(a, NULL, 0);
    return false;
}

static bool count_ok(struct args *a, uint32_t count)
{
    if (a->failed)
        return false;
    if (count == 0)
        args_error(a, args_span(a), "the map has no entry");
    else if (count > ENTRIES_MAX)
        args_error(a, args_span(a), "the map has more than 256 entries");
    return !a->failed;
}

// A map identifier standing first; another kind of map is an error.
static const void *map_identifier(struct args *a, enum value_kind kind)
{
    const struct value *v = args_take_value(a, kind);
    if (!v)
        return NULL;
    if (a->at)
        args_unknown(a, NULL, 0);
    return v->data;
}

static void *copy(struct arena *arena, const void *from, size_t size)
{
    return memcpy(arena_alloc(arena, size), from, size);
}

// ---- color_map -------------------------------------------------------------

struct colors {
    uint32_t count;
    float key[ENTRIES_MAX + 1];
    struct rgbft color[ENTRIES_MAX + 1];
};

static void add_color(struct args *a, struct colors *c, double key, struct rgbft color)
{
    if (c->count > 0 && c->key[c->count - 1] == (float)key &&
        memcmp(&c->color[c->count - 1], &color, sizeof color) == 0)
        return;
    if (c->count > ENTRIES_MAX) {
        args_error(a, args_span(a), "the map has more than 256 entries");
        return;
    }
    c->key[c->count] = (float)key;
    c->color[c->count++] = color;
}

// `[a, b color C1 color C2]`: after the first value a number of width 1 stands.
static bool double_entry(struct args *a)
{
    double v[5];
    int width = 1;
    const struct ast *n = a->at;
    if (!n || !ast_is_number(n) || n->kind == AST_VECTOR || n->kind == AST_VECTOR3)
        return false;
    if (n->kind == AST_NUMBER)
        return true;
    return eval_number(a->b->e, n, 1, v, &width) && width == 1;
}

static void color_entry(struct args *a, struct colors *c)
{
    struct args in;
    double low, high;
    struct rgbft color;
    if (!next_key(a, &in, &low, false))
        return;
    high = low;
    bool is_double = double_entry(&in);
    if (is_double && !args_float(&in, "second value of the entry", &high))
        return;
    if (!args_color(&in, false, &color))
        return;
    add_color(&in, c, low, color);
    if (is_double && args_color(&in, false, &color))
        add_color(&in, c, high, color);
    if (in.at)
        args_unknown(&in, NULL, 0);
}

const struct color_map *build_color_map(struct args *a, const struct ast *block)
{
    struct args in = args_of(a->b, block, a);
    const void *id = map_identifier(&in, VALUE_COLOR_MAP);
    struct colors c;
    if (id)
        return in.failed ? NULL : id;
    c.count = 0;
    while (in.at && c.count <= ENTRIES_MAX)
        if (at_entry(&in))
            color_entry(&in, &c);
    if (!count_ok(&in, c.count))
        return NULL;
    struct arena *arena = a->b->arena;
    struct color_map *m = arena_new_struct(arena, struct color_map);
    m->count = c.count;
    m->key = copy(arena, c.key, c.count * sizeof *c.key);
    m->color = copy(arena, c.color, c.count * sizeof *c.color);
    return m;
}

// ---- maps of pigments, normals, textures -----------------------------------

static const void *entry_body(struct args *a, enum body_kind kind)
{
    static const struct pigment bare;
    const struct texture_layer *layer = a->b->default_texture->layer;
    switch (kind) {
    case BODY_PIGMENT: return build_pigment_body(a, layer->pigment);
    case BODY_DENSITY: return build_pigment_body(a, &bare);
    case BODY_NORMAL: return build_normal_body(a, layer->normal);
    case BODY_TEXTURE: return build_texture_body(a);
    case BODY_FUNCTION: break;
    }
    return NULL;
}

static bool read_entries(struct args *in, enum body_kind kind, bool average,
                         struct entries *e)
{
    struct args entry;
    double key;
    e->count = 0;
    while (in->at && e->count <= ENTRIES_MAX) {
        if (!at_entry(in) || !next_key(in, &entry, &key, average))
            continue;
        e->key[e->count] = (float)key;
        e->item[e->count++] = entry_body(&entry, kind);
    }
    return count_ok(in, e->count);
}

// The entries of a map of any of the three kinds. False: *id is what there is instead, a
// declared map or NULL.
static bool read_map(struct args *a, const struct ast *block, enum value_kind declared,
                     enum body_kind kind, bool average, struct entries *e,
                     const void **id)
{
    struct args in = args_of(a->b, block, a);
    *id = map_identifier(&in, declared);
    bool ok = !*id && read_entries(&in, kind, average, e);
    if (in.failed)
        *id = NULL;
    return ok;
}

static const float *keys_of(struct args *a, const struct entries *e)
{
    return copy(a->b->arena, e->key, e->count * sizeof *e->key);
}

// Pointers to what a map's entries are, whichever kind it is of.
static const void *items_of(struct args *a, const struct entries *e)
{
    return copy(a->b->arena, e->item, e->count * sizeof *e->item);
}

const struct pigment_map *build_pigment_map(struct args *a, const struct ast *block,
                                            bool average, bool density)
{
    struct entries e;
    const void *id;
    if (!read_map(a, block, density ? VALUE_DENSITY_MAP : VALUE_PIGMENT_MAP,
                  density ? BODY_DENSITY : BODY_PIGMENT, average, &e, &id))
        return id;
    struct pigment_map *m = arena_new_struct(a->b->arena, struct pigment_map);
    *m = (struct pigment_map){e.count, keys_of(a, &e), items_of(a, &e)};
    return m;
}

const struct normal_map *build_normal_map(struct args *a, const struct ast *block,
                                          bool average)
{
    struct entries e;
    const void *id;
    if (!read_map(a, block, VALUE_NORMAL_MAP, BODY_NORMAL, average, &e, &id))
        return id;
    struct normal_map *m = arena_new_struct(a->b->arena, struct normal_map);
    *m = (struct normal_map){e.count, keys_of(a, &e), items_of(a, &e)};
    return m;
}

const struct texture_map *build_texture_map(struct args *a, const struct ast *block,
                                            bool average)
{
    struct entries e;
    const void *id;
    if (!read_map(a, block, VALUE_TEXTURE_MAP, BODY_TEXTURE, average, &e, &id))
        return id;
    struct texture_map *m = arena_new_struct(a->b->arena, struct texture_map);
    *m = (struct texture_map){e.count, keys_of(a, &e), items_of(a, &e)};
    return m;
}

const struct slope_map *build_slope_map(struct args *a, const struct ast *block)
{
    struct args in = args_of(a->b, block, a), entry;
    float key[ENTRIES_MAX + 1];
    struct vec2 slope[ENTRIES_MAX + 1];
    uint32_t count = 0;
    double k;
    const void *id = map_identifier(&in, VALUE_SLOPE_MAP);
    if (id)
        return in.failed ? NULL : id;
    while (in.at && count <= ENTRIES_MAX) {
        if (!at_entry(&in) || !next_key(&in, &entry, &k, false) ||
            !args_vec2(&entry, "height and slope", &slope[count]))
            continue;
        key[count++] = (float)k;
        if (entry.at)
            args_unknown(&entry, NULL, 0);
    }
    if (!count_ok(&in, count))
        return NULL;
    struct slope_map *m = arena_new_struct(a->b->arena, struct slope_map);
    m->count = count;
    m->key = copy(a->b->arena, key, count * sizeof *key);
    m->entry = copy(a->b->arena, slope, count * sizeof *slope);
    return m;
}
