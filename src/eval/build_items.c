#include "eval/build.h"

#include <string.h>

#include "eval/builder.h"
#include "eval/include_hint.h"

// The cursor over a block's items and the tables of simple items.

struct args args_list(struct builder *b, const struct ast *items, const struct ast *owner,
                      const char *name, struct args *parent)
{
    return (struct args){
        .b = b, .at = items, .owner = owner, .name = name, .parent = parent};
}

struct args args_of(struct builder *b, const struct ast *block, struct args *parent)
{
    return args_list(b, block->list, block, word_text((enum word)block->word), parent);
}

void args_fail(struct args *a)
{
    for (; a && !a->failed; a = a->parent)
        a->failed = true;
}

struct span args_span(const struct args *a)
{
    if (a->at)
        return a->at->where;
    struct span end = {0};
    if (a->owner) {
        end = a->owner->where;
        if (end.end > end.begin)
            end.begin = end.end - 1;
    }
    return end;
}

enum word args_at_word(const struct args *a)
{
    return a->at && a->at->kind == AST_WORD ? (enum word)a->at->word : WORD_NONE;
}

enum word args_at_block(const struct args *a)
{
    return a->at && a->at->kind == AST_BLOCK ? (enum word)a->at->word : WORD_NONE;
}

const struct ast *args_next(struct args *a)
{
    const struct ast *n = a->at;
    if (n) {
        a->at = n->next;
        a->last = n;
    }
    return n;
}

bool args_take(struct args *a, enum word w)
{
    if (args_at_word(a) != w)
        return false;
    args_next(a);
    return true;
}

const struct value *args_at_value(const struct args *a, enum value_kind kind)
{
    const struct ast *n = a->at;
    return n && n->kind == AST_VALUE && n->value && n->value->kind == kind ? n->value
                                                                           : NULL;
}

const struct value *args_take_value(struct args *a, enum value_kind kind)
{
    const struct value *v = args_at_value(a, kind);
    if (v)
        args_next(a);
    return v;
}

void args_error(struct args *a, struct span where, const char *message)
{
    diag_at(args_diags(a), DIAG_BLOCK_ERROR, where, a->name, message);
    args_fail(a);
}

void args_warning(struct args *a, struct span where, const char *message)
{
    diag_at(args_diags(a), DIAG_BLOCK_WARNING, where, a->name, message);
}

void args_skip(struct args *a)
{
    while (a->at && a->at->kind != AST_WORD && a->at->kind != AST_BLOCK)
        args_next(a);
}

enum { KNOWN_MAX = 160 };

static const char *closest_word(const char *text, size_t len, const enum word *known,
                                size_t count)
{
    const char *names[KNOWN_MAX];
    if (count > KNOWN_MAX)
        count = KNOWN_MAX;
    for (size_t i = 0; i < count; i++)
        names[i] = word_text(known[i]);
    return diag_closest(text, len, names, count);
}

// The name of an item as it was written, or NULL for an expression.
static const char *item_name(struct args *a, const struct ast *n)
{
    if (n->kind == AST_WORD || n->kind == AST_BLOCK || n->kind == AST_CONSTANT ||
        n->kind == AST_CALL || n->kind == AST_FACES)
        return word_text((enum word)n->word);
    if ((n->kind == AST_UNDECLARED || n->kind == AST_VALUE) && n->text && n->len)
        return arena_strndup(a->b->e->parse, n->text, n->len);
    return NULL;
}

// Blocks that are lists of entries in brackets.
static bool is_list(const char *block)
{
    static const char *const names[] = {"color_map",  "colour_map", "pigment_map",
                                        "normal_map", "slope_map",  "texture_map",
                                        "density_map"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(block, names[i]) == 0)
            return true;
    return false;
}

