#include <string.h>

#include "base/memory.h"
#include "lang/parse_state.h"
#include "lang/stream_state.h"
#include "parser.h"

// Reported once: scenes for old versions may have many macros.
static bool version_has_macros(struct stream *s, struct span where)
{
    if (s->version >= MACRO_VERSION)
        return true;
    if (!s->old_macro)
        diag_hint(s->diags, DIAG_MACRO_VERSION, where,
                  "write `#version 3.1;` or later before it", s->version);
    s->old_macro = true;
    return false;
}

// #macro NAME(parameters) body #end: the body is kept as a run of tokens.
void macro_define(struct stream *s, struct token word)
{
    struct token name;
    version_has_macros(s, word.where);
    struct macro_parameter parameter[PARAMETERS_MAX];
    int count = 0;
    bool ok = raw_expect_name(s, &name, "#macro") && raw_expect(s, '(', "'('", "#macro");
    while (ok && raw_kind(s) != ')') {
        struct token t;
        ok = raw_expect_name(s, &t, "#macro");
        if (ok && count == PARAMETERS_MAX) {
            diag_at(s->diags, DIAG_TOO_MANY_PARAMETERS, t.where, PARAMETERS_MAX);
            ok = false;
        }
        if (ok)
            parameter[count++] = (struct macro_parameter){t.text, t.len};
        raw_take_if(s, ',');
    }
    ok = ok && raw_expect(s, ')', "')'", "#macro");
    const struct cursor *c = &s->cursors[s->cursor_count - 1];
    uint32_t from = c->at;
    struct token stop;
    if (!directive_skip(s, 1, false, false, &stop)) {
        diag_at(s->diags, DIAG_MISSING_END, word.where, "macro");
        return;
    }
    if (!ok)
        return;
    const size_t size = (size_t)count * sizeof *parameter;
    struct macro *m = arena_alloc(s->arena, sizeof *m + size);
    memcpy(m->parameter, parameter, size);
    m->parameter_count = count;
    m->name = arena_strndup(s->arena, name.text, name.len);
    m->where = name.where;
    m->file = c->file;
    m->text = c->text;
    m->body = c->tokens + from;
    m->slots = c->slots + from;
    m->count = c->at - 2 - from; // without '#' and `end`
    s->host.define_macro(s->host.user, name.text, name.len, name.where, m);
}

bool array_literal(struct stream *s, struct ast_list *sizes, struct ast **elements)
{
    bool ok = true;
    *sizes = (struct ast_list){0};
    *elements = NULL;
    if (!raw_expect(s, '[', "'['", "array"))
        return false;
    do {
        struct ast *n = parse_run(s, TOK_START_SUBSCRIPT, &ok);
        if (!ok)
            return false;
        *sizes = ast_append(*sizes, n);
    } while (raw_take_if(s, '['));
    if (raw_kind(s) == '{')
        *elements = parse_run(s, TOK_START_ELEMENTS, &ok);
    return ok;
}

// Whether a call's next argument is one name or array element and nothing else.
static bool is_reference(const struct stream *s)
{
    if (s->pending_set)
        return false;
    const struct cursor *c = &s->cursors[s->cursor_count - 1];
    uint32_t i = c->at;
    if (i >= c->count || c->tokens[i].kind != TOK_NAME)
        return false;
    struct name_info info =
        s->host.lookup(s->host.user, c->text + c->tokens[i].begin, c->tokens[i].len);
    if (info.class == NAME_FUNCTION || info.class == NAME_MACRO)
        return false;
    i++;
    while (info.class == NAME_ARRAY && i < c->count && c->tokens[i].kind == '[') {
        int depth = 0;
        do
            depth += (c->tokens[i].kind == '[') - (c->tokens[i].kind == ']');
        while (++i < c->count && depth > 0);
    }
    int kind = c->tokens[i].kind;
    return i < c->count && (kind == ',' || kind == ')' || kind == TOK_NAME ||
                            kind == TOK_NUMBER || kind == TOK_STRING || kind == '<');
}

// After an argument that makes no sense: past the ')' of the call.
static void skip_call(struct stream *s)
{
    for (int depth = 1; depth > 0;) {
        int kind = raw_kind(s);
        if (kind == TOK_END || kind == '#' || kind == '{' || kind == '}' || kind == ';')
            return;
        raw_take(s);
        depth += (kind == '(') - (kind == ')');
    }
}

