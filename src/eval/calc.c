// Carries out calculations, and keeps the steps of those that come again.

#include "eval/calc.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "eval/array.h"
#include "eval/expr.h"
#include "eval/functions.h"
#include "lang/macro.h"
#include "math/color.h"

// What a place in the text holds instead of an index.
enum { SLOT_NEW, SLOT_SEEN, SLOT_NEVER, SLOT_FIRST };

struct calc_table {
    struct arena *arena;
    struct calc **calc;
    uint32_t count, capacity;
    struct calc *scratch; // of a place met for the first time
};

struct calc_table *calc_table_new(void)
{
    struct arena *a = arena_new(1 << 14);
    struct calc_table *t = arena_new_struct(a, struct calc_table);
    t->arena = a;
    t->scratch =
        arena_alloc(a, sizeof *t->scratch + CALC_OPS_MAX * sizeof(struct calc_op));
    return t;
}

void calc_table_free(struct calc_table *t)
{
    if (!t)
        return;
    free(t->calc);
    arena_free(t->arena);
}

static void keep(struct calc_table *t, uint32_t *slot)
{
    t->calc = must_grow(t->calc, t->count, &t->capacity, sizeof *t->calc);
    size_t size = sizeof *t->scratch + t->scratch->count * sizeof t->scratch->op[0];
    t->calc[t->count] = memcpy(arena_alloc(t->arena, size), t->scratch, size);
    *slot = SLOT_FIRST + t->count++;
}

// A text met once is not kept: a mesh of a million triangles is read once only.
static const struct calc *find(struct eval *e, const struct calc_place *at)
{
    struct calc_table *t = e->calcs;
    if (*at->slot >= SLOT_FIRST)
        return t->calc[*at->slot - SLOT_FIRST];
    if (*at->slot == SLOT_NEVER)
        return NULL;
    if (!calc_compile(e, at, t->arena, t->scratch)) {
        *at->slot = SLOT_NEVER;
        return NULL;
    }
    if (*at->slot == SLOT_NEW)
        *at->slot = SLOT_SEEN;
    else
        keep(t, at->slot);
    return t->scratch;
}

// ---- running -----------------------------------------------------------------

struct number {
    int width; // 0: a string
    union {
        double n[5];
        const char *text; // terminated
    };
};

struct run {
    struct eval *e;
    const struct calc_place *at;
    const struct calc *calc;
    struct number stack[CALC_STACK_MAX + 1];
    struct number *top; // one above the last
    bool failed;        // and reported
    int random_count;   // to be taken back if the grammar has to do it all again
    struct {
        uint32_t index, state;
    } random[CALC_RANDOM_MAX];
};

// Of a place in the text of macro i (calc_op.macro).
static struct span place_in(const struct run *r, uint8_t i, uint32_t begin, uint32_t end)
{
    struct span s = r->at->where;
    if (i) {
        const struct calc_macro *m = &r->calc->macro[i - 1];
        const struct span called = place_in(r, m->outer, m->begin, m->end);
        s.expansion = source_expand(r->e->sources, m->macro->name, called);
        s.file = m->macro->file;
    }
    s.begin = begin;
    s.end = end;
    return s;
}

static struct span place_in_text(const struct run *r, const struct calc_op *op)
{
    return place_in(r, op->macro, op->begin, op->end);
}

static void push(struct run *r, int width, const double *n)
{
    r->top->width = width;
    memcpy(r->top->n, n, (size_t)width * sizeof *n);
    r->top++;
}

static void push_text(struct run *r, const char *text)
{
    r->top->width = 0;
    r->top->text = text;
    r->top++;
}

static bool push_name(struct run *r, struct name *name)
{
    struct place p = symbols_place(r->e->symbols, name);
    const struct value *v = p.symbol ? symbol_number(p.symbol) : NULL;
    if (p.array && p.array->kind == VALUE_NUMBER && p.array->set[p.index]) {
        push(r, p.array->width, p.array->number + (size_t)p.index * p.array->width);
        return true;
    }
    if (v)
        push(r, v->width, v->n);
    else if ((v = p.symbol ? symbol_string(p.symbol) : NULL))
        push_text(r, v->string.text);
    return v;
}

