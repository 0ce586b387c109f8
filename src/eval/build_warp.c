#include "eval/build.h"

// warp { } (spec/textures 4).

static const enum word warp_words[] = {
    WORD_repeat,    WORD_black_hole,   WORD_turbulence, WORD_planar, WORD_cylindrical,
    WORD_spherical, WORD_toroidal,     WORD_cubic,      WORD_offset, WORD_flip,
    WORD_strength,  WORD_falloff,      WORD_inverse,    WORD_type,   WORD_orientation,
    WORD_dist_exp,  WORD_major_radius, WORD_octaves,    WORD_omega,  WORD_lambda};

#define AT(member) offsetof(struct warp, member)

static void read_fields(struct args *a, struct warp *w, const struct field *f, size_t n)
{
    while (a->at)
        if (!fields_read(a, f, n, w))
            args_unknown(a, warp_words, ARRAY_COUNT(warp_words));
}

static void repeat(struct args *a, struct warp *w)
{
    static const struct field fields[] = {{WORD_offset, FIELD_VEC3, AT(offset), 0, 0},
                                          {WORD_flip, FIELD_VEC3, AT(flip), 0, 0}};
    struct span where = args_span(a);
    w->kind = WARP_REPEAT;
    if (!args_vec3(a, "repeat", &w->repeat))
        return;
    if ((w->repeat.x != 0) + (w->repeat.y != 0) + (w->repeat.z != 0) != 1)
        args_error(a, where, "exactly one component of repeat must not be 0");
    read_fields(a, w, fields, 2);
}

// Keeps the hole inside its cell (spec/textures 4.2).
static void enlarge(double *centre, double *size, double radius, double uncertainty)
{
    if (*size > 0) {
        *centre = fmax(*centre, radius);
        *size = fmax(*size, *centre + radius + uncertainty);
    }
    if (*size < 1e-10)
        *size = 0;
}

static void black_hole(struct args *a, struct warp *w)
{
    static const struct field fields[] = {
        {WORD_strength, FIELD_DOUBLE, AT(strength), 0, 0},
        {WORD_falloff, FIELD_DOUBLE, AT(falloff), 0, 0},
        {WORD_inverse, FIELD_FLAG, AT(inverse), 0, 0},
        {WORD_type, FIELD_INT, AT(type), 0, 0},
    };
    w->kind = WARP_BLACK_HOLE;
    w->strength = 1;
    w->falloff = 2;
    args_vec3(a, "centre", &w->centre);
    args_float(a, "radius", &w->radius);
    while (a->at) {
        bool repeats = args_take(a, WORD_repeat);
        if (repeats || args_take(a, WORD_turbulence)) {
            struct vec3 *u = &w->uncertainty, *v = &w->repeat, *c = &w->centre;
            args_vec3(a, "vector", repeats ? v : u);
            enlarge(&c->x, &v->x, w->radius, u->x);
            enlarge(&c->y, &v->y, w->radius, u->y);
            enlarge(&c->z, &v->z, w->radius, u->z);
        } else if (!fields_read(a, fields, ARRAY_COUNT(fields), w)) {
            args_unknown(a, warp_words, ARRAY_COUNT(warp_words));
        }
    }
}

static void turbulence(struct args *a, struct warp *w)
{
    static const struct field fields[] = {
        {WORD_octaves, FIELD_NEAREST, AT(turbulence.octaves), 1, 10},
        {WORD_omega, FIELD_FLOAT, AT(turbulence.omega), 0, 0},
        {WORD_lambda, FIELD_FLOAT, AT(turbulence.lambda), 0, 0}};
    w->kind = WARP_TURBULENCE;
    w->turbulence = (struct turbulence){vec3(0, 0, 0), 6, 2, 0.5f};
    args_vec3(a, "turbulence", &w->turbulence.amount);
    read_fields(a, w, fields, ARRAY_COUNT(fields));
}

static void mapping(struct args *a, struct warp *w, enum warp_kind kind)
{
    static const struct field fields[] = {
        {WORD_orientation, FIELD_UNIT, AT(orientation), 0, 0},
        {WORD_dist_exp, FIELD_DOUBLE, AT(dist_exp), 0, 0},
        {WORD_major_radius, FIELD_DOUBLE, AT(major_radius), 0, 0}};
    w->kind = kind;
    w->orientation = vec3(0, 0, 1);
    w->major_radius = 1;
    if (kind == WARP_PLANAR) {
        if (args_at_number(a) && args_vec3(a, "orientation", &w->orientation)) {
            w->orientation = vec3_normalize(w->orientation);
            args_float(a, "distance", &w->distance);
        }
        read_fields(a, w, NULL, 0);
    } else {
        read_fields(a, w, fields, kind == WARP_TOROIDAL ? 3 : 2);
    }
}

bool build_warp(struct args *a, struct pattern *p)
{
    struct args in = args_of(a->b, args_next(a), a);
    struct warp *w = arena_new_struct(a->b->arena, struct warp);
    w->transform = transform_identity;
    enum word kind = args_at_word(&in);
    if (kind)
        args_next(&in);
    switch (kind) {
    case WORD_repeat: repeat(&in, w); break;
    case WORD_black_hole: black_hole(&in, w); break;
    case WORD_turbulence: turbulence(&in, w); break;
    case WORD_planar: mapping(&in, w, WARP_PLANAR); break;
    case WORD_cylindrical: mapping(&in, w, WARP_CYLINDRICAL); break;
    case WORD_spherical: mapping(&in, w, WARP_SPHERICAL); break;
    case WORD_toroidal: mapping(&in, w, WARP_TOROIDAL); break;
    case WORD_cubic:
        w->kind = WARP_CUBIC;
        read_fields(&in, w, NULL, 0);
        break;
    default: args_error(&in, args_span(&in), "a kind of warp is expected"); return true;
    }
    if (!in.failed)
        pattern_add_warp(a->b->arena, p, w);
    return true;
}
