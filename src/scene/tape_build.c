// Building tapes: nodes with shared subexpressions, then registers (tape_build.h).
#include "scene/tape_build.h"

#include <string.h>

#include "base/arena.h"

struct tape_builder {
    struct arena *work;
    struct tape_node *node;
    uint32_t count, capacity;
    uint32_t *slot; // open addressing, number of the node + 1
    uint32_t slots;
    bool failed;
};

struct tape_builder *tape_builder_new(struct arena *work)
{
    struct tape_builder *b = arena_new_struct(work, struct tape_builder);
    b->work = work;
    tape_constant(b, 0); // node 0 is nobody's side in root_of
    return b;
}

// ---- nodes --------------------------------------------------------------------------

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

// The node, an equal one if there is one already.
static uint32_t add(struct tape_builder *b, const struct tape_node *n)
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
    return add(b, &(struct tape_node){.op = TAPE_CONSTANT, .k = k});
}

uint32_t tape_argument(struct tape_builder *b, int i)
{
    return add(b, &(struct tape_node){.op = TAPE_ARGUMENT, .k = i});
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
        return add(b, &(struct tape_node){.op = TAPE_LENGTH,
                                          .arg = {x, side[0], side[1], side[2]}});
    if (tape_is_constant(b, x, &k))
        return tape_constant(b, computed(op, k, 0));
    return add(b, &(struct tape_node){.op = (uint8_t)op, .arg = {x}});
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
    return add(b, &(struct tape_node){.op = (uint8_t)op, .arg = {x, y}});
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
    return add(b, &(struct tape_node){.op = TAPE_SELECT, .arg = {a, less, equal, more}});
}

uint32_t tape_where(struct tape_builder *b, uint32_t whether, uint32_t x, uint32_t y)
{
    return tape_select(b, whether, x, y, x);
}

// ---- calls --------------------------------------------------------------------------

void tape_call_extern(struct tape_builder *b, const struct tape_extern *f,
                      const void *data, const uint32_t *in, uint32_t *out)
{
    if (f->expand && f->expand(b, data, in, out))
        return;
    uint32_t list[TAPE_EXTERN_ARGUMENTS];
    memcpy(list, in, (size_t)f->arguments * sizeof *list);
    out[0] = add(b, &(struct tape_node){.op = TAPE_EXTERN,
                                        .list = list,
                                        .callee = f,
                                        .count = (uint32_t)f->arguments,
                                        .data = data});
    for (int i = 1; i < f->width; i++)
        out[i] = add(b, &(struct tape_node){.op = TAPE_EXTERN,
                                            .part = (uint8_t)i,
                                            .arg = {out[0]},
                                            .callee = f,
                                            .data = data});
}

// A node of another tape whose operands are known here.
static uint32_t taken_in(struct tape_builder *b, const struct tape_node *n,
                         const uint32_t *in, const uint32_t *map)
{
    const uint32_t *a = n->arg;
    uint32_t list[TAPE_LIST_MAX];
    for (uint32_t i = 0; i < n->count; i++)
        list[i] = map[n->list[i]];
    switch (n->op) {
    case TAPE_CONSTANT: return tape_constant(b, n->k);
    case TAPE_ARGUMENT: return in[(int)n->k];
    case TAPE_SELECT: return tape_select(b, map[a[0]], map[a[1]], map[a[2]], map[a[3]]);
    case TAPE_CALL: {
        uint32_t out[TAPE_WIDTH_MAX];
        tape_call(b, n->callee, list, out);
        return out[0];
    }
    case TAPE_SUM:
    case TAPE_PRODUCT:
        return tape_loop(b, n->op == TAPE_PRODUCT, n->callee, list[0], list[1], list + 2,
                         (int)n->count - 2);
    case TAPE_DIVIDE: return tape_binary(b, TAPE_DIVIDE, map[a[0]], map[a[1]]);
    case TAPE_LENGTH: return tape_unary(b, TAPE_SQRT, map[a[0]]);
#define UNARY(name, value, derivative)                                                   \
    case TAPE_##name:                                                                    \
        return tape_unary(b, (enum tape_op)n->op, map[a[0]]);
#define BINARY(name, value, by_a, by_b)
#include "scene/tape.def"
#undef UNARY
#undef BINARY
    default: return tape_binary(b, (enum tape_op)n->op, map[a[0]], map[a[1]]);
    }
}