// What was likely meant by an item that has no place; NULL: nobody knows.
static const char *misplaced_hint(const struct args *a, const struct ast *n)
{
    const bool pigment = strcmp(a->name, "pigment") == 0,
               texture = strcmp(a->name, "texture") == 0;
    if (n->kind == AST_VALUE && n->value && n->value->kind != VALUE_NUMBER) {
        const char *kind = value_kind_name(n->value);
        return arena_printf(a->b->e->parse, "it is %s %s",
                            strchr("aeiou", *kind) ? "an" : "a", kind);
    }
    if (is_list(a->name) && n->kind == AST_NUMBER)
        return "entries stand in brackets, as in [0.5 rgb 1]";
    if (n->kind == AST_STRING && pigment)
        return "a file stands in its map, as in image_map { png \"NAME\" }";
    if (texture && n->kind == AST_BLOCK && n->word == WORD_interior)
        return "an interior stands beside its texture";
    if (n->kind == AST_WORD &&
        (n->word == WORD_contained_by || builder_is_block_word((enum word)n->word) ||
         builder_is_object_word((enum word)n->word)))
        return "a '{' is missing after it";
    if (n->kind == AST_WORD && n->word == WORD_type && strcmp(a->name, "fog") == 0)
        return "did you mean 'fog_type'?";
    if (n->kind == AST_CONSTANT &&
        (n->word == WORD_x || n->word == WORD_y || n->word == WORD_z))
        return "a product is written with a *, as in 45*y";
    if (n->kind == AST_NUMBER && pigment)
        return "the parts of a colour are written in < >, as in rgb <1, 0.5, 0>";
    const bool color = n->word == WORD_rgb || n->word == WORD_rgbf ||
                       n->word == WORD_rgbt || n->word == WORD_rgbft ||
                       n->word == WORD_color || n->word == WORD_colour;
    return n->kind == AST_WORD && color && texture ? "colours belong in a pigment { }"
                                                   : NULL;
}

void args_unknown(struct args *a, const enum word *known, size_t count)
{
    const struct ast *n = args_next(a);
    if (!n)
        return;
    if (n->kind == AST_VALUE && !n->value) { // already reported
        args_fail(a);
        return;
    }
    const char *name = item_name(a, n), *hint = NULL;
    if (n->kind == AST_UNDECLARED) {
        const char *close = closest_word(name, strlen(name), known, count);
        if (!close)
            hint = undeclared_hint(a->b->e, n->text, n->len, UNDECLARED_VALUE, NULL);
        if (!close && !hint)
            close = diag_closest(name, strlen(name), word_list(), WORD_COUNT - 1);
        if (close)
            hint = arena_printf(a->b->e->parse, "did you mean '%s'?", close);
        diag_hint(args_diags(a), DIAG_UNKNOWN_NAME, n->where, hint, name, a->name);
    } else if (name) {
        diag_hint(args_diags(a), DIAG_UNKNOWN_ITEM, n->where, misplaced_hint(a, n), name,
                  a->name);
    } else {
        diag_hint(args_diags(a), DIAG_EXTRA_ARG, n->where, misplaced_hint(a, n), a->name);
        if (is_list(a->name)) // of which nothing is in brackets
            a->at = NULL;
    }
    args_fail(a);
    args_skip(a);
}

void args_not_built(struct args *a)
{
    const struct ast *n = args_next(a);
    diag_at(args_diags(a), DIAG_NOT_BUILT, n->where, word_text((enum word)n->word));
    args_fail(a);
    if (n->kind != AST_BLOCK)
        args_skip(a);
}

bool args_at_color(struct args *a) { return a->at && ast_is_color_start(a->at); }

bool args_color(struct args *a, bool rgb_only, struct rgbft *out)
{
    if (!a->at || !(ast_is_color_start(a->at) || ast_is_number(a->at))) {
        return args_expected(a, "colour", "such as rgb <1, 0.5, 0>");
    }
    const struct ast *before = a->at;
    bool ok = eval_color(a->b->e, &a->at, rgb_only, out);
    if (!ok) {
        if (a->at == before)
            args_next(a);
        args_fail(a);
    }
    return ok;
}

bool args_rgb(struct args *a, struct rgb *out)
{
    struct rgbft c;
    if (!args_color(a, true, &c))
        return false;
    *out = rgbft_rgb(c);
    return true;
}

bool args_optional(struct args *a, double *io)
{
    return !args_at_number(a) || args_float(a, "value", io);
}

