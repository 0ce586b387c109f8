#ifndef EVAL_CALC_H
#define EVAL_CALC_H

#include "eval/eval.h"
#include "eval/symbol.h"

// Numeric expressions taken straight from tokens, without grammar or tree: most of what
// a loop does. Only what surely means the same is taken: known functions of numbers,
// names that hold numbers now, elements of arrays of numbers, equal widths. All else is
// left to the grammar, and nothing has happened then.

enum calc_code {
    CALC_NUMBER,
    CALC_VECTOR3,
    CALC_NAME,
    CALC_ELEMENT,
    CALC_CONSTANT,
    CALC_CALL,
    CALC_VECTOR,
    CALC_BINARY,
    CALC_UNARY,
    CALC_MEMBER,
    CALC_CHOOSE,
};

// One step of a stack machine.
struct calc_op {
    uint8_t code, count; // count: operands of CALL, VECTOR, ELEMENT
    uint16_t word;       // CALL, CONSTANT, MEMBER: the word; BINARY, UNARY: the operator
    uint32_t begin, end; // place in the file
    union {
        double number;
        const double *vector;
        struct name *name;
    };
};

struct calc {
    uint32_t used;       // tokens
    uint32_t count;      // steps
    bool at_end;         // the last token of its text ends it
    bool literal;        // begins with `<`: its width does not depend on where it stands
    struct name *next;   // a name that follows, which must be no macro, or NULL
    struct name *target; // of an assignment
    uint32_t subscripts; // ... to an array element: computed first
    struct calc_op op[];
};

struct calc_table;
struct calc_table *calc_table_new(void);
void calc_table_free(struct calc_table *t);
// stream_host.calculate
enum calc_outcome calc_run(void *user, const struct calc_place *at,
                           struct calc_result *out);

enum { CALC_OPS_MAX = 128, CALC_STACK_MAX = 24, CALC_RANDOM_MAX = 16 };
// calc_compile.c: the steps of the text at `at` in *out, which has room for
// CALC_OPS_MAX; false when it is none of the simple ones.
bool calc_compile(struct eval *e, const struct calc_place *at, struct calc *out);

#endif
