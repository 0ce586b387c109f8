#ifndef EVAL_FUNCTION_H
#define EVAL_FUNCTION_H

#include "eval/eval.h"
#include "scene/tape.h"

// Functions of the scene language (spec/language 4.16): the parameters are the arguments of a
// tape, a vector function has more results.

// The data of a VALUE_FUNCTION. functions.inc declares 79, of which a scene uses few: those
// that are internal() become tapes when they are first asked for.
struct function {
    const struct tape *tape; // NULL: not yet
    const struct internal_function *internal;
};
const struct tape *function_tape(struct eval *e, const struct value *v);

// The value of `function (a, b) { }`; NULL after an error.
const struct value *function_value(struct eval *e, const struct ast *block);
// Of `function { }` where the language wants an expression in x, y, z.
const struct tape *function_expression(struct eval *e, const struct ast *block);

#endif
