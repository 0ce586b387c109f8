#include "eval/build.h"

#include <string.h>

#include "scene/pigment_tape.h"

// Pattern keywords with their arguments and the modifiers of spec/language 4.7.

static long read_int(struct args *a, const char *role, long low, long high)
{
    long v = low;
    struct span where = args_span(a);
    if (!args_int(a, role, &v))
        return low;
    if (v < low || v > high) {
        diag_at(args_diags(a), DIAG_OUT_OF_RANGE, where, role, (double)v, (double)low,
                (double)high);
        args_fail(a);
        return low;
    }
    return v;
}

static void julia(struct args *a, struct pattern *p)
{
    struct vec2 c;
    if (args_vec2(a, "c", &c))
        p->vector = vec3(c.u, c.v, 0);
    p->integer[0] = (int)read_int(a, "iterations", 1, 1 << 30);
}

static void slope_band(struct args *a, double *low, double *high)
{
    *low = *high = 0;
    args_optional(a, low);
    args_optional(a, high);
}

static void slope(struct args *a, struct pattern *p)
{
    static const enum word known[] = {WORD_point_at, WORD_altitude};
    if (args_at_block(a) != WORD_slope) {
        args_next(a);
        args_vec3(a, "direction", &p->vector);
        p->vector = vec3_normalize(p->vector);
        p->vector2 = vec3(0, 0, 0);
        return;
    }
    struct args in = args_of(a->b, args_next(a), a);
    p->point_at = args_take(&in, WORD_point_at);
    args_vec3(&in, "direction", &p->vector);
    slope_band(&in, &p->low, &p->high);
    if (args_take(&in, WORD_altitude)) {
        if (p->point_at)
            args_error(&in, args_span(&in), "altitude cannot be used with point_at");
        args_vec3(&in, "altitude", &p->vector2);
        slope_band(&in, &p->low2, &p->high2);
    }
    if (in.at)
        args_unknown(&in, known, ARRAY_COUNT(known));
}

// Items standing directly after a list pattern: colours, or blocks of the body's kind.
static const void *list_block(struct args *a, struct body *body)
{
    static const struct pigment bare;
    const struct texture_layer *d = a->b->default_texture->layer;
    switch (body->kind) {
    case BODY_PIGMENT:
        return args_at_block(a) == WORD_pigment
                   ? build_pigment(a, args_next(a), d->pigment)
                   : NULL;
    case BODY_DENSITY:
        return args_at_block(a) == WORD_density ? build_pigment(a, args_next(a), &bare)
                                                : NULL;
    case BODY_NORMAL:
        return args_at_block(a) == WORD_normal ? build_normal(a, args_next(a), d->normal)
                                               : NULL;
    case BODY_FUNCTION: break;
    case BODY_TEXTURE:
        return args_at_block(a) == WORD_texture ? build_texture(a, args_next(a)) : NULL;
    }
    return NULL;
}

enum { LIST_MAX = 8 };

static float *list_keys(struct arena *arena, uint32_t n)
{
    float *key = arena_new_array(arena, float, n);
    for (uint32_t i = 0; i < n; i++)
        key[i] = (float)i;
    return key;
}

static void list_blocks(struct args *a, struct body *body, uint32_t n)
{
    struct arena *arena = a->b->arena;
    const void *item[LIST_MAX];
    const struct texture_layer *d = a->b->default_texture->layer;
    uint32_t count = 0;
    while (count < n && (item[count] = list_block(a, body)))
        count++;
    if (count == 0 && body->kind == BODY_NORMAL)
        return; // a plain pattern
    for (; count < n; count++)
        item[count] = body->kind == BODY_TEXTURE  ? (const void *)a->b->default_texture
                      : body->kind == BODY_NORMAL ? (const void *)d->normal
                                                  : (const void *)d->pigment;
    if (body->kind == BODY_TEXTURE) {
        struct texture_map *m = arena_new_struct(arena, struct texture_map);
        const struct texture **entry = arena_new_array(arena, const struct texture *, n);
        for (uint32_t i = 0; i < n; i++)
            entry[i] = item[i];
        *m = (struct texture_map){n, list_keys(arena, n), entry};
        body->texture->map = m;
    } else if (body->kind == BODY_NORMAL) {
        static const struct normal flat;
        struct normal_map *m = arena_new_struct(arena, struct normal_map);
        const struct normal **entry = arena_new_array(arena, const struct normal *, n);
        for (uint32_t i = 0; i < n; i++)
            entry[i] = item[i] ? item[i] : &flat;
        *m = (struct normal_map){n, list_keys(arena, n), entry};
        body->normal->map = m;
        body->normal->kind = NORMAL_MAP;
    } else {
        struct pigment_map *m = arena_new_struct(arena, struct pigment_map);
        const struct pigment **entry = arena_new_array(arena, const struct pigment *, n);
        for (uint32_t i = 0; i < n; i++)
            entry[i] = item[i];
        *m = (struct pigment_map){n, list_keys(arena, n), entry};
        body->pigment->map = m;
        body->pigment->kind = PIGMENT_MAP;
    }
    body->has_map = true;
}

