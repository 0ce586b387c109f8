#include "eval/build.h"
#include "math/elementary.h"

// finish { } (spec/language 4.10, spec/textures 12.6).

#define AT(member) offsetof(struct finish, member)
static const struct field finish_fields[] = {
    {WORD_ambient, FIELD_RGB, AT(ambient), 0, 0},
    {WORD_emission, FIELD_RGB, AT(emission), 0, 0},
    {WORD_brilliance, FIELD_FLOAT, AT(brilliance), 0, 0},
    {WORD_crand, FIELD_FLOAT, AT(crand), 0, 0},
    {WORD_phong_size, FIELD_FLOAT, AT(phong_size), 0, 0},
    {WORD_metallic, FIELD_METALLIC, AT(metallic), 0, 0},
    {WORD_reflection_exponent, FIELD_RECIPROCAL, AT(reflection_exponent), 0, 0},
    {WORD_conserve_energy, FIELD_SWITCH, AT(conserve_energy), 0, 0},
};
static const struct field old_fields[] = {
    {WORD_ior, FIELD_FLOAT, AT(old_ior), 0, 0},
    {WORD_caustics, FIELD_FLOAT, AT(old_caustics), 0, 0},
    {WORD_refraction, FIELD_FLOAT, AT(old_refraction), 0, 0},
};
static const struct field reflection_fields[] = {
    {WORD_fresnel, FIELD_SWITCH, AT(fresnel), 0, 0},
    {WORD_falloff, FIELD_FLOAT, AT(reflection_falloff), 0, 0},
    {WORD_exponent, FIELD_RECIPROCAL, AT(reflection_exponent), 0, 0},
    {WORD_metallic, FIELD_METALLIC, AT(reflection_metallic), 0, 0},
};
static const struct field irid_fields[] = {
    {WORD_thickness, FIELD_FLOAT, AT(irid_thickness), 0, 0},
};
static const enum word other_words[] = {
    WORD_diffuse, WORD_phong,      WORD_specular, WORD_roughness, WORD_reflection,
    WORD_irid,    WORD_subsurface, WORD_ior,      WORD_caustics,  WORD_refraction};

// Which of the three were written with `albedo`: scaled when the block ends.
struct albedo {
    bool diffuse, phong, specular;
};

static void read_float(struct args *a, const char *role, float *out)
{
    double v;
    if (args_float(a, role, &v))
        *out = (float)v;
    else
        args_skip(a);
}

static void diffuse(struct args *a, struct finish *f, struct albedo *albedo)
{
    double back = 0;
    if (args_take(a, WORD_albedo))
        albedo->diffuse = true;
    read_float(a, "diffuse", &f->diffuse);
    if (args_optional(a, &back))
        f->diffuse_back = (float)back;
    f->matt = f->diffuse;
    f->matt_back = f->diffuse_back;
}

static void roughness(struct args *a, struct finish *f)
{
    double r;
    struct span where = args_span(a);
    if (!args_float(a, "roughness", &r)) {
        args_skip(a);
        return;
    }
    if (r == 0)
        args_warning(a, where, "roughness 0 is ignored");
    f->roughness = r == 0 ? 0 : (float)(1 / r);
}

static void reflection_block(struct args *a, struct finish *f)
{
    static const struct rgb none = {0, 0, 0};
    struct args in = args_of(a->b, args_next(a), a);
    bool two = false;
    f->fresnel = false;
    f->reflection_falloff = 1;
    if (args_rgb(&in, &f->reflection_max)) {
        f->reflection_min = f->reflection_max;
        if (args_at_color(&in) || args_at_number(&in)) {
            two = true;
            args_rgb(&in, &f->reflection_max);
        }
    }
    while (in.at)
        if (!fields_read(&in, reflection_fields, ARRAY_COUNT(reflection_fields), f))
            fields_unknown(&in, reflection_fields, ARRAY_COUNT(reflection_fields), NULL,
                           0);
    if (f->fresnel && !two)
        f->reflection_min = none;
}

