#include <string.h>

#include "lang/parse_state.h"
#include "lang/stream_state.h"
#include "parser.h"

// The directives that only hand their pieces to the host.

static bool is_texture(const struct ast *n)
{
    return n && n->kind == AST_BLOCK && n->word == WORD_texture;
}

// The right side of a #declare; textures in a row are one.
static const struct ast *read_rvalue(struct stream *s, bool *ok)
{
    struct ast *first = parse_run(s, TOK_START_RVALUE, ok);
    struct ast *last = first;
    while (*ok && is_texture(last) && raw_word(s) == WORD_texture) {
        last->next = parse_run(s, TOK_START_RVALUE, ok);
        last = last->next;
    }
    return first;
}

static void read_deprecated(struct stream *s, struct lvalue *to)
{
    to->deprecated = true;
    if (raw_word(s) == WORD_once)
        raw_take(s);
    if (raw_kind(s) == TOK_STRING) {
        struct token t = raw_take(s);
        struct ast *text = ast_new(s->nodes, AST_STRING, t.where);
        text->text = t.text;
        text->len = t.len;
        to->deprecated_text = text;
    }
}

// After a head that makes no sense: to the next ';' or directive.
static void skip_declaration(struct stream *s)
{
    for (;;) {
        int kind = raw_kind(s);
        if (kind == TOK_END || kind == '#' || kind == '{' || kind == '}')
            return;
        raw_take(s);
        if (kind == ';')
            return;
    }
}

// Whether an `array` word is the right side, after an #if or macro may have made it.
static bool next_is_array(struct stream *s)
{
    if (raw_kind(s) == '#')
        stream_give_back(s, stream_next(s));
    return raw_kind(s) == TOK_ARRAY;
}

void directive_declare(struct stream *s, struct token word)
{
    struct lvalue mark = {0}, to;
    const char *directive = word.word == WORD_local ? "#local" : "#declare";
    if (raw_word(s) == WORD_deprecated) {
        raw_take(s);
        read_deprecated(s, &mark);
    }
    if (!raw_lvalue(s, &to, directive) || !raw_expect(s, '=', "'='", directive)) {
        skip_declaration(s);
        return;
    }
    to.local = word.word == WORD_local;
    to.deprecated = mark.deprecated;
    to.deprecated_text = mark.deprecated_text;
    bool begun = s->host.declare_begin(s->host.user, &to), ok, done;
    if (next_is_array(s)) {
        struct ast_list sizes;
        struct ast *elements;
        raw_take(s);
        ok = array_literal(s, &sizes, &elements);
        done = ok && begun &&
               s->host.declare_array(s->host.user, &to, sizes.first, elements);
    } else {
        const struct ast *items = read_rvalue(s, &ok);
        done = ok && begun && s->host.declare(s->host.user, &to, items);
    }
    if (!done && !to.index)
        stream_set_reported(s, to.name, to.len);
    if (ok)
        raw_take_if(s, ';');
}

void directive_version(struct stream *s, struct token word)
{
    struct token t = raw_peek(s);
    if (t.kind == TOK_NAME && t.len == 10 && memcmp(t.text, "unofficial", 10) == 0) {
        diag_at(s->diags, DIAG_UNOFFICIAL, t.where, 0);
        raw_take(s);
    }
    double v;
    bool ok = directive_number(s, TOK_START_ARGUMENT, &v);
    bool ended = raw_take_if(s, ';');
    if (!ok)
        return;
    if (!ended)
        parse_old_semicolon(s, word.where);
    s->version = v;
    s->host.version(s->host.user, word.where, v);
}

void directive_default(struct stream *s, struct token word)
{
    bool ok;
    (void)word;
    const struct ast *items = parse_run(s, TOK_START_BRACES, &ok);
    if (ok)
        s->host.defaults(s->host.user, items);
}

