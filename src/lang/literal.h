#ifndef LANG_LITERAL_H
#define LANG_LITERAL_H

#include "lang/ast.h"

// A block in which everything is written out, `sphere { <1, 2, 3>, 0.5 texture { pigment { rgb
// <1, 0, 0> } } }`: one token, TOK_LITERAL, from its word to its '}'. Programs write scenes of
// millions of these. Only plain numbers, vectors of three, words, commas, and blocks of the same
// kind are taken; what holds anything else (a name, a sum, a comment, a directive, an object
// inside an object) is left to scanner and grammar, which make the same nodes and the errors.

// text: what follows the block's word. The bytes up to and with its '}' and how many tokens
// the word and they are; or 0.
size_t literal_scan(const struct word_table *words, enum word w, const char *text,
                    size_t len, uint32_t *tokens);

// The AST_BLOCK of a TOK_LITERAL.
struct ast *literal_read(struct arena *a, const struct word_table *words,
                         const struct token *t);

#endif
