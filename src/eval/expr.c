// Numeric and string expressions (spec/language 2.2-2.5).

#include "eval/expr.h"

#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "eval/array.h"
#include "eval/include_hint.h"
#include "eval/symbol.h"
#include "eval/text.h"
#include "math/color.h"
#include "math/pi.h"

// What the language takes for zero and for equal (spec/language, conventions).
static const double equal_within = 1e-10;
enum { EXPRESSION_DEPTH_MAX = 20000 };

bool eval_truth(double v) { return fabs(v) > equal_within; }

void number_widen(double *n, int *width, int wanted)
{
    for (int i = *width; i < wanted; i++)
        n[i] = *width == 1 ? n[0] : 0;
    if (*width < wanted)
        *width = wanted;
}

static bool fill(double v, int wanted, double *out, int *width)
{
    for (int i = 0; i < wanted; i++)
        out[i] = v;
    *width = wanted;
    return true;
}

static bool not_numeric(struct eval *e, const struct ast *n)
{
    if (n->op == OP_FAILED)
        return false;
    if (n->kind == AST_UNDECLARED) {
        const char *hint = undeclared_hint(e, n->text, n->len, UNDECLARED_VALUE, NULL);
        diag_hint(e->diags, DIAG_UNDECLARED, n->where, hint, (int)n->len, n->text);
    } else {
        diag_at(e->diags, DIAG_EXPECTED_NUMBER, n->where,
                n->value                ? value_kind_name(n->value)
                : n->kind == AST_STRING ? "a string"
                                        : "something else");
    }
    return false;
}

static bool of_value(struct eval *e, const struct ast *n, const struct value *v,
                     int wanted, double *out, int *width)
{
    if (!v || v->kind != VALUE_NUMBER)
        return not_numeric(e, n);
    if (v->width == 1)
        return fill(v->n[0], wanted, out, width);
    memset(out, 0, 5 * sizeof *out);
    memcpy(out, v->n, v->width * sizeof *out);
    *width = v->width == 3 && wanted > 3 ? wanted : v->width;
    return true;
}

static double now_constant(struct eval *e, enum word w)
{
    switch (w) {
    case WORD_pi: return PI;
    case WORD_true:
    case WORD_yes:
    case WORD_on: return 1;
    case WORD_clock: return (double)(float)e->options->clock;
    case WORD_clock_on: return e->options->clock_set;
    case WORD_version: return e->version / 100.0;
    default: return 0; // false, no, off
    }
}

static bool constant(struct eval *e, const struct ast *n, int wanted, double *out,
                     int *width)
{
    enum word w = n->word;
    if (w == WORD_now) {
        struct call_result r;
        bool ok = eval_call(e, n, &r);
        return ok && fill(r.n[0], wanted, out, width);
    }
    int axis = w == WORD_x || w == WORD_u   ? 0
               : w == WORD_y || w == WORD_v ? 1
               : w == WORD_z                ? 2
               : w == WORD_t                ? 3
                                            : -1;
    if (axis < 0)
        return fill(now_constant(e, w), wanted, out, width);
    memset(out, 0, 5 * sizeof *out);
    out[axis] = 1;
    *width = w == WORD_t ? 4 : w == WORD_u || w == WORD_v ? 2 : wanted > 3 ? wanted : 3;
    return true;
}

static bool vector(struct eval *e, const struct ast *n, double *out, int *width)
{
    int count = 0;
    for (const struct ast *c = n->list; c; c = c->next) {
        if (count == 5) {
            diag_at(e->diags, DIAG_WIDTH, c->where, "a vector has at most 5 components");
            return false;
        }
        if (!eval_float(e, c, &out[count++]))
            return false;
    }
    if (count == 1) {
        diag_hint(e->diags, DIAG_WIDTH, n->where,
                  "write commas between them: `1 -2` is a difference",
                  "a vector has at least 2 components");
        return false;
    }
    *width = count;
    return true;
}

static double arithmetic(struct eval *e, const struct ast *n, double a, double b)
{
    switch (n->op) {
    case '+': return a + b;
    case '-': return a - b;
    case '*': return a * b;
    default:
        if (b != 0)
            return a / b;
        diag_at(e->diags, DIAG_DIVIDE_BY_ZERO, n->where, "");
        return INFINITY;
    }
}

bool eval_compare(int op, double a, double b)
{
    bool equal = fabs(a - b) <= equal_within;
    switch (op) {
    case '<': return a < b;
    case '>': return a > b;
    case '=': return equal;
    case OP_NE: return !equal;
    case OP_LE: return a < b || equal;
    case OP_GE: return a > b || equal;
    case '&': return eval_truth(a) && eval_truth(b);
    default: return eval_truth(a) || eval_truth(b);
    }
}

static bool compare_strings(struct eval *e, const struct ast *n, int wanted, double *out,
                            int *width)
{
    const char *a, *b;
    if (!eval_string(e, n->left, &a) || !eval_string(e, n->right, &b))
        return false;
    return fill(eval_compare(n->op, strcmp(a, b), 0), wanted, out, width);
}

