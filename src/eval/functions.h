#ifndef EVAL_FUNCTIONS_H
#define EVAL_FUNCTIONS_H

#include "eval/expr.h"

// One argument as its letter in functions.def says.
struct argument {
    double f;
    double n[5]; // v; missing components 0
    struct vec3 v;
    const char *s;
    const struct value *o; // NULL: an expression without a declared value
    const struct ast *node;
};

struct call {
    struct eval *e;
    const struct ast *node;
    const char *name;
    uint32_t count;
    const struct argument *arg;
    struct call_result result;
};

struct builtin {
    bool (*run)(struct call *c); // NULL: the word is no function
    const char *arguments;
    uint8_t least, most;
    char result;
};
const struct builtin *builtin_find(enum word w);

#define BUILTIN(word, least, most, arguments, kind) bool call_##word(struct call *c);
#include "eval/functions.def"
#undef BUILTIN

bool call_domain(struct call *c, const char *what); // reports; false

#endif
