// The readers of scene/args.h over a flat text: numbers, words and { }. Vectors are their
// components; '<', '>' and ',' are blanks.
#include "fake_args.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "eval/formula.h"
#include "image/texels.h"
#include "math/transform.h"
#include "scene/args.h"
#include "scene/shapes/mesh.h"

struct args {
    const char *at;
    struct arena *arena;
    struct diag_sink *diags;
    struct args *parent;
    bool failed;
    void *shared;
};

struct args *fake_args_new(struct arena *a, struct diag_sink *sink, const char *text)
{
    struct args *args = arena_new_struct(a, struct args);
    args->at = text;
    args->arena = a;
    args->diags = sink;
    return args;
}

bool fake_args_failed(const struct args *a) { return a->failed; }

static const char *blank(const char *s)
{
    while (*s && strchr(" ,<>\n", *s))
        s++;
    return s;
}

bool args_vectors(struct args *a, struct args_vectors *out)
{
    (void)a;
    (void)out;
    return false;
}

bool args_at_number(struct args *a)
{
    const char *s = blank(a->at); // '<' stays for args_at_vector
    return isdigit((unsigned char)*s) || *s == '-' || *s == '.';
}

bool args_at_vector(struct args *a)
{
    while (*a->at == ' ' || *a->at == ',' || *a->at == '>')
        a->at++;
    return *a->at == '<';
}

bool args_float(struct args *a, const char *role, double *out)
{
    (void)role;
    if (!args_at_number(a))
        return false;
    char *end;
    *out = strtod(blank(a->at), &end);
    a->at = end;
    return true;
}

bool args_int(struct args *a, const char *role, long *out)
{
    double v;
    if (!args_float(a, role, &v))
        return false;
    *out = (long)v;
    return true;
}

bool args_floats(struct args *a, const char *role, double *out, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!args_float(a, role, &out[i]))
            return false;
    return true;
}

bool args_vec2(struct args *a, const char *role, struct vec2 *out)
{
    return args_float(a, role, &out->u) && args_float(a, role, &out->v);
}

bool args_vec3(struct args *a, const char *role, struct vec3 *out)
{
    return args_float(a, role, &out->x) && args_float(a, role, &out->y) &&
           args_float(a, role, &out->z);
}

bool args_vec4(struct args *a, const char *role, double out[4])
{
    return args_floats(a, role, out, 4);
}

bool args_word(struct args *a, const char *word)
{
    a->at = blank(a->at);
    const size_t n = strlen(word);
    if (strncmp(a->at, word, n) != 0 || isalnum((unsigned char)a->at[n]) ||
        a->at[n] == '_' || *blank(a->at + n) == '{')
        return false;
    a->at += n;
    return true;
}

struct args *args_block(struct args *a, const char *word)
{
    a->at = blank(a->at);
    const size_t n = strlen(word);
    const char *open = strncmp(a->at, word, n) == 0 ? blank(a->at + n) : "";
    if (*open != '{')
        return NULL;
    const char *end = open + 1;
    for (int depth = 1; *end && depth; end++)
        depth += (*end == '{') - (*end == '}');
    struct args *inner = fake_args_new(
        a->arena, a->diags, arena_strndup(a->arena, open + 1, (size_t)(end - open - 2)));
    inner->parent = a;
    a->at = end;
    return inner;
}

struct mesh_soup *args_faces(struct args *a)
{
    struct mesh_soup *all = NULL;
    for (;;) {
        struct args *flat = args_block(a, "triangle");
        struct args *smooth = flat ? NULL : args_block(a, "smooth_triangle");
        if (!flat && !smooth)
            return all;
        all = all ? all : mesh_soup_new(a->arena);
        mesh_soup_add(all, flat ? flat : smooth, smooth);
    }
}

// Contents up to the closing bracket, and the number behind a colon.
struct args *args_call(struct args *a, const char *word)
{
    a->at = blank(a->at);
    const size_t n = strlen(word);
    const char *open = strncmp(a->at, word, n) == 0 ? blank(a->at + n) : "";
    const char *end = strchr(open, ')');
    if (*open != '(' || !end)
        return NULL;
    char *text = arena_strndup(a->arena, open + 1, strlen(open + 1));
    char *stop = text + (end - open - 1);
    *stop = ' ';
    if (*blank(end + 1) == ':') {
        char *colon = strchr(stop, ':');
        *colon = ' ';
        strtod(colon, &stop);
    }
    a->at = open + 1 + (stop - text);
    a->at += *a->at == ')';
    *stop = 0;
    struct args *inner = fake_args_new(a->arena, a->diags, text);
    inner->parent = a;
    return inner;
}

const struct tape *args_function(struct args *a, const char *role)
{
    (void)role;
    struct args *in = args_block(a, "function");
    if (!in)
        return NULL;
    struct tape_builder *b = tape_builder_new(a->arena);
    const uint32_t at[] = {tape_argument(b, 0), tape_argument(b, 1), tape_argument(b, 2)};
    const uint32_t out = formula_build(b, in->at, at, NULL);
    return tape_finish(b, a->arena, 3, &out, 1);
}

bool args_end(struct args *a) { return !*blank(a->at); }

void args_reject(struct args *a, const char *message)
{
    (void)message;
    for (; a; a = a->parent)
        a->failed = true;
}

void args_warn(struct args *a, const char *message)
{
    (void)a;
    (void)message;
}

bool args_string(struct args *a, const char *role, const char **out)
{
    (void)a;
    (void)role;
    (void)out;
    return false;
}

bool args_find_file(struct args *a, const char *role, const char *name,
                    const char *extension, const char **path)
{
    (void)a;
    (void)role;
    (void)name;
    (void)extension;
    (void)path;
    return false;
}

// Hills, 9 by 7 samples.
const struct texels *args_image(struct args *a, struct transfer *decode)
{
    struct texels *t = arena_new_struct(a->arena, struct texels);
    uint16_t *at = arena_new_array(a->arena, uint16_t, 63);
    for (int i = 0; i < 63; i++)
        at[i] = (uint16_t)(20000 + (i * 7919) % 40000);
    *t = (struct texels){.width = 9,
                         .height = 7,
                         .channels = 1,
                         .format = TEXEL_U16,
                         .max = 65535,
                         .data = at};
    *decode = (struct transfer){TRANSFER_NONE, 1};
    return t;
}

bool args_part(struct args *a, struct transform *out, const struct texture **texture)
{
    (void)a;
    *texture = NULL;
    *out = transform_identity;
    return true;
}

const struct texture *args_texture(struct args *a)
{
    (void)a;
    return NULL;
}

bool args_at_texture(struct args *a)
{
    (void)a;
    return false;
}

bool args_pov_patches(struct args *a)
{
    (void)a;
    return false;
}
struct arena *args_arena(struct args *a) { return a->arena; }
void **args_shared(struct args *a) { return &a->shared; }
struct diag_sink *args_diags(struct args *a) { return a->diags; }
struct span args_where(struct args *a)
{
    (void)a;
    return (struct span){0};
}
const char *args_owner(struct args *a)
{
    (void)a;
    return "shape";
}