static void reflection(struct args *a, struct finish *f)
{
    args_next(a);
    f->fresnel = false;
    f->reflection_falloff = 1;
    if (args_rgb(a, &f->reflection_max))
        f->reflection_min = f->reflection_max;
    else
        args_skip(a);
}

static void irid(struct args *a, struct finish *f)
{
    static const enum word more[] = {WORD_turbulence};
    struct args in = args_of(a->b, args_next(a), a);
    struct vec3 v;
    read_float(&in, "amount", &f->irid);
    while (in.at) {
        if (args_take(&in, WORD_turbulence)) {
            if (args_vec3(&in, "turbulence", &v))
                f->irid_turbulence = (float)v.x;
            else
                args_skip(&in);
        } else if (!fields_read(&in, irid_fields, ARRAY_COUNT(irid_fields), f)) {
            fields_unknown(&in, irid_fields, ARRAY_COUNT(irid_fields), more,
                           ARRAY_COUNT(more));
        }
    }
}

static void subsurface(struct args *a, struct finish *f)
{
    static const struct field fields[] = {
        {WORD_translucency, FIELD_RGB, AT(subsurface_translucency), 0, 0},
        {WORD_anisotropy, FIELD_RGB, AT(subsurface_anisotropy), 0, 0},
    };
    const struct ast *block = args_next(a);
    struct args in = args_of(a->b, block, a);
    f->has_subsurface = true;
    while (in.at)
        if (!fields_read(&in, fields, ARRAY_COUNT(fields), f))
            fields_unknown(&in, fields, ARRAY_COUNT(fields), NULL, 0);
}

static bool block_item(struct args *a, struct finish *f)
{
    switch (args_at_block(a)) {
    case WORD_reflection: reflection_block(a, f); return true;
    case WORD_irid: irid(a, f); return true;
    case WORD_subsurface: subsurface(a, f); return true;
    default: return false;
    }
}

static bool word_item(struct args *a, struct finish *f, struct albedo *albedo)
{
    switch (args_at_word(a)) {
    case WORD_reflection: reflection(a, f); return true;
    case WORD_diffuse:
        args_next(a);
        diffuse(a, f, albedo);
        return true;
    case WORD_phong:
        args_next(a);
        albedo->phong |= args_take(a, WORD_albedo);
        read_float(a, "phong", &f->phong);
        return true;
    case WORD_specular:
        args_next(a);
        albedo->specular |= args_take(a, WORD_albedo);
        read_float(a, "specular", &f->specular);
        return true;
    case WORD_roughness:
        args_next(a);
        roughness(a, f);
        return true;
    default:
        if (!fields_read(a, old_fields, ARRAY_COUNT(old_fields), f))
            return false;
        return true;
    }
}

// The factors make the albedo, not the peak, the number that was written.
static void apply_albedo(struct finish *f, const struct albedo *albedo)
{
    if (albedo->diffuse) {
        f->diffuse *= (f->brilliance + 1) / 2;
        f->diffuse_back *= (f->brilliance + 1) / 2;
    }
    if (albedo->phong)
        f->phong *= (f->phong_size + 1) / 2;
    if (albedo->specular) {
        double r = f->roughness;
        f->specular = (float)(f->specular * (r + 2) / (4 * (2 - det_pow(2, -r / 2))));
    }
}

const struct finish *build_finish(struct args *a, const struct ast *block,
                                  const struct finish *start)
{
    struct args in = args_of(a->b, block, a);
    const struct value *id = args_take_value(&in, VALUE_FINISH);
    struct finish f = id ? *(const struct finish *)id->data : *start;
    struct albedo albedo = {0};
    if (!in.at)
        return id ? id->data : start;
    while (in.at)
        if (!fields_read(&in, finish_fields, ARRAY_COUNT(finish_fields), &f) &&
            !block_item(&in, &f) && !word_item(&in, &f, &albedo))
            fields_unknown(&in, finish_fields, ARRAY_COUNT(finish_fields), other_words,
                           ARRAY_COUNT(other_words));
    if (in.failed)
        return NULL;
    apply_albedo(&f, &albedo);
    struct finish *out = arena_new_struct(a->b->arena, struct finish);
    *out = f;
    return out;
}
