#include "eval/build.h"

#include <string.h>

// texture { } (spec/language 4.6, spec/textures 12.1).

// The layers of a plain texture, copied so that the top one can be changed.
static struct texture_layer *own_layers(struct args *a, struct texture *x)
{
    struct texture_layer *layer =
        arena_new_array(a->b->arena, struct texture_layer, x->layer_count);
    memcpy(layer, x->layer, x->layer_count * sizeof *layer);
    x->layer = layer;
    return layer;
}

// One of pigment, normal, finish, as a block or as a name standing first. Writes into
// the top layer and makes `x` plain.
static bool part(struct args *a, struct texture *x, struct texture_layer **own)
{
    enum word w = args_at_block(a);
    bool names = args_at_value(a, VALUE_PIGMENT) || args_at_value(a, VALUE_NORMAL) ||
                 args_at_value(a, VALUE_FINISH);
    if (w != WORD_pigment && w != WORD_normal && w != WORD_finish && !names)
        return false;
    if (!*own)
        *own = own_layers(a, x);
    struct texture_layer *top = &(*own)[x->layer_count - 1];
    const void *made;
    if (names) {
        const struct value *v = args_next(a)->value;
        if (v->kind == VALUE_PIGMENT)
            top->pigment = v->data;
        else if (v->kind == VALUE_NORMAL)
            top->normal = v->data;
        else
            top->finish = v->data;
    } else if (w == WORD_pigment) {
        if ((made = build_pigment(a, args_next(a), top->pigment)))
            top->pigment = made;
    } else if (w == WORD_normal) {
        if ((made = build_normal(a, args_next(a), top->normal)))
            top->normal = made;
    } else if ((made = build_finish(a, args_next(a), top->finish))) {
        top->finish = made;
    }
    return true;
}

static void keep_bump_size(struct args *a, struct texture *x, struct texture_layer **own)
{
    if (!*own)
        *own = own_layers(a, x);
    for (uint32_t i = 0; i < x->layer_count; i++) {
        if (!(*own)[i].normal)
            continue;
        struct normal *n = arena_new_struct(a->b->arena, struct normal);
        *n = *(*own)[i].normal;
        n->no_bump_scale = true;
        (*own)[i].normal = n;
    }
}

static void moved(struct args *a, struct texture *x, const struct transform *t)
{
    const struct texture *m = texture_transform(a->b->arena, x, t);
    *x = *m;
}

static void plain_items(struct args *a, struct texture *x)
{
    static const enum word known[] = {WORD_pigment,   WORD_normal,    WORD_finish,
                                      WORD_translate, WORD_rotate,    WORD_scale,
                                      WORD_matrix,    WORD_transform, WORD_no_bump_scale};
    struct texture_layer *own = NULL;
    struct transform t;
    bool keep = false;
    while (a->at) {
        if (part(a, x, &own))
            continue;
        if (build_trans(a, &t)) {
            moved(a, x, &t);
            own = NULL;
        } else if (args_take(a, WORD_no_bump_scale)) {
            keep = true;
        } else {
            args_unknown(a, known, ARRAY_COUNT(known));
        }
    }
    if (keep)
        keep_bump_size(a, x, &own);
}

static void move_only(struct args *a, struct texture *x)
{
    struct transform t;
    while (a->at) {
        if (build_trans(a, &t))
            moved(a, x, &t);
        else
            args_unknown(a, NULL, 0);
    }
}

static const struct texture *layers(struct args *a, const struct texture *below)
{
    while (args_at_block(a) == WORD_texture) {
        struct span where = args_span(a);
        const struct texture *top = build_texture(a, args_next(a));
        below = below && top ? build_layer(a, where, below, top) : top;
    }
    return below;
}

