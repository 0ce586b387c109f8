#include "eval/build.h"

#include <string.h>

// normal { } (spec/language 4.10, spec/textures 11).

static const struct field normal_fields[] = {
    {WORD_accuracy, FIELD_FLOAT, offsetof(struct normal, delta), 0, 0},
    {WORD_no_bump_scale, FIELD_FLAG, offsetof(struct normal, no_bump_scale), 0, 0},
};

static void amount(struct args *a, struct normal *n)
{
    double v;
    if (args_at_number(a) && args_float(a, "amount", &v))
        n->amount = n->bump_size = (float)v;
}

static void uv_mapping(struct args *a, struct normal *n, const struct normal *start)
{
    struct arena *arena = a->b->arena;
    struct normal_map *m = arena_new_struct(arena, struct normal_map);
    const struct normal **entry = arena_new_array(arena, const struct normal *, 1);
    args_next(a);
    entry[0] = build_normal_body(a, start);
    *m = (struct normal_map){1, arena_new_array(arena, float, 1), entry};
    n->kind = NORMAL_UV;
    n->map = m;
}

const struct normal *build_normal_body(struct args *a, const struct normal *start)
{
    static const struct normal bare = {.amount = 0.5f, .delta = 0.02f, .bump_size = 0.5f};
    const struct value *id = args_take_value(a, VALUE_NORMAL);
    const struct normal *from = id ? id->data : start ? start : &bare;
    struct normal n = *from;
    struct body body = {.kind = BODY_NORMAL, .pattern = &n.pattern, .normal = &n};
    size_t known;
    const enum word *words = pattern_modifier_words(&known);
    if (args_at_word(a) == WORD_uv_mapping)
        uv_mapping(a, &n, start);
    else
        build_pattern(a, &body);
    amount(a, &n);
    while (a->at) {
        if (args_take(a, WORD_bump_size))
            amount(a, &n);
        else if (!fields_read(a, normal_fields, ARRAY_COUNT(normal_fields), &n) &&
                 !build_pattern_modifier(a, &body))
            args_unknown(a, words, known);
    }
    pattern_finish(a, &n.pattern);
    if (!a->failed && n.kind == NORMAL_AVERAGE && !n.map)
        args_error(a, args_span(a), "average needs a map");
    if (a->failed)
        return NULL;
    struct normal *out = arena_new_struct(a->b->arena, struct normal);
    *out = n;
    return out;
}

// A default and a declared normal may leave the pattern to those who use them.
static bool is_used(const struct args *a)
{
    return strcmp(a->name, "default") != 0 && strcmp(a->name, "right side") != 0;
}

static bool lacks_pattern(const struct normal *n)
{
    return !n->pattern.ops && (n->kind == NORMAL_PATTERN || n->kind == NORMAL_MAP ||
                               n->kind == NORMAL_SLOPES);
}

const struct normal *build_normal(struct args *a, const struct ast *block,
                                  const struct normal *start)
{
    struct args in = args_of(a->b, block, a);
    const struct normal *n = build_normal_body(&in, start);
    if (n && is_used(a) && lacks_pattern(n)) {
        args_error(&in, block->where, "no pattern is given");
        return NULL;
    }
    return n;
}
