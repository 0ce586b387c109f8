#include "eval/build.h"

// light_source { } (spec/language 4.13, spec/lighting 8.1).

#define AT(member) offsetof(struct light, member)
static const struct field light_fields[] = {
    {WORD_shadowless, FIELD_FLAG, AT(shadowless), 0, 0},
    {WORD_parallel, FIELD_FLAG, AT(parallel), 0, 0},
    {WORD_fade_distance, FIELD_DOUBLE, AT(fade_distance), 0, 0},
    {WORD_fade_power, FIELD_DOUBLE, AT(fade_power), 0, 0},
    {WORD_media_interaction, FIELD_SWITCH, AT(media_interaction), 0, 0},
    {WORD_media_attenuation, FIELD_SWITCH, AT(media_attenuation), 0, 0},
    {WORD_adaptive, FIELD_INT, AT(adaptive), 0, 0},
    {WORD_jitter, FIELD_FLAG, AT(jitter), 0, 0},
    {WORD_circular, FIELD_FLAG, AT(circular), 0, 0},
    {WORD_orient, FIELD_FLAG, AT(orient), 0, 0},
    {WORD_area_illumination, FIELD_SWITCH, AT(area_illumination), 0, 0},
};
// Only for spotlights and cylinders.
static const struct field cone_fields[] = {
    {WORD_radius, FIELD_DOUBLE, AT(radius), 0, 0},
    {WORD_falloff, FIELD_DOUBLE, AT(falloff), 0, 0},
    {WORD_tightness, FIELD_DOUBLE, AT(tightness), 0, 0},
};
static const enum word other_words[] = {
    WORD_spotlight,  WORD_cylinder,   WORD_point_at,
    WORD_area_light, WORD_looks_like, WORD_projected_through,
    WORD_color_map,  WORD_photons,    WORD_radius,
    WORD_falloff,    WORD_tightness,  WORD_translate,
    WORD_rotate,     WORD_scale,      WORD_transform};

static void area_light(struct args *a, struct light *l)
{
    struct span where = args_span(a);
    long n = 1, m = 1;
    l->area = true;
    if (!args_vec3(a, "first axis", &l->axis1) ||
        !args_vec3(a, "second axis", &l->axis2) || !args_int(a, "first size", &n) ||
        !args_int(a, "second size", &m)) {
        args_skip(a);
        return;
    }
    if (n < 1 || m < 1 || n > 65535 || m > 65535)
        args_error(a, where, "the sizes of an area light must be at least 1");
    l->size1 = (int)n;
    l->size2 = (int)m;
}

static void spectrum(struct args *a, struct light *l)
{
    const struct color_map *m = build_color_map(a, args_next(a));
    l->color = rgb(0, 0, 0);
    for (uint32_t i = 0; m && i < m->count; i++)
        l->color = rgb_add(l->color, rgb_scale(m->key[i], rgbft_rgb(m->color[i])));
}

static void move(struct builder *b, struct light *l, const struct transform *t)
{
    l->location = transform_point(t, l->location);
    l->point_at = transform_point(t, l->point_at);
    l->axis1 = transform_vector(t, l->axis1);
    l->axis2 = transform_vector(t, l->axis2);
    const struct object **shown[] = {&l->looks_like, &l->projected_through};
    for (int i = 0; i < 2; i++) {
        if (!*shown[i])
            continue;
        struct object *o = object_copy(b->arena, *shown[i]);
        object_move(b, o, t);
        *shown[i] = o;
    }
}

static bool direction_item(struct args *a, struct light *l)
{
    enum word w = args_at_word(a);
    bool cone = l->kind != LIGHT_POINT;
    if (w != WORD_point_at && w != WORD_radius && w != WORD_falloff &&
        w != WORD_tightness)
        return false;
    if (!(cone || (w == WORD_point_at && l->parallel))) {
        args_error(a, args_span(a),
                   w == WORD_point_at
                       ? "point_at needs spotlight, cylinder or parallel before it"
                       : "this needs spotlight or cylinder before it");
        args_next(a);
        args_skip(a);
        return true;
    }
    if (w != WORD_point_at)
        return fields_read(a, cone_fields, ARRAY_COUNT(cone_fields), l);
    args_next(a);
    if (!args_vec3(a, "point_at", &l->point_at))
        args_skip(a);
    return true;
}

static void light_photons(struct args *a, struct light *l)
{
    static const enum word words[] = {WORD_refraction, WORD_reflection, WORD_area_light};
    struct args in = args_of(a->b, args_next(a), a);
    while (in.at) {
        if (args_take(&in, WORD_refraction))
            l->photon_refraction = args_switch(&in) ? 1 : -1;
        else if (args_take(&in, WORD_reflection))
            l->photon_reflection = args_switch(&in) ? 1 : -1;
        else if (args_take(&in, WORD_area_light))
            l->photon_area = true;
        else
            args_unknown(&in, words, ARRAY_COUNT(words));
    }
}

static void looks_like(struct args *a, struct light *l)
{
    struct transform t = transform_translate(l->location);
    if (l->looks_like)
        args_error(a, args_span(a), "only one looks_like is allowed");
    l->looks_like = build_one_object(a, args_next(a), &t);
}

static bool block_item(struct args *a, struct light *l)
{
    switch (args_at_block(a)) {
    case WORD_looks_like: looks_like(a, l); return true;
    case WORD_projected_through:
        l->projected_through = build_one_object(a, args_next(a), NULL);
        return true;
    case WORD_color_map:
    case WORD_colour_map: spectrum(a, l); return true;
    case WORD_photons: light_photons(a, l); return true;
    default: return false;
    }
}

static bool kind_item(struct args *a, struct light *l)
{
    if (args_take(a, WORD_spotlight)) {
        l->kind = LIGHT_SPOT;
        l->radius = 30;
        l->falloff = 45;
        l->tightness = 0;
    } else if (args_take(a, WORD_cylinder)) {
        l->kind = LIGHT_CYLINDER;
        l->radius = 0.75;
        l->falloff = 1;
        l->tightness = 0;
        l->parallel = true;
    } else if (args_take(a, WORD_area_light)) {
        area_light(a, l);
    } else {
        return false;
    }
    return true;
}

static void checks(struct args *a, struct light *l)
{
    if (!l->area && (l->circular || l->orient || l->area_illumination))
        args_warning(a, a->owner->where,
                     "circular, orient and area_illumination need area_light");
    if (l->area && l->orient && !l->circular)
        args_warning(a, a->owner->where, "orient works with circular only");
}

struct object *build_light(struct args *a, const struct ast *block)
{
    struct light *l = arena_new_struct(a->b->arena, struct light);
    struct transform t;
    *l = light_default;
    if (!args_vec3(a, "location", &l->location) || !args_rgb(a, &l->color))
        args_skip(a);
    while (a->at) {
        if (build_trans(a, &t))
            move(a->b, l, &t);
        else if (!fields_read(a, light_fields, ARRAY_COUNT(light_fields), l) &&
                 !kind_item(a, l) && !direction_item(a, l) && !block_item(a, l))
            fields_unknown(a, light_fields, ARRAY_COUNT(light_fields), other_words,
                           ARRAY_COUNT(other_words));
    }
    l->axis = vec3_normalize(vec3_sub(l->point_at, l->location));
    checks(a, l);
    struct object *o = object_new_csg(a->b->arena, CSG_UNION, NULL, 0, block->where);
    o->kind = OBJECT_LIGHT;
    o->light = l;
    object_hold(o, l->looks_like);
    object_hold(o, l->projected_through);
    return o;
}