// tiles { texture A tile2 texture B }: a checker with A for value 1.
static void tiles(struct args *a, struct texture *x)
{
    static const enum word known[] = {WORD_texture, WORD_tile2};
    struct args in = args_of(a->b, args_next(a), a);
    struct arena *arena = a->b->arena;
    const struct texture **entry = arena_new_array(arena, const struct texture *, 2);
    float *key = arena_new_array(arena, float, 2);
    entry[1] = layers(&in, NULL);
    if (args_take(&in, WORD_tile2))
        entry[0] = layers(&in, NULL);
    if (in.at)
        args_unknown(&in, known, ARRAY_COUNT(known));
    if (!entry[0] || !entry[1]) {
        if (!in.failed)
            args_error(&in, args_span(&in),
                       "two textures with tile2 between are expected");
        return;
    }
    const struct pattern_ops *ops = a->b->pattern[WORD_checker];
    if (!ops)
        return;
    key[1] = 1;
    struct texture_map *m = arena_new_struct(arena, struct texture_map);
    *m = (struct texture_map){2, key, entry};
    struct pattern *checker = arena_new_struct(arena, struct pattern);
    pattern_set_kind(checker, ops);
    x->pattern = checker;
    x->kind = TEXTURE_MAP;
    x->map = m;
}

static void uv_mapping(struct args *a, struct texture *x)
{
    struct arena *arena = a->b->arena;
    struct texture_map *m = arena_new_struct(arena, struct texture_map);
    const struct texture **entry = arena_new_array(arena, const struct texture *, 1);
    args_next(a);
    entry[0] = build_texture_body(a);
    *m = (struct texture_map){1, arena_new_array(arena, float, 1), entry};
    x->kind = TEXTURE_UV;
    x->map = m;
}

static void patterned(struct args *a, struct texture *x)
{
    struct pattern *pattern = arena_new_struct(a->b->arena, struct pattern);
    struct body body = {.kind = BODY_TEXTURE, .pattern = pattern, .texture = x};
    size_t known;
    const enum word *words = pattern_modifier_words(&known);
    *x = (struct texture){.kind = TEXTURE_MAP, .pattern = pattern};
    build_pattern(a, &body);
    while (a->at)
        if (!build_pattern_modifier(a, &body))
            args_unknown(a, words, known);
    pattern_finish(a, pattern);
    if (!a->failed && !x->map)
        args_error(a, args_span(a), "a patterned texture needs a texture_map");
}

const struct texture *build_texture_body(struct args *a)
{
    const struct value *id = args_take_value(a, VALUE_TEXTURE);
    const struct texture *start = id ? id->data : a->b->default_texture;
    if (!a->at)
        return a->failed ? NULL : start;
    struct texture x = *start;
    enum word w = args_at_block(a) ? args_at_block(a) : args_at_word(a);
    if (x.kind != TEXTURE_PLAIN) {
        move_only(a, &x);
    } else if (!id && w == WORD_tiles) {
        x = (struct texture){.kind = TEXTURE_MAP, .pattern = &pattern_none};
        tiles(a, &x);
        move_only(a, &x);
    } else if (!id && w == WORD_material_map) {
        build_material_map(a, &x);
        move_only(a, &x);
    } else if (!id && w == WORD_uv_mapping) {
        x = (struct texture){.kind = TEXTURE_UV, .pattern = &pattern_none};
        uv_mapping(a, &x);
    } else if (!id && word_is_pattern(a->b, w)) {
        patterned(a, &x);
    } else {
        plain_items(a, &x);
    }
    if (a->failed)
        return NULL;
    struct texture *out = arena_new_struct(a->b->arena, struct texture);
    *out = x;
    return out;
}

const struct texture *build_texture(struct args *a, const struct ast *block)
{
    struct args in = args_of(a->b, block, a);
    return build_texture_body(&in);
}

const struct texture *build_layer(struct args *a, struct span where,
                                  const struct texture *bottom, const struct texture *top)
{
    if (bottom->kind != TEXTURE_PLAIN || top->kind != TEXTURE_PLAIN) {
        args_error(a, where, "a patterned texture cannot be one of several layers");
        return bottom;
    }
    struct texture *x = arena_new_struct(a->b->arena, struct texture);
    uint32_t n = bottom->layer_count, m = top->layer_count;
    struct texture_layer *layer =
        arena_new_array(a->b->arena, struct texture_layer, n + m);
    memcpy(layer, bottom->layer, n * sizeof *layer);
    memcpy(layer + n, top->layer, m * sizeof *layer);
    layer[n].covers = true;
    *x = *bottom;
    x->layer = layer;
    x->layer_count = n + m;
    return x;
}
