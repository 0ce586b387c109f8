#include "lang/stream.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "lang/lexer.h"
#include "lang/literal.h"
#include "lang/parse_state.h"
#include "lang/stream_state.h"
#include "parser.h"

struct stream *stream_new(struct arena *a, struct source_map *sources, uint32_t file,
                          struct diag_sink *diags, struct stream_host host)
{
    struct stream *s = arena_new_struct(a, struct stream);
    s->arena = a;
    s->nodes = arena_new(1 << 16);
    s->sources = sources;
    s->diags = diags;
    s->host = host;
    s->version = 3.7;
    s->statement = arena_mark(s->nodes);
    word_table_init(&s->words);
    stream_push_file(s, file);
    return s;
}

void stream_set_version(struct stream *s, double version) { s->version = version; }

void stream_free(struct stream *s)
{
    if (!s)
        return;
    for (uint32_t i = 0; i < s->lexed_count; i++) {
        free(s->lexed[i].tokens);
        free(s->lexed[i].slots);
    }
    free(s->lexed);
    free(s->cursors);
    free(s->frames);
    arena_free(s->nodes);
}

struct arena *stream_arena(struct stream *s) { return s->nodes; }

struct diag_sink *stream_diags(struct stream *s) { return s->diags; }

// An include file read again with the same text is not scanned again.
static const struct lexed *lex_once(struct stream *s, uint32_t file)
{
    const struct source_file *f = s->sources->file[file];
    for (uint32_t i = 0; i < s->lexed_count; i++) {
        const struct source_file *o = s->sources->file[s->lexed[i].file];
        if (o->len == f->len && strcmp(o->name, f->name) == 0 &&
            memcmp(o->text, f->text, f->len) == 0)
            return &s->lexed[i];
    }
    s->lexed = must_grow(s->lexed, s->lexed_count, &s->lexed_capacity, sizeof *s->lexed);
    struct lexed *l = &s->lexed[s->lexed_count++];
    l->file = file;
    struct arena *vectors = s->host.calculate ? s->arena : NULL;
    l->tokens = lex_file(s->sources, file, s->diags, &s->words, vectors, &l->count);
    l->slots = must_calloc(l->count + 1, sizeof *l->slots);
    return l;
}

void stream_push_file(struct stream *s, uint32_t file)
{
    const struct lexed *l = lex_once(s, file);
    s->cursors =
        must_grow(s->cursors, s->cursor_count, &s->cursor_capacity, sizeof *s->cursors);
    s->cursors[s->cursor_count++] =
        (struct cursor){.tokens = l->tokens,
                        .slots = l->slots,
                        .count = l->count,
                        .file = l->file,
                        .text = s->sources->file[l->file]->text,
                        .frames = s->frame_count};
    s->includes++;
}

struct frame *stream_push_frame(struct stream *s, enum frame_kind kind,
                                const struct token *opener)
{
    if (s->frame_count == FRAMES_MAX) {
        diag_at(s->diags, DIAG_TOO_DEEP, opener->where, "directives", FRAMES_MAX);
        s->stopped = true;
    }
    s->frames =
        must_grow(s->frames, s->frame_count, &s->frame_capacity, sizeof *s->frames);
    struct frame *f = &s->frames[s->frame_count++];
    *f = (struct frame){.kind = kind,
                        .opener = opener->where,
                        .word = (enum word)opener->word,
                        .cursor = s->cursor_count - 1};
    return f;
}

void stream_ask(struct stream *s, struct span where)
{
    if (!s->stopped && s->host.may_go_on &&
        !s->host.may_go_on(s->host.user, where, s->steps))
        s->stopped = true;
}

void stream_give_back(struct stream *s, struct token t)
{
    s->pending = t;
    s->pending_set = true;
}

void stream_pop_finished(struct stream *s)
{
    if (s->cursors[s->cursor_count - 1].at < s->cursors[s->cursor_count - 1].count)
        return;
    while (s->cursor_count > 1) {
        struct cursor *c = &s->cursors[s->cursor_count - 1];
        if (c->at < c->count)
            return;
        if (!c->piece)
            directive_end_of_cursor(s, c);
        s->cursor_count--;
        if (c->piece)
            continue;
        if (c->macro)
            s->calls--;
        else
            s->includes--;
        s->host.leave_scope(s->host.user);
    }
}

