#ifndef LANG_LITERAL_H
#define LANG_LITERAL_H

#include "lang/ast.h"

// A block in which everything is written out, `sphere { <1, 2, 3>, 0.5 texture { pigment { rgb
// <1, 0, 0> } } }`: one token, TOK_LITERAL, from its word to its '}'. Programs write scenes of
// millions of these. Only plain numbers, vectors of three, words, commas, and blocks of the same
// kind are taken; what holds anything else (a sum, a comment, a directive, an object inside an
// object) is left to scanner and grammar, which make the same nodes and the errors.
//
// Names are taken where they stand for what was declared before, `texture { T }`: then the
// token is a TOK_NAMED, which the stream makes a TOK_LITERAL of if they are declared as blocks
// or objects when it comes there; else it goes through the tokens of the block.
struct stream_host;

// text: what follows the block's word. The bytes up to and with its '}', or 0. Of *out: how
// many tokens the word and they are, and the names, as places in `text`.
size_t literal_scan(const struct word_table *words, enum word w, const char *text,
                    size_t len, struct named_literal *out);

// The AST_BLOCK of a TOK_LITERAL; `names`: who knows what names in it are.
struct ast *literal_read(struct arena *a, const struct word_table *words,
                         const struct token *t, const struct stream_host *names);

// The tokens that a TOK_NAMED stands for, in t->named.
void literal_expand(struct arena *a, const struct word_table *words,
                    const struct token *t);

#endif
