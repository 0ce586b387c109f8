#include "eval/build.h"

// pigment { } and density { } (spec/language 4.6, spec/textures 10.1).

static void uv_mapping(struct args *a, struct pigment *p, const struct pigment *start)
{
    struct arena *arena = a->b->arena;
    struct pigment_map *m = arena_new_struct(arena, struct pigment_map);
    const struct pigment **entry = arena_new_array(arena, const struct pigment *, 1);
    args_next(a);
    entry[0] = build_pigment_body(a, start);
    *m = (struct pigment_map){1, arena_new_array(arena, float, 1), entry};
    p->kind = PIGMENT_UV;
    p->map = m;
}

static void modifiers(struct args *a, struct body *body)
{
    struct pigment *p = body->pigment;
    size_t known;
    const enum word *words = pattern_modifier_words(&known);
    while (a->at) {
        if (args_take(a, WORD_quick_color) || args_take(a, WORD_quick_colour))
            p->has_quick_color = args_color(a, false, &p->quick_color);
        else if (!build_pattern_modifier(a, body))
            args_unknown(a, words, known);
    }
}

// A map without a pattern to give it a place: POV-Ray warns and takes black.
static void without_pattern(struct args *a, struct pigment *p)
{
    const struct span where = a->owner ? a->owner->where : args_span(a);
    args_warning(a, where, "no pattern stands before the map, the pigment is black");
    p->kind = PIGMENT_SOLID;
    p->color = (struct rgbft){0};
}

const struct pigment *build_pigment_body(struct args *a, const struct pigment *start)
{
    bool density = args_at_value(a, VALUE_DENSITY) != NULL;
    const struct value *id = args_take_value(a, density ? VALUE_DENSITY : VALUE_PIGMENT);
    const struct pigment *from = id ? id->data : start;
    if (!a->at)
        return a->failed ? NULL : from;
    struct pigment p = *from;
    const struct pattern *before = p.pattern ? p.pattern : &pattern_none;
    struct pattern pattern = *before;
    struct body body = {.kind = BODY_PIGMENT, .pattern = &pattern, .pigment = &p};
    const char *name = a->name;
    if (name && (a->owner && (a->owner->word == WORD_density)))
        body.kind = BODY_DENSITY;
    if (args_at_word(a) == WORD_uv_mapping) {
        uv_mapping(a, &p, start);
    } else if (args_at_color(a)) {
        p.kind = PIGMENT_SOLID;
        body.plain = args_color(a, false, &p.color);
    } else {
        build_pattern(a, &body);
    }
    modifiers(a, &body);
    pattern_finish(a, &pattern);
    if (p.kind == PIGMENT_AVERAGE && !p.map)
        args_error(a, args_span(a), "average needs a map");
    if ((p.kind == PIGMENT_COLORS || p.kind == PIGMENT_MAP) && !pattern.ops)
        without_pattern(a, &p);
    if (p.kind == PIGMENT_COLORS && !p.colors)
        p.colors = color_map_default(&pattern);
    if (a->failed)
        return NULL;
    p.pattern = pattern_keep(a->b->arena, &pattern, before);
    struct pigment *out = arena_new_struct(a->b->arena, struct pigment);
    *out = p;
    return out;
}

const struct pigment *build_pigment(struct args *a, const struct ast *block,
                                    const struct pigment *start)
{
    struct args in = args_of(a->b, block, a);
    return build_pigment_body(&in, start);
}

const struct pigment *build_density(struct args *a, const struct ast *block,
                                    const struct pigment *start)
{
    return build_pigment(a, block, start);
}
