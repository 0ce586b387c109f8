#include "eval/image_source.h"

#include <math.h>
#include <string.h>

#include "eval/expr.h"
#include "eval/function.h"
#include "image/texels.h"
#include "scene/image_map.h"

struct image_file {
    const char *path;
    const struct texels *texels;
    bool joined; // as `pot`
    struct image_file *next;
};

static enum image_type type_of_word(enum word w, bool *pot)
{
    static const struct {
        enum word word;
        enum image_type type;
    } types[] = {{WORD_gif, IMAGE_GIF}, {WORD_tga, IMAGE_TGA},   {WORD_iff, IMAGE_IFF},
                 {WORD_pot, IMAGE_GIF}, {WORD_ppm, IMAGE_PPM},   {WORD_pgm, IMAGE_PPM},
                 {WORD_png, IMAGE_PNG}, {WORD_jpeg, IMAGE_JPEG}, {WORD_tiff, IMAGE_TIFF},
                 {WORD_bmp, IMAGE_BMP}, {WORD_exr, IMAGE_EXR},   {WORD_hdr, IMAGE_HDR},
                 {WORD_sys, IMAGE_BMP}};
    *pot = w == WORD_pot;
    for (size_t i = 0; w && i < ARRAY_COUNT(types); i++)
        if (types[i].word == w)
            return types[i].type;
    return IMAGE_UNKNOWN;
}

// The texels move into the scene's arena, which counts them as the scene's memory.
static const struct texels *keep(struct args *a, struct span where, struct texels *t)
{
    struct arena *arena = a->b->arena;
    const size_t palette = 4 * (size_t)t->palette_count, size = texels_size(t) - palette;
    struct texels *kept = NULL;
    if (eval_has_memory(a->b->e, where, size)) {
        kept = arena_new_struct(arena, struct texels);
        *kept = *t;
        kept->data = memcpy(arena_alloc(arena, size), t->data, size);
        if (palette)
            kept->palette = memcpy(arena_alloc(arena, palette), t->palette, palette);
    } else {
        args_fail(a);
    }
    texels_free(t);
    return kept;
}

// A file is read once a scene.
static const struct texels *read_file(struct args *a, struct span where, const char *path,
                                      enum image_type type, bool pot)
{
    struct arena *arena = a->b->arena;
    for (const struct image_file *f = a->b->images; f; f = f->next)
        if (strcmp(f->path, path) == 0 && f->joined == pot)
            return f->texels;
    char error[256];
    struct texels t;
    if (!texels_read(&t, path, type, error, sizeof error)) {
        args_error(a, where,
                   arena_printf(arena, "the image '%s' cannot be read: %s", path, error));
        return NULL;
    }
    if (pot && !texels_join_halves(&t)) {
        args_error(a, where,
                   arena_printf(arena, "'%s' is no image of the type pot", path));
        texels_free(&t);
        return NULL;
    }
    struct image_file *f = arena_new_struct(arena, struct image_file);
    *f = (struct image_file){path, keep(a, where, &t), pot, a->b->images};
    if (f->texels)
        a->b->images = f;
    return f->texels;
}

// A name without an extension may have that of any type.
static const char *with_extension(struct args *a, const char *name)
{
    static const char *const all[] = {"tga",  "png", "ppm",  "pgm", "gif", "iff", "jpg",
                                      "jpeg", "tif", "tiff", "bmp", "exr", "hdr"};
    const char *slash = strrchr(name, '/'), *path;
    if (strchr(slash ? slash : name, '.'))
        return name;
    for (size_t i = 0; i < ARRAY_COUNT(all); i++) {
        const char *longer = arena_printf(a->b->arena, "%s.%s", name, all[i]);
        if (args_look_for_file(a, longer, &path))
            return longer;
    }
    return name;
}

static bool named_file(struct args *a, struct image_source *s)
{
    bool pot;
    const enum word w = args_at_word(a);
    const enum image_type type = type_of_word(w, &pot);
    const char *name, *path;
    if (type != IMAGE_UNKNOWN)
        args_next(a);
    const struct span where = args_span(a);
    const char *extension = type == IMAGE_UNKNOWN ? "png" : pot ? "gif" : word_text(w);
    if (!args_string(a, "image file", &name))
        return false;
    if (type == IMAGE_UNKNOWN)
        name = with_extension(a, name);
    if (!args_find_file(a, "image file", name, extension, &path))
        return false;
    s->texels = read_file(a, where, path, type, pot);
    return s->texels;
}

// ---- function W, H { } -------------------------------------------------------
static bool image_size(struct args *a, const struct ast *n, int *out)
{
    double v;
    if (!eval_float(a->b->e, n, &v)) {
        args_fail(a);
        return false;
    }
    v = v + 0.5;
    if (!(v >= 1 && v < 65536)) {
        args_error(a, n->where, "the sizes of an image are 1 to 65535");
        return false;
    }
    *out = (int)v;
    return true;
}

// As 16 bits hold it: values outside 0..1 wrap.
static uint16_t stored(double v)
{
    v *= 65535;
    return v > -1e9 && v < 1e9 ? (uint16_t)(int32_t)v : 0;
}

static double share(int i, int count)
{
    return count > 1 ? (double)i / (count - 1) : 0; // one texel alone is taken at 0
}

// Eight texels of a row at once.
static void fill(const struct tape *f, const struct texels *t, uint16_t *out)
{
    double at[3][TAPE_LANES] = {0}, c[5][TAPE_LANES] = {0};
    for (int y = 0; y < t->height; y++) {
        for (int lane = 0; lane < TAPE_LANES; lane++)
            at[1][lane] = share(y, t->height);
        for (int x = 0; x < t->width; x += TAPE_LANES) {
            const int here = t->width - x < TAPE_LANES ? t->width - x : TAPE_LANES;
            for (int lane = 0; lane < TAPE_LANES; lane++)
                at[0][lane] = share(lane < here ? x + lane : x, t->width);
            tape_run_packet(f, (const double(*)[TAPE_LANES])at, c);
            for (int lane = 0; lane < here; lane++)
                for (int k = 0; k < t->channels; k++)
                    *out++ = stored(k == 3 ? 1 - c[4][lane] : c[k][lane]);
        }
    }
}

