#ifndef LANG_PARSE_STATE_H
#define LANG_PARSE_STATE_H

#include "base/arena.h"
#include "lang/ast.h"
#include "lang/stream.h"

// A '{' the parser is inside of: where, of which keyword, and what was true outside.
struct parse_block {
    enum word word;
    bool entry;    // '[' rather than '{'
    bool function; // we were in a function body outside
    struct span where;
    struct arena_mark mark;
    void *faces; // of a mesh: stream_host.faces, from its first triangle on
};

// One run of the grammar. A directive inside an expression runs another one.
struct parse {
    struct stream *in;
    struct arena *arena;
    int start;     // the pseudo-token that says what to read, until it is read
    bool bounded;  // a right side or argument: it ends where no operator follows
    bool function; // in a function body, '<' is always "less than"
    bool operand;  // the last token completed an operand
    bool after_period;
    bool failed;
    int nest;           // open ( [ {
    int parens;         // open (
    struct span paren;  // the first of them
    int braces;         // open {
    int vectors;        // open < outside all of them
    struct token *last; // the token before the one looked at
    struct token *now;  // the token looked at
    struct token slot[2];
    struct parse_block *blocks;
    uint32_t block_count, block_capacity;
    struct arena_mark before_faces; // the last AST_FACES
    struct ast *result;
};

enum {
    PARSE_NEST_MAX = 2400, // brackets open at once
    PARSE_RUNS_MAX = 2400, // runs of the grammar inside each other
};

// Runs the grammar once; NULL after an error, which was reported and skipped over.
// `result` may also be NULL for an empty list: then *ok says.
struct ast *parse_run(struct stream *in, int start, bool *ok);

// The node of a calculation's result.
struct ast *parse_calculated(struct stream *s, struct span where,
                             const struct calc_result *r);

// For the grammar's actions.
struct diag_sink *stream_diags(struct stream *s);
void parse_open(struct parse *p, enum word word, bool entry, struct span where);
struct ast *parse_close(struct parse *p, struct ast *node);
// Of the token looked at, a TOK_LITERAL.
struct ast *parse_literal(struct parse *p);
struct ast *parse_finish(struct parse *p, struct ast *node);
// Whether an item is more of the one before it, which then stands for both.
bool parse_joins(struct parse *p, struct ast *last, const struct ast *item);
// After a value: it may not begin with a bare `t`, which POV-Ray takes for no value there.
void parse_check_first(struct parse *p, const struct ast *n);
// Of a word with a number and no braces: whether it may stand so; reports.
bool parse_is_bare(struct parse *p, enum word word, struct span where);
void parse_missing_semicolon(struct parse *p, const struct ast *value);
// A ';' that only version 3.5 and later ask for; said of the first.
void parse_old_semicolon(struct stream *s, struct span where);
// parse_token.c: the kind and place of the next token, which is *p->now then.
int parse_token(struct parse *p, struct span *where);

// Counts a token among the brackets that are open.
void parse_note_brackets(struct parse *p, const struct token *t);
// From an opening bracket to its closing one.
void parse_skip_group(struct stream *s);

// parse_error.c: what the grammar finds wrong, in words.
void parse_syntax_error(struct parse *p, const int *expected, int count);
// A name nobody declared; call: arguments follow.
void parse_undeclared(struct stream *s, const struct token *t, bool call);
// The same at the start of a statement. Before '(' it was to be a macro, before '{' a word
// of the language.
void parse_unknown_word(struct stream *s, const struct token *t, bool call);

#endif
