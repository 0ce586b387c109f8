#ifndef LANG_TOKEN_H
#define LANG_TOKEN_H

#include <stdint.h>

#include "base/source.h"

struct value;

// One token of a file, made once by the lexer. `word` is the index of a reserved
// word in keywords.def (enum word), or WORD_NONE for an ordinary name.
struct token {
    int kind; // a TOK_* of grammar/parser.y, or a character
    struct span where;
    uint16_t word;
    uint16_t len;
    const char *text; // points into the source; not terminated
    double number;
    const struct value *value; // a declared name, when read by the stream: its value
};

// Reserved words, in the order of keywords.def: WORD_sphere, WORD_rotate, ...
enum word {
    WORD_NONE,
#define WORD(name, class) WORD_##name,
#include "lang/keywords.def"
#undef WORD
    WORD_COUNT
};

const char *word_text(enum word w);

#endif
