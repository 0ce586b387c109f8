#include "eval/build.h"

#include <math.h>

// fog, rainbow, sky_sphere, background (spec/language 4.13).

#define AT(member) offsetof(struct fog, member)
static const struct field fog_fields[] = {
    {WORD_distance, FIELD_DOUBLE, AT(distance), 0, 0},
    {WORD_fog_alt, FIELD_DOUBLE, AT(alt), 0, 0},
    {WORD_fog_offset, FIELD_DOUBLE, AT(offset), 0, 0},
    {WORD_up, FIELD_UNIT, AT(up), 0, 0},
    {WORD_octaves, FIELD_NEAREST, AT(turbulence.octaves), 1, 10},
    {WORD_omega, FIELD_FLOAT, AT(turbulence.omega), 0, 0},
    {WORD_lambda, FIELD_FLOAT, AT(turbulence.lambda), 0, 0},
    {WORD_turb_depth, FIELD_DOUBLE, AT(turb_depth), 0, 0},
};
static const enum word fog_words[] = {WORD_fog_type, WORD_turbulence, WORD_color,
                                      WORD_rgb,      WORD_rotate,     WORD_scale,
                                      WORD_translate};

static bool fog_item(struct args *a, struct fog *f)
{
    struct transform t;
    long type;
    if (args_at_color(a)) {
        args_color(a, false, &f->color);
    } else if (args_at_number(a)) { // old style: a bare distance
        args_float(a, "distance", &f->distance);
    } else if (args_take(a, WORD_fog_type)) {
        if (args_int(a, "fog_type", &type) && (type == 1 || type == 2))
            f->type = type == 1 ? FOG_CONSTANT : FOG_GROUND;
        else
            args_error(a, args_span(a), "fog_type is 1 or 2");
    } else if (args_take(a, WORD_turbulence)) {
        f->has_turbulence = args_vec3(a, "turbulence", &f->turbulence.amount);
    } else if (build_trans(a, &t)) {
        f->up = vec3_normalize(transform_vector(&t, f->up));
    } else {
        return false;
    }
    return true;
}

const struct fog *build_fog(struct args *a, const struct ast *block)
{
    struct args in = args_of(a->b, block, a);
    const struct value *id = args_take_value(&in, VALUE_FOG);
    struct fog *f = arena_new_struct(a->b->arena, struct fog);
    *f = id ? *(const struct fog *)id->data
            : (struct fog){.type = FOG_CONSTANT,
                           .up = vec3(0, 1, 0),
                           .turbulence = {vec3(0, 0, 0), 6, 2, 0.5f},
                           .turb_depth = 0.5};
    while (in.at)
        if (!fields_read(&in, fog_fields, ARRAY_COUNT(fog_fields), f) &&
            !fog_item(&in, f))
            fields_unknown(&in, fog_fields, ARRAY_COUNT(fog_fields), fog_words,
                           ARRAY_COUNT(fog_words));
    return in.failed ? NULL : f;
}

#undef AT
#define AT(member) offsetof(struct rainbow, member)
static const struct field rainbow_fields[] = {
    {WORD_direction, FIELD_VEC3, AT(direction), 0, 0},
    {WORD_angle, FIELD_DOUBLE, AT(angle), 0, 0},
    {WORD_width, FIELD_DOUBLE, AT(width), 0, 0},
    {WORD_distance, FIELD_DOUBLE, AT(distance), 0, 0},
    {WORD_jitter, FIELD_DOUBLE, AT(jitter), 0, 0},
    {WORD_up, FIELD_UNIT, AT(up), 0, 0},
    {WORD_arc_angle, FIELD_DOUBLE, AT(arc_angle), 0, 360},
    {WORD_falloff_angle, FIELD_DOUBLE, AT(falloff_angle), 0, 360},
};

