// Functions: from the body's tree to a tape of steps (spec/language 4.16).

#include "eval/function.h"

#include <string.h>

#include "base/arena.h"
#include "eval/builder.h"
#include "eval/expr.h"
#include "eval/function_tape.h"
#include "eval/internal.h"

enum { STEPS_MAX = 65535, NAMES_MAX = FUNCTION_PARAMETERS_MAX + 64 };

struct compiler {
    struct eval *e;
    struct step *step;
    uint32_t count, capacity;
    uint16_t free; // the first register in nobody's use
    const char *name[NAMES_MAX];
    size_t len[NAMES_MAX];
    uint16_t at[NAMES_MAX]; // register of each name
    int names;
    bool standard; // no parameter list: x y z, u = x, v = y
};

static bool compile(struct compiler *c, const struct ast *n, uint16_t to);

static bool refuse(struct compiler *c, const struct ast *n, const char *what)
{
    diag_at(c->e->diags, DIAG_FUNCTION_ITEM, n->where, what);
    return false;
}

static struct step *emit(struct compiler *c, enum step_op op, uint16_t to, uint16_t a,
                         uint16_t b)
{
    if (c->count == c->capacity) {
        uint32_t capacity = 2 * c->capacity + 32;
        struct step *grown = arena_new_array(c->e->parse, struct step, capacity);
        if (c->count)
            memcpy(grown, c->step, c->count * sizeof *grown);
        c->step = grown;
        c->capacity = capacity;
    }
    struct step *s = &c->step[c->count++];
    *s = (struct step){.op = (uint8_t)op, .to = to, .a = a, .b = b};
    return s;
}

static bool take(struct compiler *c, const struct ast *n, int count, uint16_t *first)
{
    if (c->free + count > FUNCTION_REGISTERS || c->count >= STEPS_MAX - 8)
        return refuse(c, n, "an expression this large");
    *first = c->free;
    c->free = (uint16_t)(c->free + count);
    return true;
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
            return c->at[i];
    return -1;
}

static bool add_name(struct compiler *c, const struct ast *n, uint16_t at)
{
    if (c->names == NAMES_MAX ||
        !name_of(n, &c->name[c->names], &c->len[c->names]))
        return refuse(c, n, "this as a name");
    c->at[c->names++] = at;
    return true;
}

static bool constant(struct compiler *c, const struct ast *n, uint16_t to)
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
    emit(c, STEP_CONSTANT, to, 0, 0)->k = v;
    return true;
}

static enum step_op op_of(int op)
{
    switch (op) {
    case '+': return STEP_ADD;
    case '-': return STEP_SUBTRACT;
    case '*': return STEP_MULTIPLY;
    case '/': return STEP_DIVIDE;
    case '<': return STEP_LESS;
    case '>': return STEP_GREATER;
    case '=': return STEP_EQUAL;
    case OP_NE: return STEP_NOT_EQUAL;
    case OP_LE: return STEP_LESS_EQUAL;
    case OP_GE: return STEP_GREATER_EQUAL;
    case '&': return STEP_AND;
    default: return STEP_OR;
    }
}

static bool is_logic(const struct ast *n)
{
    return n->kind == AST_BINARY && !n->parens && (n->op == '&' || n->op == '|');
}

// `a & b | c & d`: the tree is left associative with equal precedence, but in a
// function & binds tighter. r[to] is the sum so far, r[to + 1] the running product.
static bool logic(struct compiler *c, const struct ast *n, uint16_t sum, uint16_t product,
                  uint16_t work)
{
    if (!is_logic(n->left)) {
        emit(c, STEP_CONSTANT, sum, 0, 0)->k = 0;
        if (!compile(c, n->left, product))
            return false;
    } else if (!logic(c, n->left, sum, product, work)) {
        return false;
    }
    if (n->op == '|') {
        emit(c, STEP_OR, sum, sum, product);
        return compile(c, n->right, product);
    }
    if (!compile(c, n->right, work))
        return false;
    emit(c, STEP_AND, product, product, work);
    return true;
}

static bool binary(struct compiler *c, const struct ast *n, uint16_t to)
{
    uint16_t r;
    if (!take(c, n, 3, &r))
        return false;
    if (n->op == '&' || n->op == '|') {
        if (!logic(c, n, r, (uint16_t)(r + 1), (uint16_t)(r + 2)))
            return false;
        emit(c, STEP_OR, to, r, (uint16_t)(r + 1));
    } else {
        if (!compile(c, n->left, r) || !compile(c, n->right, (uint16_t)(r + 1)))
            return false;
        emit(c, op_of(n->op), to, r, (uint16_t)(r + 1));
    }
    c->free = r;
    return true;
}

