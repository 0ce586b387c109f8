#ifndef EVAL_FUNCTION_H
#define EVAL_FUNCTION_H

#include "eval/eval.h"

// Functions of the scene language (spec/language 4.16): a tape of simple steps over
// numbered registers, the parameters first.
struct function;

// The value of `function (a, b) { }`; NULL after an error.
const struct value *function_value(struct eval *e, const struct ast *block);
int function_parameters(const struct function *f);
// Components of the result: 1 for expressions.
int function_width(const struct function *f);
void function_run(const struct function *f, const double *argument, double out[5]);
// As pattern.function wants it: a function of x, y, z.
double function_at(const void *data, struct vec3 p);

#endif
