// text { ttf "font" "string", depth, <offset> }
//
// Every character is a solid: its TrueType or OpenType outline (even-odd) swept from
// z = 0 to z = depth; the string is the union of its characters. Units are ems, the
// baseline is y = 0. Layout as POV-Ray's (spec/shapes.md 4.26): the first character
// starts at its left edge; pairs are kerned; the offset is added after each character.
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <string.h>

#include "base/arena.h"
#include "base/library.h"
#include "math/transform.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shapes/extrude.h"
#include "scene/shapes/extrude_lanes.h"

#define FUNCTIONS(F)                                                                     \
    F(FT_Done_Face)                                                                      \
    F(FT_Done_FreeType)                                                                  \
    F(FT_Get_Char_Index)                                                                 \
    F(FT_Get_Kerning)                                                                    \
    F(FT_Init_FreeType)                                                                  \
    F(FT_Load_Glyph)                                                                     \
    F(FT_New_Face)                                                                       \
    F(FT_Outline_Decompose)

struct freetype {
    FUNCTIONS(LIBRARY_POINTER)
};

#ifdef FREETYPE_SONAME
LIBRARY_LOADED(freetype, FREETYPE_SONAME)
#else
LIBRARY_LINKED(freetype)
#endif

struct text {
    struct outline *glyph;
    uint32_t count;
    double depth;
    struct transform
        tilt; // the language turns every text by 0.001 degrees about each axis
    const char *font, *string;
};

// ---- outlines -----------------------------------------------------------

struct pen {
    struct outline *outline;
    struct vec2 at, start, shift;
    double scale;
    bool open;
};

static struct vec2 place(const struct pen *p, const FT_Vector *v)
{
    return (struct vec2){(double)v->x * p->scale + p->shift.u,
                         (double)v->y * p->scale + p->shift.v};
}

static void close_contour(struct pen *p)
{
    if (p->open)
        outline_line(p->outline, p->at, p->start);
    p->open = false;
}

static int move_to(const FT_Vector *to, void *user)
{
    struct pen *p = user;
    close_contour(p);
    p->start = p->at = place(p, to);
    p->open = true;
    return 0;
}

static int line_to(const FT_Vector *to, void *user)
{
    struct pen *p = user;
    struct vec2 b = place(p, to);
    outline_line(p->outline, p->at, b);
    p->at = b;
    return 0;
}

static int conic_to(const FT_Vector *control, const FT_Vector *to, void *user)
{
    struct pen *p = user;
    struct vec2 b = place(p, to);
    outline_parabola(p->outline, p->at, place(p, control), b);
    p->at = b;
    return 0;
}

static int cubic_to(const FT_Vector *c1, const FT_Vector *c2, const FT_Vector *to,
                    void *user)
{
    struct pen *p = user;
    struct vec2 b = place(p, to);
    outline_cubic(p->outline, p->at, place(p, c1), place(p, c2), b);
    p->at = b;
    return 0;
}

// ---- layout -------------------------------------------------------------

// The next character of UTF-8 text; a byte that is not UTF-8 stands for itself (Latin-1).
static uint32_t next_character(const char **at)
{
    const unsigned char *s = (const unsigned char *)*at;
    int more = s[0] >= 0xf0 ? 3 : s[0] >= 0xe0 ? 2 : s[0] >= 0xc0 ? 1 : 0;
    uint32_t c = more ? s[0] & (0x3fu >> more) : s[0];
    for (int i = 1; i <= more; i++) {
        if ((s[i] & 0xc0) != 0x80) {
            *at += 1;
            return s[0];
        }
        c = c << 6 | (s[i] & 0x3fu);
    }
    *at += 1 + more;
    return c;
}

// Fonts made of symbols keep their characters at 0xf000.
static FT_UInt glyph_index(const struct freetype *lib, FT_Face face, uint32_t c)
{
    FT_UInt index = lib->FT_Get_Char_Index(face, c);
    if (index == 0 && c < 256)
        index = lib->FT_Get_Char_Index(face, 0xf000u + c);
    return index;
}

struct layout {
    const struct freetype *lib;
    FT_Face face;
    struct arena *arena;
    double em;
    struct vec2 pen, offset;
    FT_UInt previous;
};

static bool add_character(struct text *t, struct layout *l, uint32_t c)
{
    const struct freetype *lib = l->lib;
    FT_UInt index = glyph_index(lib, l->face, c);
    if (lib->FT_Load_Glyph(l->face, index, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP))
        return false;
    const FT_GlyphSlot slot = l->face->glyph;
    const double bearing = (double)slot->metrics.horiBearingX / l->em;
    const double advance = (double)slot->metrics.horiAdvance / l->em;
    struct vec2 shift = l->pen;
    if (t->count == 0 && l->previous == 0)
        shift.u -= bearing; // the first starts at its left edge
    FT_Vector kern = {0, 0};
    if (l->previous)
        lib->FT_Get_Kerning(l->face, l->previous, index, FT_KERNING_UNSCALED, &kern);
    shift.u += (double)kern.x / l->em;
    shift.v += (double)kern.y / l->em;
    l->pen.u = shift.u + advance + l->offset.u;
    l->pen.v += l->offset.v;
    l->previous = index;
    if (c == ' ' || slot->outline.n_points == 0)
        return true;
    static const FT_Outline_Funcs funcs = {.move_to = move_to,
                                           .line_to = line_to,
                                           .conic_to = conic_to,
                                           .cubic_to = cubic_to};
    struct outline *g = &t->glyph[t->count++];
    outline_init(g, l->arena);
    struct pen pen = {g, {0, 0}, {0, 0}, shift, 1 / l->em, false};
    if (lib->FT_Outline_Decompose(&slot->outline, &funcs, &pen))
        return false;
    close_contour(&pen);
    return true;
}