// Pops the subscripts; the flat index, or false when they do not fit.
static bool flat_index(struct run *r, const struct array_value *a, uint32_t count,
                       uint32_t *out)
{
    uint64_t flat = 0;
    if (a->dimensions != count)
        return false;
    r->top -= count;
    for (uint32_t i = 0; i < count; i++) {
        double v = r->top[i].n[0] + INDEX_SLACK;
        if (r->top[i].width != 1 || !(v >= 0) || !(v < a->size[i]))
            return false;
        flat = flat * a->size[i] + (uint32_t)v;
    }
    *out = (uint32_t)flat;
    return true;
}

static struct array_value *array_of(struct eval *e, struct name *name)
{
    struct place p = symbols_place(e->symbols, name);
    if (!place_found(p))
        return NULL;
    const struct value *v = p.array ? NULL : symbol_value(p.symbol);
    return v && v->kind == VALUE_ARRAY ? v->array : NULL;
}

static bool element(struct run *r, const struct calc_op *op)
{
    uint32_t i;
    const struct array_value *a = array_of(r->e, op->name);
    if (!a || a->kind != VALUE_NUMBER || !flat_index(r, a, op->count, &i) || !a->set[i])
        return false;
    push(r, a->width, a->number + (size_t)i * a->width);
    return true;
}

static bool constant(struct run *r, const struct calc_op *op)
{
    struct ast n = {.kind = AST_CONSTANT, .word = op->word};
    struct number v = {0};
    if (!eval_number(r->e, &n, 1, v.n, &v.width))
        return false;
    *r->top++ = v;
    return true;
}

static void note_random(struct run *r, double stream)
{
    double i = number_to_int(stream);
    if (!(i >= 0 && i < r->e->random_count))
        return;
    r->random[r->random_count].index = (uint32_t)i;
    r->random[r->random_count++].state = r->e->random[(uint32_t)i];
}

static bool call(struct run *r, const struct calc_op *op)
{
    const struct builtin *f = builtin_find((enum word)op->word);
    struct argument arg[8];
    struct ast node = {.kind = AST_CALL, .word = op->word, .where = place_in_text(r, op)};
    const char *kind = f->arguments;
    r->top -= op->count;
    for (uint32_t i = 0; i < op->count; i++) {
        const struct number *v = &r->top[i];
        if (*kind == 'f') {
            if (v->width != 1)
                return false;
            arg[i].f = v->n[0];
        } else if (*kind == 's') {
            if (v->width)
                return false;
            arg[i].s = v->text;
        } else if (v->width == 1) {
            arg[i].v = vec3(v->n[0], v->n[0], v->n[0]);
        } else if (v->width == 3) {
            arg[i].v = vec3(v->n[0], v->n[1], v->n[2]);
        } else {
            return false;
        }
        kind += kind[1] != 0;
    }
    if (op->word == WORD_rand)
        note_random(r, arg[0].f);
    struct call c = {.e = r->e,
                     .node = &node,
                     .name = word_text((enum word)op->word),
                     .count = op->count,
                     .arg = arg};
    c.result.width = f->result == 'f' ? 1 : 3;
    r->failed = !f->run(&c);
    if (f->result != 's')
        push(r, c.result.width, c.result.n);
    else
        push_text(r, r->failed ? "" : c.result.text);
    return true;
}

static bool vector(struct run *r, const struct calc_op *op)
{
    struct number v = {.width = op->count};
    r->top -= op->count;
    for (int i = 0; i < op->count; i++) {
        if (r->top[i].width != 1)
            return false;
        v.n[i] = r->top[i].n[0];
    }
    *r->top++ = v;
    return true;
}

static double of_two(struct run *r, const struct calc_op *op, double a, double b)
{
    switch (op->word) {
    case '+': return a + b;
    case '-': return a - b;
    case '*': return a * b;
    case '/':
        if (b != 0)
            return a / b;
        diag_at(r->e->diags, DIAG_DIVIDE_BY_ZERO, place_in_text(r, op), "");
        return INFINITY;
    default: return eval_compare(op->word, a, b);
    }
}

static bool binary(struct run *r, const struct calc_op *op)
{
    struct number *b = --r->top, *a = b - 1;
    if (a->width == 1 && b->width == 1) {
        a->n[0] = of_two(r, op, a->n[0], b->n[0]);
        return true;
    }
    if (!a->width || !b->width ||
        (a->width != b->width && a->width != 1 && b->width != 1))
        return false;
    number_widen(a->n, &a->width, b->width);
    number_widen(b->n, &b->width, a->width);
    for (int i = 0; i < a->width; i++)
        a->n[i] = of_two(r, op, a->n[i], b->n[i]);
    return true;
}