static void take_in(struct tape_builder *b, const struct tape *t, const uint32_t *in,
                    uint32_t *out)
{
    uint32_t *map = arena_new_array(b->work, uint32_t, t->node_count);
    for (uint32_t i = 0; i < t->node_count; i++) {
        const struct tape_node *n = &t->node[i];
        if (n->op != TAPE_EXTERN) {
            map[i] = taken_in(b, n, in, map);
            continue;
        }
        if (n->part)
            continue; // filled with the first part
        const struct tape_extern *f = n->callee;
        uint32_t list[TAPE_EXTERN_ARGUMENTS], part[TAPE_WIDTH_MAX];
        for (uint32_t k = 0; k < n->count; k++)
            list[k] = map[n->list[k]];
        tape_call_extern(b, f, n->data, list, part);
        map[i] = part[0];
        for (int k = 1; k < f->width; k++)
            map[i + (uint32_t)k] = part[k];
    }
    for (int i = 0; i < t->width; i++)
        out[i] = map[t->node_result[i]];
}

void tape_call(struct tape_builder *b, const struct tape *t, const uint32_t *in,
               uint32_t *out)
{
    if (t->width > 1 || b->count + t->node_count <= TAPE_INLINE_MAX ||
        t->node_count < 32) {
        take_in(b, t, in, out);
        return;
    }
    uint32_t list[TAPE_LIST_MAX];
    memcpy(list, in, (size_t)t->arguments * sizeof *list);
    out[0] = add(b, &(struct tape_node){.op = TAPE_CALL,
                                        .list = list,
                                        .callee = t,
                                        .count = (uint32_t)t->arguments});
}

// The turns one after the other, if they are few.
static bool unroll(struct tape_builder *b, bool product, const struct tape *body,
                   double from, double to, const uint32_t *more, int count, uint32_t *out)
{
    uint32_t in[TAPE_LIST_MAX], total = tape_constant(b, product), term;
    const double turns = tape_turns(from, to);
    if (!(turns <= TAPE_UNROLL_MAX) ||
        b->count + turns * body->node_count > TAPE_INLINE_MAX)
        return false;
    memcpy(in + 1, more, (size_t)count * sizeof *in);
    for (double k = from; k <= to; k++) {
        in[0] = tape_constant(b, k);
        take_in(b, body, in, &term);
        total = tape_binary(b, product ? TAPE_MULTIPLY : TAPE_ADD, total, term);
    }
    *out = total;
    return true;
}

uint32_t tape_loop(struct tape_builder *b, bool product, const struct tape *body,
                   uint32_t from, uint32_t to, const uint32_t *more, int count)
{
    double first, last;
    uint32_t out, list[TAPE_LIST_MAX];
    if (count > TAPE_LIST_MAX - 2) {
        b->failed = true;
        return 0;
    }
    if (tape_is_constant(b, from, &first) && tape_is_constant(b, to, &last) &&
        unroll(b, product, body, first, last, more, count, &out))
        return out;
    list[0] = from;
    list[1] = to;
    memcpy(list + 2, more, (size_t)count * sizeof *list);
    return add(b, &(struct tape_node){.op = product ? TAPE_PRODUCT : TAPE_SUM,
                                      .list = list,
                                      .count = (uint32_t)count + 2,
                                      .callee = body});
}

// ---- registers ----------------------------------------------------------------------

struct finish {
    const struct tape_node *node;
    uint32_t count; // of nodes
    uint32_t *last; // the last node that reads this one; 0: nobody
    uint16_t *reg;  // register of each node
    uint16_t *free; // registers in nobody's use
    uint32_t free_count, registers, steps, list;
    int depth;
    bool opaque, calls;
};

