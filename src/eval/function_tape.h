#ifndef EVAL_FUNCTION_TAPE_H
#define EVAL_FUNCTION_TAPE_H

#include "eval/function.h"
#include "eval/spline.h"

enum { FUNCTION_REGISTERS = 256, FUNCTION_PARAMETERS_MAX = 56 };

enum function_kind {
    FUNCTION_TAPE, FUNCTION_TRANSFORM, FUNCTION_SPLINE, FUNCTION_INTERNAL,
    FUNCTION_PIGMENT, FUNCTION_PATTERN,
};

enum step_op {
    STEP_CONSTANT, // r[to] = k
    STEP_COPY, STEP_NEGATE,
    STEP_ADD, STEP_SUBTRACT, STEP_MULTIPLY, STEP_DIVIDE,
    STEP_LESS, STEP_GREATER, STEP_EQUAL, STEP_NOT_EQUAL, STEP_LESS_EQUAL,
    STEP_GREATER_EQUAL, STEP_AND, STEP_OR,
    STEP_MATH,   // r[to] = the built-in `word` of the registers from a on, b of them
    STEP_CALL,   // r[to] = component b of `callee` of the registers from a on
    STEP_GRAY,   // the same, as grey
    STEP_JUMP,   // to step number `to`
    STEP_UNLESS, // ... if r[a] is 0
};

struct step {
    uint8_t op;
    uint16_t to, a, b, word;
    union {
        double k;
        const struct function *callee;
    };
};

struct function {
    enum function_kind kind;
    int parameters, width;
    const struct step *step;
    uint32_t step_count;
    uint16_t result;
    const void *data; // struct transform, spline, internal_function, pigment, pattern
    const struct pattern_defaults *defaults;
};

// The built-in functions that functions may use, on n arguments.
double function_math(enum word w, const double *a, int n);
// How many arguments; false: the word is not one of them.
bool function_math_arity(enum word w, int *least, int *most);

#endif
