#include "lang/literal.h"

#include "base/arena.h"
#include "lang/bulk.h"
#include "lang/lexer.h"
#include "lang/scan.h"
#include "parser.h"

enum { NESTING = 6 }; // of blocks; texts that are not taken are looked at again as often

struct reader {
    struct scan s;
    const struct word_table *words;
    struct arena *nodes; // NULL: only looks
    const char *text;    // of the file from where.begin on
    struct span where;   // of the whole
    uint32_t tokens;
};

// The items of a block so far.
struct items {
    struct ast **end; // where the next one goes; NULL when only looking
    struct ast *last;
    bool comma;  // may follow
    bool vector; // may follow: a '<' here is certainly no "less than"
};

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// Of one item; NULL when only looking.
static struct ast *add(struct reader *r, struct items *i, enum ast_kind kind,
                       const char *from)
{
    i->comma = true;
    if (!r->nodes)
        return NULL;
    struct span where = r->where;
    where.begin += (uint32_t)(from - r->text);
    where.end = r->where.begin + (uint32_t)(r->s.at - r->text);
    struct ast *n = *i->end = i->last = ast_new(r->nodes, kind, where);
    i->end = &n->next;
    return n;
}

static bool take_number(struct reader *r, struct items *i)
{
    const char *from = r->s.at;
    double v;
    i->vector = false;
    if (!scan_number(&r->s, r->nodes ? &v : NULL))
        return false;
    struct ast *n = add(r, i, AST_NUMBER, from);
    if (n)
        n->number = v;
    return true;
}

static bool take_vector(struct reader *r, struct items *i)
{
    const char *from = r->s.at++;
    double *v = r->nodes ? arena_new_array(r->nodes, double, 3) : NULL;
    if (!i->vector || !scan_vector3(&r->s, v))
        return false;
    struct ast *n = add(r, i, AST_VECTOR3, from);
    if (n)
        n->vector = v;
    return true;
}

static bool take_items(struct reader *r, struct ast *block, uint32_t depth);

// Words of directives may stand without their '#'; lists of mesh2 have a token of their own.
static bool opens_block(enum word w)
{
    const enum word_class class = word_class(w);
    return lex_word(w) == TOK_WORD && class != CLASS_DIRECTIVE_WORDS &&
           class != CLASS_DIRECTIVE_HELPERS && !bulk_word(w);
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
        return false;
    const int kind = lex_word(w);
    if (kind != TOK_WORD && kind != TOK_RGB && kind != TOK_COLOR && kind != TOK_PART)
        return false;
    i->vector = kind != TOK_PART;
    struct ast *n = add(r, i, AST_WORD, from);
    if (n)
        n->word = (uint16_t)w;
    scan_blanks(&r->s);
    if (scan_next(&r->s) != '{')
        return true;
    if (depth == NESTING || !opens_block(w) || word_class(w) == CLASS_OBJECTS)
        return false;
    if (n)
        n->kind = AST_BLOCK;
    i->vector = false;
    return take_items(r, n, depth + 1);
}

static bool take_comma(struct reader *r, struct items *i)
{
    if (!i->comma)
        return false;
    i->comma = false;
    i->vector = true;
    if (i->last)
        i->last->comma_after = 1;
    r->s.at++;
    return true;
}

// From a '{' to its '}': the rest of a block, which is then complete.
static bool take_items(struct reader *r, struct ast *block, uint32_t depth)
{
    struct items i = {.end = block ? &block->list : NULL, .vector = true};
    r->s.at++;
    r->tokens++;
    for (;;) {
        scan_blanks(&r->s);
        const char c = scan_next(&r->s);
        bool ok;
        r->tokens++;
        if (c == '}')
            break;
        if (c == ',')
            ok = take_comma(r, &i);
        else if (c == '<')
            ok = take_vector(r, &i);
        else if (is_letter(c))
            ok = take_word(r, &i, depth);
        else
            ok = c != '-' && take_number(r, &i);
        if (!ok)
            return false;
    }
    r->s.at++;
    if (block)
        block->where.end = r->where.begin + (uint32_t)(r->s.at - r->text);
    return true;
}

size_t literal_scan(const struct word_table *words, enum word w, const char *text,
                    size_t len, uint32_t *tokens)
{
    struct reader r = {
        .s = {text, text + len}, .words = words, .text = text, .tokens = 1};
    scan_blanks(&r.s);
    if (scan_next(&r.s) != '{' || !opens_block(w) || !take_items(&r, NULL, 0))
        return 0;
    *tokens = r.tokens;
    return (size_t)(r.s.at - text);
}

struct ast *literal_read(struct arena *a, const struct word_table *words,
                         const struct token *t)
{
    struct reader r = {.s = {t->text, t->text + (t->where.end - t->where.begin)},
                       .words = words,
                       .nodes = a,
                       .text = t->text,
                       .where = t->where};
    struct ast *block = ast_new(a, AST_BLOCK, t->where);
    block->word = t->word;
    while (*r.s.at != '{')
        r.s.at++;
    take_items(&r, block, 0);
    return block;
}
