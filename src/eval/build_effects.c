#include "eval/build.h"

#include "eval/file_io.h"

// radiosity { } and photons { } of global_settings (spec/language 4.14).

#define AT(member) offsetof(struct radiosity_settings, member)
static const struct field radiosity_fields[] = {
    {WORD_pretrace_start, FIELD_DOUBLE, AT(pretrace_start), 1e-10, 1},
    {WORD_pretrace_end, FIELD_DOUBLE, AT(pretrace_end), 1e-10, 1},
    {WORD_error_bound, FIELD_DOUBLE, AT(error_bound), 1e-10, 1e10},
    {WORD_low_error_factor, FIELD_DOUBLE, AT(low_error_factor), 1e-10, 1e10},
    {WORD_gray_threshold, FIELD_DOUBLE, AT(gray_threshold), 0, 1},
    {WORD_adc_bailout, FIELD_DOUBLE, AT(adc_bailout), 0, 1e10},
    {WORD_brightness, FIELD_DOUBLE, AT(brightness), 0, 0},
    {WORD_max_sample, FIELD_DOUBLE, AT(max_sample), 0, 0},
    {WORD_recursion_limit, FIELD_INT, AT(recursion_limit), 1, 20},
    {WORD_normal, FIELD_NUMBER_BOOL, AT(normal), 0, 0},
    {WORD_media, FIELD_NUMBER_BOOL, AT(media), 0, 0},
    {WORD_always_sample, FIELD_NUMBER_BOOL, AT(always_sample), 0, 0},
    {WORD_subsurface, FIELD_NUMBER_BOOL, AT(subsurface), 0, 0},
};
static const enum word radiosity_words[] = {WORD_count,         WORD_nearest_count,
                                            WORD_minimum_reuse, WORD_maximum_reuse,
                                            WORD_load_file,     WORD_save_file};

static bool pair_in_range(struct args *a, const char *role, struct span where, double v,
                          double low, double high)
{
    if (v >= low && v <= high)
        return true;
    diag_at(args_diags(a), DIAG_OUT_OF_RANGE, where, role, v, low, high);
    args_fail(a);
    return false;
}

static bool read_pair(struct args *a, int *first, int *second, double low, double high)
{
    double v, w = *second;
    const char *role = word_text((enum word)args_next(a)->word);
    struct span where = args_span(a), next;
    if (!args_float(a, role, &v))
        return true;
    next = args_span(a);
    args_optional(a, &w);
    if (pair_in_range(a, role, where, v, low, high) &&
        pair_in_range(a, role, next, w, 0, high)) {
        *first = (int)v;
        *second = (int)w;
    }
    return true;
}

static void check_nearest(struct args *a, const struct radiosity_settings *r)
{
    if (r->nearest_adaptive < 0 ||
        (r->nearest_adaptive && r->nearest_adaptive >= r->nearest_count))
        args_error(a, a->owner->where,
                   "the second number of nearest_count must be at least 0 and below the "
                   "first");
}

// Only one of the two given: the other follows (spec/language 4.14).
static void check_reuse(struct args *a, struct radiosity_settings *r, bool low, bool high)
{
    if (low && high && r->minimum_reuse >= r->maximum_reuse)
        args_error(a, a->owner->where, "minimum_reuse must be below maximum_reuse");
    else if (low && !high && r->minimum_reuse > r->maximum_reuse / 2)
        r->maximum_reuse = 2 * r->minimum_reuse;
    else if (high && !low && r->minimum_reuse > r->maximum_reuse / 2)
        r->minimum_reuse = r->maximum_reuse / 2;
}

// Files of samples are no matter of scenes since POV-Ray 3.7, which ignores them too.
static void ignored_file(struct args *a)
{
    const char *name;
    args_warning(a, args_span(a), "radiosity files in a scene are ignored");
    const struct ast *n = args_next(a);
    args_string(a, word_text((enum word)n->word), &name);
}