static bool binary(struct eval *e, const struct ast *n, int wanted, double *out,
                   int *width)
{
    if (ast_is_string(n->left))
        return compare_strings(e, n, wanted, out, width);
    double b[5];
    int q;
    if (!eval_number(e, n->left, wanted, out, width) ||
        !eval_number(e, n->right, *width, b, &q))
        return false;
    bool arith = n->op == '+' || n->op == '-' || n->op == '*' || n->op == '/';
    number_widen(out, width, q);
    number_widen(b, &q, *width);
    for (int i = 0; i < *width; i++)
        out[i] =
            arith ? arithmetic(e, n, out[i], b[i]) : eval_compare(n->op, out[i], b[i]);
    return true;
}

static bool conditional(struct eval *e, const struct ast *n, int wanted, double *out,
                        int *width)
{
    const struct ast *yes = n->list->next, *no = yes->next;
    double which, a[5], b[5];
    int p, q;
    if (!eval_float(e, n->list, &which) || !eval_full(e, yes, wanted, a, &p) ||
        !eval_full(e, no, wanted, b, &q))
        return false; // both branches count (spec/language 2.5)
    *width = eval_truth(which) ? p : q;
    memcpy(out, eval_truth(which) ? a : b, (size_t)*width * sizeof *out);
    return true;
}

int member_index(enum word w)
{
    switch (w) {
    case WORD_y:
    case WORD_v:
    case WORD_green: return 1;
    case WORD_z:
    case WORD_blue: return 2;
    case WORD_t:
    case WORD_filter: return 3;
    case WORD_transmit: return 4;
    case WORD_gray: return -1;
    default: return 0;
    }
}

static bool member(struct eval *e, const struct ast *n, int wanted, double *out,
                   int *width)
{
    double v[5] = {0};
    int w, i = member_index(n->word);
    if (!eval_number(e, n->left, wanted, v, &w))
        return false;
    if (i < 0)
        return fill(luminance(v[0], v[1], v[2]), 1, out, width);
    if (i >= w) {
        diag_at(e->diags, DIAG_NO_MEMBER, n->where, word_text(n->word), w);
        return false;
    }
    return fill(v[i], 1, out, width);
}

static bool bare_number(struct eval *e, const struct ast *n, int wanted, double *out,
                        int *width)
{
    switch (n->kind) {
    case AST_NUMBER: return fill(n->number, wanted, out, width);
    case AST_CONSTANT: return constant(e, n, wanted, out, width);
    case AST_VECTOR: return vector(e, n, out, width);
    case AST_VECTOR3:
        memcpy(out, n->vector, 3 * sizeof *out);
        *width = 3;
        return true;
    case AST_BINARY: return binary(e, n, wanted, out, width);
    case AST_CONDITIONAL: return conditional(e, n, wanted, out, width);
    case AST_MEMBER: return member(e, n, wanted, out, width);
    case AST_UNARY:
        if (!eval_number(e, n->left, wanted, out, width))
            return false;
        for (int i = 0; i < *width && n->op != '+'; i++)
            out[i] = n->op == '-' ? -out[i] : !eval_truth(out[i]);
        return true;
    case AST_VALUE: return of_value(e, n, n->value, wanted, out, width);
    case AST_INDEX: {
        const struct value *v = eval_named(e, n);
        return v && of_value(e, n, v, wanted, out, width);
    }
    case AST_APPLY:
        if (!eval_apply(e, n, out, width))
            return false;
        return *width > 1 || fill(out[0], wanted, out, width);
    case AST_CALL: {
        struct call_result r = {0};
        if (!eval_call(e, n, &r))
            return false;
        struct value v = value_of_number(r.n, r.width ? r.width : 1);
        return of_value(e, n, r.width ? &v : NULL, wanted, out, width);
    }
    default: return not_numeric(e, n);
    }
}

bool eval_number(struct eval *e, const struct ast *n, int wanted, double out[5],
                 int *width)
{
    if (e->depth >= EXPRESSION_DEPTH_MAX) {
        diag_at(e->diags, DIAG_EXPRESSION_DEPTH, n->where, "");
        return false;
    }
    e->depth++;
    // Parentheses hold a whole expression, which is read with the width of a float
    // and widened after (spec/language 2.4); of `?:` the branches are.
    bool whole = n->parens && n->kind != AST_CONDITIONAL;
    bool ok = bare_number(e, n, whole ? 1 : wanted, out, width);
    if (ok && whole)
        number_widen(out, width, wanted);
    e->depth--;
    return ok;
}

bool eval_full(struct eval *e, const struct ast *n, int wanted, double out[5], int *width)
{
    if (n->kind == AST_CONDITIONAL)
        return eval_number(e, n, wanted, out, width);
    if (!eval_number(e, n, 1, out, width))
        return false;
    number_widen(out, width, wanted);
    return true;
}

