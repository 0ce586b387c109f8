#ifndef EVAL_FUNCTION_COMPILE_H
#define EVAL_FUNCTION_COMPILE_H

#include "eval/eval.h"
#include "scene/tape_build.h"

// The tape of an expression in the parameters, or in x, y, z where there are none (NULL).
// NULL after an error.
struct tape *function_compile(struct eval *e, const struct ast *parameters,
                              const struct ast *body);
// Ends the tape of a body; NULL, and an error at n, when it is too large.
struct tape *function_finish(struct eval *e, const struct ast *n, struct tape_builder *b,
                             int arguments, const uint32_t *result, int width);

#endif
