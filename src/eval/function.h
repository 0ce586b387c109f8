#ifndef EVAL_FUNCTION_H
#define EVAL_FUNCTION_H

#include "eval/eval.h"
#include "scene/tape.h"

// Functions of the scene language (spec/language 4.16). The data of a VALUE_FUNCTION is a
// struct tape: the parameters are its arguments, a vector function has more results.

// The value of `function (a, b) { }`; NULL after an error.
const struct value *function_value(struct eval *e, const struct ast *block);
// Of `function { }` where the language wants an expression in x, y, z.
const struct tape *function_expression(struct eval *e, const struct ast *block);

#endif
