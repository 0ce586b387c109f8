// From tokens to the steps of a calculation, by recursive descent (spec/language 2.2).

#include "eval/calc.h"

#include <string.h>

#include "eval/functions.h"
#include "lang/lexeme.h"

enum { NEST_MAX = 40 };

struct compile {
    struct eval *e;
    const struct lexeme *t;
    const char *text; // of the file
    uint32_t count, at;
    struct calc *out;
    int depth; // values on the stack
    int nest, randoms;
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
    c->depth += 1 - pops;
    if (c->out->count == CALC_OPS_MAX || c->depth > CALC_STACK_MAX)
        return NULL;
    struct calc_op *op = &c->out->op[c->out->count++];
    *op = (struct calc_op){0};
    op->code = (uint8_t)code;
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

static bool name(struct compile *c)
{
    uint32_t from = c->at++;
    int n;
    struct calc_op *op;
    if (kind(c) == '(')
        return false;
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
    case WORD_pi: return number(c, 3.14159265358979323846);
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

// A function of numbers that changes nothing, or rand.
static bool call(struct compile *c)
{
    uint32_t from = c->at;
    enum word w = (enum word)c->t[from].word;
    const struct builtin *f = builtin_find(w);
    if (!f->run || f->result == 's' || w == WORD_seed || w == WORD_now ||
        strspn(f->arguments, "fv") != strlen(f->arguments) || kind_after(c) != '(')
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

static bool assignment(struct compile *c)
{
    int n;
    if (kind(c) != TOK_NAME)
        return false;
    c->out->target = name_of(c, &c->t[c->at++]);
    if (!subscripts(c, &n) || !take(c, '='))
        return false;
    c->out->subscripts = (uint32_t)n;
    return arith(c) && take(c, ';');
}

bool calc_compile(struct eval *e, const struct calc_place *at, struct calc *out)
{
    struct compile c = {.e = e, .t = at->tokens, .text = at->text, .count = at->count, .out = out};
    bool ok = false;
    *out = (struct calc){0};
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
    return ok;
}
