#include "eval/builder.h"

#include <string.h>

#include "eval/build.h"
#include "scene/shapes/mesh.h"

// Which block word means what, and what belongs to a whole scene.

enum { ROLE_NONE, ROLE_OBJECT, ROLE_BLOCK };

static const enum word object_words[] = {WORD_bicubic_patch,
                                         WORD_blob,
                                         WORD_box,
                                         WORD_cone,
                                         WORD_cylinder,
                                         WORD_disc,
                                         WORD_height_field,
                                         WORD_isosurface,
                                         WORD_julia_fractal,
                                         WORD_lathe,
                                         WORD_mesh,
                                         WORD_mesh2,
                                         WORD_ovus,
                                         WORD_parametric,
                                         WORD_plane,
                                         WORD_quadric,
                                         WORD_cubic,
                                         WORD_quartic,
                                         WORD_poly,
                                         WORD_polynomial,
                                         WORD_polygon,
                                         WORD_prism,
                                         WORD_smooth_triangle,
                                         WORD_sor,
                                         WORD_sphere,
                                         WORD_sphere_sweep,
                                         WORD_superellipsoid,
                                         WORD_text,
                                         WORD_torus,
                                         WORD_triangle,
                                         WORD_union,
                                         WORD_merge,
                                         WORD_intersection,
                                         WORD_difference,
                                         WORD_composite,
                                         WORD_light_source,
                                         WORD_light_group,
                                         WORD_object};

bool builder_is_object_word(enum word w)
{
    for (size_t i = 0; w && i < ARRAY_COUNT(object_words); i++)
        if (object_words[i] == w)
            return true;
    return false;
}

bool builder_is_block_word(enum word w)
{
    static const enum word words[] = {
        WORD_texture,    WORD_pigment,   WORD_normal,      WORD_finish,
        WORD_interior,   WORD_media,     WORD_density,     WORD_material,
        WORD_transform,  WORD_color_map, WORD_colour_map,  WORD_pigment_map,
        WORD_normal_map, WORD_slope_map, WORD_texture_map, WORD_density_map,
        WORD_camera,     WORD_fog,       WORD_rainbow,     WORD_sky_sphere};
    for (size_t i = 0; w && i < ARRAY_COUNT(words); i++)
        if (words[i] == w)
            return true;
    return false;
}

static void find_tables(struct builder *b)
{
    for (size_t i = 0; i < pattern_count; i++) {
        const char *text = pattern_table[i]->keyword;
        const enum word w = word_find(text, strlen(text));
        if (w != WORD_NONE)
            b->pattern[w] = pattern_table[i];
    }
    for (size_t i = 0; i < ARRAY_COUNT(object_words); i++) {
        const char *text = word_text(object_words[i]);
        b->shape[object_words[i]] = shape_find(text, strlen(text));
    }
}

static void default_texture(struct builder *b)
{
    static const struct pigment black;
    struct pigment *p = arena_new_struct(b->arena, struct pigment);
    struct finish *f = arena_new_struct(b->arena, struct finish);
    struct texture *x = arena_new_struct(b->arena, struct texture);
    struct texture_layer *layer = arena_new_struct(b->arena, struct texture_layer);
    *p = black;
    *f = finish_default;
    layer->pigment = p;
    layer->finish = f;
    x->kind = TEXTURE_PLAIN;
    x->layer = layer;
    x->layer_count = 1;
    b->default_texture = x;
}

static void default_settings(struct settings *s)
{
    s->max_trace_level = 5;
    s->adc_bailout = 1.0f / 255;
    s->ambient_light = rgb(1, 1, 1);
    s->irid_wavelength = rgb(0.70f, 0.52f, 0.48f);
    s->noise_generator = 2;
    s->number_of_waves = 10;
    s->mm_per_unit = 10;
    s->radiosity_settings = (struct radiosity_settings){.pretrace_start = 0.08,
                                                        .pretrace_end = 0.04,
                                                        .error_bound = 1.8,
                                                        .low_error_factor = 0.5,
                                                        .minimum_reuse = 0.015,
                                                        .maximum_reuse = 0.2,
                                                        .adc_bailout = 0.01,
                                                        .importance = 1,
                                                        .brightness = 1,
                                                        .max_sample = -1,
                                                        .count = 35,
                                                        .count_directions = 1600,
                                                        .nearest_count = 5,
                                                        .recursion_limit = 2};
    s->photons = (struct photon_settings){.spacing = 1,
                                          .gather_min = 20,
                                          .gather_max = 100,
                                          .radius = {-1, 1, -1, 1},
                                          .media_factor = 1,
                                          .jitter = 0.4,
                                          .autostop = 0.5,
                                          .expand_increase = 0.2,
                                          .expand_min = 35,
                                          .adc_bailout = -1};
}

