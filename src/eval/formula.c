// Compiler of the formulas of internal.def (formula.h).
#include "eval/formula.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "eval/internal.h"
#include "math/pi.h"

struct formula {
    struct tape_builder *b;
    const char *at;
    const uint32_t *parameter;
    uint32_t name[128]; // by letter
};

enum { CALL_ARGUMENTS = 4 };

static uint32_t sum(struct formula *f);

static void wrong(const struct formula *f)
{
    fprintf(stderr, "lambert: not a formula: %s\n", f->at);
    abort();
}

static void blank(struct formula *f)
{
    while (*f->at == ' ' || *f->at == '\n')
        f->at++;
}

static bool take(struct formula *f, char c)
{
    blank(f);
    if (*f->at != c)
        return false;
    f->at++;
    return true;
}

static void need(struct formula *f, char c)
{
    if (!take(f, c))
        wrong(f);
}

static uint32_t k(struct formula *f, double v) { return tape_constant(f->b, v); }

static uint32_t add(struct formula *f, uint32_t x, uint32_t y)
{
    return tape_binary(f->b, TAPE_ADD, x, y);
}

static uint32_t times(struct formula *f, uint32_t x, uint32_t y)
{
    return tape_binary(f->b, TAPE_MULTIPLY, x, y);
}

static uint32_t square(struct formula *f, uint32_t x)
{
    return tape_unary(f->b, TAPE_SQUARE, x);
}

static uint32_t power(struct formula *f, uint32_t x, uint32_t y)
{
    return tape_binary(f->b, TAPE_POW, x, y);
}

uint32_t formula_bounded(struct tape_builder *b, uint32_t v, uint32_t limit)
{
    const uint32_t least = tape_unary(b, TAPE_NEGATE, limit);
    return tape_binary(b, TAPE_MIN, tape_binary(b, TAPE_MAX, v, least), limit);
}

// fmod made positive.
static uint32_t positive_mod(struct formula *f, uint32_t v, uint32_t period)
{
    const uint32_t r = tape_binary(f->b, TAPE_MOD, v, period);
    return tape_select(f->b, r, add(f, r, period), r, r);
}

// The radius of a cross section: 1 round, 0 square, others by power.
static uint32_t section(struct formula *f, uint32_t u, uint32_t v, uint32_t shape)
{
    struct tape_builder *b = f->b;
    const uint32_t round = tape_unary(b, TAPE_SQRT, add(f, square(f, u), square(f, v)));
    const uint32_t p = tape_unary(b, TAPE_ABS, u), q = tape_unary(b, TAPE_ABS, v);
    const uint32_t corner = tape_binary(b, TAPE_MAX, p, q);
    const uint32_t n = tape_quotient(b, k(f, 2), shape);
    const uint32_t other =
        power(f, add(f, power(f, p, n), power(f, q, n)), times(f, shape, k(f, 0.5)));
    const uint32_t is_round = tape_binary(b, TAPE_EQUAL, shape, k(f, 1));
    const uint32_t is_square = tape_binary(b, TAPE_EQUAL, shape, k(f, 0));
    return tape_where(b, is_round, round, tape_where(b, is_square, corner, other));
}

// An angle needs a direction: x, or c for a point on the y axis.
static uint32_t off_axis(struct formula *f, uint32_t c)
{
    struct tape_builder *b = f->b;
    const uint32_t x = f->name['x'], zero = k(f, 0);
    const uint32_t on = tape_binary(b, TAPE_AND, tape_binary(b, TAPE_EQUAL, x, zero),
                                    tape_binary(b, TAPE_EQUAL, f->name['z'], zero));
    return tape_where(b, on, c, x);
}

static uint32_t tubes(struct formula *f, uint32_t count, uint32_t r)
{
    uint32_t out;
    const uint32_t in[] = {f->name['x'], f->name['z'], count, r};
    tape_call_extern(f->b, &internal_tubes, NULL, in, &out);
    return out;
}

struct unary {
    const char *name;
    enum tape_op op;
};

static const struct unary unary[] = {
    {"sqrt", TAPE_SQRT}, {"exp", TAPE_EXP},  {"cos", TAPE_COS},
    {"sin", TAPE_SIN},   {"fabs", TAPE_ABS}, {"square", TAPE_SQUARE},
};
static const struct unary binary[] = {
    {"atan2", TAPE_ATAN2}, {"smaller", TAPE_MIN}, {"larger", TAPE_MAX},
    {"mod", TAPE_MOD},     {"power", TAPE_POW},   {"less", TAPE_LESS},
    {"equal", TAPE_EQUAL},
};