static void list_colors(struct args *a, struct body *body, uint32_t n)
{
    struct arena *arena = a->b->arena;
    const struct color_map *d = color_map_default(body->pattern);
    struct rgbft *color = arena_new_array(arena, struct rgbft, n);
    uint32_t count = 0;
    while (count < n && (args_at_color(a) || args_at_number(a)))
        if (!args_color(a, false, &color[count++]))
            return;
    for (; count < n; count++)
        color[count] = d->color[count];
    struct color_map *m = arena_new_struct(arena, struct color_map);
    *m = (struct color_map){n, list_keys(arena, n), color};
    body->pigment->colors = m;
    body->pigment->kind = PIGMENT_COLORS;
    body->has_map = true;
}

static void list(struct args *a, struct body *body, int n)
{
    bool blocks = body->kind == BODY_NORMAL || body->kind == BODY_TEXTURE ||
                  args_at_block(a) == WORD_pigment || args_at_block(a) == WORD_density;
    body->list = true;
    if (body->kind == BODY_FUNCTION)
        return; // the number of the entry is what counts
    if (blocks)
        list_blocks(a, body, (uint32_t)n);
    else
        list_colors(a, body, (uint32_t)n);
}

static void object_pattern(struct args *a, struct body *body, int n)
{
    struct args in = args_of(a->b, args_next(a), a);
    struct transform t;
    bool was;
    const struct object *o = args_object(&in, &was);
    if (!was) {
        args_error(&in, args_span(&in), "an object is expected first");
        return;
    }
    while (build_trans(&in, &t)) {
        if (!o)
            continue;
        struct object *moved = object_copy(a->b->arena, o);
        object_move(a->b, moved, &t);
        o = moved;
    }
    body->pattern->object = o;
    list(&in, body, n);
    if (in.at)
        args_unknown(&in, NULL, 0);
}

static void pigment_pattern(struct args *a, struct pattern *p)
{
    static const struct pigment bare;
    p->pigment = build_pigment(a, args_next(a), &bare);
    struct pigment_compiler c = {.arena = a->b->arena};
    p->tape = p->pigment ? pigment_compile(&c, p->pigment) : NULL;
}

static void set_kind(struct args *a, struct body *body, const struct pattern_ops *ops)
{
    pattern_set_kind(body->pattern, ops);
    body->pattern->defaults = a->b->pattern_defaults;
    if (body->pigment &&
        (body->pigment->kind == PIGMENT_NONE || body->pigment->kind == PIGMENT_SOLID ||
         body->pigment->kind == PIGMENT_IMAGE || body->pigment->kind == PIGMENT_UV))
        body->pigment->kind = PIGMENT_COLORS;
    if (body->pigment && color_map_is_default(body->pigment->colors))
        body->pigment->colors = NULL;
    if (body->normal &&
        (body->normal->kind == NORMAL_UV || body->normal->kind == NORMAL_AVERAGE ||
         body->normal->kind == NORMAL_BUMP_MAP))
        body->normal->kind = NORMAL_PATTERN;
    if (body->texture)
        body->texture->kind = TEXTURE_MAP;
}

static void arguments(struct args *a, struct body *body, enum word w)
{
    struct pattern *p = body->pattern;
    switch (w) {
    case WORD_gradient:
        if (args_vec3(a, "direction", &p->vector))
            p->vector = vec3_normalize(p->vector);
        break;
    case WORD_spiral1:
    case WORD_spiral2:
        p->integer[0] = (int)read_int(a, "number of arms", -32768, 32767);
        break;
    case WORD_mandel: p->integer[0] = (int)read_int(a, "iterations", 1, 1 << 30); break;
    case WORD_julia: julia(a, p); break;
    case WORD_density_file: build_density_file(a, p); break;
    case WORD_magnet:
        p->integer[1] = (int)read_int(a, "type", 1, 2);
        if ((p->integer[2] = args_take(a, WORD_julia)))
            julia(a, p);
        else if (args_take(a, WORD_mandel))
            p->integer[0] = (int)read_int(a, "iterations", 1, 1 << 30);
        else
            args_error(a, args_span(a), "magnet: mandel or julia is expected");
        break;
    case WORD_tiling: p->integer[0] = (int)read_int(a, "type", 1, 27); break;
    default: break;
    }
}

