#ifndef SCENE_TAPE_BUILD_H
#define SCENE_TAPE_BUILD_H

#include "scene/tape_steps.h"

struct arena;

// Builds a tape from the leaves up. A value is the number of its node; equal nodes are
// one, constants are folded, what no result needs is dropped. Roundings are those of the
// scene language (spec/textures 14.1): a division by a constant is a product with its
// reciprocal, whole powers 2..8 are products. After something went wrong (too many nodes
// or registers) all calls go on harmlessly and tape_finish returns NULL.
struct tape_builder;

// Nodes live in `work` until the tape is finished.
struct tape_builder *tape_builder_new(struct arena *work);
// A copy in `a` with these results; NULL: too large.
struct tape *tape_finish(struct tape_builder *b, struct arena *a, int arguments,
                         const uint32_t *result, int width);

uint32_t tape_constant(struct tape_builder *b, double k);
uint32_t tape_argument(struct tape_builder *b, int i);
uint32_t tape_unary(struct tape_builder *b, enum tape_op op, uint32_t x);
uint32_t tape_binary(struct tape_builder *b, enum tape_op op, uint32_t x, uint32_t y);
// x / y as it stands, also for a constant y.
uint32_t tape_quotient(struct tape_builder *b, uint32_t x, uint32_t y);
uint32_t tape_select(struct tape_builder *b, uint32_t a, uint32_t less, uint32_t equal,
                     uint32_t more);
// whether ? x : y, for a `whether` that is 0 or 1.
uint32_t tape_where(struct tape_builder *b, uint32_t whether, uint32_t x, uint32_t y);
void tape_call_extern(struct tape_builder *b, const struct tape_extern *f,
                      const void *data, const uint32_t *in, uint32_t *out);
// The results of another tape: its steps, or a call where they would be too many.
void tape_call(struct tape_builder *b, const struct tape *t, const uint32_t *in,
               uint32_t *out);
// sum or product of body(k, more...) for k = from, from + 1, .. up to `to`.
uint32_t tape_loop(struct tape_builder *b, bool product, const struct tape *body,
                   uint32_t from, uint32_t to, const uint32_t *more, int count);
bool tape_is_constant(const struct tape_builder *b, uint32_t x, double *k);

#endif
