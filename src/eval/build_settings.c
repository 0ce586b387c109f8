#include "eval/build.h"

// global_settings { } (spec/language 4.14) and what the end of parsing decides.

#define AT(member) offsetof(struct settings, member)
static const struct field fields[] = {
    {WORD_adc_bailout, FIELD_FLOAT, AT(adc_bailout), 0, 0},
    {WORD_ambient_light, FIELD_RGB, AT(ambient_light), 0, 0},
    {WORD_irid_wavelength, FIELD_RGB, AT(irid_wavelength), 0, 0},
    {WORD_number_of_waves, FIELD_INT, AT(number_of_waves), 1, 1e6},
    {WORD_mm_per_unit, FIELD_DOUBLE, AT(mm_per_unit), 0, 0},
};
static const enum word other_words[] = {
    WORD_assumed_gamma, WORD_max_trace_level,   WORD_noise_generator,
    WORD_charset,       WORD_subsurface,        WORD_photons,
    WORD_radiosity,     WORD_max_intersections, WORD_hf_gray_16};

static void assumed_gamma(struct args *a, struct settings *s)
{
    struct span where = args_span(a);
    double g = 1;
    enum gamma_mode mode = GAMMA_SRGB;
    if (!args_take(a, WORD_srgb)) {
        mode = GAMMA_POWER;
        if (!args_float(a, "assumed_gamma", &g))
            return;
        if (g <= 0) {
            args_error(a, where, "assumed_gamma must be above 0");
            return;
        }
        if (g < 1)
            args_warning(a, where, "an assumed_gamma below 1 is unusual");
    }
    if (a->b->gamma_set) {
        args_warning(a, where, "assumed_gamma was given before, this one is ignored");
        return;
    }
    a->b->gamma_set = true;
    s->gamma_mode = mode;
    s->assumed_gamma = g;
}

static void max_trace_level(struct args *a, struct settings *s)
{
    struct span where = args_span(a);
    long n;
    if (!args_int(a, "max_trace_level", &n))
        return;
    if (n < 1)
        args_warning(a, where, "max_trace_level below 1, 1 is used");
    if (n > 256)
        args_warning(a, where, "max_trace_level above 256, 256 is used");
    s->max_trace_level = n > 256 ? 256 : n < 1 ? 1 : (int)n;
}

static void noise_generator(struct args *a, struct settings *s)
{
    struct span where = args_span(a);
    long n;
    if (!args_int(a, "noise_generator", &n))
        return;
    if (n < 1 || n > 3) {
        args_error(a, where, "noise_generator is 1, 2 or 3");
        return;
    }
    a->b->noise_set = true;
    s->noise_generator = (int)n;
    settings_noise(a->b);
}

static void charset(struct args *a)
{
    if (!args_take(a, WORD_ascii) && !args_take(a, WORD_utf8) && !args_take(a, WORD_sys))
        args_error(a, args_span(a), "charset is ascii, utf8 or sys");
}

static void subsurface(struct args *a, struct settings *s)
{
    struct args in = args_of(a->b, args_next(a), a);
    double v;
    long n, m;
    s->subsurface = (struct subsurface_settings){true, false, 50, 50};
    while (in.at) {
        const struct span where = args_span(&in);
        if (args_take(&in, WORD_samples)) {
            if (args_int(&in, "samples", &n) && args_int(&in, "samples", &m)) {
                if (n < 1 || m < 1 || n > 1000000 || m > 1000000)
                    args_error(&in, where,
                               "subsurface takes 1 to 1000000 samples of each kind");
                s->subsurface.samples_diffuse = (int)n;
                s->subsurface.samples_single = (int)m;
            }
        } else if (args_take(&in, WORD_radiosity)) {
            if (args_float(&in, "radiosity", &v))
                s->subsurface.radiosity = v > 0;
        } else {
            args_unknown(&in, NULL, 0);
        }
    }
}

static bool word_item(struct args *a, struct settings *s)
{
    enum word w = args_at_word(a);
    double v;
    switch (w) {
    case WORD_assumed_gamma:
        args_next(a);
        assumed_gamma(a, s);
        break;
    case WORD_max_trace_level:
        args_next(a);
        max_trace_level(a, s);
        break;
    case WORD_noise_generator:
        args_next(a);
        noise_generator(a, s);
        break;
    case WORD_charset:
        args_next(a);
        charset(a);
        break;
    case WORD_max_intersections:
        args_warning(a, args_span(a),
                     "max_intersections has no effect, as in POV-Ray 3.7");
        args_next(a);
        args_float(a, "max_intersections", &v);
        break;
    case WORD_hf_gray_16:
        args_warning(a, args_span(a),
                     "hf_gray_16 has no effect, as in POV-Ray 3.7; for a picture in grey "
                     "use Grayscale_Output=on, or +FNg");
        args_next(a);
        args_switch(a);
        break;
    default: return false;
    }
    if (a->failed)
        args_skip(a);
    return true;
}

bool build_settings(struct args *a, const struct ast *block)
{
    struct args in = args_of(a->b, block, a);
    struct settings *s = &a->b->e->scene->settings;
    while (in.at) {
        if (fields_read(&in, fields, ARRAY_COUNT(fields), s) || word_item(&in, s))
            continue;
        switch (args_at_block(&in)) {
        case WORD_radiosity: build_radiosity_settings(&in, args_next(&in)); break;
        case WORD_photons: build_photons_settings(&in, args_next(&in)); break;
        case WORD_subsurface: subsurface(&in, s); break;
        default:
            fields_unknown(&in, fields, ARRAY_COUNT(fields), other_words,
                           ARRAY_COUNT(other_words));
        }
    }
    return !in.failed;
}

bool build_old_setting(struct args *a)
{
    const struct ast *n = args_next(a);
    struct args in = args_list(a->b, n->list, n, "scene", a);
    if (n->word == WORD_max_trace_level)
        max_trace_level(&in, &a->b->e->scene->settings);
    args_warning(a, n->where, "this belongs into global_settings");
    return !in.failed;
}

void settings_noise(struct builder *b)
{
    struct settings *s = &b->e->scene->settings;
    if (!b->noise_set)
        s->noise_generator = b->e->version_seen && b->e->version < 350 ? 1 : 2;
    b->pattern_defaults->noise_generator = s->noise_generator;
}

// The number that decides rendering rules: the last #version, 3.62 when there is none.
void settings_finish(struct builder *b)
{
    struct settings *s = &b->e->scene->settings;
    struct span nowhere = {0};
    s->version = b->e->version_seen ? b->e->version : 362;
    settings_noise(b);
    if (!b->gamma_set) {
        s->gamma_mode = s->version >= 370 ? GAMMA_POWER : GAMMA_NONE;
        s->assumed_gamma = 1;
        diag_at(b->e->diags, DIAG_NO_GAMMA, nowhere,
                s->version >= 370 ? "1.0 is used" : "no gamma correction is done");
    }
    b->pattern_defaults->number_of_waves = s->number_of_waves;
}
