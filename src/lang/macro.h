#ifndef LANG_MACRO_H
#define LANG_MACRO_H

#include "lang/token.h"

enum { PARAMETERS_MAX = 55 };

#define MACRO_VERSION 3.1 // of the language, the first with macros

// A macro as it was defined: its body is a run of tokens. Never changed, and kept as long
// as the scene is read.
struct macro {
    const char *name; // terminated
    struct span where;
    uint32_t file;
    const char *text;          // of the file
    const struct lexeme *body; // count tokens
    uint32_t *slots;           // ... and calc_place.slot of each
    uint32_t count;
    int parameter_count;
    struct macro_parameter {
        const char *text;
        size_t len;
    } parameter[];
};

#endif