static uint32_t call(struct formula *f, const char *name)
{
    uint32_t a[CALL_ARGUMENTS] = {0};
    int n = 0;
    need(f, '(');
    do
        a[n++] = sum(f);
    while (n < CALL_ARGUMENTS && take(f, ','));
    need(f, ')');
    for (size_t i = 0; i < sizeof unary / sizeof *unary; i++)
        if (!strcmp(name, unary[i].name))
            return tape_unary(f->b, unary[i].op, a[0]);
    for (size_t i = 0; i < sizeof binary / sizeof *binary; i++)
        if (!strcmp(name, binary[i].name))
            return tape_binary(f->b, binary[i].op, a[0], a[1]);
    if (!strcmp(name, "cube"))
        return times(f, square(f, a[0]), a[0]);
    if (!strcmp(name, "bounded"))
        return formula_bounded(f->b, a[0], a[1]);
    if (!strcmp(name, "positive_mod"))
        return positive_mod(f, a[0], a[1]);
    if (!strcmp(name, "where"))
        return tape_where(f->b, a[0], a[1], a[2]);
    if (!strcmp(name, "section"))
        return section(f, a[0], a[1], a[2]);
    if (!strcmp(name, "off_axis"))
        return off_axis(f, a[0]);
    if (!strcmp(name, "tubes"))
        return tubes(f, a[0], a[1]);
    wrong(f);
    return 0;
}

static uint32_t primary(struct formula *f)
{
    char name[16], *end;
    size_t n = 0;
    blank(f);
    if (take(f, '(')) {
        const uint32_t v = sum(f);
        need(f, ')');
        return v;
    }
    if (isdigit((unsigned char)*f->at)) {
        const double v = strtod(f->at, &end);
        f->at = end;
        return k(f, v);
    }
    while (n < sizeof name - 1 && (isalnum((unsigned char)*f->at) || *f->at == '_'))
        name[n++] = *f->at++;
    name[n] = '\0';
    if (!strcmp(name, "p")) {
        need(f, '[');
        const long i = strtol(f->at, &end, 10);
        f->at = end;
        need(f, ']');
        return f->parameter[i];
    }
    if (!strcmp(name, "pi"))
        return k(f, PI);
    if (n == 1)
        return f->name[(unsigned char)name[0]];
    return call(f, name);
}

static uint32_t factor(struct formula *f)
{
    return take(f, '-') ? tape_unary(f->b, TAPE_NEGATE, factor(f)) : primary(f);
}

static uint32_t product(struct formula *f)
{
    uint32_t v = factor(f);
    for (;;) {
        if (take(f, '*'))
            v = times(f, v, factor(f));
        else if (take(f, '/'))
            v = tape_quotient(f->b, v, factor(f));
        else
            return v;
    }
}

static uint32_t sum(struct formula *f)
{
    uint32_t v = product(f);
    for (;;) {
        if (take(f, '+'))
            v = add(f, v, product(f));
        else if (take(f, '-'))
            v = tape_binary(f->b, TAPE_SUBTRACT, v, product(f));
        else
            return v;
    }
}

static void set(struct formula *f, char name, uint32_t v)
{
    f->name[(unsigned char)name] = v;
    if (name >= 'x' && name <= 'z')
        f->name['A' + name - 'x'] = square(f, v);
}

// At `name =`: takes both.
static bool names(struct formula *f, char *name)
{
    blank(f);
    if (!isalpha((unsigned char)f->at[0]) || f->at[1] != ' ' || f->at[2] != '=')
        return false;
    *name = *f->at;
    f->at += 3;
    return true;
}

uint32_t formula_build(struct tape_builder *b, const char *text, const uint32_t at[3],
                       const uint32_t *parameter)
{
    struct formula f = {.b = b, .at = text, .parameter = parameter};
    char name;
    for (int i = 0; i < 3; i++)
        set(&f, (char)('x' + i), at[i]);
    while (names(&f, &name)) {
        const uint32_t v = sum(&f);
        set(&f, name, v);
        need(&f, ';');
    }
    const uint32_t v = sum(&f);
    blank(&f);
    if (*f.at)
        wrong(&f);
    return v;
}