static bool sized(struct eval *e, const struct ast *n, int most, double out[5])
{
    int width;
    memset(out, 0, 5 * sizeof *out);
    if (!eval_number(e, n, most, out, &width))
        return false;
    if (width > most) {
        static const char *const wanted[] = {"", "a float", "two components", "a vector",
                                             "four components"};
        diag_at(e->diags, DIAG_WIDTH, n->where,
                arena_printf(e->parse, "expected %s, found %d components", wanted[most],
                             width));
        return false;
    }
    return true;
}

bool eval_float(struct eval *e, const struct ast *n, double *out)
{
    if (n->kind == AST_NUMBER) {
        *out = n->number;
        return true;
    }
    double v[5];
    if (!sized(e, n, 1, v))
        return false;
    *out = v[0];
    return true;
}

bool eval_vec2(struct eval *e, const struct ast *n, struct vec2 *out)
{
    double v[5];
    if (!sized(e, n, 2, v))
        return false;
    *out = (struct vec2){v[0], v[1]};
    return true;
}

bool eval_vec3(struct eval *e, const struct ast *n, struct vec3 *out)
{
    double v[5];
    if (!sized(e, n, 3, v))
        return false;
    *out = vec3(v[0], v[1], v[2]);
    return true;
}

bool eval_vec4(struct eval *e, const struct ast *n, double out[4])
{
    double v[5];
    if (!sized(e, n, 4, v))
        return false;
    memcpy(out, v, 4 * sizeof *out);
    return true;
}

const struct value *eval_named(struct eval *e, const struct ast *n)
{
    if (n->kind == AST_VALUE)
        return n->value;
    if (n->kind != AST_INDEX || n->value->kind != VALUE_ARRAY)
        return NULL;
    struct place at;
    struct value whole = *n->value;
    const struct ast *index = n->list;
    // Subscripts beyond an array's own go on into an array that is its element.
    while (index && whole.kind == VALUE_ARRAY) {
        if (!eval_index(e, (struct place){.array = whole.array}, index, n->where, &at))
            return NULL;
        const struct value *v = place_get(e->nodes, at);
        if (!v) {
            diag_at(e->diags, DIAG_UNSET, n->where, (int)n->len, n->text);
            return NULL;
        }
        for (uint32_t i = 0; i < whole.array->dimensions && index; i++)
            index = index->next;
        if (!index)
            return v;
        whole = *v;
    }
    diag_at(e->diags, DIAG_SUBSCRIPTS, n->where, "too many subscripts");
    return NULL;
}

bool ast_is_string(const struct ast *n)
{
    switch (n->kind) {
    case AST_STRING: return true;
    case AST_VALUE: return n->value && n->value->kind == VALUE_STRING;
    case AST_CALL: return word_is_string_function(n->word);
    case AST_INDEX:
        return n->value->kind == VALUE_ARRAY && n->value->array->kind == VALUE_STRING;
    default: return false;
    }
}

static bool literal(struct eval *e, const struct ast *n, bool path, const char **out)
{
    struct text_buffer b = {.arena = e->nodes};
    const char *bad = text_unescape(&b, n->text, n->len, path);
    if (bad)
        diag_at(e->diags, DIAG_BAD_ESCAPE, n->where, bad[1]);
    *out = b.text;
    return !bad;
}

static bool string(struct eval *e, const struct ast *n, bool path, const char **out)
{
    if (n->kind == AST_STRING)
        return literal(e, n, path, out);
    struct call_result r = {0};
    if (n->kind == AST_CALL && word_is_string_function(n->word)) {
        if (!eval_call(e, n, &r))
            return false;
        *out = r.text;
        return true;
    }
    const struct value *v = eval_named(e, n);
    if (v && v->kind == VALUE_STRING) {
        *out = v->string.text;
        return true;
    }
    if (n->kind == AST_UNDECLARED)
        not_numeric(e, n);
    else if (n->op != OP_FAILED && (n->kind != AST_INDEX || v))
        diag_at(e->diags, DIAG_EXPECTED_STRING, n->where, "");
    return false;
}

bool eval_string(struct eval *e, const struct ast *n, const char **out)
{
    return string(e, n, false, out);
}

bool eval_path(struct eval *e, const struct ast *n, const char **out)
{
    return string(e, n, true, out);
}

bool ast_is_number(const struct ast *n)
{
    if (!n)
        return false;
    switch (n->kind) {
    case AST_NUMBER:
    case AST_CONSTANT:
    case AST_VECTOR:
    case AST_VECTOR3:
    case AST_UNARY:
    case AST_BINARY:
    case AST_CONDITIONAL:
    case AST_MEMBER:
    case AST_APPLY: return true;
    case AST_VALUE:
        return n->op == OP_FAILED || (n->value && n->value->kind == VALUE_NUMBER);
    case AST_CALL: return !word_is_string_function(n->word);
    case AST_INDEX:
        return n->value->kind == VALUE_ARRAY &&
               (n->value->array->kind == VALUE_NUMBER ||
                n->value->array->kind == VALUE_NONE); // whose evaluation says so
    default: return false;
    }
}