static uint32_t operands(const struct tape_node *n)
{
    switch (n->op) {
    case TAPE_CONSTANT:
    case TAPE_ARGUMENT:
    case TAPE_CALL:
    case TAPE_SUM:
    case TAPE_PRODUCT: return 0;
    case TAPE_EXTERN: return n->part > 0;
    case TAPE_SELECT:
    case TAPE_LENGTH: return 4;
#define UNARY(name, value, derivative)                                                   \
    case TAPE_##name:                                                                    \
        return 1;
#define BINARY(name, value, by_a, by_b)
#include "scene/tape.def"
#undef UNARY
#undef BINARY
    default: return 2;
    }
}

// What the results need, renumbered; first parts of externs come with all their parts.
static struct tape_node *reachable(struct tape_builder *b, struct arena *a,
                                   const uint32_t *result, int width, uint32_t *count,
                                   uint32_t *map)
{
    uint8_t *used = arena_new_array(b->work, uint8_t, b->count);
    for (int i = 0; i < width; i++)
        used[result[i]] = 1;
    for (uint32_t i = b->count; i-- > 0;) {
        const struct tape_node *n = &b->node[i];
        if (n->op == TAPE_EXTERN && !n->part)
            for (int k = 1; k < ((const struct tape_extern *)n->callee)->width; k++)
                used[i] |= used[i + (uint32_t)k];
        if (!used[i])
            continue;
        for (uint32_t k = 0; k < operands(n); k++)
            used[n->arg[k]] = 1;
        for (uint32_t k = 0; k < n->count; k++)
            used[n->list[k]] = 1;
    }
    for (uint32_t i = 0; i < b->count; i++)
        if (b->node[i].op == TAPE_EXTERN && b->node[i].part)
            used[i] |= used[b->node[i].arg[0]];
    *count = 0;
    for (uint32_t i = 0; i < b->count; i++)
        if (used[i])
            map[i] = (*count)++;
    struct tape_node *out = arena_new_array(a, struct tape_node, *count);
    for (uint32_t i = 0; i < b->count; i++) {
        if (!used[i])
            continue;
        struct tape_node *n = &out[map[i]];
        *n = b->node[i];
        for (uint32_t k = 0; k < operands(n); k++)
            n->arg[k] = map[n->arg[k]];
        if (n->count)
            n->list = arena_new_array(a, uint32_t, n->count);
        for (uint32_t k = 0; k < n->count; k++)
            n->list[k] = map[b->node[i].list[k]];
    }
    return out;
}

static void find_last_uses(struct finish *f, const uint32_t *result, int width)
{
    for (uint32_t i = 0; i < f->count; i++) {
        const struct tape_node *n = &f->node[i];
        for (uint32_t k = 0; k < operands(n); k++)
            f->last[n->arg[k]] = i;
        for (uint32_t k = 0; k < n->count; k++)
            f->last[n->list[k]] = i;
    }
    for (int i = 0; i < width; i++)
        f->last[result[i]] = UINT32_MAX;
}

static void release(struct finish *f, uint32_t id, uint32_t now)
{
    const struct tape_node *n = &f->node[id];
    if (f->last[id] != now || n->op == TAPE_CONSTANT || n->op == TAPE_ARGUMENT ||
        n->op == TAPE_EXTERN)
        return;
    f->last[id] = UINT32_MAX; // once, also when it is read twice
    f->free[f->free_count++] = f->reg[id];
}

// Operands are released before the result gets its place: a step reads all of them
// before it writes.
static bool place(struct finish *f, uint32_t i)
{
    const struct tape_node *n = &f->node[i];
    if (n->op == TAPE_EXTERN && n->part) {
        f->reg[i] = (uint16_t)(f->reg[n->arg[0]] + n->part);
        return true;
    }
    for (uint32_t k = 0; k < operands(n); k++)
        release(f, n->arg[k], i);
    for (uint32_t k = 0; k < n->count; k++)
        release(f, n->list[k], i);
    const uint32_t width = n->op == TAPE_EXTERN
                               ? (uint32_t)((const struct tape_extern *)n->callee)->width
                               : 1;
    if (width == 1 && f->free_count) {
        f->reg[i] = f->free[--f->free_count];
    } else {
        f->reg[i] = (uint16_t)f->registers;
        f->registers += width;
    }
    f->steps++;
    f->list += n->count;
    return f->registers <= TAPE_REGISTERS_MAX;
}