static bool function_pattern(struct args *a, struct body *body)
{
    const struct ast *n = a->at;
    if (!build_function_pattern(a->b->e, n, body->pattern))
        args_fail(a);
    args_next(a);
    return true;
}

bool word_is_pattern(const struct builder *b, enum word w)
{
    static const enum word others[] = {
        WORD_image_map, WORD_bump_map, WORD_image_pattern, WORD_density_file,
        WORD_crackle,   WORD_facets,   WORD_mandel,        WORD_julia,
        WORD_magnet,    WORD_pavement, WORD_tiling,        WORD_average,
        WORD_uv_mapping};
    if (w == WORD_NONE)
        return false;
    if (b->pattern[w])
        return true;
    for (size_t i = 0; i < ARRAY_COUNT(others); i++)
        if (others[i] == w)
            return true;
    return false;
}

bool build_pattern(struct args *a, struct body *body)
{
    enum word block = args_at_block(a), w = block ? block : args_at_word(a);
    if (!word_is_pattern(a->b, w))
        return false;
    const bool bitmap =
        w == WORD_image_map || w == WORD_bump_map || w == WORD_image_pattern;
    const struct pattern_ops *ops = a->b->pattern[bitmap ? WORD_image_pattern : w];
    if (w == WORD_average) {
        args_next(a);
        body->average = true;
        body->pattern->ops = NULL;
        if (body->pigment)
            body->pigment->kind = PIGMENT_AVERAGE;
        else if (body->normal)
            body->normal->kind = NORMAL_AVERAGE;
        else if (body->texture)
            body->texture->kind = TEXTURE_AVERAGE;
        return true;
    }
    if (!ops) {
        args_not_built(a);
        a->at = NULL; // what follows belongs to it
        return true;
    }
    set_kind(a, body, ops);
    if (w == WORD_object) {
        object_pattern(a, body, ops->list);
    } else if (bitmap && block) {
        build_image_pattern(a, body, w);
    } else if (w == WORD_pigment_pattern) {
        pigment_pattern(a, body->pattern);
    } else if (w == WORD_function) {
        function_pattern(a, body);
    } else if (w == WORD_slope) {
        slope(a, body->pattern);
    } else {
        args_next(a);
        if (w == WORD_agate && !body->pattern->turbulence) {
            struct turbulence *t = arena_new_struct(a->b->arena, struct turbulence);
            *t = (struct turbulence){vec3(0, 0, 0), 6, 2, 0.5f};
            body->pattern->turbulence = t;
        }
        arguments(a, body, w);
        if (ops->list)
            list(a, body, ops->list);
    }
    return true;
}

// ---- modifiers -------------------------------------------------------------

static void classic(struct args *a, struct pattern *p, enum word w)
{
    static const struct field fields[] = {
        {WORD_octaves, FIELD_NEAREST, offsetof(struct turbulence, octaves), 1, 10},
        {WORD_omega, FIELD_FLOAT, offsetof(struct turbulence, omega), 0, 0},
        {WORD_lambda, FIELD_FLOAT, offsetof(struct turbulence, lambda), 0, 0}};
    struct turbulence *t = arena_new_struct(a->b->arena, struct turbulence);
    *t = p->turbulence ? *p->turbulence : (struct turbulence){vec3(0, 0, 0), 6, 2, 0.5f};
    if (w != WORD_turbulence)
        fields_read(a, fields, ARRAY_COUNT(fields), t);
    else if (args_take(a, w))
        args_vec3(a, "turbulence", &t->amount);
    p->turbulence = t;
}

static void wave(struct args *a, struct pattern *p, enum wave kind)
{
    double e = 1;
    args_next(a);
    p->wave = kind;
    if (kind == WAVE_POLY && args_optional(a, &e))
        p->exponent = (float)e;
}

