// Runs a scene file: names known from the start, statement after statement, right
// sides of assignments.

#include "eval/eval.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "eval/array.h"
#include "eval/builder.h"
#include "eval/calc.h"
#include "eval/expr.h"
#include "eval/function.h"
#include "eval/spline.h"
#include "eval/symbol.h"
#include "lang/parse.h"

static const struct value *color_value(struct eval *e, const struct ast *items)
{
    struct rgbft c;
    if (!eval_color(e, &items, false, &c))
        return NULL;
    if (items) {
        diag_at(e->diags, DIAG_EXPECTED_NUMBER, items->where, "more after the colour");
        return NULL;
    }
    double n[5] = {c.r, c.g, c.b, c.filter, c.transmit};
    return value_new_number(e->nodes, n, 5);
}

static const struct value *copied(struct eval *e, const struct value *v)
{
    if (v->kind == VALUE_ARRAY) {
        struct value *copy = arena_new_struct(e->arena, struct value);
        copy->kind = VALUE_ARRAY;
        copy->array = array_copy(e->arena, v->array);
        return copy;
    }
    if (!v->deprecated)
        return v;
    struct value *copy = arena_new_struct(e->arena, struct value);
    *copy = *v;
    copy->deprecated = copy->warned = false;
    return copy;
}

static const struct value *block_value(struct eval *e, const struct ast *n)
{
    if (n->kind == AST_BLOCK && n->word == WORD_function)
        return function_value(e, n);
    if (n->kind == AST_BLOCK && n->word == WORD_spline)
        return spline_value(e, n);
    if (n->kind == AST_BLOCK && n->word == WORD_array)
        return eval_array(e, n->list->list, n->list->next);
    if (n->kind == AST_BLOCK && builder_is_object_word(n->word))
        return builder_object(e->builder, n);
    return builder_block(e->builder, n);
}

const struct value *eval_rvalue(struct eval *e, const struct ast *items)
{
    double v[5] = {0};
    int width;
    if (!items)
        return NULL;
    if (!items->next) {
        const struct value *named = eval_named(e, items);
        bool kept = named && (named->kind != VALUE_STRING || items->len);
        if (kept)
            return copied(e, named);
        if (items->kind == AST_INDEX)
            return NULL;
    }
    if (ast_is_color_start(items))
        return color_value(e, items);
    if (ast_is_string(items)) {
        const char *text;
        if (!eval_string(e, items, &text))
            return NULL;
        return value_new_string(e->nodes, text, strlen(text));
    }
    if (ast_is_number(items) || items->kind == AST_UNDECLARED) {
        if (!eval_number(e, items, 1, v, &width))
            return NULL;
        return value_new_number(e->nodes, v, width);
    }
    return block_value(e, items);
}

// ---- names known from the start -------------------------------------------------

static void predeclare(struct eval *e, const char *name, const struct value *v)
{
    struct place p = symbols_make(e->symbols, name, strlen(name), false);
    if (!place_get(e->parse, p))
        place_set(e->arena, p, v);
}

// These go through a text of six digits (spec/language 7.3).
static void predeclare_number(struct eval *e, const char *name, double v)
{
    char text[40];
    snprintf(text, sizeof text, "%g", v);
    v = atof(text);
    predeclare(e, name, value_new_number(e->parse, &v, 1));
}

static void predeclare_option(struct eval *e, const char *option)
{
    const char *equals = strchr(option, '=');
    if (!equals || equals == option)
        return;
    const char *name = arena_strndup(e->parse, option, (size_t)(equals - option));
    const char *quote = strchr(equals, '"');
    if (!quote) {
        predeclare_number(e, name, atof(equals + 1));
        return;
    }
    size_t len = strcspn(quote + 1, "\"");
    predeclare(e, name, value_new_string(e->arena, quote + 1, len));
}

static void predeclare_all(struct eval *e)
{
    static const char *const still[] = {"clock_delta",   "initial_clock", "final_clock",
                                        "initial_frame", "final_frame",   "frame_number"};
    const struct eval_options *o = e->options;
    const char *input = o->input_name ? o->input_name : "";
    for (uint32_t i = 0; i < o->declare_count; i++)
        predeclare_option(e, o->declare[i]);
    predeclare_number(e, "image_width", o->image_width);
    predeclare_number(e, "image_height", o->image_height);
    for (size_t i = 0; i < sizeof still / sizeof *still; i++)
        predeclare_number(e, still[i], 0);
    predeclare_number(e, "lambert", 1); // lets a scene ask who reads it
    predeclare(e, "input_file_name", value_new_string(e->arena, input, strlen(input)));
}

// Settings of the renderer that the scene declares.
static void hand_over(struct eval *e)
{
    for (const char *const *name = e->options->wanted; name && *name; name++) {
        const struct place p = symbols_find(e->symbols, *name, strlen(*name), 1);
        const struct value *v = place_found(p) ? place_get(e->parse, p) : NULL;
        char number[40];
        if (!v || (v->kind != VALUE_STRING && v->kind != VALUE_NUMBER))
            continue;
        snprintf(number, sizeof number, "%.17g", v->n[0]);
        e->options->found(e->options->found_user, *name,
                          v->kind == VALUE_STRING ? v->string.text : number);
    }
}

bool eval_scene(struct arena *arena, struct source_map *sources, uint32_t file,
                struct diag_sink *diags, const struct eval_options *options,
                struct scene *scene)
{
    struct eval e = {.arena = arena,
                     .parse = arena_new(1 << 18),
                     .sources = sources,
                     .diags = diags,
                     .options = options,
                     .symbols = symbols_new(),
                     .calcs = calc_table_new(),
                     .scene = scene,
                     .version = options->version ? options->version : 370};
    unsigned errors = diags->errors, errors_max = diags->errors_max;
    predeclare_all(&e);
    e.builder = builder_new(&e);
    struct arena *tokens = arena_new(1 << 18);
    struct stream *in = stream_new(tokens, sources, file, diags, eval_host(&e));
    stream_set_version(in, e.version / 100.0);
    e.nodes = stream_arena(in);
    const struct ast *item;
    while ((item = parse_item(in))) {
        if (options->statement)
            options->statement(options->statement_user, item);
        builder_statement(e.builder, item);
    }
    if (diags->errors == errors)
        builder_finish(e.builder);
    hand_over(&e);
    files_close(&e);
    stream_free(in);
    for (size_t i = 0; i < sizeof e.line / sizeof *e.line; i++)
        free(e.line[i]);
    arena_free(tokens);
    arena_free(e.parse);
    symbols_free(e.symbols);
    calc_table_free(e.calcs);
    diags->errors_max = errors_max;
    return diags->errors == errors;
}