static void look_into(struct finish *f, const struct tape_node *n)
{
    if (n->op == TAPE_EXTERN) {
        const struct tape_extern *e = n->callee;
        f->opaque |= !e->bounds || (e->opaque && e->opaque(n->data));
    }
    if (n->op == TAPE_CALL || n->op == TAPE_SUM || n->op == TAPE_PRODUCT) {
        const struct tape *t = n->callee;
        f->opaque |= t->opaque;
        f->calls = true;
        if (t->depth >= f->depth)
            f->depth = t->depth + 1;
    }
}

static bool assign(struct finish *f, struct tape *t, double *constant)
{
    for (uint32_t i = 0; i < f->count; i++)
        if (f->node[i].op == TAPE_CONSTANT) {
            f->reg[i] = (uint16_t)t->constant_count;
            constant[t->constant_count++] = f->node[i].k;
        }
    f->registers = t->constant_count + (uint32_t)t->arguments;
    if (f->registers > TAPE_REGISTERS_MAX)
        return false;
    for (uint32_t i = 0; i < f->count; i++) {
        const struct tape_node *n = &f->node[i];
        look_into(f, n);
        if (n->op == TAPE_ARGUMENT)
            f->reg[i] = (uint16_t)(t->constant_count + (uint32_t)n->k);
        else if (n->op != TAPE_CONSTANT && !place(f, i))
            return false;
    }
    return f->depth <= TAPE_DEPTH_MAX;
}

static void write_steps(const struct finish *f, struct tape_step *s, uint16_t *list)
{
    uint32_t listed = 0;
    for (uint32_t i = 0; i < f->count; i++) {
        const struct tape_node *n = &f->node[i];
        if (n->op == TAPE_CONSTANT || n->op == TAPE_ARGUMENT ||
            (n->op == TAPE_EXTERN && n->part))
            continue;
        uint16_t r[4] = {0};
        for (uint32_t k = 0; k < operands(n); k++)
            r[k] = f->reg[n->arg[k]];
        *s++ = (struct tape_step){.op = n->op,
                                  .to = f->reg[i],
                                  .a = r[0],
                                  .b = r[1],
                                  .c = r[2],
                                  .d = r[3],
                                  .list = listed,
                                  .count = n->count,
                                  .callee = n->callee,
                                  .data = n->data};
        for (uint32_t k = 0; k < n->count; k++)
            list[listed++] = f->reg[n->list[k]];
    }
}

struct tape *tape_finish(struct tape_builder *b, struct arena *a, int arguments,
                         const uint32_t *result, int width)
{
    if (b->failed)
        return NULL;
    struct tape *t = arena_new_struct(a, struct tape);
    uint32_t *map = arena_new_array(b->work, uint32_t, b->count);
    t->arguments = arguments;
    t->width = width;
    t->node = reachable(b, a, result, width, &t->node_count, map);
    for (int i = 0; i < width; i++)
        t->node_result[i] = map[result[i]];
    struct finish f = {.node = t->node, .count = t->node_count};
    f.last = arena_new_array(b->work, uint32_t, f.count);
    f.reg = arena_new_array(b->work, uint16_t, f.count);
    f.free = arena_new_array(b->work, uint16_t, f.count);
    double *constant = arena_new_array(a, double, f.count);
    find_last_uses(&f, t->node_result, width);
    if (!assign(&f, t, constant))
        return NULL;
    struct tape_step *step = arena_new_array(a, struct tape_step, f.steps);
    uint16_t *list = arena_new_array(a, uint16_t, f.list);
    write_steps(&f, step, list);
    t->constant = constant;
    t->step = step;
    t->list = list;
    t->step_count = f.steps;
    t->register_count = f.registers;
    t->depth = f.depth;
    t->opaque = f.opaque;
    t->calls = f.calls;
    for (int i = 0; i < width; i++)
        t->result[i] = f.reg[t->node_result[i]];
    return t;
}
