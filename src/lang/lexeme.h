#ifndef LANG_LEXEME_H
#define LANG_LEXEME_H

#include "lang/bulk.h"
#include "lang/token.h"
#include "parser.h"

// What a lexeme of 16 bytes leaves to be worked out.

// Bytes of its text, a string's quotes among them.
static inline uint32_t lexeme_len(const struct lexeme *t)
{
    switch (t->kind) {
    case TOK_NUMBER: return t->word;
    case TOK_VECTOR3: return t->vector->len;
    case TOK_BULK: return t->bulk->len;
    case TOK_NAMED: return t->named->len;
    default: return t->len;
    }
}

static inline enum word lexeme_word(const struct lexeme *t)
{
    return t->kind == TOK_NUMBER ? WORD_NONE : (enum word)t->word;
}

// The whole token; `file` and `expansion` for its place, `text` of the whole file. Written
// where it is wanted: tokens are large, and copies of what was just written in parts are
// slow.
static inline void lexeme_token(const struct lexeme *t, uint32_t file, const char *text,
                                uint32_t expansion, struct token *out)
{
    const uint32_t quote = t->kind == TOK_STRING, len = lexeme_len(t);
    const uint32_t inner = len - 2 * quote;
    out->kind = t->kind;
    out->where.file = file;
    out->where.begin = t->begin;
    out->where.end = t->begin + len;
    out->where.expansion = expansion;
    out->word = (uint16_t)lexeme_word(t);
    out->len = (uint16_t)(inner < UINT16_MAX ? inner : UINT16_MAX);
    out->text = text + t->begin + quote;
    out->number = t->number; // or what else the union holds
    out->value = NULL;
}

#endif
