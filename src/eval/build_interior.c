#include "eval/build.h"

// interior, media, material (spec/language 4.11).

#define AT(member) offsetof(struct media, member)
static const struct field media_fields[] = {
    {WORD_method, FIELD_INT, AT(method), 1, 3},
    {WORD_intervals, FIELD_INT, AT(intervals), 1, 1e6},
    {WORD_confidence, FIELD_FLOAT, AT(confidence), 0, 1},
    {WORD_variance, FIELD_FLOAT, AT(variance), 0, 0},
    {WORD_ratio, FIELD_FLOAT, AT(ratio), 0, 0},
    {WORD_absorption, FIELD_RGB, AT(absorption), 0, 0},
    {WORD_emission, FIELD_RGB, AT(emission), 0, 0},
    {WORD_aa_level, FIELD_INT, AT(aa_level), 1, 1e6},
    {WORD_aa_threshold, FIELD_FLOAT, AT(aa_threshold), 0, 0},
    {WORD_jitter, FIELD_FLOAT, AT(jitter), 0, 0},
    {WORD_collect, FIELD_SWITCH, AT(collect), 0, 0},
};
static const enum word media_words[] = {WORD_scattering, WORD_density, WORD_samples,
                                        WORD_translate,  WORD_rotate,  WORD_scale};

static void scattering(struct args *a, struct media *m)
{
    static const struct field fields[] = {
        {WORD_eccentricity, FIELD_FLOAT, AT(eccentricity), 0, 0},
        {WORD_extinction, FIELD_FLOAT, AT(extinction), 0, 0}};
    struct args in = args_of(a->b, args_next(a), a);
    long type;
    if (args_int(&in, "type", &type) && (type < 1 || type > 5))
        args_error(&in, args_span(&in), "the type of scattering is 1 to 5");
    else
        m->scattering_type = (int)type;
    args_rgb(&in, &m->scattering);
    while (in.at)
        if (!fields_read(&in, fields, ARRAY_COUNT(fields), m))
            fields_unknown(&in, fields, ARRAY_COUNT(fields), NULL, 0);
}

static void samples(struct args *a, struct media *m)
{
    static const double most = 1e6;
    double low = 1, high;
    struct span where = args_span(a);
    if (!args_float(a, "samples", &low))
        return;
    high = low;
    args_optional(a, &high);
    if (!(low >= 1 && high >= low)) {
        args_error(a, where,
                   "samples must be at least 1, the second not below the first");
        return;
    }
    if (high > most) { // a table is as long
        diag_at(args_diags(a), DIAG_OUT_OF_RANGE, where, "samples", high, 1.0, most);
        args_fail(a);
        return;
    }
    m->samples_min = (int)low;
    m->samples_max = (int)high;
}

static void set_densities(struct builder *b, struct media *m,
                          const struct pointer_list *l)
{
    const struct pigment **d =
        arena_new_array(b->arena, const struct pigment *, l->count);
    for (uint32_t i = 0; i < l->count; i++)
        d[i] = l->at[i];
    m->density = d;
    m->density_count = l->count;
}

static void density(struct args *a, struct pointer_list *l)
{
    static const struct pigment white = {.kind = PIGMENT_SOLID, .color = {1, 1, 1, 0, 0}};
    const struct pigment *d;
    if (args_at_value(a, VALUE_DENSITY))
        d = args_next(a)->value->data;
    else
        d = build_density(a, args_next(a), &white);
    if (d)
        pointer_list_add(a->b->arena, l, d);
}

static const struct media media_defaults = {.method = 3,
                                            .intervals = 1,
                                            .samples_min = 10,
                                            .samples_max = 10,
                                            .confidence = 0.9f,
                                            .variance = 1.0f / 128,
                                            .ratio = 0.9f,
                                            .extinction = 1,
                                            .aa_level = 3,
                                            .aa_threshold = 0.1f,
                                            .collect = true};

const struct media *build_media(struct args *a, const struct ast *block)
{
    struct args in = args_of(a->b, block, a);
    const struct value *id = args_take_value(&in, VALUE_MEDIA);
    struct media *m = arena_new_struct(a->b->arena, struct media);
    struct pointer_list l = {0};
    struct transform t;
    *m = id ? *(const struct media *)id->data : media_defaults;
    if (!id && a->b->e->version_seen && a->b->e->version < 350) {
        m->method = 1;
        m->intervals = 10;
        m->samples_min = m->samples_max = 1;
    }
    for (uint32_t i = 0; i < m->density_count; i++)
        pointer_list_add(a->b->arena, &l, m->density[i]);
    while (in.at) {
        if (fields_read(&in, media_fields, ARRAY_COUNT(media_fields), m))
            continue;
        if (args_at_block(&in) == WORD_scattering)
            scattering(&in, m);
        else if (args_at_block(&in) == WORD_density || args_at_value(&in, VALUE_DENSITY))
            density(&in, &l);
        else if (args_take(&in, WORD_samples))
            samples(&in, m);
        else if (build_trans(&in, &t))
            for (uint32_t i = 0; i < l.count; i++)
                l.at[i] = pigment_transform(a->b->arena, l.at[i], &t);
        else
            fields_unknown(&in, media_fields, ARRAY_COUNT(media_fields), media_words,
                           ARRAY_COUNT(media_words));
    }
    if (in.failed)
        return NULL;
    set_densities(a->b, m, &l);
    return m;
}

