// Images in the scene: their modifiers, and what they are used for (spec/textures 9).
#include "eval/build.h"

#include "eval/image_source.h"
#include "scene/image_map.h"

// ---- modifiers ---------------------------------------------------------------
static const enum word modifier_words[] = {
    WORD_once,      WORD_map_type,  WORD_interpolate, WORD_use_color,
    WORD_use_index, WORD_use_alpha, WORD_filter,      WORD_transmit,
    WORD_repeat,    WORD_offset,    WORD_bump_size,   WORD_gamma};

static void read_choice(struct args *a, const char *role, const int *allowed, size_t n,
                        int *out)
{
    const struct span where = args_span(a);
    long v;
    if (!args_int(a, role, &v))
        return;
    for (size_t i = 0; i < n; i++)
        if (v == allowed[i]) {
            *out = (int)v;
            return;
        }
    args_error(a, where, arena_printf(a->b->arena, "%s cannot be %ld here", role, v));
}

static void map_type(struct args *a, enum word use, struct image_map *m)
{
    static const int allowed[] = {0, 1, 2, 5};
    long v;
    if (use == WORD_image_map)
        read_choice(a, "map_type", allowed, ARRAY_COUNT(allowed), &m->projection);
    else if (args_int(a, "map_type", &v))
        m->projection = v == 1 || v == 2 || v == 5 ? (int)v : 0;
}

static void interpolate(struct args *a, enum word use, struct image_map *m)
{
    static const int strict[] = {2, 3, 4}, all[] = {0, 2, 3, 4};
    if (use == WORD_image_map)
        read_choice(a, "interpolate", strict, ARRAY_COUNT(strict), &m->interpolation);
    else
        read_choice(a, "interpolate", all, ARRAY_COUNT(all), &m->interpolation);
}

// filter and transmit, of all texels or of one entry of the palette.
static void let_through(struct args *a, enum word w, struct image_map *m,
                        struct rgbft *palette)
{
    const int count = m->texels->palette_count;
    const struct span where = args_span(a);
    const bool all = args_take(a, WORD_all);
    long n = 0;
    double v;
    if (!all && !args_int(a, "palette entry", &n))
        return;
    if (!args_float(a, word_text(w), &v))
        return;
    if (!all && (!palette || n < 0 || n >= count)) {
        args_error(a, where,
                   !palette
                       ? "the image has no palette"
                       : arena_printf(a->b->arena, "the palette has %d entries", count));
        return;
    }
    if (all && !palette)
        *(w == WORD_filter ? &m->filter_all : &m->transmit_all) = (float)v;
    for (int i = all ? 0 : (int)n; palette && i < (all ? count : (int)n + 1); i++)
        *(w == WORD_filter ? &palette[i].filter : &palette[i].transmit) = (float)v;
}

static void read_repeat(struct args *a, struct image_map *m)
{
    const struct span where = args_span(a);
    struct vec2 v;
    if (!args_vec2(a, "repeat", &v))
        return;
    if (v.u > 0 && v.v > 0)
        m->repeat = v;
    else
        args_error(a, where, "repeat must be above 0");
}

static bool modifier(struct args *a, enum word use, struct image_map *m,
                     struct rgbft *palette)
{
    const enum word w = args_at_word(a);
    switch (w) {
    case WORD_once: args_next(a); return m->once = true;
    case WORD_map_type:
        args_next(a);
        map_type(a, use, m);
        return true;
    case WORD_interpolate:
        args_next(a);
        interpolate(a, use, m);
        return true;
    case WORD_use_color:
    case WORD_use_colour:
        args_next(a);
        m->use_index = m->use_alpha = false;
        return true;
    case WORD_use_index: args_next(a); return m->use_index = true;
    case WORD_repeat:
        args_next(a);
        read_repeat(a, m);
        return true;
    case WORD_offset:
        args_next(a);
        args_vec2(a, "offset", &m->offset);
        return true;
    case WORD_use_alpha:
        if (use != WORD_image_pattern)
            return false;
        args_next(a);
        return m->use_alpha = true;
    case WORD_filter:
    case WORD_transmit:
        if (use != WORD_image_map)
            return false;
        args_next(a);
        let_through(a, w, m, palette);
        return true;
    default: return false;
    }
}