struct builder *builder_new(struct eval *e)
{
    struct builder *b = arena_new_struct(e->arena, struct builder);
    b->e = e;
    b->arena = e->arena;
    b->camera_default.camera = camera_default;
    b->camera_default.sky = vec3(0, 1, 0);
    b->camera_default.look_at = vec3(0, 0, 1);
    b->camera = b->camera_default;
    b->pattern_defaults = arena_new_struct(e->arena, struct pattern_defaults);
    b->pattern_defaults->noise_generator = 2;
    b->pattern_defaults->number_of_waves = 10;
    find_tables(b);
    default_texture(b);
    default_settings(&e->scene->settings);
    return b;
}

const struct pattern_defaults *builder_pattern_defaults(const struct builder *b)
{
    return b->pattern_defaults;
}

static const struct value *make(struct builder *b, enum value_kind kind, const void *data)
{
    if (!data)
        return NULL;
    struct value *v = arena_new_struct(b->arena, struct value);
    v->kind = kind;
    v->data = data;
    return v;
}

const struct value *builder_object(struct builder *b, const struct ast *block)
{
    struct args top = args_list(b, block, block, "scene", NULL);
    return make(b, VALUE_OBJECT, build_object(&top, block));
}

void builder_face(struct builder *b, struct mesh_soup *mesh, const struct ast *block)
{
    struct args face = args_of(b, block, NULL);
    mesh_soup_add(mesh, &face, block->word == WORD_smooth_triangle);
    if (face.failed)
        mesh_soup_fail(mesh);
}

static const void *copied(struct builder *b, const void *from, size_t size)
{
    return memcpy(arena_alloc(b->arena, size), from, size);
}

static const struct value *textures(struct builder *b, struct args *a)
{
    const struct texture *all = NULL;
    while (args_at_block(a) == WORD_texture) {
        struct span where = args_span(a);
        const struct texture *x = build_texture(a, args_next(a));
        all = all && x ? build_layer(a, where, all, x) : x ? x : all;
    }
    return a->failed ? NULL : make(b, VALUE_TEXTURE, all);
}

static const struct value *material(struct builder *b, struct args *a,
                                    const struct ast *n)
{
    struct material none = {0};
    none.texture.transform = none.interior_texture.transform = &transform_identity;
    struct material m = build_material(a, n, none);
    return make(b, VALUE_MATERIAL, copied(b, &m, sizeof m));
}

static const struct value *map(struct builder *b, struct args *a, const struct ast *n)
{
    switch (n->word) {
    case WORD_color_map:
    case WORD_colour_map: return make(b, VALUE_COLOR_MAP, build_color_map(a, n));
    case WORD_pigment_map:
        return make(b, VALUE_PIGMENT_MAP, build_pigment_map(a, n, false, false));
    case WORD_density_map:
        return make(b, VALUE_DENSITY_MAP, build_pigment_map(a, n, false, true));
    case WORD_normal_map: return make(b, VALUE_NORMAL_MAP, build_normal_map(a, n, false));
    case WORD_slope_map: return make(b, VALUE_SLOPE_MAP, build_slope_map(a, n));
    case WORD_texture_map:
        return make(b, VALUE_TEXTURE_MAP, build_texture_map(a, n, false));
    default: return NULL;
    }
}