#define AT(member) offsetof(struct pattern, member)
static const struct field common_fields[] = {
    {WORD_frequency, FIELD_FLOAT, AT(frequency), 0, 0},
    {WORD_phase, FIELD_FLOAT, AT(phase), 0, 0},
    {WORD_noise_generator, FIELD_INT, AT(noise_generator), 0, 3},
};
// Parameters of single patterns; `pattern` is who takes them.
static const struct {
    const char *pattern;
    struct field field;
} own_fields[] = {
    {"agate", {WORD_agate_turb, FIELD_FLOAT, AT(value[0]), 0, 0}},
    {"brick", {WORD_brick_size, FIELD_VEC3, AT(vector), 0, 0}},
    {"brick", {WORD_mortar, FIELD_FLOAT, AT(value[0]), 0, 0}},
    {"quilted", {WORD_control0, FIELD_FLOAT, AT(value[0]), 0, 0}},
    {"quilted", {WORD_control1, FIELD_FLOAT, AT(value[1]), 0, 0}},
    {"crackle", {WORD_solid, FIELD_FLAG, AT(solid), 0, 0}},
    {"crackle", {WORD_form, FIELD_VEC3, AT(vector), 0, 0}},
    {"crackle", {WORD_offset, FIELD_FLOAT, AT(offset), 0, 0}},
    {"crackle", {WORD_metric, FIELD_FLOAT, AT(metric), 0, 0}},
    {"facets", {WORD_size, FIELD_FLOAT, AT(value[0]), 0, 0}},
    {"facets", {WORD_coords, FIELD_FLOAT, AT(value[1]), 0, 0}},
    {"facets", {WORD_metric, FIELD_FLOAT, AT(metric), 0, 0}},
    {"pavement", {WORD_number_of_sides, FIELD_INT, AT(integer[0]), 3, 6}},
    {"pavement", {WORD_number_of_tiles, FIELD_INT, AT(integer[1]), 1, 6}},
    {"pavement", {WORD_pattern, FIELD_INT, AT(integer[2]), 1, 35}},
    {"pavement", {WORD_form, FIELD_INT, AT(integer[3]), 0, 0}},
    {"pavement", {WORD_exterior, FIELD_INT, AT(exterior_type), 0, 0}},
    {"pavement", {WORD_interior, FIELD_INT, AT(interior_type), 0, 0}},
    {"density_file", {WORD_interpolate, FIELD_INT, AT(integer[0]), 0, 0}},
    {"mandel", {WORD_exponent, FIELD_INT, AT(fractal_exponent), 2, 33}},
    {"julia", {WORD_exponent, FIELD_INT, AT(fractal_exponent), 2, 33}},
};

static bool is_fractal(const struct pattern *p)
{
    const char *k = p->ops ? p->ops->keyword : "";
    return strcmp(k, "mandel") == 0 || strcmp(k, "julia") == 0 ||
           strcmp(k, "magnet") == 0;
}

static bool own_parameter(struct args *a, struct pattern *p)
{
    enum word w = args_at_word(a);
    double factor;
    if (is_fractal(p) && (w == WORD_exterior || w == WORD_interior)) {
        bool out = w == WORD_exterior;
        args_next(a);
        *(out ? &p->exterior_type : &p->interior_type) =
            (int)read_int(a, word_text(w), 0, out ? 8 : 6);
        if (args_float(a, "factor", &factor))
            *(out ? &p->exterior_factor : &p->interior_factor) = factor;
        return true;
    }
    bool exists = false;
    for (size_t i = 0; w && i < ARRAY_COUNT(own_fields); i++) {
        if (own_fields[i].field.word != w)
            continue;
        exists = true;
        if (p->ops && strcmp(own_fields[i].pattern, p->ops->keyword) == 0)
            return fields_read(a, &own_fields[i].field, 1, p);
    }
    if (exists && w != WORD_interior) {
        diag_at(args_diags(a), DIAG_WRONG_PATTERN, a->at->where, word_text(w));
        args_fail(a);
        args_next(a);
        args_skip(a);
        return true;
    }
    return false;
}

static bool map_allowed(struct args *a, struct body *body, enum body_kind kind,
                        bool with_average)
{
    const char *why =
        body->kind != kind ? "this map has no place here"
        : body->list       ? "a pattern with a list of its own entries takes no map"
        : body->bitmap && kind != BODY_NORMAL ? "an image takes no map"
        : body->plain                         ? "a plain colour takes no map"
        : body->average && !with_average      ? "this map cannot be used with average"
                                              : NULL;
    if (!why)
        return true;
    args_error(a, a->at->where, why);
    args_next(a);
    return false;
}

