// Functions: from the body's tree to a tape (spec/language 4.16).

#include "eval/function.h"

#include <string.h>

#include "base/arena.h"
#include "eval/builder.h"
#include "eval/expr.h"
#include "eval/internal.h"
#include "eval/spline.h"
#include "scene/pattern_function.h"

enum { NAMES_MAX = TAPE_ARGUMENTS_MAX + 64, MORE_ARGUMENTS = 10000 };

static const double pi = 3.14159265358979323846;

struct compiler {
    struct eval *e;
    struct tape_builder *b;
    const char *name[NAMES_MAX];
    size_t len[NAMES_MAX];
    uint32_t at[NAMES_MAX]; // value of each name
    int names;
};

static bool compile(struct compiler *c, const struct ast *n, uint32_t *to);

static bool refuse(struct compiler *c, const struct ast *n, const char *what)
{
    diag_at(c->e->diags, DIAG_FUNCTION_ITEM, n->where, what);
    return false;
}

static bool wrong_count(struct compiler *c, const struct ast *n, const char *name,
                        int count)
{
    diag_at(c->e->diags, DIAG_CALL_ARGUMENTS, n->where, name, count);
    return false;
}

static bool name_of(const struct ast *n, const char **name, size_t *len)
{
    if (n->kind == AST_UNDECLARED || n->kind == AST_VALUE) {
        *name = n->text;
        *len = n->len;
        return n->len > 0;
    }
    if (n->kind != AST_CONSTANT)
        return false;
    *name = word_text(n->word);
    *len = strlen(*name);
    return true;
}

static int find_name(const struct compiler *c, const struct ast *n)
{
    const char *name;
    size_t len;
    if (!name_of(n, &name, &len))
        return -1;
    for (int i = c->names; i-- > 0;)
        if (c->len[i] == len && !memcmp(c->name[i], name, len))
            return i;
    return -1;
}

static bool add_name(struct compiler *c, const struct ast *n, uint32_t at)
{
    if (c->names == NAMES_MAX || !name_of(n, &c->name[c->names], &c->len[c->names]))
        return refuse(c, n, "this as a name");
    c->at[c->names++] = at;
    return true;
}

static bool constant(struct compiler *c, const struct ast *n, uint32_t *to)
{
    double v;
    if (n->kind == AST_CONSTANT && n->word != WORD_pi && n->word != WORD_clock) {
        if (n->word != WORD_x && n->word != WORD_y && n->word != WORD_z &&
            n->word != WORD_u && n->word != WORD_v)
            return refuse(c, n, word_text(n->word));
        v = 0; // x, y, z of a function with other parameters
    } else if (!eval_float(c->e, n, &v)) {
        return false;
    }
    *to = tape_constant(c->b, v);
    return true;
}

// ---- operators ----------------------------------------------------------------------

static enum tape_op op_of(int op)
{
    switch (op) {
    case '+': return TAPE_ADD;
    case '-': return TAPE_SUBTRACT;
    case '*': return TAPE_MULTIPLY;
    case '/': return TAPE_DIVIDE;
    case '<': return TAPE_LESS;
    case '>': return TAPE_GREATER;
    case '=': return TAPE_EQUAL;
    case OP_NE: return TAPE_NOT_EQUAL;
    case OP_LE: return TAPE_LESS_EQUAL;
    default: return TAPE_GREATER_EQUAL;
    }
}

static bool is_logic(const struct ast *n)
{
    return n->kind == AST_BINARY && !n->parens && (n->op == '&' || n->op == '|');
}

// `a & b | c & d`: the tree is left associative with equal precedence, but in a
// function & binds tighter. sum | product is what has been read.
static bool logic(struct compiler *c, const struct ast *n, uint32_t *sum,
                  uint32_t *product)
{
    uint32_t right;
    if (!is_logic(n->left)) {
        *sum = tape_constant(c->b, 0);
        if (!compile(c, n->left, product))
            return false;
    } else if (!logic(c, n->left, sum, product)) {
        return false;
    }
    if (!compile(c, n->right, &right))
        return false;
    if (n->op == '|') {
        *sum = tape_binary(c->b, TAPE_OR, *sum, *product);
        *product = right;
    } else {
        *product = tape_binary(c->b, TAPE_AND, *product, right);
    }
    return true;
}