static bool read_argument(struct stream *s, struct macro_argument *a)
{
    bool ok;
    struct span where = raw_peek(s).where;
    *a = (struct macro_argument){0};
    if (is_reference(s)) {
        a->by_reference = true;
        if (!raw_lvalue(s, &a->reference, "a macro call"))
            return false;
        struct name_info info =
            s->host.lookup(s->host.user, a->reference.name, a->reference.len);
        if (info.class != NAME_UNDECLARED)
            return true;
        diag_at(s->diags, DIAG_UNDECLARED_ARGUMENT, a->reference.where,
                (int)a->reference.len, a->reference.name);
        skip_call(s);
        return false;
    }
    struct calc_result calc;
    enum calc_outcome outcome = stream_calculate(s, CALC_ARGUMENT, false, &calc);
    if (outcome != CALC_NONE) {
        a->rvalue = parse_calculated(s, where, &calc);
        return true;
    }
    if (raw_kind(s) == TOK_ARRAY) {
        struct ast_list sizes;
        struct ast *elements, *array;
        raw_take(s);
        if (!array_literal(s, &sizes, &elements))
            return false;
        array = ast_new(s->nodes, AST_BLOCK, where);
        array->word = WORD_array;
        array->list = ast_new(s->nodes, AST_ENTRY, where);
        array->list->list = sizes.first;
        array->list->next = elements;
        a->rvalue = array;
        return true;
    }
    a->rvalue = parse_run(s, TOK_START_ARGUMENT, &ok);
    return ok;
}

// Reads the arguments up to the ')'; -1 after an error.
static int read_arguments(struct stream *s, struct span call, const struct macro *m,
                          struct macro_argument *out)
{
    int count = 0;
    bool ok = raw_expect(s, '(', "'('", "a macro call");
    while (ok) {
        // A directive or macro may stand before an argument.
        if (raw_kind(s) == '#')
            stream_give_back(s, stream_next(s));
        if (raw_kind(s) == ')')
            break;
        struct macro_argument extra;
        ok = read_argument(s, count < m->parameter_count ? &out[count] : &extra);
        count++;
        if (ok && !raw_take_if(s, ',') && raw_kind(s) == TOK_END)
            break;
    }
    if (!ok || !raw_expect(s, ')', "')'", "a macro call"))
        return -1;
    if (count == m->parameter_count)
        return count;
    diag_report(s->diags, DIAG_ARGUMENT_COUNT, call, &m->where, NULL, m->name,
                m->parameter_count, count);
    return -1;
}

void macro_call(struct stream *s, struct token name, struct macro *m)
{
    struct arena_mark mark = arena_mark(s->nodes);
    const bool known = version_has_macros(s, name.where);
    struct macro_argument *args =
        arena_new_array(s->nodes, struct macro_argument, (size_t)m->parameter_count + 1);
    int count = read_arguments(s, name.where, m, args);
    if (count >= 0 && s->calls >= CALLS_MAX) {
        diag_at(s->diags, DIAG_TOO_DEEP, name.where, "macro calls", CALLS_MAX);
        s->stopped = true;
        count = -1;
    }
    stream_ask(s, name.where);
    if (s->stopped || !known)
        count = -1;
    if (count >= 0 && s->host.enter_scope(s->host.user, name.where)) {
        bool ok = true;
        for (int i = 0; i < count; i++)
            ok &= s->host.bind_argument(s->host.user, m->parameter[i].text,
                                        m->parameter[i].len, &args[i]);
        s->cursors = must_grow(s->cursors, s->cursor_count, &s->cursor_capacity,
                               sizeof *s->cursors);
        s->cursors[s->cursor_count++] =
            (struct cursor){.tokens = m->body,
                            .slots = m->slots,
                            .count = m->count,
                            .file = m->file,
                            .text = m->text,
                            .macro = m,
                            .frames = s->frame_count,
                            .at = ok ? 0 : m->count,
                            .expansion = source_expand(s->sources, m->name, name.where)};
        s->calls++;
    }
    arena_rewind(s->nodes, mark);
}