static bool lay_out(const struct freetype *lib, struct text *t, const char *path,
                    struct vec3 offset, struct arena *arena)
{
    FT_Library library;
    if (lib->FT_Init_FreeType(&library))
        return false;
    struct layout l = {.lib = lib, .arena = arena, .offset = {offset.x, offset.y}};
    bool ok = lib->FT_New_Face(library, path, 0, &l.face) == 0;
    if (ok) {
        l.em = l.face->units_per_EM ? l.face->units_per_EM : 1000;
        t->glyph = arena_new_array(arena, struct outline, strlen(t->string) + 1);
        for (const char *at = t->string; *at && ok;)
            ok = add_character(t, &l, next_character(&at));
        lib->FT_Done_Face(l.face);
    }
    lib->FT_Done_FreeType(library);
    return ok;
}

static bool read_font(struct text *t, struct args *args)
{
    static const char *const internal[] = {"timrom.ttf", "cyrvetic.ttf", "crystal.ttf"};
    if (args_word(args, "internal")) {
        long k;
        if (!args_int(args, "number of the font", &k))
            return false;
        t->font = k >= 1 && k <= 3 ? internal[k - 1] : "povlogo.ttf";
        return true;
    }
    args_word(args, "ttf");
    return args_string(args, "font file", &t->font);
}

static bool build(void *shape, struct args *args)
{
    struct text *t = shape;
    struct vec3 offset;
    const char *path;
    if (!read_font(t, args) ||
        !args_string(args, "text behind the font file", &t->string) ||
        !args_float(args, "depth", &t->depth) || !args_vec3(args, "offset", &offset) ||
        !args_find_file(args, "font", t->font, ".ttf", &path))
        return false;
    t->tilt = transform_rotate(vec3(0.001, 0.001, 0.001));
    struct freetype lib;
    char why[256];
    if (!load(&lib, why, sizeof why)) {
        args_reject(args, why);
        return false;
    }
    if (!lay_out(&lib, t, path, offset, args_arena(args))) {
        args_reject(args, "the font cannot be read");
        return false;
    }
    return true;
}

// ---- geometry -----------------------------------------------------------

static struct aabb bounds(const void *shape)
{
    const struct text *t = shape;
    struct aabb box = aabb_empty();
    for (uint32_t i = 0; i < t->count; i++) {
        const struct outline *g = &t->glyph[i];
        box = aabb_add(box, vec3(g->min.u, g->min.v, 0));
        box = aabb_add(box, vec3(g->max.u, g->max.v, t->depth));
    }
    return aabb_is_empty(box) ? box : aabb_transform(box, &t->tilt);
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct text *t = shape;
    const struct vec3 q = transform_inverse_point(&t->tilt, p);
    if (!(q.z >= 0 && q.z <= t->depth))
        return false;
    for (uint32_t i = 0; i < t->count; i++)
        if (outline_inside(&t->glyph[i], (struct vec2){q.x, q.y}))
            return true;
    return false;
}

// Whether the line of the ray passes the glyph's rectangle in (x, y), generously.
static bool passes(const struct outline *g, const struct ray *r)
{
    const double cx = 0.5 * (g->min.u + g->max.u) - r->o.x;
    const double cy = 0.5 * (g->min.v + g->max.v) - r->o.y;
    const double hx = g->max.u - g->min.u, hy = g->max.v - g->min.v;
    return fabs(r->d.y * cx - r->d.x * cy) <= fabs(r->d.y) * hx + fabs(r->d.x) * hy;
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct text *t = shape;
    const struct ray r = transform_inverse_ray(&t->tilt, ray);
    const struct extrude_ray e = {{r.o.x, r.o.y, r.o.z}, {r.d.x, r.d.y, r.d.z}};
    const uint32_t from = out->count;
    int hit = 0;
    for (uint32_t i = 0; i < t->count; i++) {
        const uint32_t before = out->count;
        if (!passes(&t->glyph[i], &r))
            continue;
        extrude_intersect(&t->glyph[i], 0, t->depth, false, &e, out);
        for (uint32_t j = before; j < out->count; j++)
            out->at[j].part |= i << 16; // the character, above the part within it
        hit += out->count > before;
    }
    if (hit > 1) {
        boundary_list_sort(out, from);
        boundary_list_merge(out, from);
    }
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    (void)any;
    const struct text *t = shape;
    const struct extrude_solid e = {t->glyph, t->count, 0,         t->depth,
                                    false,    false,    {0, 1, 2}, &t->tilt};
    unsigned odd;
    const unsigned met = k->extrude(&e, rays, lanes, out, &odd);
    return met | shape_lanes_alone(&text_ops, t, rays, odd, out);
}

static bool has_lanes(const void *shape)
{
    const struct text *t = shape;
    return t->depth >= 0;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct text *t = shape;
    struct boundary local = *b;
    local.part &= 0xffff;
    const struct vec3 n = extrude_normal(&t->glyph[b->part >> 16], &local);
    out->p = p;
    out->ng = out->ns = vec3_normalize(transform_normal(&t->tilt, n));
    out->uv = (struct vec2){p.x, p.y};
}

static void print(const void *shape, FILE *out)
{
    const struct text *t = shape;
    fprintf(out, "text { ttf \"%s\" \"%s\", ", t->font, t->string);
    shape_print_number(out, t->depth);
    fputs(", 0", out);
}

const struct shape_ops text_ops = {
    .keyword = "text",
    .size = sizeof(struct text),
    .flags = SHAPE_SOLID | SHAPE_FLAT | SHAPE_BOUNDED | SHAPE_BOUND_BOX,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .has_lanes = has_lanes,
    .surface = surface,
    .print = print,
};
