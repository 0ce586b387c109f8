#ifndef LANG_LEXER_H
#define LANG_LEXER_H

#include "base/diag.h"
#include "lang/token.h"

enum { LEX_TEXT_MAX = 65535 }; // bytes of a name or string (token.len)

// The whole file as tokens, from malloc, with one of kind 0 (the end) after the last
// of *count. Loops and macros then rewind an index instead of scanning text again.
struct token *lex_file(const struct source_map *sources, uint32_t file,
                       struct diag_sink *diags, uint32_t *count);

#endif
