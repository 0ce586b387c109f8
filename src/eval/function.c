// Functions: what their bodies may be, and their values (spec/language 4.16).

#include "eval/function.h"

#include <string.h>

#include "base/arena.h"
#include "eval/builder.h"
#include "eval/expr.h"
#include "eval/function_compile.h"
#include "eval/internal.h"
#include "eval/spline.h"
#include "scene/pattern_function.h"

static struct tape *of_extern(struct eval *e, const struct ast *n,
                              const struct tape_extern *f, const void *data)
{
    struct tape_builder *b = tape_builder_new(e->parse);
    uint32_t in[3], out[TAPE_WIDTH_MAX];
    if (!data)
        return NULL;
    for (int i = 0; i < f->arguments; i++)
        in[i] = tape_argument(b, i);
    tape_call_extern(b, f, data, in, out);
    return function_finish(e, n, b, f->arguments, out, f->width);
}

// Point times the matrix, in the order of transform_point.
static struct tape *of_transform(struct eval *e, const struct ast *n,
                                 const struct transform *t)
{
    struct tape_builder *b = tape_builder_new(e->parse);
    uint32_t out[3];
    for (int i = 0; i < 3; i++) {
        uint32_t sum = tape_constant(b, 0);
        for (int k = 0; k < 3; k++) {
            const uint32_t m = tape_constant(b, t->linear.m[k][i]);
            const uint32_t term = tape_binary(b, TAPE_MULTIPLY, tape_argument(b, k), m);
            sum = t->linear.m[k][i] == 0 ? sum : tape_binary(b, TAPE_ADD, sum, term);
        }
        const uint32_t offset = tape_constant(b, vec3_axis(t->offset, i));
        out[i] = tape_binary(b, TAPE_ADD, sum, offset);
    }
    return function_finish(e, n, b, 3, out, 3);
}

static struct tape *of_spline(struct eval *e, const struct ast *n, const struct value *v)
{
    if (!v)
        return NULL;
    const struct spline *s = v->data;
    return of_extern(e, n, &spline_extern[s->width], s);
}

static struct tape *of_pigment(struct eval *e, const struct ast *n)
{
    const struct pigment *p = builder_function_pigment(e->builder, n);
    return p ? of_extern(e, n, &pigment_extern, pigment_function(e->arena, e->parse, p))
             : NULL;
}

static struct tape *of_pattern(struct eval *e, const struct ast *n)
{
    const struct pattern *p = builder_function_pattern(e->builder, n);
    return p ? of_extern(e, n, &pattern_extern, pattern_function(e->arena, e->parse, p))
             : NULL;
}

static struct tape *of_block(struct eval *e, const struct ast *body)
{
    const struct value *v;
    switch (body->word) {
    case WORD_spline: return of_spline(e, body, spline_value(e, body));
    case WORD_transform:
        v = builder_block(e->builder, body);
        return v ? of_transform(e, body, v->data) : NULL;
    case WORD_pigment: return of_pigment(e, body);
    case WORD_pattern: return of_pattern(e, body);
    default:
        diag_at(e->diags, DIAG_FUNCTION_ITEM, body->where,
                word_text((enum word)body->word));
        return NULL;
    }
}

// internal() has its own parameters whatever list is written.
static const struct internal_function *of_internal(struct eval *e, const struct ast *n)
{
    double number;
    if (ast_count(n->list) != 1) {
        diag_at(e->diags, DIAG_CALL_ARGUMENTS, n->where, "internal", ast_count(n->list));
        return NULL;
    }
    if (!eval_float(e, n->list, &number))
        return NULL;
    const struct internal_function *f = internal_function(number);
    if (!f)
        diag_at(e->diags, DIAG_DOMAIN, n->where, "internal", "there is no such function");
    return f;
}

// NULL: too large, which no row of internal.def is.
static const struct tape *internal_tape(struct eval *e, const struct internal_function *f)
{
    struct tape_builder *b = tape_builder_new(e->parse);
    uint32_t in[3 + INTERNAL_PARAMETERS_MAX];
    for (int i = 0; i < 3 + f->parameters; i++)
        in[i] = tape_argument(b, i);
    const uint32_t out = internal_build(b, f, in, builder_pattern_defaults(e->builder));
    return tape_finish(b, e->arena, 3 + f->parameters, &out, 1);
}