static bool palette_opaque(const struct image_map *m)
{
    for (int i = 0; m->palette && i < m->texels->palette_count; i++)
        if (m->palette[i].filter != 0 || m->palette[i].transmit != 0)
            return false;
    return m->filter_all == 0 && m->transmit_all == 0;
}

// An image with its modifiers: the items of `in` up to a texture. NULL after an error.
static const struct image_map *build_image_map(struct args *in, enum word use,
                                               float *bump_size)
{
    struct image_source s;
    if (!image_source_read(in, &s)) {
        in->at = NULL; // the rest speaks of the image
        return NULL;
    }
    struct image_map *m = arena_new_struct(in->b->arena, struct image_map);
    *m = (struct image_map){
        .texels = s.texels, .repeat = {1, 1}, .premultiplied = s.premultiplied};
    if (use == WORD_image_map)
        image_source_decode(in, &s, m);
    else if (s.has_gamma && use != WORD_material_map)
        m->decode = s.gamma;
    image_map_prepare(in->b->arena, m);
    // Entries of the palette may be changed: it was made for this map alone.
    struct rgbft *palette = (struct rgbft *)(uintptr_t)m->palette;
    double v;
    while (in->at && args_at_block(in) != WORD_texture) {
        if (use == WORD_bump_map && args_take(in, WORD_bump_size)) {
            if (args_float(in, "bump_size", &v))
                *bump_size = (float)v;
        } else if (!modifier(in, use, m, palette)) {
            args_unknown(in, modifier_words, ARRAY_COUNT(modifier_words));
        }
    }
    m->opaque = m->opaque && !m->once && palette_opaque(m);
    return in->failed ? NULL : m;
}

// ---- places ------------------------------------------------------------------
void build_image_pattern(struct args *a, struct body *body, enum word use)
{
    struct args in = args_of(a->b, args_next(a), a);
    float bump_size = body->normal ? body->normal->amount : 0;
    const struct image_map *m = build_image_map(&in, use, &bump_size);
    body->bitmap = use != WORD_image_pattern;
    body->pattern->image = m;
    if (use == WORD_image_map && body->pigment) {
        body->pigment->kind = PIGMENT_IMAGE;
        body->pigment->image = m;
    } else if (use == WORD_bump_map && body->normal) {
        body->normal->kind = NORMAL_BUMP_MAP;
        body->normal->image = m;
        body->normal->amount = body->normal->bump_size = bump_size;
    }
}

// material_map { image, textures }: the image's indices choose among them.
void build_material_map(struct args *a, struct texture *x)
{
    struct args in = args_of(a->b, args_next(a), a);
    struct arena *arena = a->b->arena;
    float unused;
    *x = (struct texture){.kind = TEXTURE_MATERIAL, .pattern = &pattern_none};
    x->image = build_image_map(&in, WORD_material_map, &unused);
    struct pointer_list list = {0};
    while (args_at_block(&in) == WORD_texture) {
        const struct texture *entry = build_texture(&in, args_next(&in));
        if (entry)
            pointer_list_add(arena, &list, entry);
    }
    if (in.at)
        args_unknown(&in, NULL, 0);
    if (!list.count && !in.failed)
        args_error(&in, args_span(&in), "textures are expected in a material_map");
    struct texture_map *m = arena_new_struct(arena, struct texture_map);
    const struct texture **entry =
        arena_new_array(arena, const struct texture *, list.count + 1);
    for (uint32_t i = 0; i < list.count; i++)
        entry[i] = list.at[i];
    *m = (struct texture_map){list.count, arena_new_array(arena, float, list.count + 1),
                              entry};
    x->map = m;
}
