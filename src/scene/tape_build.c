// Building tapes: nodes with shared subexpressions (tape_build.h).
#include "scene/tape_builder.h"

#include <string.h>

#include "base/arena.h"

struct tape_builder *tape_builder_new(struct arena *work)
{
    struct tape_builder *b = arena_new_struct(work, struct tape_builder);
    b->work = work;
    tape_constant(b, 0); // node 0 is nobody's side in root_of
    return b;
}

static uint32_t mix(uint32_t h, uint64_t v)
{
    v = (v ^ h) * 0x9e3779b97f4a7c15u;
    return (uint32_t)(v ^ v >> 32);
}

static uint32_t hash_of(const struct tape_node *n)
{
    uint64_t k;
    memcpy(&k, &n->k, sizeof k);
    uint32_t h = mix(n->op, k);
    for (int i = 0; i < 4; i++)
        h = mix(h, n->arg[i]);
    for (uint32_t i = 0; i < n->count; i++)
        h = mix(h, n->list[i]);
    return mix(h, (uint64_t)(uintptr_t)n->callee + n->part);
}

static bool same(const struct tape_node *a, const struct tape_node *b)
{
    return a->op == b->op && a->part == b->part && a->count == b->count &&
           a->callee == b->callee && a->data == b->data &&
           !memcmp(&a->k, &b->k, sizeof a->k) && !memcmp(a->arg, b->arg, sizeof a->arg) &&
           (!a->count || !memcmp(a->list, b->list, a->count * sizeof *a->list));
}

static void enter(struct tape_builder *b, uint32_t id)
{
    uint32_t at = hash_of(&b->node[id]) & (b->slots - 1);
    while (b->slot[at])
        at = (at + 1) & (b->slots - 1);
    b->slot[at] = id + 1;
}

static void grow(struct tape_builder *b)
{
    b->capacity = b->capacity ? 2 * b->capacity : 8;
    struct tape_node *node = arena_new_array(b->work, struct tape_node, b->capacity);
    if (b->count)
        memcpy(node, b->node, b->count * sizeof *node);
    b->node = node;
    b->slots = 2 * b->capacity;
    b->slot = arena_new_array(b->work, uint32_t, b->slots);
    for (uint32_t i = 0; i < b->count; i++)
        enter(b, i);
}

uint32_t tape_add_node(struct tape_builder *b, const struct tape_node *n)
{
    if (b->count == TAPE_NODES_MAX) {
        b->failed = true;
        return 0;
    }
    if (b->count == b->capacity)
        grow(b);
    for (uint32_t at = hash_of(n) & (b->slots - 1); b->slot[at];
         at = (at + 1) & (b->slots - 1))
        if (same(&b->node[b->slot[at] - 1], n))
            return b->slot[at] - 1;
    b->node[b->count] = *n;
    if (n->count) {
        uint32_t *list = arena_new_array(b->work, uint32_t, n->count);
        memcpy(list, n->list, n->count * sizeof *list);
        b->node[b->count].list = list;
    }
    enter(b, b->count);
    return b->count++;
}

uint32_t tape_constant(struct tape_builder *b, double k)
{
    return tape_add_node(b, &(struct tape_node){.op = TAPE_CONSTANT, .k = k});
}

uint32_t tape_argument(struct tape_builder *b, int i)
{
    return tape_add_node(b, &(struct tape_node){.op = TAPE_ARGUMENT, .k = i});
}

bool tape_is_constant(const struct tape_builder *b, uint32_t x, double *k)
{
    if (x >= b->count || b->node[x].op != TAPE_CONSTANT)
        return false;
    *k = b->node[x].k;
    return true;
}

static double computed(enum tape_op op, double a, double b)
{
    switch (op) {
#define UNARY(name, value, derivative)                                                   \
    case TAPE_##name:                                                                    \
        return value;
#define BINARY(name, value, by_a, by_b) UNARY(name, value, 0)
#include "scene/tape.def"
#undef UNARY
#undef BINARY
    default: return 0;
    }
}

// What x is the square of; 0: of nothing, or of a constant.
static uint32_t root_of(const struct tape_builder *b, uint32_t x)
{
    return b->node[x].op == TAPE_SQUARE ? b->node[x].arg[0] : 0;
}