const struct tape *function_tape(struct eval *e, const struct value *v)
{
    // Made below, not const: values are.
    struct function *f = (struct function *)(uintptr_t)v->data;
    if (!f->tape)
        f->tape = internal_tape(e, f->internal);
    return f->tape;
}

static const struct value *new_function(struct eval *e, const struct tape *t,
                                        const struct internal_function *internal)
{
    struct function *f = arena_new_struct(e->arena, struct function);
    f->tape = t;
    f->internal = internal;
    return value_new_data(e->arena, VALUE_FUNCTION, f);
}

// Noise looks at what is set where it is declared; all others can wait until they are used.
static const struct value *internal_value(struct eval *e, const struct ast *n)
{
    const struct internal_function *f = of_internal(e, n);
    return f ? new_function(e, f->noise ? internal_tape(e, f) : NULL, f) : NULL;
}

static struct tape *of_body(struct eval *e, const struct ast *parameters,
                            const struct ast *body)
{
    return body->kind == AST_BLOCK ? of_block(e, body)
                                   : function_compile(e, parameters, body);
}

const struct value *function_value(struct eval *e, const struct ast *block)
{
    const struct ast *parameters = NULL, *body = block->list;
    if (body && body->kind == AST_ENTRY) {
        parameters = body;
        body = body->next;
    }
    if (!body || body->next) {
        diag_at(e->diags, DIAG_FUNCTION_ITEM, block->where, "more or less than one body");
        return NULL;
    }
    if (parameters && body->kind == AST_BLOCK) {
        diag_at(e->diags, DIAG_FUNCTION_ITEM, parameters->where, "a parameter list");
        return NULL;
    }
    if (body->kind == AST_CALL && body->word == WORD_internal)
        return internal_value(e, body);
    const struct tape *t = of_body(e, parameters, body);
    return t ? new_function(e, t, NULL) : NULL;
}

const struct tape *function_expression(struct eval *e, const struct ast *block)
{
    const struct value *v = function_value(e, block);
    if (!v)
        return NULL;
    const struct tape *t = function_tape(e, v);
    if (tape_arguments(t) == 3 && tape_width(t) == 1)
        return t;
    diag_at(e->diags, DIAG_FUNCTION_ITEM, block->where, "a parameter list or a vector");
    return NULL;
}

static bool apply_spline(struct eval *e, const struct ast *n, double out[5], int *width)
{
    const struct spline *s = n->value->data;
    enum spline_kind kind = s->kind;
    const struct ast *type = n->list ? n->list->next : NULL;
    double at;
    if (!n->list || (type && (type->kind != AST_WORD || type->next ||
                              !spline_kind_of(type->word, &kind)))) {
        diag_at(e->diags, DIAG_CALL_ARGUMENTS, n->where, "spline", ast_count(n->list));
        return false;
    }
    if (!eval_float(e, n->list, &at))
        return false;
    spline_at(s, kind, at, out);
    *width = s->width;
    return true;
}

bool eval_apply(struct eval *e, const struct ast *n, double out[5], int *width)
{
    if (n->value->kind == VALUE_SPLINE)
        return apply_spline(e, n, out, width);
    double argument[TAPE_ARGUMENTS_MAX];
    const struct tape *f = function_tape(e, n->value);
    int count = ast_count(n->list), i = 0;
    if (count != tape_arguments(f)) {
        diag_hint(e->diags, DIAG_CALL_ARGUMENTS, n->where,
                  arena_printf(e->parse, "it takes %d", tape_arguments(f)),
                  arena_printf(e->parse, "%.*s", (int)n->len, n->text), count);
        return false;
    }
    for (const struct ast *a = n->list; a; a = a->next)
        if (!eval_float(e, a, &argument[i++]))
            return false;
    memset(out, 0, 5 * sizeof *out);
    if (!tape_run(f, argument, out)) {
        diag_at(e->diags, DIAG_LOOP_TURNS, n->where, "a sum or prod of this function",
                TAPE_TURNS_MAX);
        return false;
    }
    *width = tape_width(f);
    return true;
}
