#ifndef EVAL_CALC_H
#define EVAL_CALC_H

#include "eval/eval.h"
#include "eval/symbol.h"

// Expressions taken straight from tokens, without grammar or tree: most of what
// a loop does. Only what surely means the same is taken: known functions of numbers,
// names that hold numbers or strings now, elements of arrays of numbers, equal widths,
// macros whose body is one closed expression after some #local. All else is
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
    CALC_STRING,
    CALC_SLOT,  // an argument or local of a macro that is carried out in place
    CALC_LEAVE, // its end: the value on top takes the place of these
};

// One step of a stack machine.
struct calc_op {
    uint8_t code, count; // count: operands of CALL, VECTOR, ELEMENT; SLOT, LEAVE: a place
                         // on the stack
    uint16_t word;       // CALL, CONSTANT, MEMBER: the word; BINARY, UNARY: the operator
    uint32_t begin, end; // place in the file
    uint8_t macro;       // which of calc.macro it stands in, from 1; 0: none
    union {
        double number;
        const double *vector;
        struct name *name;
        const char *string;
    };
};

// A macro that is carried out in place: it must be what its name stands for.
struct calc_macro {
    struct name *name;
    const struct macro *macro;
    uint32_t begin, end; // the name where it is called
    uint8_t outer;       // as calc_op.macro
};

enum {
    CALC_OPS_MAX = 128,
    CALC_STACK_MAX = 40,
    CALC_RANDOM_MAX = 16,
    CALC_MACROS_MAX = 8
};

struct calc {
    uint32_t used;       // tokens
    uint32_t count;      // steps
    bool at_end;         // the last token of its text ends it
    bool literal;        // begins with `<`: its width does not depend on where it stands
    struct name *next;   // a name that follows, which must be no macro, or NULL
    struct name *target; // of an assignment
    uint32_t subscripts; // ... to an array element: computed first
    bool reports;        // a step may have something to say: names are looked at first
    bool appends;        // `target = concat(target, ...)`
    uint32_t macro_count;
    struct calc_macro macro[CALC_MACROS_MAX];
    struct calc_op op[];
};

struct calc_table;
struct calc_table *calc_table_new(void);
void calc_table_free(struct calc_table *t);
// stream_host.calculate
enum calc_outcome calc_run(void *user, const struct calc_place *at,
                           struct calc_result *out);

// calc_compile.c: the steps of the text at `at` in *out, which has room for
// CALC_OPS_MAX; false when it is none of the simple ones. strings: where literals go.
bool calc_compile(struct eval *e, const struct calc_place *at, struct arena *strings,
                  struct calc *out);

#endif
