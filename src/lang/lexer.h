#ifndef LANG_LEXER_H
#define LANG_LEXER_H

#include "base/diag.h"
#include "lang/token.h"

enum { LEX_TEXT_MAX = 65535 }; // bytes of a name or string (token.len)

// The whole file as tokens. `vectors`: where the numbers of literal vectors go, each of
// which becomes one TOK_VECTOR3, and literal blocks become one TOK_LITERAL; NULL: all stays as
// it is written.
// From malloc, with one of kind 0 (the end) after the last of *count. Loops and macros then rewind an index instead of scanning text again.
struct lexeme *lex_file(const struct source_map *sources, uint32_t file,
                        struct diag_sink *diags, const struct word_table *words,
                        struct arena *vectors, uint32_t *count);

// The kind of a reserved word's token. Functions are TOK_CALL1 and so on only before a '('
// (the stream sees to that): `sin` is also a kind of julia_fractal.
int lex_word(enum word w);

// Prints a file's tokens (without TOK_VECTOR3 and blocks), one a line: place, kind, text.
void lex_print(const struct source_map *sources, uint32_t file, struct diag_sink *diags,
               FILE *out);

#endif