void directive_include(struct stream *s, struct token word)
{
    bool ok;
    const char *name, *found, *text;
    size_t len;
    const struct ast *path = parse_run(s, TOK_START_STRING, &ok);
    if (!ok)
        return;
    if (path->kind == AST_STRING) // no escapes in a path
        name = arena_strndup(s->nodes, path->text, path->len);
    else if (!s->host.path(s->host.user, path, &name))
        return;
    if (s->includes >= INCLUDES_MAX) {
        diag_at(s->diags, DIAG_TOO_DEEP, word.where, "include files", (int)INCLUDES_MAX);
        s->stopped = true;
        return;
    }
    if (!s->host.open_include(s->host.user, name, path->where, &found, &text, &len) ||
        !s->host.enter_scope(s->host.user, path->where))
        return;
    const uint32_t file = source_add(s->sources, found, text, len, path->where);
    s->sources->file[file]->ended = true;
    stream_push_file(s, file);
}

static void run_message(struct stream *s, struct token word)
{
    bool ok;
    const char *text;
    const struct ast *e = parse_run(s, TOK_START_STRING, &ok);
    if (ok && s->host.string(s->host.user, e, &text))
        s->host.message(s->host.user, (enum word)word.word, word.where, text);
    if (word.word == WORD_error)
        s->stopped = true;
}

static struct ast *lvalue_node(struct stream *s, const struct lvalue *name)
{
    struct name_info info = s->host.lookup(s->host.user, name->name, name->len);
    struct ast *n = ast_new(s->nodes,
                            name->index  ? AST_INDEX
                            : info.value ? AST_VALUE
                                         : AST_UNDECLARED,
                            name->where);
    n->text = name->name;
    n->len = (uint16_t)name->len;
    n->value = info.value;
    n->list = (struct ast *)name->index;
    return n;
}

// #read(FILE, place, ...) and #write(FILE, item, ...), after the '('.
static bool read_items(struct stream *s, struct token word, struct ast_list *items)
{
    bool ok = true;
    if (word.word == WORD_write) {
        items->first = parse_run(s, TOK_START_ITEMS, &ok);
        return ok;
    }
    while (raw_kind(s) != ')') {
        struct lvalue place;
        if (!raw_lvalue(s, &place, "#read"))
            return false;
        *items = ast_append(*items, lvalue_node(s, &place));
        if (!raw_take_if(s, ','))
            break;
    }
    return raw_expect(s, ')', "')'", "#read");
}

static bool open_items(struct stream *s, struct ast_list *items)
{
    bool ok;
    struct ast *path = parse_run(s, TOK_START_STRING, &ok);
    if (!ok)
        return false;
    struct token mode = raw_peek(s);
    if (mode.word != WORD_read && mode.word != WORD_write && mode.word != WORD_append) {
        diag_at(s->diags, DIAG_EXPECTED_IN, mode.where, "read, write or append",
                "#fopen");
        return false;
    }
    raw_take(s);
    struct ast *how = ast_new(s->nodes, AST_WORD, mode.where);
    how->word = mode.word;
    *items = ast_append(ast_append(*items, path), how);
    return true;
}

static void run_file(struct stream *s, struct token word)
{
    char directive[16];
    snprintf(directive, sizeof directive, "#%s", word_text((enum word)word.word));
    bool parens = word.word == WORD_read || word.word == WORD_write;
    struct lvalue handle;
    struct ast_list items = {0};
    if ((parens && !raw_expect(s, '(', "'('", directive)) ||
        !raw_lvalue(s, &handle, directive))
        return;
    bool ok = true;
    if (parens) {
        raw_take_if(s, ',');
        ok = read_items(s, word, &items);
    } else if (word.word == WORD_fopen) {
        ok = open_items(s, &items);
    }
    if (ok)
        s->host.file_io(s->host.user, (enum word)word.word, word.where, &handle,
                        items.first);
}

void directive_output(struct stream *s, struct token word)
{
    struct lvalue name;
    switch (word.word) {
    case WORD_undef:
        if (raw_lvalue(s, &name, "#undef"))
            s->host.undef(s->host.user, &name);
        break;
    case WORD_fopen:
    case WORD_fclose:
    case WORD_read:
    case WORD_write: run_file(s, word); break;
    default: run_message(s, word);
    }
}
