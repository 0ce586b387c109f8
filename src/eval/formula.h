#ifndef EVAL_FORMULA_H
#define EVAL_FORMULA_H

#include "scene/tape_build.h"

// The formulas of internal.def as steps of a tape: + - * / and calls over numbers, pi,
// x y z and their squares A B C, the parameters p[i], and one-letter names given before
// by `name = value;`. The point is in `at`. Aborts on text that is no formula: it comes
// from the table alone.
uint32_t formula_build(struct tape_builder *b, const char *text, const uint32_t at[3],
                       const uint32_t *parameter);
// Kept within -limit..limit.
uint32_t formula_bounded(struct tape_builder *b, uint32_t v, uint32_t limit);

#endif