static bool binary(struct compiler *c, const struct ast *n, uint32_t *to)
{
    uint32_t left, right;
    if (n->op == '&' || n->op == '|') {
        if (!logic(c, n, &left, &right))
            return false;
        *to = tape_binary(c->b, TAPE_OR, left, right);
        return true;
    }
    if (!compile(c, n->left, &left) || !compile(c, n->right, &right))
        return false;
    *to = tape_binary(c->b, op_of(n->op), left, right);
    return true;
}

// ---- built-in functions -------------------------------------------------------------

static int count_list(const struct ast *n)
{
    int count = 0;
    for (; n; n = n->next)
        count++;
    return count;
}

// The body as a tape of its own: of the counter and of everything that has a name here.
static struct tape *loop_body(struct compiler *c, const struct ast *counter,
                              const struct ast *term)
{
    struct compiler inner = *c;
    uint32_t result;
    inner.b = tape_builder_new(c->e->parse);
    for (int i = 0; i < c->names; i++)
        inner.at[i] = tape_argument(inner.b, i + 1);
    if (!add_name(&inner, counter, tape_argument(inner.b, 0)) ||
        !compile(&inner, term, &result))
        return NULL;
    struct tape *t = tape_finish(inner.b, c->e->arena, c->names + 1, &result, 1);
    if (!t)
        refuse(c, term, "an expression this large");
    return t;
}

// sum(k, from, to, e), prod(...)
static bool loop(struct compiler *c, const struct ast *n, uint32_t *to)
{
    uint32_t first, last;
    if (count_list(n->list) != 4)
        return wrong_count(c, n, word_text(n->word), count_list(n->list));
    const struct ast *from = n->list->next, *end = from->next;
    if (!compile(c, from, &first) || !compile(c, end, &last))
        return false;
    double at[2];
    if (tape_is_constant(c->b, first, &at[0]) && tape_is_constant(c->b, last, &at[1]) &&
        tape_turns(at[0], at[1]) > TAPE_TURNS_MAX) {
        diag_at(c->e->diags, DIAG_LOOP_TURNS, n->where,
                n->word == WORD_prod ? "this prod" : "this sum", TAPE_TURNS_MAX);
        return false;
    }
    const struct tape *body = loop_body(c, n->list, end->next);
    if (!body)
        return false;
    *to = tape_loop(c->b, n->word == WORD_prod, body, first, last, c->at, c->names);
    return true;
}

static bool unary_op(enum word w, enum tape_op *op)
{
    switch (w) {
    case WORD_sin: *op = TAPE_SIN; return true;
    case WORD_cos: *op = TAPE_COS; return true;
    case WORD_tan: *op = TAPE_TAN; return true;
    case WORD_asin: *op = TAPE_ASIN; return true;
    case WORD_acos: *op = TAPE_ACOS; return true;
    case WORD_atan: *op = TAPE_ATAN; return true;
    case WORD_sinh: *op = TAPE_SINH; return true;
    case WORD_cosh: *op = TAPE_COSH; return true;
    case WORD_tanh: *op = TAPE_TANH; return true;
    case WORD_asinh: *op = TAPE_ASINH; return true;
    case WORD_acosh: *op = TAPE_ACOSH; return true;
    case WORD_atanh: *op = TAPE_ATANH; return true;
    case WORD_abs: *op = TAPE_ABS; return true;
    case WORD_int: *op = TAPE_INTEGER; return true;
    case WORD_floor: *op = TAPE_FLOOR; return true;
    case WORD_ceil: *op = TAPE_CEIL; return true;
    case WORD_sqrt: *op = TAPE_SQRT; return true;
    case WORD_exp: *op = TAPE_EXP; return true;
    case WORD_ln: *op = TAPE_LOG; return true;
    case WORD_log: *op = TAPE_LOG10; return true;
    default: return false;
    }
}

