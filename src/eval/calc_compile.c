// From tokens to the steps of a calculation, by recursive descent (spec/language 2.2).

#include "eval/calc.h"

#include <string.h>

#include "base/arena.h"
#include "eval/functions.h"
#include "lang/lexeme.h"
#include "lang/macro.h"
#include "math/pi.h"

enum { NEST_MAX = 40 };

struct compile {
    struct eval *e;
    const struct lexeme *t;
    const char *text; // of the file
    uint32_t count, at;
    struct calc *out;
    struct arena *strings;
    int depth;       // values on the stack
    int from_bottom; // steps that leave the lowest value
    int nest, randoms;
    const struct inlined *inlined; // the innermost
};

enum { LOCALS_MAX = 8 };

// A macro while its body is compiled. Its arguments and locals lie on the stack from `base`
// on.
struct inlined {
    const struct inlined *outer;
    const struct macro *macro;
    uint8_t index; // calc_op.macro
    int base, local_count;
    const struct lexeme *local[LOCALS_MAX];
};

static int kind(const struct compile *c)
{
    return c->at < c->count ? c->t[c->at].kind : TOK_END;
}

static int kind_after(const struct compile *c)
{
    return c->at + 1 < c->count ? c->t[c->at + 1].kind : TOK_END;
}

static bool take(struct compile *c, int k)
{
    if (kind(c) != k)
        return false;
    c->at++;
    return true;
}

// Adds a step that takes `pops` values and leaves one.
static struct calc_op *emit(struct compile *c, enum calc_code code, int pops,
                            uint32_t from)
{
    c->from_bottom += c->depth <= pops;
    c->depth += 1 - pops;
    if (c->out->count == CALC_OPS_MAX || c->depth > CALC_STACK_MAX)
        return NULL;
    struct calc_op *op = &c->out->op[c->out->count++];
    *op = (struct calc_op){0};
    op->code = (uint8_t)code;
    op->macro = c->inlined ? c->inlined->index : 0;
    op->begin = c->t[from].begin;
    op->end = c->t[c->at - 1].begin + lexeme_len(&c->t[c->at - 1]);
    return op;
}

static bool arith(struct compile *c);
static bool full(struct compile *c);

static struct name *name_of(struct compile *c, const struct lexeme *t)
{
    return symbols_name(c->e->symbols, c->text + t->begin, t->len);
}

static bool subscripts(struct compile *c, int *count)
{
    for (*count = 0; take(c, '['); ++*count)
        if (*count == 5 || !arith(c) || !take(c, ']'))
            return false;
    return true;
}

// ---- macros ----------------------------------------------------------------------

static bool same(const char *a, size_t a_len, const char *b, size_t b_len)
{
    return a_len == b_len && memcmp(a, b, a_len) == 0;
}

// Where on the stack the name's value lies; -1: it is none of a macro's.
static int slot_of(const struct compile *c, const struct lexeme *t)
{
    const char *text = c->text + t->begin;
    for (const struct inlined *in = c->inlined; in; in = in->outer) {
        const struct macro *m = in->macro;
        for (int i = in->local_count; i-- > 0;)
            if (same(m->text + in->local[i]->begin, in->local[i]->len, text, t->len))
                return in->base + m->parameter_count + i;
        for (int i = 0; i < m->parameter_count; i++)
            if (same(m->parameter[i].text, m->parameter[i].len, text, t->len))
                return in->base + i;
    }
    return -1;
}

static bool primary(struct compile *c);

// `#local NAME = value;`
static bool local(struct compile *c, struct inlined *in)
{
    const struct lexeme *t;
    if (!take(c, '#') || kind(c) != TOK_WORD || c->t[c->at++].word != WORD_local ||
        kind(c) != TOK_NAME || in->local_count == LOCALS_MAX)
        return false;
    t = &c->t[c->at++];
    const int known = slot_of(c, t);
    if (known >= in->base || !take(c, '=') || !arith(c) || !take(c, ';'))
        return false;
    in->local[in->local_count++] = t;
    return true;
}

// The body must be such that it means the same as a value: no operator of the text around
// it may reach into it.
static bool body(struct compile *c, struct inlined *in)
{
    while (kind(c) == '#')
        if (!local(c, in))
            return false;
    return primary(c) && c->at == c->count;
}

