#ifndef LANG_LEXER_H
#define LANG_LEXER_H

#include "base/diag.h"
#include "lang/token.h"

enum { LEX_TEXT_MAX = 65535 }; // bytes of a name or string (token.len)

// The whole file as tokens. `vectors`: where the numbers of literal vectors go, each of
// which becomes one TOK_VECTOR3; NULL: vectors stay as they are written.
// From malloc, with one of kind 0 (the end) after the last
// of *count. Loops and macros then rewind an index instead of scanning text again.
struct lexeme *lex_file(const struct source_map *sources, uint32_t file,
                       struct diag_sink *diags, struct arena *vectors, uint32_t *count);

#endif