const struct rainbow *build_rainbow(struct args *a, const struct ast *block)
{
    static const double unset = -1, far = 1e7; // spec/lighting.md 0
    static const double parallel = 1 - 1e-10;  // cosine between unit vectors
    struct args in = args_of(a->b, block, a);
    const struct value *id = args_take_value(&in, VALUE_RAINBOW);
    struct rainbow *r = arena_new_struct(a->b->arena, struct rainbow);
    *r = id ? *(const struct rainbow *)id->data
            : (struct rainbow){.distance = far,
                               .up = vec3(0, 1, 0),
                               .arc_angle = 360,
                               .falloff_angle = unset};
    if (id)
        r->angle += r->width / 2;
    while (in.at) {
        if (args_at_block(&in) == WORD_color_map || args_at_block(&in) == WORD_colour_map)
            r->colors = build_color_map(&in, args_next(&in));
        else if (!fields_read(&in, rainbow_fields, ARRAY_COUNT(rainbow_fields), r))
            fields_unknown(&in, rainbow_fields, ARRAY_COUNT(rainbow_fields), NULL, 0);
    }
    if (in.failed)
        return NULL;
    if (r->falloff_angle == unset)
        r->falloff_angle = r->arc_angle;
    if (vec3_length(r->direction) == 0)
        args_error(&in, block->where, "a direction is needed");
    else if (r->arc_angle < r->falloff_angle)
        args_error(&in, block->where, "falloff_angle must not be larger than arc_angle");
    r->direction = vec3_normalize(r->direction);
    if (!in.failed && fabs(vec3_dot(r->direction, r->up)) > parallel)
        args_error(&in, block->where, "direction and up must not be parallel");
    r->angle -= r->width / 2;
    return in.failed ? NULL : r;
}

static void sky_move(struct builder *b, struct pointer_list *l, const struct transform *t)
{
    for (uint32_t i = 0; i < l->count; i++)
        l->at[i] = pigment_transform(b->arena, l->at[i], t);
}

const struct sky_sphere *build_sky_sphere(struct args *a, const struct ast *block)
{
    static const struct pigment bare;
    static const enum word known[] = {WORD_pigment, WORD_emission,  WORD_rotate,
                                      WORD_scale,   WORD_translate, WORD_transform};
    struct args in = args_of(a->b, block, a);
    const struct value *id = args_take_value(&in, VALUE_SKY_SPHERE);
    struct sky_sphere *s = arena_new_struct(a->b->arena, struct sky_sphere);
    struct pointer_list l = {0};
    struct transform t;
    s->emission = rgb(1, 1, 1);
    if (id) {
        *s = *(const struct sky_sphere *)id->data;
        for (uint32_t i = 0; i < s->count; i++)
            pointer_list_add(a->b->arena, &l, s->pigment[i]);
    }
    while (in.at) {
        if (args_at_block(&in) == WORD_pigment) {
            const struct pigment *p = build_pigment(&in, args_next(&in), &bare);
            if (p)
                pointer_list_add(a->b->arena, &l, p);
        } else if (args_take(&in, WORD_emission)) {
            args_rgb(&in, &s->emission);
        } else if (build_trans(&in, &t)) {
            sky_move(a->b, &l, &t);
        } else {
            args_unknown(&in, known, ARRAY_COUNT(known));
        }
    }
    if (!in.failed && l.count == 0)
        args_error(&in, block->where, "at least one pigment is needed");
    const struct pigment **p =
        arena_new_array(a->b->arena, const struct pigment *, l.count);
    for (uint32_t i = 0; i < l.count; i++)
        p[i] = l.at[i];
    s->pigment = p;
    s->count = l.count;
    return in.failed ? NULL : s;
}

bool build_background(struct args *a, const struct ast *block)
{
    struct args in = args_of(a->b, block, a);
    struct rgbft c = {0};
    if (in.at && !args_color(&in, false, &c))
        return false;
    if (in.at)
        args_unknown(&in, NULL, 0);
    a->b->e->scene->background = c;
    a->b->e->scene->has_background = true;
    return !in.failed;
}