static bool arity(enum word w, int *least, int *most)
{
    enum tape_op op;
    *least = *most = 1;
    switch (w) {
    case WORD_radians:
    case WORD_degrees: return true;
    case WORD_div:
    case WORD_mod:
    case WORD_atan2:
    case WORD_pow: *least = *most = 2; return true;
    case WORD_min:
    case WORD_max:
        *least = 2;
        *most = MORE_ARGUMENTS;
        return true;
    case WORD_select:
        *least = 3;
        *most = 4;
        return true;
    default: return unary_op(w, &op);
    }
}

static uint32_t turned(struct compiler *c, uint32_t x, double times, double over)
{
    const uint32_t v = tape_binary(c->b, TAPE_MULTIPLY, x, tape_constant(c->b, times));
    return tape_quotient(c->b, v, tape_constant(c->b, over));
}

static uint32_t applied(struct compiler *c, enum word w, const uint32_t *a, int n)
{
    enum tape_op op;
    if (unary_op(w, &op))
        return tape_unary(c->b, op, a[0]);
    switch (w) {
    case WORD_radians: return turned(c, a[0], pi, 180);
    case WORD_degrees: return turned(c, a[0], 180, pi);
    case WORD_div: return tape_unary(c->b, TAPE_INTEGER, tape_quotient(c->b, a[0], a[1]));
    case WORD_mod: return tape_binary(c->b, TAPE_MOD, a[0], a[1]);
    case WORD_atan2: return tape_binary(c->b, TAPE_ATAN2, a[0], a[1]);
    case WORD_pow: return tape_binary(c->b, TAPE_POW, a[0], a[1]);
    default: return tape_select(c->b, a[0], a[1], a[2], a[n - 1]);
    }
}

static bool extreme(struct compiler *c, const struct ast *n, uint32_t *to)
{
    const enum tape_op op = n->word == WORD_min ? TAPE_MIN : TAPE_MAX;
    uint32_t v;
    if (!compile(c, n->list, to))
        return false;
    for (const struct ast *a = n->list->next; a; a = a->next) {
        if (!compile(c, a, &v))
            return false;
        *to = tape_binary(c->b, op, *to, v);
    }
    return true;
}

static bool builtin(struct compiler *c, const struct ast *n, uint32_t *to)
{
    int least, most;
    const int count = count_list(n->list);
    uint32_t v[4];
    if (n->word == WORD_sum || n->word == WORD_prod)
        return loop(c, n, to);
    if (!arity(n->word, &least, &most))
        return refuse(c, n, word_text(n->word));
    if (count < least || count > most)
        return wrong_count(c, n, word_text(n->word), count);
    if (most == MORE_ARGUMENTS)
        return extreme(c, n, to);
    int i = 0;
    for (const struct ast *a = n->list; a; a = a->next)
        if (!compile(c, a, &v[i++]))
            return false;
    *to = applied(c, n->word, v, count);
    return true;
}

// ---- declared functions -------------------------------------------------------------

static uint32_t gray(struct compiler *c, const uint32_t *v)
{
    static const double weight[] = {0.297, 0.589, 0.114};
    uint32_t sum = tape_constant(c->b, 0);
    for (int i = 0; i < 3; i++)
        sum = tape_binary(
            c->b, TAPE_ADD, sum,
            tape_binary(c->b, TAPE_MULTIPLY, tape_constant(c->b, weight[i]), v[i]));
    return sum;
}