static bool map(struct args *a, struct body *body)
{
    enum body_kind kind = body->kind;
    switch (args_at_block(a)) {
    case WORD_color_map:
    case WORD_colour_map: {
        bool density = kind == BODY_DENSITY;
        if (!map_allowed(a, body, density ? BODY_DENSITY : BODY_PIGMENT, false))
            return true;
        const struct color_map *m = build_color_map(a, args_next(a));
        body->pigment->colors = m;
        body->pigment->kind = PIGMENT_COLORS;
        break;
    }
    case WORD_pigment_map:
    case WORD_density_map: {
        bool density = args_at_block(a) == WORD_density_map;
        if (!map_allowed(a, body, density ? BODY_DENSITY : BODY_PIGMENT, true))
            return true;
        body->pigment->map = build_pigment_map(a, args_next(a), body->average, density);
        body->pigment->kind = body->average ? PIGMENT_AVERAGE : PIGMENT_MAP;
        break;
    }
    case WORD_normal_map:
        if (!map_allowed(a, body, BODY_NORMAL, true))
            return true;
        body->normal->map = build_normal_map(a, args_next(a), body->average);
        body->normal->kind = body->average ? NORMAL_AVERAGE : NORMAL_MAP;
        break;
    case WORD_slope_map:
        if (!map_allowed(a, body, BODY_NORMAL, false))
            return true;
        body->normal->slopes = build_slope_map(a, args_next(a));
        body->normal->kind = NORMAL_SLOPES;
        break;
    case WORD_texture_map:
        if (!map_allowed(a, body, BODY_TEXTURE, true))
            return true;
        body->texture->map = build_texture_map(a, args_next(a), body->average);
        break;
    default: return false;
    }
    body->has_map = true;
    return true;
}

const enum word *pattern_modifier_words(size_t *count)
{
    static const enum word words[] = {
        WORD_translate,       WORD_rotate,     WORD_scale,         WORD_matrix,
        WORD_transform,       WORD_turbulence, WORD_octaves,       WORD_omega,
        WORD_lambda,          WORD_warp,       WORD_frequency,     WORD_phase,
        WORD_noise_generator, WORD_ramp_wave,  WORD_triangle_wave, WORD_sine_wave,
        WORD_scallop_wave,    WORD_cubic_wave, WORD_poly_wave,     WORD_color_map,
        WORD_pigment_map,     WORD_normal_map, WORD_slope_map,     WORD_texture_map,
        WORD_quick_color,     WORD_agate,      WORD_bozo,          WORD_granite,
        WORD_gradient,        WORD_marble,     WORD_wood,          WORD_crackle,
        WORD_checker,         WORD_brick,      WORD_bumps,         WORD_wrinkles,
        WORD_image_map};
    *count = ARRAY_COUNT(words);
    return words;
}

bool build_pattern_modifier(struct args *a, struct body *body)
{
    struct pattern *p = body->pattern;
    struct transform t;
    enum word w = args_at_word(a);
    if (build_trans(a, &t)) {
        pattern_add_transform(a->b->arena, p, &t);
        return true;
    }
    switch (w) {
    case WORD_turbulence:
    case WORD_octaves:
    case WORD_omega:
    case WORD_lambda: classic(a, p, w); return true;
    case WORD_ramp_wave: wave(a, p, WAVE_RAMP); return true;
    case WORD_triangle_wave: wave(a, p, WAVE_TRIANGLE); return true;
    case WORD_sine_wave: wave(a, p, WAVE_SINE); return true;
    case WORD_scallop_wave: wave(a, p, WAVE_SCALLOP); return true;
    case WORD_cubic_wave: wave(a, p, WAVE_CUBIC); return true;
    case WORD_poly_wave: wave(a, p, WAVE_POLY); return true;
    default: break;
    }
    if (args_at_block(a) == WORD_warp)
        return build_warp(a, p);
    return fields_read(a, common_fields, ARRAY_COUNT(common_fields), p) ||
           own_parameter(a, p) || map(a, body);
}

void pattern_finish(struct args *a, struct pattern *p)
{
    const char *wrong = p->ops && p->ops->finish ? p->ops->finish(p, a->b->arena) : NULL;
    if (wrong)
        args_error(a, a->owner ? a->owner->where : args_span(a), wrong);
}