static bool unary(struct run *r, const struct calc_op *op)
{
    struct number *v = r->top - 1;
    if (!v->width)
        return false;
    for (int i = 0; i < v->width && op->word != '+'; i++)
        v->n[i] = op->word == '-' ? -v->n[i] : !eval_truth(v->n[i]);
    return true;
}

// A colour would have been rounded to single precision on its way into a name.
static bool slot(struct run *r, const struct calc_op *op)
{
    const struct number *v = &r->stack[op->count];
    if (v->width == 5)
        return false;
    *r->top++ = *v;
    return true;
}

static void leave(struct run *r, const struct calc_op *op)
{
    struct number *to = &r->stack[op->count];
    *to = r->top[-1];
    r->top = to + 1;
}

static bool member(struct run *r, const struct calc_op *op)
{
    struct number *v = r->top - 1;
    int i = member_index((enum word)op->word);
    if (v->width == 1 || i >= v->width)
        return false;
    for (int k = v->width; k < 3; k++)
        v->n[k] = 0;
    v->n[0] = i < 0 ? luminance(v->n[0], v->n[1], v->n[2]) : v->n[i];
    v->width = 1;
    return true;
}

static bool choose(struct run *r)
{
    struct number *which = r->top - 3;
    r->top -= 2;
    if (which->width != 1 || !which[1].width || !which[2].width)
        return false;
    *which = eval_truth(which->n[0]) ? which[1] : which[2];
    return true;
}

static bool step(struct run *r, const struct calc_op *op)
{
    switch ((enum calc_code)op->code) {
    case CALC_NUMBER: push(r, 1, &op->number); return true;
    case CALC_VECTOR3: push(r, 3, op->vector); return true;
    case CALC_NAME: return push_name(r, op->name);
    case CALC_ELEMENT: return element(r, op);
    case CALC_CONSTANT: return constant(r, op);
    case CALC_CALL: return call(r, op);
    case CALC_VECTOR: return vector(r, op);
    case CALC_BINARY: return binary(r, op);
    case CALC_UNARY: return unary(r, op);
    case CALC_MEMBER: return member(r, op);
    case CALC_CHOOSE: return choose(r);
    case CALC_STRING: push_text(r, op->string); return true;
    case CALC_SLOT: return slot(r, op);
    case CALC_LEAVE: leave(r, op); return true;
    }
    return false;
}

static bool macros_fit(struct eval *e, const struct calc *c)
{
    for (uint32_t i = 0; i < c->macro_count; i++) {
        struct place p = symbols_place(e->symbols, c->macro[i].name);
        const struct value *v = p.symbol ? symbol_value(p.symbol) : NULL;
        if (!v || v->kind != VALUE_MACRO || v->data != c->macro[i].macro)
            return false;
    }
    return true;
}

// Whether every name holds what the steps take it for; nothing has run yet.
static bool names_fit(struct eval *e, const struct calc *c)
{
    for (uint32_t i = 0; c->reports && i < c->count; i++) {
        const struct calc_op *op = &c->op[i];
        if (op->code == CALC_NAME) {
            struct place p = symbols_place(e->symbols, op->name);
            if (p.array
                    ? p.array->kind != VALUE_NUMBER || !p.array->set[p.index]
                    : !p.symbol || (!symbol_number(p.symbol) && !symbol_string(p.symbol)))
                return false;
        } else if (op->code == CALC_ELEMENT) {
            const struct array_value *a = array_of(e, op->name);
            if (!a || a->kind != VALUE_NUMBER || a->dimensions != op->count)
                return false;
        }
    }
    return macros_fit(e, c);
}

static void take_back(struct run *r)
{
    while (r->random_count > 0) {
        r->random_count--;
        r->e->random[r->random[r->random_count].index] = r->random[r->random_count].state;
    }
}