#undef AT
#define AT(member) offsetof(struct interior, member)
static const struct field interior_fields[] = {
    {WORD_ior, FIELD_FLOAT, AT(ior), 0, 0},
    {WORD_dispersion, FIELD_FLOAT, AT(dispersion), 0, 0},
    {WORD_dispersion_samples, FIELD_INT, AT(dispersion_samples), 2, 1e6},
    {WORD_fade_color, FIELD_RGB, AT(fade_color), 0, 0},
    {WORD_fade_colour, FIELD_RGB, AT(fade_color), 0, 0},
    {WORD_fade_distance, FIELD_DOUBLE, AT(fade_distance), 0, 0},
    {WORD_fade_power, FIELD_DOUBLE, AT(fade_power), 0, 0},
    {WORD_refraction, FIELD_FLOAT, AT(old_refraction), 0, 0},
};

static void add_media(struct builder *b, struct interior *i, const struct media *m)
{
    const struct media **all =
        arena_new_array(b->arena, const struct media *, i->media_count + 1);
    for (uint32_t k = 0; k < i->media_count; k++)
        all[k] = i->media[k];
    all[i->media_count++] = m;
    i->media = all;
}

const struct interior *build_interior(struct args *a, const struct ast *block,
                                      const struct interior *start)
{
    static const struct interior fresh = {
        .dispersion = 1, .dispersion_samples = 7, .old_refraction = 1};
    static const enum word more[] = {WORD_caustics, WORD_media};
    struct args in = args_of(a->b, block, a);
    const struct value *id = args_take_value(&in, VALUE_INTERIOR);
    struct interior *i = arena_new_struct(a->b->arena, struct interior);
    double v;
    *i = id ? *(const struct interior *)id->data : start ? *start : fresh;
    while (in.at) {
        if (args_take(&in, WORD_caustics)) {
            if (args_float(&in, "caustics", &v))
                i->caustics = (float)(45 * v);
        } else if (args_at_block(&in) == WORD_media || args_at_value(&in, VALUE_MEDIA)) {
            const struct value *mv = args_take_value(&in, VALUE_MEDIA);
            const struct media *m = mv ? mv->data : build_media(&in, args_next(&in));
            if (m)
                add_media(a->b, i, m);
        } else if (!fields_read(&in, interior_fields, ARRAY_COUNT(interior_fields), i)) {
            fields_unknown(&in, interior_fields, ARRAY_COUNT(interior_fields), more,
                           ARRAY_COUNT(more));
        }
    }
    return in.failed ? NULL : i;
}

static const struct texture *settled(struct builder *b, const struct attached_texture *at)
{
    if (!at->texture || at->transform->identity)
        return at->texture;
    return texture_transform(b->arena, at->texture, at->transform);
}

static void put_layer(struct args *a, struct attached_texture *at,
                      const struct texture *top)
{
    const struct texture *below = settled(a->b, at);
    if (!top)
        return;
    at->texture = below ? build_layer(a, args_span(a), below, top) : top;
    at->transform = &transform_identity;
}

static void move(struct arena *a, struct attached_texture *at, const struct transform *t)
{
    if (at->texture)
        at->transform = transform_join(a, at->transform, t);
}

struct material build_material(struct args *a, const struct ast *block,
                               struct material start)
{
    static const enum word known[] = {WORD_texture,  WORD_interior_texture,
                                      WORD_interior, WORD_translate,
                                      WORD_rotate,   WORD_scale};
    struct args in = args_of(a->b, block, a);
    const struct value *id = args_take_value(&in, VALUE_MATERIAL);
    struct material m = start;
    struct transform t;
    if (id) {
        const struct material *from = id->data;
        put_layer(&in, &m.texture, settled(a->b, &from->texture));
        put_layer(&in, &m.interior_texture, settled(a->b, &from->interior_texture));
        if (from->interior)
            m.interior = from->interior;
    }
    while (in.at) {
        if (args_at_block(&in) == WORD_texture)
            put_layer(&in, &m.texture, build_texture(&in, args_next(&in)));
        else if (args_at_block(&in) == WORD_interior_texture)
            put_layer(&in, &m.interior_texture, build_texture(&in, args_next(&in)));
        else if (args_at_block(&in) == WORD_interior)
            m.interior = build_interior(&in, args_next(&in), m.interior);
        else if (build_trans(&in, &t)) {
            move(a->b->arena, &m.texture, &t);
            move(a->b->arena, &m.interior_texture, &t);
            if (m.interior)
                m.interior = interior_moved(a->b->arena, m.interior, &t);
        } else {
            args_unknown(&in, known, ARRAY_COUNT(known));
        }
    }
    return m;
}