static struct token at(const struct cursor *c, uint32_t i)
{
    struct token t;
    cursor_token(c, i, &t);
    return t;
}

// What comes next, looking through the ends of macro bodies and includes.
static struct token peek(const struct stream *s, uint32_t skip)
{
    for (uint32_t i = s->cursor_count; i-- > 0;) {
        const struct cursor *c = &s->cursors[i];
        if (c->at + skip < c->count)
            return at(c, c->at + skip);
        if (i == 0)
            return at(c, c->count);
        if (skip)
            skip -= c->count - c->at;
    }
    return (struct token){0};
}

// The kind of what comes after the token in hand.
static int next_kind(const struct stream *s)
{
    const struct cursor *c = &s->cursors[s->cursor_count - 1];
    return c->at < c->count ? c->tokens[c->at].kind : peek(s, 0).kind;
}

static bool is_name(int kind)
{
    return kind == TOK_NAME || kind == TOK_STRING_NAME || kind == TOK_OTHER_NAME ||
           kind == TOK_ARRAY_NAME || kind == TOK_FUNCTION_NAME;
}

static struct token uncooked(struct token t)
{
    if (is_name(t.kind))
        t.kind = TOK_NAME;
    return t;
}

struct token raw_peek(struct stream *s)
{
    return s->pending_set ? uncooked(s->pending) : peek(s, 0);
}

int raw_kind(struct stream *s)
{
    const struct cursor *c = &s->cursors[s->cursor_count - 1];
    if (!s->pending_set && c->at < c->count)
        return c->tokens[c->at].kind;
    return raw_peek(s).kind;
}

enum word raw_word(struct stream *s)
{
    const struct cursor *c = &s->cursors[s->cursor_count - 1];
    if (!s->pending_set && c->at < c->count)
        return lexeme_word(&c->tokens[c->at]);
    return (enum word)raw_peek(s).word;
}

struct token raw_peek_second(struct stream *s) { return peek(s, s->pending_set ? 0 : 1); }

static void take(struct stream *s, struct token *out)
{
    if (s->pending_set) {
        s->pending_set = false;
        *out = uncooked(s->pending);
        return;
    }
    stream_pop_finished(s);
    struct cursor *c = &s->cursors[s->cursor_count - 1];
    uint32_t i = c->at;
    s->steps++;
    c->at += i < c->count;
    cursor_token(c, i, out);
    if (out->kind == TOK_LITERAL)
        s->steps += c->tokens[i].tokens - 1;
}

struct token raw_take(struct stream *s)
{
    struct token t;
    take(s, &t);
    return t;
}

// Whether what comes after a text might go on with the expression that ends it.
static bool may_go_on_after(const struct stream *s, const struct cursor *c)
{
    if (c == &s->cursors[0])
        return false;
    switch (peek(s, c->count - c->at).kind) {
    case ',':
    case '}':
    case '>':
    case ')':
    case ';':
    case ']':
    case TOK_WORD:
    case TOK_NAMED:
    case TOK_LITERAL: return false;
    default: return true;
    }
}

enum calc_outcome stream_calculate(struct stream *s, enum calc_kind kind, bool local,
                                   struct calc_result *out)
{
    if (!s->host.calculate || s->pending_set || s->stopped || diag_full(s->diags) ||
        s->version < MACRO_VERSION)
        return CALC_NONE;
    stream_pop_finished(s);
    struct cursor *c = &s->cursors[s->cursor_count - 1];
    uint32_t once = 0; // what no loop or macro can come back to is not remembered
    const bool again = s->frame_count || s->cursor_count > 1;
    struct calc_place at = {.kind = kind,
                            .local = local,
                            .goes_on = kind == CALC_ITEM && may_go_on_after(s, c),
                            .tokens = c->tokens + c->at,
                            .count = c->count - c->at,
                            .text = c->text,
                            .slot = again ? c->slots + c->at : &once,
                            .where = {.file = c->file, .expansion = c->expansion}};
    if (!at.count)
        return CALC_NONE;
    enum calc_outcome outcome = s->host.calculate(s->host.user, &at, out);
    if (outcome != CALC_NONE) {
        c->at += out->used;
        s->steps += out->used;
    }
    return outcome;
}

bool raw_take_if(struct stream *s, int kind)
{
    if (raw_kind(s) != kind)
        return false;
    raw_take(s);
    return true;
}

