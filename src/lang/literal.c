#include "lang/literal.h"

#include <string.h>

#include "base/arena.h"
#include "lang/bulk.h"
#include "lang/lexer.h"
#include "lang/scan.h"
#include "lang/stream.h"
#include "parser.h"

enum { NESTING = 6 }; // of blocks; texts that are not taken are looked at again as often

// What is made of a text: nodes, or tokens, or nothing but a look at it.
struct reader {
    struct scan s;
    const struct word_table *words;
    struct arena *nodes;
    const struct stream_host *names; // of nodes
    struct lexeme *tokens;           // the next one
    struct arena *vectors;           // of tokens
    const char *text;                // of the file from where.begin on
    struct span where;               // of the whole
    struct named_literal found;
};

// The items of a block so far.
struct items {
    enum word block;
    struct ast **end; // where the next one goes; NULL when no nodes are made
    struct ast *last;
    bool any;
    bool comma;  // may follow
    bool vector; // may follow: a '<' here is certainly no "less than"
};

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// Of one item; NULL unless nodes are made.
static struct ast *add(struct reader *r, struct items *i, enum ast_kind kind,
                       const char *from)
{
    i->comma = i->any = true;
    if (!r->nodes)
        return NULL;
    struct span where = r->where;
    where.begin += (uint32_t)(from - r->text);
    where.end = r->where.begin + (uint32_t)(r->s.at - r->text);
    struct ast *n = *i->end = i->last = ast_new(r->nodes, kind, where);
    i->end = &n->next;
    return n;
}

// The token from there to where the scan is; NULL unless tokens are made.
static struct lexeme *emit(struct reader *r, int kind, const char *from)
{
    r->found.tokens++;
    if (!r->tokens)
        return NULL;
    struct lexeme *t = r->tokens++;
    t->kind = (uint16_t)kind;
    t->begin = r->where.begin + (uint32_t)(from - r->text);
    t->len = (uint32_t)(r->s.at - from);
    return t;
}

static void mark(struct reader *r)
{
    r->s.at++;
    emit(r, r->s.at[-1], r->s.at - 1);
}

static bool take_number(struct reader *r, struct items *i)
{
    const char *from = r->s.at;
    double v;
    i->vector = false;
    if (!scan_number(&r->s, r->nodes || r->tokens ? &v : NULL))
        return false;
    struct ast *n = add(r, i, AST_NUMBER, from);
    if (n)
        n->number = v;
    struct lexeme *t = emit(r, TOK_NUMBER, from);
    if (t) {
        const uint32_t len = t->len;
        t->word = (uint16_t)(len < UINT16_MAX ? len : UINT16_MAX);
        t->number = v;
    }
    return true;
}

// A component of a pair, whose sign is a token and a node of its own.
static bool take_component(struct reader *r, struct ast **out)
{
    const char *from = r->s.at;
    const bool minus = scan_next(&r->s) == '-';
    if (minus)
        mark(r);
    struct items one = {.end = out};
    if (scan_next(&r->s) == '-' || !take_number(r, &one))
        return false;
    if (minus && r->nodes) {
        struct ast *number = *out;
        add(r, &(struct items){.end = out}, AST_UNARY, from);
        (*out)->op = '-';
        (*out)->left = number;
    }
    return true;
}

static bool take_mark(struct reader *r, char c)
{
    scan_blanks(&r->s);
    if (scan_next(&r->s) != c)
        return false;
    mark(r);
    scan_blanks(&r->s);
    return true;
}

static bool take_pair(struct reader *r, struct items *i)
{
    const char *from = r->s.at;
    struct ast *u = NULL, *v = NULL;
    if (!take_mark(r, '<') || !take_component(r, &u) || !take_mark(r, ',') ||
        !take_component(r, &v))
        return false;
    scan_blanks(&r->s);
    if (scan_next(&r->s) != '>')
        return false;
    mark(r);
    struct ast *n = add(r, i, AST_VECTOR, from);
    if (n) {
        n->list = u;
        u->comma_after = 1;
        u->next = v;
    }
    return scan_next(&r->s) != '='; // `>=` is one token
}

static bool take_vector(struct reader *r, struct items *i)
{
    const char *from = r->s.at++;
    double *v = r->nodes    ? arena_new_array(r->nodes, double, 3)
                : r->tokens ? arena_new_struct(r->vectors, struct lexed_vector)->v
                            : NULL;
    if (!i->vector)
        return false;
    if (!scan_vector3(&r->s, v)) {
        r->s.at = from;
        return take_pair(r, i);
    }
    struct ast *n = add(r, i, AST_VECTOR3, from);
    if (n)
        n->vector = v;
    struct lexeme *t = emit(r, TOK_VECTOR3, from);
    if (t) {
        struct lexed_vector *whole = (struct lexed_vector *)v; // its first member
        whole->len = t->len;
        t->vector = whole;
    }
    return true;
}

static bool take_items(struct reader *r, struct items *i, struct ast *block,
                       uint32_t depth);

// Words of directives may stand without their '#'; lists of mesh2 have a token of their own.
static bool opens_block(enum word w)
{
    const enum word_class class = word_class(w);
    return lex_word(w) == TOK_WORD && class != CLASS_DIRECTIVE_WORDS &&
           class != CLASS_DIRECTIVE_HELPERS && !bulk_word(w);
}

