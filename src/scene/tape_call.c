// Steps of tapes that are calls: of other tapes, which may be taken in, of C functions, of loops.
#include "scene/tape_builder.h"

#include <string.h>

#include "base/arena.h"

void tape_call_extern(struct tape_builder *b, const struct tape_extern *f,
                      const void *data, const uint32_t *in, uint32_t *out)
{
    if (f->expand && f->expand(b, data, in, out))
        return;
    uint32_t list[TAPE_EXTERN_ARGUMENTS];
    memcpy(list, in, (size_t)f->arguments * sizeof *list);
    out[0] = tape_add_node(b, &(struct tape_node){.op = TAPE_EXTERN,
                                                  .list = list,
                                                  .callee = f,
                                                  .count = (uint32_t)f->arguments,
                                                  .data = data});
    for (int i = 1; i < f->width; i++)
        out[i] = tape_add_node(b, &(struct tape_node){.op = TAPE_EXTERN,
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
    out[0] = tape_add_node(b, &(struct tape_node){.op = TAPE_CALL,
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
    return tape_add_node(b, &(struct tape_node){.op = product ? TAPE_PRODUCT : TAPE_SUM,
                                                .list = list,
                                                .count = (uint32_t)count + 2,
                                                .callee = body});
}