static bool function_image(struct args *a, struct image_source *s)
{
    struct arena *arena = a->b->arena;
    const struct ast *block = args_next(a), *sizes = block->list;
    const struct span where = block->where;
    struct texels *t = arena_new_struct(arena, struct texels);
    if (!sizes || !sizes->next || !sizes->next->next) {
        args_error(a, where, "an image by a function needs sizes: function W, H { }");
        return false;
    }
    if (!image_size(a, sizes, &t->width) || !image_size(a, sizes->next, &t->height))
        return false;
    struct ast body = *block;
    body.list = ast_copy(a->b->e->parse, sizes->next->next);
    const struct value *v = function_value(a->b->e, &body);
    if (!v) {
        args_fail(a);
        return false;
    }
    const struct tape *f = function_tape(a->b->e, v);
    const int width = tape_width(f);
    if (tape_arguments(f) != 3 || (width != 1 && width != 5)) {
        args_error(a, where,
                   "a function of x, y, z with a number or a colour is expected");
        return false;
    }
    t->type = IMAGE_UNKNOWN;
    t->channels = width == 1 ? 1 : 4;
    t->format = TEXEL_U16;
    t->max = 65535;
    if (!eval_has_memory(a->b->e, where, texels_size(t))) {
        args_fail(a);
        return false;
    }
    t->data = arena_alloc(arena, texels_size(t));
    fill(f, t, t->data);
    s->texels = t;
    return true;
}

// ---- gamma -------------------------------------------------------------------
// Gammas this near to 1 are none (spec/lighting 3.1).
#define GAMMA_NONE_BAND 0.01

static struct transfer power(double g)
{
    if (fabs(1 - 1 / g) <= GAMMA_NONE_BAND)
        return (struct transfer){TRANSFER_NONE, 1};
    return (struct transfer){TRANSFER_POWER, g};
}

static void read_gamma(struct args *a, struct image_source *s)
{
    const struct span where = args_span(a);
    double g;
    s->has_gamma = true;
    s->gamma = (struct transfer){TRANSFER_SRGB, 0};
    if (args_take(a, WORD_srgb) || !args_float(a, "gamma", &g))
        return;
    if (g <= 0) {
        args_error(a, where, "gamma must be above 0");
        return;
    }
    if (g < 1)
        args_warning(a, where, "a gamma below 1 is unusual: it decodes the file");
    s->gamma = power(g);
}

static void working_space(const struct settings *s, struct image_map *m)
{
    if (s->gamma_mode == GAMMA_SRGB)
        m->working = (struct transfer){TRANSFER_SRGB, 0};
    else if (s->gamma_mode == GAMMA_POWER && s->assumed_gamma > 0)
        m->working = power(s->assumed_gamma);
}

static void default_decoding(const struct texels *t, struct image_map *m)
{
    static const struct transfer srgb = {TRANSFER_SRGB, 0};
    switch (t->type) {
    case IMAGE_PNG:
        m->decode = !t->has_encoding                     ? srgb
                    : t->encoding.kind == TRANSFER_POWER ? power(t->encoding.gamma)
                                                         : t->encoding;
        break;
    case IMAGE_GIF:
    case IMAGE_JPEG:
    case IMAGE_TGA:
    case IMAGE_BMP: m->decode = srgb; break;
    default: break; // the numbers are light
    }
}

void image_source_decode(struct args *a, const struct image_source *s,
                         struct image_map *m)
{
    const struct settings *set = &a->b->e->scene->settings;
    const struct texels *t = s->texels;
    const bool is_new = a->b->e->version_seen && a->b->e->version >= 370;
    const bool light = t->type == IMAGE_EXR || t->type == IMAGE_HDR;
    if (t->type == IMAGE_UNKNOWN) // made by a function
        return;
    if (!is_new && !a->b->gamma_set) { // no gamma handling but what is asked for
        if (s->has_gamma)
            m->decode = s->gamma;
        return;
    }
    if (s->has_gamma)
        m->decode = s->gamma;
    else if (is_new || t->has_encoding || light)
        default_decoding(t, m);
    else
        return; // taken for the working space's own numbers
    working_space(set, m);
    if (transfer_equal(m->decode, m->working))
        m->decode = m->working = (struct transfer){TRANSFER_NONE, 1};
}

bool image_source_read(struct args *a, struct image_source *s)
{
    struct vec3 old;
    *s = (struct image_source){0};
    if (args_at_number(a)) {
        args_warning(a, args_span(a), "the orientation of an image is not used");
        args_vec3(a, "orientation", &old);
    }
    if (args_at_block(a) == WORD_function)
        return function_image(a, s);
    if (!named_file(a, s))
        return false;
    s->premultiplied = s->texels->premultiplied;
    while (a->at) {
        double v;
        if (args_take(a, WORD_gamma))
            read_gamma(a, s);
        else if (args_take(a, WORD_premultiplied))
            s->premultiplied = args_float(a, "premultiplied", &v) && v != 0;
        else
            break;
    }
    return true;
}

const struct texels *args_image(struct args *a, struct transfer *decode)
{
    struct image_source s;
    if (!image_source_read(a, &s))
        return NULL;
    *decode = s.has_gamma ? s.gamma : (struct transfer){TRANSFER_NONE, 1};
    return s.texels;
}