static const struct macro *macro_of(const struct compile *c, struct name *name)
{
    const struct symbol *s = symbols_place(c->e->symbols, name).symbol;
    const struct value *v = s ? symbol_value(s) : NULL;
    return v && v->kind == VALUE_MACRO ? v->data : NULL;
}

// After the name of a macro: its arguments and, in place, its body.
static bool macro(struct compile *c, const struct lexeme *t)
{
    struct name *name = name_of(c, t);
    const struct macro *m = macro_of(c, name);
    struct inlined in = {.outer = c->inlined, .macro = m, .base = c->depth};
    if (!m || slot_of(c, t) >= 0 || c->out->macro_count == CALC_MACROS_MAX ||
        !take(c, '('))
        return false;
    for (int i = 0; i < m->parameter_count; i++)
        if ((i && !take(c, ',')) || !arith(c))
            return false;
    if (!take(c, ')'))
        return false;
    c->out->macro[c->out->macro_count++] = (struct calc_macro){
        name, m, t->begin, t->begin + t->len, c->inlined ? c->inlined->index : 0};
    in.index = (uint8_t)c->out->macro_count;
    struct compile outer = *c;
    c->t = m->body;
    c->text = m->text;
    c->count = m->count;
    c->at = 0;
    c->inlined = &in;
    const bool ok = body(c, &in);
    c->t = outer.t;
    c->text = outer.text;
    c->count = outer.count;
    c->at = outer.at;
    c->inlined = outer.inlined;
    struct calc_op *op = ok ? emit(c, CALC_LEAVE, c->depth - in.base, c->at - 1) : NULL;
    if (op)
        op->count = (uint8_t)in.base;
    return op;
}

// ----------------------------------------------------------------------------------

static bool slot(struct compile *c, uint32_t from, int at)
{
    struct calc_op *op = kind(c) == '[' ? NULL : emit(c, CALC_SLOT, 0, from);
    if (op)
        op->count = (uint8_t)at;
    return op;
}

static bool name(struct compile *c)
{
    uint32_t from = c->at++;
    int n;
    struct calc_op *op;
    if (kind(c) == '(')
        return macro(c, &c->t[from]);
    const int at = slot_of(c, &c->t[from]);
    if (at >= 0)
        return slot(c, from, at);
    if (!subscripts(c, &n))
        return false;
    if (!(op = emit(c, n ? CALC_ELEMENT : CALC_NAME, n, from)))
        return false;
    op->count = (uint8_t)n;
    op->name = name_of(c, &c->t[from]);
    return true;
}

static bool number(struct compile *c, double v)
{
    uint32_t from = c->at++;
    struct calc_op *op = emit(c, CALC_NUMBER, 0, from);
    if (op)
        op->number = v;
    return op;
}

static bool constant(struct compile *c)
{
    static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    uint32_t from = c->at;
    enum word w = (enum word)c->t[from].word;
    struct calc_op *op;
    switch (w) {
    case WORD_pi: return number(c, PI);
    case WORD_true:
    case WORD_yes:
    case WORD_on: return number(c, 1);
    case WORD_false:
    case WORD_no:
    case WORD_off: return number(c, 0);
    case WORD_now: return false;
    case WORD_x:
    case WORD_y:
    case WORD_z:
        c->at++;
        if ((op = emit(c, CALC_VECTOR3, 0, from)))
            op->vector = axes[w == WORD_x ? 0 : w == WORD_y ? 1 : 2];
        return op;
    default:
        c->at++;
        if ((op = emit(c, CALC_CONSTANT, 0, from)))
            op->word = (uint16_t)w;
        return op;
    }
}

// Of numbers and strings, changing nothing, or rand.
static bool is_simple(enum word w, const struct builtin *f)
{
    return f->run && w != WORD_seed && w != WORD_now && w != WORD_vstr &&
           w != WORD_file_exists && w != WORD_datetime && w != WORD_val &&
           strspn(f->arguments, "fvs") == strlen(f->arguments);
}