static bool assign(struct run *r, const struct calc *c)
{
    struct eval *e = r->e;
    const struct number *result = --r->top;
    struct value v;
    if (!result->width)
        v = (struct value){.kind = VALUE_STRING,
                           .string = {result->text, (uint32_t)strlen(result->text)}};
    else if (result->width == 1)
        v = (struct value){.kind = VALUE_NUMBER, .width = 1, .n = {result->n[0]}};
    else
        v = value_of_number(result->n, result->width);
    if (c->subscripts) {
        uint32_t i;
        struct array_value *a = array_of(e, c->target);
        return a && result->width && (a->kind == VALUE_NUMBER || a->kind == VALUE_NONE) &&
               flat_index(r, a, c->subscripts, &i) && array_set(e->arena, a, i, &v);
    }
    struct place p = symbols_place_for(e->symbols, c->target, r->at->local);
    if (!result->width)
        return p.symbol && symbol_takes_number(p.symbol) && place_set(e->arena, p, &v);
    return p.symbol && symbol_set_number(p.symbol, &v);
}

// `S = concat(S, ...)`: what is added is written behind what is there. False when nothing
// was done.
static bool appended(struct run *r, const struct calc *c)
{
    struct eval *e = r->e;
    const uint32_t added = c->op[c->count - 1].count - 1u;
    struct place p = symbols_place_for(e->symbols, c->target, r->at->local);
    bool ok = p.symbol && symbol_string(p.symbol);
    r->top = r->stack;
    for (uint32_t i = 1; ok && !r->failed && i + 1 < c->count; i++)
        ok = step(r, &c->op[i]);
    for (uint32_t i = 0; ok && i < added; i++)
        ok = !r->stack[i].width &&
             r->stack[i].text != symbol_string(p.symbol)->string.text;
    ok = ok && !r->failed;
    for (uint32_t i = 0; ok && i < added; i++)
        symbol_append(e->arena, p.symbol, r->stack[i].text);
    if (!ok)
        take_back(r);
    r->top = r->stack;
    return ok;
}

// A local name exists, empty, before its right side is read (spec/language 3.2).
static bool target_fits(struct eval *e, const struct calc *c, bool local)
{
    if (!c->target)
        return true;
    if (c->subscripts)
        return array_of(e, c->target);
    if (!local && !place_found(symbols_place(e->symbols, c->target)))
        return true;
    struct place p = symbols_place_for(e->symbols, c->target, local);
    return p.symbol && symbol_takes_number(p.symbol);
}

static bool follows_alone(const struct eval *e, const struct calc_place *at,
                          const struct calc *c)
{
    if (c->at_end && at->goes_on)
        return false;
    if (!c->next)
        return true;
    struct place p = symbols_place(e->symbols, c->next);
    const struct value *v = p.symbol ? symbol_value(p.symbol) : NULL;
    return !v || v->kind != VALUE_MACRO;
}

enum calc_outcome calc_run(void *user, const struct calc_place *at,
                           struct calc_result *out)
{
    struct eval *e = user;
    const struct calc *c = find(e, at);
    if (!c || (at->kind == CALC_ITEM && c->count == 1 && c->op[0].code != CALC_VECTOR3) ||
        !follows_alone(e, at, c) || !target_fits(e, c, at->local) || !names_fit(e, c))
        return CALC_NONE;
    struct run r;
    r.e = e;
    r.at = at;
    r.calc = c;
    r.top = r.stack;
    r.failed = false;
    r.random_count = 0;
    if (c->appends && (appended(&r, c) || r.failed)) {
        out->used = c->used;
        out->width = 0;
        return r.failed ? CALC_FAILED : CALC_DONE;
    }
    bool ok = true;
    for (uint32_t i = 0; ok && !r.failed && i < c->count; i++)
        ok = step(&r, &c->op[i]);
    const struct number *result = r.top - 1;
    if (ok && !r.failed && !c->target)
        ok = result->width; // strings are for names only
    if (ok && !r.failed && at->kind == CALC_ITEM)
        ok = result->width == 1 || (c->literal && result->width < 5);
    if (ok && !r.failed && at->kind == CALC_CONDITION)
        ok = result->width == 1;
    if (ok && !r.failed && c->target)
        ok = assign(&r, c);
    if (!ok) {
        take_back(&r);
        return CALC_NONE;
    }
    out->used = c->used;
    out->width = 0;
    if (r.failed)
        return CALC_FAILED;
    out->width = result->width;
    out->number = result->n[0];
    if (result->width > 1 && !c->target)
        out->value = value_new_number(e->nodes, result->n, result->width);
    return CALC_DONE;
}
