#ifndef LANG_STREAM_STATE_H
#define LANG_STREAM_STATE_H

#include "base/arena.h"
#include "lang/lexeme.h"
#include "lang/macro.h"
#include "lang/stream.h"

// The inside of the stream, shared by stream.c, directive.c, macro.c and parse.c.

enum {
    INCLUDES_MAX = 32,
    CALLS_MAX = 4000,
    FRAMES_MAX = 20000,
};

// Where tokens come from: a file, the body of a macro being called, or a block of either.
struct cursor {
    const struct lexeme *tokens;
    uint32_t *slots; // calc_place.slot of each token
    uint32_t file;
    const char *text; // of the file
    uint32_t at, count;
    uint32_t expansion;
    uint32_t frames; // frames open when it began
    const struct macro *macro;
    bool piece; // a block of the text below, token by token
};

enum frame_kind { FRAME_IF, FRAME_SWITCH, FRAME_WHILE, FRAME_FOR };

// An #if, #switch or loop whose #end has not come.
struct frame {
    enum frame_kind kind;
    struct span opener;
    enum word word;
    uint32_t cursor; // which it stands in
    uint32_t back;   // a loop: the #while's condition, the #for's first body token
    double value;    // a #switch
    double end, step;
    struct lvalue variable; // of a #for
    void *name;             // ... the host's
};

struct lexed {
    uint32_t file;
    struct lexeme *tokens;
    uint32_t *slots;
    uint32_t count;
};

// The token at `i`; past the end, the end.
static inline void cursor_token(const struct cursor *c, uint32_t i, struct token *out)
{
    lexeme_token(&c->tokens[i], c->file, c->text, c->expansion, out);
    if (i >= c->count)
        out->kind = 0;
}

// That was called and that nobody declared, or whose declaration had an error: said once.
struct unknown_name {
    const struct unknown_name *next;
    const char *text;
    size_t len;
};

struct stream {
    const struct unknown_name *unknown; // newest first
    struct arena *arena;                // of the caller: macro definitions
    struct arena *nodes; // AST, wound back after each statement and directive
    struct source_map *sources;
    struct word_table words;
    struct diag_sink *diags;
    struct stream_host host;
    struct cursor *cursors;
    uint32_t cursor_count, cursor_capacity, includes, calls;
    struct frame *frames;
    uint32_t frame_count, frame_capacity;
    struct lexed *lexed;
    uint32_t lexed_count, lexed_capacity;
    bool pending_set;
    struct token pending; // given back by the parser
    struct arena_mark statement;
    int runs; // of the grammar, inside each other
    double version;
    bool old_macro;     // a macro below version 3.1 was reported
    bool old_semicolon; // and a missing ';' below 3.5
    uint64_t steps;     // tokens taken, those of loops and macros each time anew
    bool stopped;
};

// Leaves texts that are read to their end, except the main file.
void stream_pop_finished(struct stream *s);
void stream_push_file(struct stream *s, uint32_t file);
struct frame *stream_push_frame(struct stream *s, enum frame_kind kind,
                                const struct token *opener);
// Asks the host before anything that can repeat; stops the stream when it says no.
void stream_ask(struct stream *s, struct span where);
void stream_give_back(struct stream *s, struct token t);
bool stream_was_reported(const struct stream *s, const char *name, size_t len);
void stream_set_reported(struct stream *s, const char *name, size_t len);

// Below the directives: the very next token, and taking it.
struct token raw_peek(struct stream *s);
int raw_kind(struct stream *s);                 // of raw_peek
enum word raw_word(struct stream *s);           // likewise
struct token raw_peek_second(struct stream *s); // the one after, in the same text
struct token raw_take(struct stream *s);
bool raw_take_if(struct stream *s, int kind);
bool raw_expect(struct stream *s, int kind, const char *what, const char *where);
bool raw_expect_name(struct stream *s, struct token *name, const char *where);
// A name and its subscripts; they live in s->nodes.
bool raw_lvalue(struct stream *s, struct lvalue *out, const char *where);

// Tries to take what comes next the short way (stream_host.calculate).
enum calc_outcome stream_calculate(struct stream *s, enum calc_kind kind, bool local,
                                   struct calc_result *out);

// directive_run after asking the host; what it made of s->nodes is given back.
void stream_run_directive(struct stream *s, const struct token *hash);
void directive_run(struct stream *s, struct token hash);
void directive_end_of_cursor(struct stream *s, struct cursor *c);
bool directive_skip(struct stream *s, uint32_t depth, bool stop_at_else,
                    bool stop_at_case, struct token *stop);
void directive_declare(struct stream *s, struct token word);
void directive_output(struct stream *s, struct token word);
void directive_include(struct stream *s, struct token word);
void directive_version(struct stream *s, struct token word);
void directive_default(struct stream *s, struct token word);
bool directive_number(struct stream *s, int start, double *out);

void macro_define(struct stream *s, struct token word);
void macro_call(struct stream *s, struct token name, struct macro *macro);
// `array[..]..{..}` after its first word; elements NULL if there are none.
bool array_literal(struct stream *s, struct ast_list *sizes, struct ast **elements);

#endif