bool raw_expect(struct stream *s, int kind, const char *what, const char *where)
{
    if (raw_take_if(s, kind))
        return true;
    diag_at(s->diags, DIAG_EXPECTED_IN, raw_peek(s).where, what, where);
    return false;
}

bool raw_expect_name(struct stream *s, struct token *name, const char *where)
{
    *name = raw_peek(s);
    if (name->kind == TOK_NAME) {
        raw_take(s);
        return true;
    }
    if (name->word != WORD_NONE) {
        diag_at(s->diags, DIAG_RESERVED_WORD, name->where,
                word_text((enum word)name->word));
        raw_take(s);
    } else {
        diag_at(s->diags, DIAG_EXPECTED_IN, name->where, "a name", where);
    }
    return false;
}

bool raw_lvalue(struct stream *s, struct lvalue *out, const char *where)
{
    struct token name;
    *out = (struct lvalue){0};
    if (!raw_expect_name(s, &name, where))
        return false;
    out->name = name.text;
    out->len = name.len;
    out->where = name.where;
    struct ast_list index = {0};
    while (raw_take_if(s, '[')) {
        bool ok;
        struct ast *n = parse_run(s, TOK_START_SUBSCRIPT, &ok);
        if (!ok)
            return false;
        index = ast_append(index, n);
    }
    out->index = index.first;
    return true;
}

// defined(NAME): decided here, so that the name is not replaced by its value.
static struct token defined(struct stream *s, struct token t)
{
    struct lvalue name;
    raw_take(s);
    struct token number = t;
    number.kind = TOK_NUMBER;
    number.word = WORD_NONE;
    if (raw_word(s) != WORD_NONE && raw_peek_second(s).kind == ')') {
        raw_take(s);
        number.number = 0;
    } else if (raw_lvalue(s, &name, "defined")) {
        number.number = s->host.is_declared(s->host.user, &name);
    }
    number.where.end = raw_peek(s).where.end;
    raw_expect(s, ')', "')'", "defined");
    return number;
}

static int call_token(enum word w)
{
    switch (w) {
    case WORD_abs:
    case WORD_ceil:
    case WORD_floor:
    case WORD_cos:
    case WORD_sin:
    case WORD_tan:
    case WORD_atan:
    case WORD_cosh:
    case WORD_sinh:
    case WORD_tanh:
    case WORD_asinh:
    case WORD_acosh:
    case WORD_atanh:
    case WORD_exp:
    case WORD_acos:
    case WORD_asin:
    case WORD_degrees:
    case WORD_radians:
    case WORD_int:
    case WORD_ln:
    case WORD_log:
    case WORD_sqrt:
    case WORD_rand:
    case WORD_seed: return TOK_CALL1;
    case WORD_pwr:
    case WORD_internal: return TOK_CALL;
    default: break;
    }
    switch (word_class(w)) {
    case CLASS_FLOAT_FUNCTIONS:
    case CLASS_VECTOR_FUNCTIONS:
    case CLASS_ONLY_INSIDE__FUNCTION: return TOK_CALL;
    case CLASS_STRING_FUNCTIONS: return TOK_STRING_CALL;
    default: return TOK_WORD;
    }
}

static const struct value *held(struct stream *s, const struct name_info *info)
{
    if (!s->host.hold || (info->class != NAME_VALUE && info->class != NAME_STRING))
        return info->value;
    return s->host.hold(s->host.user, info->value);
}

// Binds a name to what it stands for now; false when it was a macro, now expanded.
static bool bind_name(struct stream *s, struct token *t)
{
    struct name_info info = s->host.lookup(s->host.user, t->text, t->len);
    if (info.deprecated)
        s->host.deprecated(s->host.user, t->text, t->len, t->where);
    t->value = held(s, &info);
    switch (info.class) {
    case NAME_UNDECLARED: t->value = NULL; break;
    case NAME_VALUE: break;
    case NAME_STRING: t->kind = TOK_STRING_NAME; break;
    case NAME_FUNCTION:
        t->kind = next_kind(s) == '(' ? TOK_FUNCTION_NAME : TOK_OTHER_NAME;
        break;
    case NAME_ARRAY:
        t->kind = next_kind(s) == '[' ? TOK_ARRAY_NAME : TOK_OTHER_NAME;
        break;
    case NAME_OBJECT:
    case NAME_BLOCK: t->kind = TOK_OTHER_NAME; break;
    case NAME_MACRO: macro_call(s, *t, info.macro); return false;
    }
    return true;
}