// `member`: the .x after the call, or WORD_NONE.
static bool apply(struct compiler *c, const struct ast *n, enum word member, uint32_t *to)
{
    uint32_t in[TAPE_ARGUMENTS_MAX], out[TAPE_WIDTH_MAX];
    if (n->value->kind != VALUE_FUNCTION)
        return refuse(c, n, "a spline");
    const struct tape *f = function_tape(c->e, n->value);
    const int index = member_index(member), part = index > 0 ? index : 0; // 0: gray, too
    const int count = count_list(n->list);
    if (part >= tape_width(f) || (member == WORD_NONE && tape_width(f) > 1))
        return refuse(c, n, member ? word_text(member) : "a vector");
    if (count != tape_arguments(f))
        return wrong_count(c, n, arena_printf(c->e->parse, "%.*s", (int)n->len, n->text),
                           count);
    int i = 0;
    for (const struct ast *a = n->list; a; a = a->next)
        if (!compile(c, a, &in[i++]))
            return false;
    tape_call(c->b, f, in, out);
    *to = member == WORD_gray && tape_width(f) > 2 ? gray(c, out) : out[part];
    return true;
}

static bool compile(struct compiler *c, const struct ast *n, uint32_t *to)
{
    int name = find_name(c, n);
    if (name >= 0) {
        *to = c->at[name];
        return true;
    }
    switch (n->kind) {
    case AST_NUMBER:
    case AST_CONSTANT:
    case AST_VALUE:
    case AST_INDEX:
    case AST_UNDECLARED: return constant(c, n, to);
    case AST_BINARY: return binary(c, n, to);
    case AST_CALL: return builtin(c, n, to);
    case AST_APPLY: return apply(c, n, WORD_NONE, to);
    case AST_MEMBER:
        if (n->left->kind != AST_APPLY)
            return refuse(c, n, "a member of this");
        return apply(c, n->left, n->word, to);
    case AST_UNARY:
        if (n->op == '!')
            return refuse(c, n, "'!'");
        if (!compile(c, n->left, to))
            return false;
        if (n->op == '-')
            *to = tape_unary(c->b, TAPE_NEGATE, *to);
        return true;
    default: return refuse(c, n, "this");
    }
}

// ---- bodies -------------------------------------------------------------------------

static void standard_names(struct compiler *c)
{
    static const char *const names[] = {"x", "y", "z", "u", "v"};
    for (int i = 0; i < 5; i++) {
        c->name[i] = names[i];
        c->len[i] = 1;
        c->at[i] = tape_argument(c->b, i % 3);
    }
    c->names = 5;
}

static bool parameter_names(struct compiler *c, const struct ast *list)
{
    for (int i = 0; list; list = list->next, i++)
        if (i == TAPE_ARGUMENTS_MAX || !add_name(c, list, tape_argument(c->b, i)))
            return refuse(c, list, "another parameter");
    return true;
}

static struct tape *finish(struct eval *e, const struct ast *n, struct tape_builder *b,
                           int arguments, const uint32_t *result, int width)
{
    struct tape *t = tape_finish(b, e->arena, arguments, result, width);
    if (!t)
        diag_at(e->diags, DIAG_FUNCTION_ITEM, n->where, "an expression this large");
    return t;
}

static struct tape *expression(struct eval *e, const struct ast *parameters,
                               const struct ast *body)
{
    struct compiler c = {.e = e, .b = tape_builder_new(e->parse)};
    uint32_t to;
    if (!parameters)
        standard_names(&c);
    else if (!parameter_names(&c, parameters->list))
        return NULL;
    if (!compile(&c, body, &to))
        return NULL;
    return finish(e, body, c.b, parameters ? count_list(parameters->list) : 3, &to, 1);
}

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
    return finish(e, n, b, f->arguments, out, f->width);
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
    return finish(e, n, b, 3, out, 3);
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
    if (count_list(n->list) != 1) {
        diag_at(e->diags, DIAG_CALL_ARGUMENTS, n->where, "internal", count_list(n->list));
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
    return body->kind == AST_BLOCK ? of_block(e, body) : expression(e, parameters, body);
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
        diag_at(e->diags, DIAG_CALL_ARGUMENTS, n->where, "spline", count_list(n->list));
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
    int count = count_list(n->list), i = 0;
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