static bool call(struct compile *c)
{
    uint32_t from = c->at;
    enum word w = (enum word)c->t[from].word;
    const struct builtin *f = builtin_find(w);
    if (!is_simple(w, f) || kind_after(c) != '(')
        return false;
    if (w == WORD_rand && ++c->randoms > CALC_RANDOM_MAX)
        return false;
    c->at += 2;
    bool one = f->least == 1 && f->most == 1;
    int n = 0;
    do
        if (!(one && f->arguments[0] == 'f' ? full(c) : arith(c)) || ++n > 8)
            return false;
    while (take(c, ','));
    if (!take(c, ')') || n < f->least || (f->most && n > f->most))
        return false;
    struct calc_op *op = emit(c, CALC_CALL, n, from);
    if (!op)
        return false;
    op->word = (uint16_t)w;
    op->count = (uint8_t)n;
    return true;
}

static bool vector(struct compile *c)
{
    uint32_t from = c->at++;
    int n = 0;
    do
        if (!arith(c) || ++n > 4)
            return false;
    while (take(c, ','));
    if (n < 2 || !take(c, '>'))
        return false;
    struct calc_op *op = emit(c, CALC_VECTOR, n, from);
    if (op)
        op->count = (uint8_t)n;
    return op;
}

// Without escapes.
static bool string(struct compile *c)
{
    const struct lexeme *t = &c->t[c->at++];
    const char *text = c->text + t->begin + 1;
    const uint32_t len = t->len - 2;
    if (len > UINT16_MAX || memchr(text, '\\', len))
        return false;
    struct calc_op *op = emit(c, CALC_STRING, 0, c->at - 1);
    if (op)
        op->string = arena_strndup(c->strings, text, len);
    return op;
}

static bool atom(struct compile *c)
{
    uint32_t from = c->at;
    struct calc_op *op;
    switch (kind(c)) {
    case TOK_NUMBER: return number(c, c->t[from].number);
    case TOK_NAME: return name(c);
    case TOK_CONSTANT: return constant(c);
    case TOK_WORD: return call(c);
    case '<': return vector(c);
    case TOK_VECTOR3:
        c->at++;
        if ((op = emit(c, CALC_VECTOR3, 0, from)))
            op->vector = c->t[from].vector->v;
        return op;
    case TOK_STRING: return string(c);
    case '(': c->at++; return full(c) && take(c, ')');
    default: return false;
    }
}

static bool primary(struct compile *c)
{
    uint32_t from = c->at;
    if (!atom(c))
        return false;
    while (kind(c) == '.') {
        c->at++;
        int k = kind(c);
        if (k != TOK_CONSTANT && k != TOK_PART && k != TOK_GRAY)
            return false;
        enum word w = (enum word)c->t[c->at++].word;
        struct calc_op *op = emit(c, CALC_MEMBER, 1, from);
        if (!op)
            return false;
        op->word = (uint16_t)w;
    }
    return true;
}

static bool unary(struct compile *c)
{
    uint32_t from = c->at;
    int k = kind(c);
    if (k != '-' && k != '+' && k != '!')
        return primary(c);
    c->at++;
    if (++c->nest > NEST_MAX || !unary(c))
        return false;
    c->nest--;
    struct calc_op *op = emit(c, CALC_UNARY, 1, from);
    if (op)
        op->word = (uint16_t)k;
    return op;
}

static bool binary(struct compile *c, int operator, uint32_t from)
{
    struct calc_op *op = emit(c, CALC_BINARY, 2, from);
    if (op)
        op->word = (uint16_t) operator;
    return op;
}

static bool term(struct compile *c)
{
    uint32_t from = c->at;
    if (!unary(c))
        return false;
    for (int k; (k = kind(c)) == '*' || k == '/';) {
        c->at++;
        if (!unary(c) || !binary(c, k, from))
            return false;
    }
    return true;
}

static bool arith(struct compile *c)
{
    uint32_t from = c->at;
    if (++c->nest > NEST_MAX || !term(c))
        return false;
    for (int k; (k = kind(c)) == '+' || k == '-';) {
        c->at++;
        if (!term(c) || !binary(c, k, from))
            return false;
    }
    c->nest--;
    return true;
}

static int relation(int k)
{
    switch (k) {
    case '<':
    case '>':
    case '=': return k;
    case TOK_LE: return OP_LE;
    case TOK_GE: return OP_GE;
    case TOK_NE: return OP_NE;
    default: return 0;
    }
}