static const struct value *value_of(struct builder *b, struct args *a,
                                    const struct ast *n)
{
    static const struct pigment white = {.kind = PIGMENT_SOLID, .color = {1, 1, 1, 0, 0}};
    const struct texture_layer *d = b->default_texture->layer;
    struct camera_state c;
    switch (n->word) {
    case WORD_pigment: return make(b, VALUE_PIGMENT, build_pigment(a, n, d->pigment));
    case WORD_normal: return make(b, VALUE_NORMAL, build_normal(a, n, d->normal));
    case WORD_finish: return make(b, VALUE_FINISH, build_finish(a, n, d->finish));
    case WORD_interior: return make(b, VALUE_INTERIOR, build_interior(a, n, NULL));
    case WORD_media: return make(b, VALUE_MEDIA, build_media(a, n));
    case WORD_density: return make(b, VALUE_DENSITY, build_density(a, n, &white));
    case WORD_material: return material(b, a, n);
    case WORD_camera:
        return build_camera(a, n, &c) ? make(b, VALUE_CAMERA, copied(b, &c, sizeof c))
                                      : NULL;
    case WORD_fog: return make(b, VALUE_FOG, build_fog(a, n));
    case WORD_rainbow: return make(b, VALUE_RAINBOW, build_rainbow(a, n));
    case WORD_sky_sphere: return make(b, VALUE_SKY_SPHERE, build_sky_sphere(a, n));
    default: return map(b, a, n);
    }
}

const struct value *builder_block(struct builder *b, const struct ast *items)
{
    struct args a = args_list(b, items, items, "right side", NULL);
    struct transform t;
    if (args_at_block(&a) == WORD_texture)
        return textures(b, &a);
    if (build_trans(&a, &t))
        return a.failed ? NULL : make(b, VALUE_TRANSFORM, copied(b, &t, sizeof t));
    if (!builder_is_block_word(args_at_block(&a))) {
        if (a.at)
            args_unknown(&a, NULL, 0);
        return NULL;
    }
    const struct value *v = value_of(b, &a, args_next(&a));
    return a.failed ? NULL : v;
}

// ---- statements ------------------------------------------------------------

static bool camera(struct builder *b, struct args *a, const struct ast *n)
{
    struct scene *s = b->e->scene;
    const bool choose = b->e->options->camera;
    if (s->has_camera && !choose)
        args_warning(a, n->where, "a camera was given before, this one is used");
    if (!build_camera(a, n, &b->camera))
        return false;
    s->camera = b->camera.camera;
    if (choose)
        pointer_list_add(b->arena, &b->cameras, copied(b, &s->camera, sizeof s->camera));
    return s->has_camera = true;
}

static bool add(struct builder *b, struct pointer_list *l, const void *p)
{
    if (p)
        pointer_list_add(b->arena, l, p);
    return p;
}

static bool sky(struct builder *b, struct args *a, const struct ast *n)
{
    if (b->e->scene->sky)
        args_warning(a, n->where, "a sky_sphere was given before, this one is used");
    b->e->scene->sky = build_sky_sphere(a, n);
    return b->e->scene->sky;
}

// Where a block belongs that stands alone.
static const char *statement_hint(struct builder *b, int word, const char *text)
{
    switch (word) {
    case WORD_texture:
    case WORD_pigment:
    case WORD_normal:
    case WORD_finish:
    case WORD_interior:
    case WORD_material:
        return arena_printf(
            b->e->parse, "it belongs in an object, or has a name: #declare NAME = %s { }",
            text);
    default: return NULL;
    }
}

static bool block_statement(struct builder *b, struct args *a, const struct ast *n)
{
    switch (n->word) {
    case WORD_camera: return camera(b, a, n);
    case WORD_fog: return add(b, &b->fogs, build_fog(a, n));
    case WORD_rainbow: return add(b, &b->rainbows, build_rainbow(a, n));
    case WORD_media: return add(b, &b->medias, build_media(a, n));
    case WORD_sky_sphere: return sky(b, a, n);
    case WORD_background: return build_background(a, n);
    case WORD_global_settings: return build_settings(a, n);
    case WORD_default: return builder_defaults(b, n->list);
    case WORD_max_trace_level:
    case WORD_max_intersections: return build_old_setting(a);
    default: break;
    }
    const char *word = word_text((enum word)n->word);
    diag_hint(b->e->diags, DIAG_UNKNOWN_STATEMENT, n->where,
              statement_hint(b, n->word, word), word);
    return false;
}

