// From nodes to steps: what the results need, and a register for each value.
#include "scene/tape_builder.h"

#include "base/arena.h"

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

uint32_t tape_operands(const struct tape_node *n)
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
        for (uint32_t k = 0; k < tape_operands(n); k++)
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
        for (uint32_t k = 0; k < tape_operands(n); k++)
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
        for (uint32_t k = 0; k < tape_operands(n); k++)
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
    for (uint32_t k = 0; k < tape_operands(n); k++)
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
        for (uint32_t k = 0; k < tape_operands(n); k++)
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