bool args_switch(struct args *a)
{
    double v = 1;
    args_optional(a, &v);
    return v > 0;
}

static bool field_in_range(struct args *a, const struct field *f, struct span where,
                           double v)
{
    if ((f->min == 0 && f->max == 0) || (v >= f->min && v <= f->max) ||
        f->kind == FIELD_NEAREST)
        return true;
    diag_at(args_diags(a), DIAG_OUT_OF_RANGE, where, word_text(f->word), v, f->min,
            f->max);
    args_fail(a);
    return false;
}

static void read_number(struct args *a, const struct field *f, void *at)
{
    double v = 0;
    struct span where = args_span(a);
    if (!args_float(a, word_text(f->word), &v) || !field_in_range(a, f, where, v))
        return;
    switch (f->kind) {
    case FIELD_FLOAT: *(float *)at = (float)v; break;
    case FIELD_DOUBLE: *(double *)at = v; break;
    case FIELD_INT: *(int *)at = (int)fmax(fmin(v, 2147483647.0), -2147483648.0); break;
    case FIELD_NEAREST: *(int *)at = (int)fmax(fmin(v, f->max), f->min); break;
    case FIELD_RECIPROCAL: *(float *)at = v == 0 ? 0 : (float)(1 / v); break;
    default: *(bool *)at = v > 0; break;
    }
}

static void read_other(struct args *a, const struct field *f, void *at)
{
    struct rgbft c;
    double v = 1;
    const char *text;
    const char *role = word_text(f->word);
    switch (f->kind) {
    case FIELD_SWITCH: *(bool *)at = args_switch(a); break;
    case FIELD_FLAG: *(bool *)at = true; break;
    case FIELD_METALLIC:
        if (args_optional(a, &v))
            *(float *)at = (float)v;
        break;
    case FIELD_VEC3: args_vec3(a, role, at); break;
    case FIELD_UNIT:
        if (args_vec3(a, role, at))
            *(struct vec3 *)at = vec3_normalize(*(struct vec3 *)at);
        break;
    case FIELD_RGB: args_rgb(a, at); break;
    case FIELD_COLOR:
        if (args_color(a, false, &c))
            *(struct rgbft *)at = c;
        break;
    case FIELD_STRING: args_string(a, role, &text); break;
    default: break;
    }
}

bool fields_read(struct args *a, const struct field *f, size_t n, void *into)
{
    enum word w = args_at_word(a);
    if (w == WORD_NONE)
        return false;
    for (size_t i = 0; i < n; i++) {
        if (f[i].word != w)
            continue;
        void *at = (char *)into + f[i].offset;
        bool failed = a->failed;
        a->failed = false;
        args_next(a);
        switch (f[i].kind) {
        case FIELD_FLOAT:
        case FIELD_DOUBLE:
        case FIELD_INT:
        case FIELD_NEAREST:
        case FIELD_RECIPROCAL:
        case FIELD_NUMBER_BOOL: read_number(a, &f[i], at); break;
        default: read_other(a, &f[i], at); break;
        }
        if (a->failed)
            args_skip(a);
        a->failed |= failed;
        return true;
    }
    return false;
}

void fields_unknown(struct args *a, const struct field *f, size_t n,
                    const enum word *more, size_t more_count)
{
    enum word known[KNOWN_MAX];
    size_t count = 0;
    for (size_t i = 0; i < n && count < KNOWN_MAX; i++)
        known[count++] = f[i].word;
    for (size_t i = 0; i < more_count && count < KNOWN_MAX; i++)
        known[count++] = more[i];
    args_unknown(a, known, count);
}

void pointer_list_add(struct arena *a, struct pointer_list *l, const void *p)
{
    if (l->count == l->capacity) {
        uint32_t capacity = l->capacity ? 2 * l->capacity : 4;
        const void **at = arena_new_array(a, const void *, capacity);
        if (l->count)
            memcpy(at, l->at, l->count * sizeof *at);
        l->at = at;
        l->capacity = capacity;
    }
    l->at[l->count++] = p;
}