// Whether a name may come next, which then can be no number.
static bool may_be_named(const struct items *i)
{
    switch (i->block) {
    case WORD_texture_list: return true;
    case WORD_texture:
    case WORD_interior_texture:
    case WORD_pigment:
    case WORD_normal:
    case WORD_finish:
    case WORD_interior:
    case WORD_material:
    case WORD_object: return !i->any;
    default: return false;
    }
}

static bool take_name(struct reader *r, struct items *i, const char *from)
{
    struct named_literal *l = &r->found;
    const size_t len = (size_t)(r->s.at - from);
    if (!may_be_named(i) || l->count == LITERAL_NAMES_MAX || len > UINT16_MAX)
        return false;
    l->name[l->count].begin = r->where.begin + (uint32_t)(from - r->text);
    l->name[l->count++].len = (uint32_t)len;
    i->vector = false;
    struct ast *n = add(r, i, AST_VALUE, from);
    if (n) {
        n->text = from;
        n->len = (uint16_t)len;
        n->value = r->names->lookup(r->names->user, from, len).value;
    }
    emit(r, TOK_NAME, from);
    scan_blanks(&r->s);
    return true;
}

// A word, alone or with a block.
static bool take_word(struct reader *r, struct items *i, uint32_t depth)
{
    const char *from = r->s.at;
    uint32_t hash = WORD_HASH;
    for (; is_letter(scan_next(&r->s)) || scan_is_digit(scan_next(&r->s)); r->s.at++)
        hash = word_hash_add(hash, *r->s.at);
    const enum word w =
        word_table_find_hashed(r->words, from, (size_t)(r->s.at - from), hash);
    if (w == WORD_NONE)
        return take_name(r, i, from);
    const int kind = lex_word(w);
    if (kind != TOK_WORD && kind != TOK_RGB && kind != TOK_COLOR && kind != TOK_PART)
        return false;
    i->vector = kind != TOK_PART;
    struct ast *n = add(r, i, AST_WORD, from);
    if (n)
        n->word = (uint16_t)w;
    struct lexeme *t = emit(r, kind, from);
    if (t)
        t->word = (uint16_t)w;
    scan_blanks(&r->s);
    if (scan_next(&r->s) != '{')
        return true;
    if (depth == NESTING || !opens_block(w) || word_class(w) == CLASS_OBJECTS)
        return false;
    if (n)
        n->kind = AST_BLOCK;
    i->vector = false;
    return take_items(r, &(struct items){.block = w}, n, depth + 1);
}

static bool take_comma(struct reader *r, struct items *i)
{
    if (!i->comma)
        return false;
    i->comma = false;
    i->any = i->vector = true;
    if (i->last)
        i->last->comma_after = 1;
    mark(r);
    return true;
}

// From a '{' to its '}': the rest of a block, which is then complete.
static bool take_items(struct reader *r, struct items *i, struct ast *block,
                       uint32_t depth)
{
    i->end = block ? &block->list : NULL;
    i->vector = true;
    mark(r);
    for (;;) {
        scan_blanks(&r->s);
        const char c = scan_next(&r->s);
        bool ok;
        if (c == '}')
            break;
        if (c == ',')
            ok = take_comma(r, i);
        else if (c == '<')
            ok = take_vector(r, i);
        else if (is_letter(c))
            ok = take_word(r, i, depth);
        else
            ok = c != '-' && take_number(r, i);
        if (!ok)
            return false;
    }
    mark(r);
    if (block)
        block->where.end = r->where.begin + (uint32_t)(r->s.at - r->text);
    return true;
}

size_t literal_scan(const struct word_table *words, enum word w, const char *text,
                    size_t len, struct named_literal *out)
{
    struct reader r = {
        .s = {text, text + len}, .words = words, .text = text, .found.tokens = 1};
    scan_blanks(&r.s);
    if (scan_next(&r.s) != '{' || !opens_block(w) ||
        !take_items(&r, &(struct items){.block = w}, NULL, 0))
        return 0;
    *out = r.found;
    return (size_t)(r.s.at - text);
}

// At the '{' of a token's block.
static struct reader reader_of(const struct word_table *words, const struct token *t)
{
    struct reader r = {.s = {t->text, t->text + (t->where.end - t->where.begin)},
                       .words = words,
                       .text = t->text,
                       .where = t->where};
    while (*r.s.at != '{')
        r.s.at++;
    return r;
}

struct ast *literal_read(struct arena *a, const struct word_table *words,
                         const struct token *t, const struct stream_host *names)
{
    struct reader r = reader_of(words, t);
    r.nodes = a;
    r.names = names;
    struct ast *block = ast_new(a, AST_BLOCK, t->where);
    block->word = t->word;
    take_items(&r, &(struct items){.block = (enum word)t->word}, block, 0);
    return block;
}

void literal_expand(struct arena *a, const struct word_table *words,
                    const struct token *t)
{
    struct named_literal *l = t->named;
    struct reader r = reader_of(words, t);
    l->piece = arena_new_array(a, struct lexeme, l->tokens + 1);
    l->slots = arena_new_array(a, uint32_t, l->tokens + 1);
    *l->piece =
        (struct lexeme){.kind = TOK_WORD, .word = t->word, .begin = t->where.begin};
    l->piece->len = (uint32_t)strlen(word_text((enum word)t->word));
    r.tokens = l->piece + 1;
    r.vectors = a;
    take_items(&r, &(struct items){.block = (enum word)t->word}, NULL, 0);
    l->piece[l->tokens] = (struct lexeme){.begin = t->where.end};
}