bool stream_was_reported(const struct stream *s, const char *name, size_t len)
{
    for (const struct unknown_name *n = s->unknown; n; n = n->next)
        if (n->len == len && memcmp(n->text, name, len) == 0)
            return true;
    return false;
}

void stream_set_reported(struct stream *s, const char *name, size_t len)
{
    if (stream_was_reported(s, name, len))
        return;
    struct unknown_name *n = arena_new_struct(s->arena, struct unknown_name);
    *n = (struct unknown_name){s->unknown, arena_strndup(s->arena, name, len), len};
    s->unknown = n;
}

// A token given back, if there is one.
static bool take_pending(struct stream *s, struct token *out)
{
    if (!s->pending_set)
        return false;
    s->pending_set = false;
    *out = s->pending;
    if ((out->kind == TOK_NAME || out->kind == TOK_STRING_NAME) && out->value) {
        struct name_info info = s->host.lookup(s->host.user, out->text, out->len);
        out->value = held(s, &info); // the one before may be gone by now
        out->kind = info.class == NAME_STRING ? TOK_STRING_NAME : TOK_NAME;
    }
    return true;
}

void stream_run_directive(struct stream *s, const struct token *hash)
{
    struct arena_mark mark = arena_mark(s->nodes);
    stream_ask(s, hash->where);
    if (s->stopped)
        return;
    directive_run(s, *hash);
    arena_rewind(s->nodes, mark);
}

static bool are_blocks(const struct stream *s, const struct token *t)
{
    const struct named_literal *l = t->named;
    const char *file = t->text - t->where.begin;
    for (uint32_t i = 0; i < l->count; i++) {
        const struct name_info info =
            s->host.lookup(s->host.user, file + l->name[i].begin, l->name[i].len);
        if ((info.class != NAME_BLOCK && info.class != NAME_OBJECT) || info.deprecated)
            return false;
    }
    return true;
}

// A block with names is one token if they are what it takes them for; false: its tokens come
// one by one.
static bool take_named(struct stream *s, struct token *t)
{
    const struct named_literal *l = t->named;
    t->kind = TOK_LITERAL;
    s->steps += l->tokens - 1;
    if (are_blocks(s, t))
        return true;
    s->steps -= l->tokens;
    if (!l->piece)
        literal_expand(s->arena, &s->words, t);
    s->cursors =
        must_grow(s->cursors, s->cursor_count, &s->cursor_capacity, sizeof *s->cursors);
    s->cursors[s->cursor_count++] = (struct cursor){.tokens = l->piece,
                                                    .slots = l->slots,
                                                    .count = l->tokens,
                                                    .file = t->where.file,
                                                    .text = t->text - t->where.begin,
                                                    .frames = s->frame_count,
                                                    .expansion = t->where.expansion,
                                                    .piece = true};
    return false;
}

// Gives the token its meaning here; false when there is none: it was a macro.
static bool cook(struct stream *s, struct token *t)
{
    if (t->kind == TOK_NAME)
        return bind_name(s, t);
    if (t->kind == TOK_NAMED)
        return take_named(s, t);
    if (t->kind == ']' && next_kind(s) == '[') {
        t->kind = TOK_MORE;
    } else if (t->kind == TOK_WORD && next_kind(s) == '(') {
        if (t->word == WORD_defined)
            *t = defined(s, *t);
        else
            t->kind = call_token((enum word)t->word);
    }
    return true;
}

void stream_take(struct stream *s, struct token *out)
{
    if (s->pending_set && !is_name(s->pending.kind)) {
        take_pending(s, out);
        return;
    }
    for (;;) {
        if (diag_full(s->diags))
            s->stopped = true;
        if (s->stopped) {
            cursor_token(&s->cursors[0], s->cursors[0].count, out);
            return;
        }
        if (take_pending(s, out)) // cooked already: a macro was expanded before
            return;
        take(s, out);
        if (out->kind == TOK_END) {
            directive_end_of_cursor(s, &s->cursors[0]);
            return;
        }
        if (out->kind == '#')
            stream_run_directive(s, out);
        else if (cook(s, out))
            return;
    }
}

struct token stream_next(struct stream *s)
{
    struct token t;
    stream_take(s, &t);
    return t;
}