static bool compare(struct compile *c)
{
    uint32_t from = c->at;
    if (!arith(c))
        return false;
    for (int op; (op = relation(kind(c))) != 0;) {
        c->at++;
        if (!arith(c) || !binary(c, op, from))
            return false;
    }
    return true;
}

// Inside parentheses.
static bool full(struct compile *c)
{
    uint32_t from = c->at;
    if (!compare(c))
        return false;
    for (int k; (k = kind(c)) == '&' || k == '|';) {
        c->at++;
        if (!compare(c) || !binary(c, k, from))
            return false;
    }
    if (!take(c, '?'))
        return true;
    return full(c) && take(c, ':') && full(c) && emit(c, CALC_CHOOSE, 3, from);
}

// What may follow an expression without being part of it.
static bool ends(struct compile *c)
{
    switch (kind(c)) {
    case TOK_END: c->out->at_end = true; return true;
    case TOK_NAME: c->out->next = name_of(c, &c->t[c->at]); return true;
    case '#':
    case '[':
    case '(':
    case '.': return false;
    default: return true;
    }
}

// Whether a `t` may stand first is the grammar's to say.
static bool at_t(const struct compile *c)
{
    return kind(c) == TOK_CONSTANT && c->t[c->at].word == WORD_t;
}

static bool assignment(struct compile *c)
{
    int n;
    if (kind(c) != TOK_NAME)
        return false;
    c->out->target = name_of(c, &c->t[c->at++]);
    if (!subscripts(c, &n) || !take(c, '=') || at_t(c))
        return false;
    c->out->subscripts = (uint32_t)n;
    if (!arith(c) || !take(c, ';'))
        return false;
    const struct calc_op *last = &c->out->op[c->out->count - 1];
    c->out->appends = !n && last->code == CALC_CALL && last->word == WORD_concat &&
                      !c->out->macro_count && c->out->op[0].code == CALC_NAME &&
                      c->out->op[0].name == c->out->target && last->count > 1 &&
                      c->from_bottom == 2;
    return true;
}

// Whether a step can only go well or be left to the grammar.
static bool is_silent(const struct calc *c, uint32_t i)
{
    const struct calc_op *op = &c->op[i];
    const bool divisor = i && op[-1].code == CALC_NUMBER && op[-1].number != 0;
    if (op->code == CALC_BINARY)
        return op->word != '/' || divisor;
    if (op->code != CALC_CALL)
        return op->code != CALC_CONSTANT;
    switch (op->word) {
    case WORD_mod:
    case WORD_div: return divisor;
    case WORD_abs:
    case WORD_ceil:
    case WORD_floor:
    case WORD_int:
    case WORD_sin:
    case WORD_cos:
    case WORD_min:
    case WORD_max:
    case WORD_degrees:
    case WORD_radians:
    case WORD_vdot:
    case WORD_vlength:
    case WORD_concat:
    case WORD_str:
    case WORD_strlen:
    case WORD_strupr:
    case WORD_strlwr:
    case WORD_asc: return true;
    default: return false;
    }
}

static bool gives_string(const struct calc *c)
{
    const struct calc_op *last = &c->op[c->count - 1];
    return last->code == CALC_STRING ||
           (last->code == CALC_CALL && word_is_string_function((enum word)last->word));
}

bool calc_compile(struct eval *e, const struct calc_place *at, struct arena *strings,
                  struct calc *out)
{
    struct compile c = {.e = e,
                        .t = at->tokens,
                        .text = at->text,
                        .count = at->count,
                        .out = out,
                        .strings = strings};
    bool ok = false;
    *out = (struct calc){0};
    if (at_t(&c))
        return false;
    switch (at->kind) {
    case CALC_ASSIGNMENT: ok = assignment(&c); break;
    case CALC_CONDITION: ok = take(&c, '(') && full(&c) && take(&c, ')'); break;
    case CALC_ARGUMENT: ok = arith(&c) && (kind(&c) == ',' || kind(&c) == ')'); break;
    case CALC_ITEM:
        out->literal = kind(&c) == '<' || kind(&c) == TOK_VECTOR3;
        ok = arith(&c) && ends(&c);
        break;
    }
    out->used = c.at;
    for (uint32_t i = 0; i < out->count; i++)
        out->reports |= !is_silent(out, i);
    return ok && (out->target || !gives_string(out));
}