static int count_list(const struct ast *n)
{
    int count = 0;
    for (; n; n = n->next)
        count++;
    return count;
}

static bool arguments(struct compiler *c, const struct ast *n, uint16_t *first,
                      int *count)
{
    *count = count_list(n->list);
    if (!take(c, n, *count, first))
        return false;
    uint16_t at = *first;
    for (const struct ast *a = n->list; a; a = a->next)
        if (!compile(c, a, at++))
            return false;
    return true;
}

// sum(k, from, to, e), prod(...)
static bool loop(struct compiler *c, const struct ast *n, uint16_t to)
{
    uint16_t r; // k, end, total, term, 1, test
    if (count_list(n->list) != 4) {
        diag_at(c->e->diags, DIAG_CALL_ARGUMENTS, n->where, word_text(n->word),
                count_list(n->list));
        return false;
    }
    const struct ast *from = n->list->next, *end = from->next, *term = end->next;
    bool product = n->word == WORD_prod;
    if (!take(c, n, 6, &r) || !compile(c, from, r) ||
        !compile(c, end, (uint16_t)(r + 1)) || !add_name(c, n->list, r))
        return false;
    emit(c, STEP_CONSTANT, (uint16_t)(r + 2), 0, 0)->k = product;
    emit(c, STEP_CONSTANT, (uint16_t)(r + 4), 0, 0)->k = 1;
    uint32_t start = c->count;
    emit(c, STEP_LESS_EQUAL, (uint16_t)(r + 5), r, (uint16_t)(r + 1));
    uint32_t leave = c->count;
    emit(c, STEP_UNLESS, 0, (uint16_t)(r + 5), 0);
    if (!compile(c, term, (uint16_t)(r + 3)))
        return false;
    emit(c, product ? STEP_MULTIPLY : STEP_ADD, (uint16_t)(r + 2), (uint16_t)(r + 2),
         (uint16_t)(r + 3));
    emit(c, STEP_ADD, r, r, (uint16_t)(r + 4));
    emit(c, STEP_JUMP, (uint16_t)start, 0, 0);
    c->step[leave].to = (uint16_t)c->count;
    emit(c, STEP_COPY, to, (uint16_t)(r + 2), 0);
    c->names--;
    c->free = r;
    return true;
}

static bool builtin(struct compiler *c, const struct ast *n, uint16_t to)
{
    int least, most, count;
    uint16_t first;
    if (n->word == WORD_sum || n->word == WORD_prod)
        return loop(c, n, to);
    if (!function_math_arity(n->word, &least, &most))
        return refuse(c, n, word_text(n->word));
    if (!arguments(c, n, &first, &count))
        return false;
    if (count < least || count > most) {
        diag_at(c->e->diags, DIAG_CALL_ARGUMENTS, n->where, word_text(n->word), count);
        return false;
    }
    emit(c, STEP_MATH, to, first, (uint16_t)count)->word = n->word;
    c->free = first;
    return true;
}

// `member`: the .x after the call, or WORD_NONE.
static bool apply(struct compiler *c, const struct ast *n, enum word member, uint16_t to)
{
    int count, part = 0;
    uint16_t first;
    if (n->value->kind != VALUE_FUNCTION)
        return refuse(c, n, "a spline");
    const struct function *f = n->value->data;
    switch (member) {
    case WORD_y: case WORD_v: case WORD_green: part = 1; break;
    case WORD_z: case WORD_blue: part = 2; break;
    case WORD_t: case WORD_filter: part = 3; break;
    case WORD_transmit: part = 4; break;
    default: break;
    }
    if (part >= f->width || (member == WORD_NONE && f->width > 1))
        return refuse(c, n, member ? word_text(member) : "a vector");
    if (!arguments(c, n, &first, &count))
        return false;
    if (count != f->parameters) {
        diag_at(c->e->diags, DIAG_CALL_ARGUMENTS, n->where,
                arena_printf(c->e->parse, "%.*s", (int)n->len, n->text), count);
        return false;
    }
    emit(c, member == WORD_gray ? STEP_GRAY : STEP_CALL, to, first, (uint16_t)part)
        ->callee = f;
    c->free = first;
    return true;
}

static bool compile(struct compiler *c, const struct ast *n, uint16_t to)
{
    int name = find_name(c, n);
    if (name >= 0) {
        emit(c, STEP_COPY, to, (uint16_t)name, 0);
        return true;
    }
    switch (n->kind) {
    case AST_NUMBER: case AST_CONSTANT: case AST_VALUE: case AST_INDEX:
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
            emit(c, STEP_NEGATE, to, to, 0);
        return true;
    default: return refuse(c, n, "this");
    }
}

