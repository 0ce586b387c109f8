// The expression of a function: from its tree to a tape (spec/language 4.16).
#include "eval/function_compile.h"

#include <string.h>

#include "base/arena.h"
#include "eval/expr.h"
#include "eval/function.h"
#include "math/color.h"
#include "math/pi.h"

enum { NAMES_MAX = TAPE_ARGUMENTS_MAX + 64, MORE_ARGUMENTS = 10000 };

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
    if (ast_count(n->list) != 4)
        return wrong_count(c, n, word_text(n->word), ast_count(n->list));
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
    case WORD_radians: return turned(c, a[0], PI, 180);
    case WORD_degrees: return turned(c, a[0], 180, PI);
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
    const int count = ast_count(n->list);
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
    static const double weight[] = {LUMINANCE_RED, LUMINANCE_GREEN, LUMINANCE_BLUE};
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
    const int count = ast_count(n->list);
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

// ---- the whole ---------------------------------------------------------------------

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

struct tape *function_finish(struct eval *e, const struct ast *n, struct tape_builder *b,
                             int arguments, const uint32_t *result, int width)
{
    struct tape *t = tape_finish(b, e->arena, arguments, result, width);
    if (!t)
        diag_at(e->diags, DIAG_FUNCTION_ITEM, n->where, "an expression this large");
    return t;
}

struct tape *function_compile(struct eval *e, const struct ast *parameters,
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
    return function_finish(e, body, c.b, parameters ? ast_count(parameters->list) : 3,
                           &to, 1);
}