bool builder_statement(struct builder *b, const struct ast *item)
{
    struct ast alone = *item;
    struct args a = args_list(b, &alone, NULL, "scene", NULL);
    alone.next = NULL;
    bool was;
    if (item->kind == AST_VALUE && !item->value)
        return false;
    const struct object *o = args_object(&a, &was);
    if (was)
        return add(b, &b->objects, o);
    if (item->kind == AST_BLOCK)
        return block_statement(b, &a, item);
    args_unknown(&a, object_words, ARRAY_COUNT(object_words));
    return false;
}

static bool default_block(struct builder *b, struct args *a, struct texture_layer *top)
{
    const void *made;
    const struct texture *x;
    switch (args_at_block(a)) {
    case WORD_texture: {
        struct span where = args_span(a);
        x = build_texture(a, args_next(a));
        if (x && (x->kind != TEXTURE_PLAIN || x->layer_count != 1))
            args_error(a, where, "the default texture must be plain and of one layer");
        else if (x)
            *top = x->layer[0];
        return true;
    }
    case WORD_pigment:
        if ((made = build_pigment(a, args_next(a), top->pigment)))
            top->pigment = made;
        return true;
    case WORD_normal:
        if ((made = build_normal(a, args_next(a), top->normal)))
            top->normal = made;
        return true;
    case WORD_finish:
        if ((made = build_finish(a, args_next(a), top->finish)))
            top->finish = made;
        return true;
    case WORD_camera: build_camera(a, args_next(a), &b->camera_default); return true;
    case WORD_radiosity:
        b->e->scene->settings.radiosity_settings.importance = build_importance(a);
        return true;
    default: return false;
    }
}

static struct attached_texture unmoved(const struct texture *x)
{
    return (struct attached_texture){x, &transform_identity};
}

bool builder_defaults(struct builder *b, const struct ast *items)
{
    const struct past_default past = {b->objects.count, unmoved(b->default_texture)};
    static const enum word known[] = {WORD_texture, WORD_pigment,   WORD_normal,
                                      WORD_finish,  WORD_radiosity, WORD_camera};
    struct args a = args_list(b, items, NULL, "default", NULL);
    while (a.at) {
        struct texture_layer top = b->default_texture->layer[0];
        if (!default_block(b, &a, &top)) {
            args_unknown(&a, known, ARRAY_COUNT(known));
            continue;
        }
        struct texture *x = arena_new_struct(b->arena, struct texture);
        *x = *b->default_texture;
        x->layer = copied(b, &top, sizeof top);
        b->default_texture = x;
    }
    if (b->default_texture != past.texture.texture && past.until > 0)
        pointer_list_add(b->arena, &b->past_defaults, copied(b, &past, sizeof past));
    return !a.failed;
}

bool builder_finish(struct builder *b)
{
    struct scene *s = b->e->scene;
    struct span nowhere = {0};
    if (!s->has_camera)
        s->camera = b->camera_default.camera;
    if (b->cameras.count)
        s->camera = *(const struct camera *)
                         b->cameras.at[(b->e->options->camera - 1) % b->cameras.count];
    settings_finish(b);
    s->object = (const struct object *const *)b->objects.at;
    s->object_count = b->objects.count;
    s->fog = (const struct fog *const *)b->fogs.at;
    s->fog_count = b->fogs.count;
    s->rainbow = (const struct rainbow *const *)b->rainbows.at;
    s->rainbow_count = b->rainbows.count;
    s->media = (const struct media *const *)b->medias.at;
    s->media_count = b->medias.count;
    s->default_texture = unmoved(b->default_texture);
    s->past_default = (const struct past_default *const *)b->past_defaults.at;
    s->past_default_count = b->past_defaults.count;
    // The rules of the old and the new language for what shows through the sky.
    if (!s->has_background)
        s->background.transmit = 1;
    if (s->settings.version < 370) {
        s->background.filter = 0;
        s->background.transmit = b->e->options->output_alpha ? 1 : 0;
    } else if (!b->e->options->output_alpha) {
        float k = 1 - s->background.transmit;
        s->background = (struct rgbft){k * s->background.r, k * s->background.g,
                                       k * s->background.b, 0, 0};
    }
    if (b->objects.count == 0)
        diag_at(b->e->diags, DIAG_NO_OBJECTS, nowhere, "scene");
    return true;
}