static bool standard_names(struct compiler *c)
{
    static const char *const names[] = {"x", "y", "z", "u", "v"};
    for (int i = 0; i < 5; i++) {
        c->name[i] = names[i];
        c->len[i] = 1;
        c->at[i] = (uint16_t)(i % 3);
    }
    c->names = 5;
    return true;
}

static bool parameter_names(struct compiler *c, const struct ast *list)
{
    for (uint16_t i = 0; list; list = list->next, i++)
        if (i == FUNCTION_PARAMETERS_MAX || !add_name(c, list, i))
            return refuse(c, list, "another parameter");
    return true;
}

static bool compile_tape(struct eval *e, const struct ast *parameters,
                         const struct ast *body, struct function *f)
{
    struct compiler c = {.e = e};
    f->parameters = parameters ? count_list(parameters->list) : 3;
    f->width = 1;
    uint16_t to;
    if (!(parameters ? parameter_names(&c, parameters->list) : standard_names(&c)))
        return false;
    c.free = (uint16_t)f->parameters;
    if (!take(&c, body, 1, &to) || !compile(&c, body, to))
        return false;
    struct step *step = arena_new_array(e->arena, struct step, c.count);
    memcpy(step, c.step, c.count * sizeof *step);
    f->step = step;
    f->step_count = c.count;
    f->result = to;
    return true;
}

static bool compile_block(struct eval *e, const struct ast *body, struct function *f)
{
    const struct value *v = NULL;
    f->parameters = 3;
    switch (body->word) {
    case WORD_spline:
        if (!(v = spline_value(e, body)))
            return false;
        f->kind = FUNCTION_SPLINE;
        f->parameters = 1;
        f->width = ((const struct spline *)v->data)->width;
        break;
    case WORD_transform:
        f->kind = FUNCTION_TRANSFORM;
        f->width = 3;
        v = builder_block(e->builder, body);
        break;
    case WORD_pigment:
        f->kind = FUNCTION_PIGMENT;
        f->width = 5;
        f->data = builder_function_pigment(e->builder, body);
        return f->data != NULL;
    case WORD_pattern:
        f->kind = FUNCTION_PATTERN;
        f->width = 1;
        f->data = builder_function_pattern(e->builder, body);
        return f->data != NULL;
    default:
        diag_at(e->diags, DIAG_FUNCTION_ITEM, body->where,
                word_text((enum word)body->word));
    }
    if (v)
        f->data = v->data;
    return v != NULL;
}

// internal() has its own parameters whatever list is written.
static bool is_expression(const struct ast *body) { return body->kind != AST_BLOCK; }

static bool find_internal(struct eval *e, const struct ast *n, struct function *f)
{
    double number;
    if (count_list(n->list) != 1) {
        diag_at(e->diags, DIAG_CALL_ARGUMENTS, n->where, "internal", count_list(n->list));
        return false;
    }
    if (!eval_float(e, n->list, &number))
        return false;
    const struct internal_function *i = internal_function(number);
    if (!i) {
        diag_at(e->diags, DIAG_DOMAIN, n->where, "internal", "there is no such function");
        return false;
    }
    f->kind = FUNCTION_INTERNAL;
    f->parameters = 3 + i->parameters;
    f->width = 1;
    f->data = i;
    return true;
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
    struct function *f = arena_new_struct(e->arena, struct function);
    f->defaults = builder_pattern_defaults(e->builder);
    if (parameters && !is_expression(body)) {
        diag_at(e->diags, DIAG_FUNCTION_ITEM, parameters->where, "a parameter list");
        return NULL;
    }
    bool internal = body->kind == AST_CALL && body->word == WORD_internal;
    bool ok = internal                  ? find_internal(e, body, f)
              : body->kind == AST_BLOCK ? compile_block(e, body, f)
                                        : compile_tape(e, parameters, body, f);
    return ok ? value_new_data(e->arena, VALUE_FUNCTION, f) : NULL;
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
    double argument[FUNCTION_PARAMETERS_MAX];
    const struct function *f = n->value->data;
    int count = count_list(n->list), i = 0;
    if (count != f->parameters) {
        diag_at(e->diags, DIAG_CALL_ARGUMENTS, n->where,
                arena_printf(e->parse, "%.*s", (int)n->len, n->text), count);
        return false;
    }
    for (const struct ast *a = n->list; a; a = a->next)
        if (!eval_float(e, a, &argument[i++]))
            return false;
    memset(out, 0, 5 * sizeof *out);
    function_run(f, argument, out);
    *width = f->width;
    return true;
}