bool build_radiosity_settings(struct args *a, const struct ast *block)
{
    struct args in = args_of(a->b, block, a);
    struct radiosity_settings *r = &a->b->e->scene->settings.radiosity_settings;
    bool low = false, high = false;
    a->b->e->scene->settings.radiosity = true;
    r->on = true;
    while (in.at) {
        if (fields_read(&in, radiosity_fields, ARRAY_COUNT(radiosity_fields), r))
            continue;
        switch (args_at_word(&in)) {
        case WORD_count: read_pair(&in, &r->count, &r->count_directions, 1, 1e6); break;
        case WORD_nearest_count:
            read_pair(&in, &r->nearest_count, &r->nearest_adaptive, 1, 20);
            break;
        case WORD_load_file:
        case WORD_save_file: ignored_file(&in); break;
        case WORD_minimum_reuse:
            args_next(&in);
            low = args_float(&in, "minimum_reuse", &r->minimum_reuse);
            break;
        case WORD_maximum_reuse:
            args_next(&in);
            high = args_float(&in, "maximum_reuse", &r->maximum_reuse);
            break;
        default:
            fields_unknown(&in, radiosity_fields, ARRAY_COUNT(radiosity_fields),
                           radiosity_words, ARRAY_COUNT(radiosity_words));
        }
    }
    check_reuse(&in, r, low, high);
    check_nearest(&in, r);
    return !in.failed;
}

#undef AT
#define AT(member) offsetof(struct photon_settings, member)
static const struct field photon_fields[] = {
    {WORD_spacing, FIELD_DOUBLE, AT(spacing), 0, 0},
    {WORD_count, FIELD_INT, AT(count), 0, 0},
    {WORD_jitter, FIELD_DOUBLE, AT(jitter), 0, 0},
    {WORD_autostop, FIELD_DOUBLE, AT(autostop), 0, 0},
    {WORD_max_trace_level, FIELD_INT, AT(max_trace_level), 0, 0},
    {WORD_adc_bailout, FIELD_DOUBLE, AT(adc_bailout), 0, 0},
};
static const enum word photon_words[] = {WORD_gather,    WORD_radius,
                                         WORD_media,     WORD_expand_thresholds,
                                         WORD_load_file, WORD_save_file};

static void photon_file(struct args *a, enum word w, struct photon_settings *p)
{
    const struct span where = args_span(a);
    const char *name;
    if (!args_string(a, "file", &name))
        return;
    if (w == WORD_load_file)
        args_find_file(a, "file of photons", name, NULL, &p->load_file);
    else if (!(p->save_file = file_to_write(a->b->e, name, where)))
        args_fail(a);
}

static bool photon_item(struct args *a, struct photon_settings *p)
{
    enum word w = args_at_word(a);
    const struct span where = args_span(a);
    long n = 0;
    switch (w) {
    case WORD_gather: return read_pair(a, &p->gather_min, &p->gather_max, 0, 1e9);
    case WORD_radius:
        args_next(a);
        for (int i = 0; i < 4 && args_at_number(a); i++)
            args_float(a, "radius", &p->radius[i]);
        return true;
    case WORD_media:
        args_next(a);
        if (args_int(a, "media", &n) && n < 0)
            args_error(a, where, "media steps below 0");
        p->media_steps = (int)n;
        args_optional(a, &p->media_factor);
        return true;
    case WORD_expand_thresholds:
        args_next(a);
        args_float(a, "expand_thresholds", &p->expand_increase);
        if (args_int(a, "expand_thresholds", &n))
            p->expand_min = (int)n;
        return true;
    case WORD_load_file:
    case WORD_save_file:
        args_next(a);
        photon_file(a, w, p);
        return true;
    default: return false;
    }
}

bool build_photons_settings(struct args *a, const struct ast *block)
{
    struct args in = args_of(a->b, block, a);
    struct photon_settings *p = &a->b->e->scene->settings.photons;
    p->on = true;
    while (in.at)
        if (!fields_read(&in, photon_fields, ARRAY_COUNT(photon_fields), p) &&
            !photon_item(&in, p))
            fields_unknown(&in, photon_fields, ARRAY_COUNT(photon_fields), photon_words,
                           ARRAY_COUNT(photon_words));
    return !in.failed;
}