// The square root of a sum of two or three squares: a length, whose slope is at most that
// of its sides also where it is zero.
static bool is_length(const struct tape_builder *b, uint32_t x, uint32_t side[3])
{
    const struct tape_node *n = &b->node[x];
    if (n->op != TAPE_ADD)
        return false;
    uint32_t rest = n->arg[0];
    side[0] = root_of(b, n->arg[1]);
    if (!side[0]) {
        rest = n->arg[1];
        side[0] = root_of(b, n->arg[0]);
    }
    side[2] = side[0];
    side[1] = root_of(b, rest);
    if (side[0] && side[1])
        return true;
    const struct tape_node *m = &b->node[rest];
    if (!side[0] || m->op != TAPE_ADD)
        return false;
    side[1] = root_of(b, m->arg[0]);
    side[2] = root_of(b, m->arg[1]);
    return side[1] && side[2];
}

uint32_t tape_unary(struct tape_builder *b, enum tape_op op, uint32_t x)
{
    double k;
    uint32_t side[3];
    if (op == TAPE_SQRT && !b->failed && is_length(b, x, side))
        return tape_add_node(b,
                             &(struct tape_node){.op = TAPE_LENGTH,
                                                 .arg = {x, side[0], side[1], side[2]}});
    if (tape_is_constant(b, x, &k))
        return tape_constant(b, computed(op, k, 0));
    return tape_add_node(b, &(struct tape_node){.op = (uint8_t)op, .arg = {x}});
}

static uint32_t power(struct tape_builder *b, uint32_t x, int n)
{
    if (n == 1)
        return x;
    const uint32_t half = power(b, x, n / 2);
    const uint32_t square = tape_unary(b, TAPE_SQUARE, half);
    return n % 2 ? tape_binary(b, TAPE_MULTIPLY, square, x) : square;
}

static uint32_t plain(struct tape_builder *b, enum tape_op op, uint32_t x, uint32_t y)
{
    double j, k;
    if (tape_is_constant(b, x, &j) && tape_is_constant(b, y, &k))
        return tape_constant(b, computed(op, j, k));
    if ((op == TAPE_ADD || op == TAPE_MULTIPLY) && x > y) {
        const uint32_t swap = x;
        x = y;
        y = swap;
    }
    return tape_add_node(b, &(struct tape_node){.op = (uint8_t)op, .arg = {x, y}});
}

uint32_t tape_quotient(struct tape_builder *b, uint32_t x, uint32_t y)
{
    return plain(b, TAPE_DIVIDE, x, y);
}

// y is the constant k.
static uint32_t with_constant(struct tape_builder *b, enum tape_op op, uint32_t x,
                              uint32_t y, double k)
{
    switch (op) {
    case TAPE_ADD: return k == 0 ? x : plain(b, op, x, y);
    case TAPE_SUBTRACT: return tape_binary(b, TAPE_ADD, x, tape_constant(b, -k));
    case TAPE_MULTIPLY: return k == 1 ? x : plain(b, op, x, y);
    case TAPE_DIVIDE:
        if (k != 0)
            return tape_binary(b, TAPE_MULTIPLY, x, tape_constant(b, 1 / k));
        break;
    case TAPE_POW:
        if (k == 0)
            return tape_constant(b, 1);
        if (k == trunc(k) && k > 0 && k <= 8)
            return power(b, x, (int)k);
        break;
    default: break;
    }
    return plain(b, op, x, y);
}

uint32_t tape_binary(struct tape_builder *b, enum tape_op op, uint32_t x, uint32_t y)
{
    double k, unused;
    if (tape_is_constant(b, y, &k) && !tape_is_constant(b, x, &unused))
        return with_constant(b, op, x, y, k);
    if ((op == TAPE_ADD || op == TAPE_MULTIPLY) && tape_is_constant(b, x, &k) &&
        !tape_is_constant(b, y, &unused))
        return with_constant(b, op, y, x, k);
    if (x == y && op == TAPE_MULTIPLY)
        return tape_unary(b, TAPE_SQUARE, x);
    if (x == y && (op == TAPE_MIN || op == TAPE_MAX))
        return x;
    return plain(b, op, x, y);
}

uint32_t tape_select(struct tape_builder *b, uint32_t a, uint32_t less, uint32_t equal,
                     uint32_t more)
{
    double k;
    if (tape_is_constant(b, a, &k))
        return k < 0 ? less : k == 0 ? equal : more;
    if (less == equal && equal == more)
        return less;
    return tape_add_node(
        b, &(struct tape_node){.op = TAPE_SELECT, .arg = {a, less, equal, more}});
}

uint32_t tape_where(struct tape_builder *b, uint32_t whether, uint32_t x, uint32_t y)
{
    return tape_select(b, whether, x, y, x);
}
