#include "lang/parse.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "lang/literal.h"
#include "lang/parse_state.h"
#include "lang/stream_state.h"
#include "parser.h"

struct ast *parse_calculated(struct stream *s, struct span where,
                             const struct calc_result *r)
{
    struct ast *n = ast_new(s->nodes, r->width == 1 ? AST_NUMBER : AST_VALUE, where);
    if (r->width == 1)
        n->number = r->number;
    else if (r->width)
        n->value = r->value;
    else
        n->op = OP_FAILED;
    return n;
}

// The block that a triangle is one of the faces of; NULL: it is none.
static struct parse_block *mesh_around(struct parse *p, enum word word)
{
    struct parse_block *outer = p->block_count ? &p->blocks[p->block_count - 1] : NULL;
    const bool face = outer && !outer->entry && outer->word == WORD_mesh &&
                      (word == WORD_triangle || word == WORD_smooth_triangle);
    return face && p->in->host.face ? outer : NULL;
}

// Before anything is made of a block: what its faces go into stays when they are wound back.
static void begin_faces(struct parse *p, enum word word)
{
    struct parse_block *mesh = mesh_around(p, word);
    if (mesh && !mesh->faces)
        mesh->faces = p->in->host.faces(p->in->host.user);
}

void parse_open(struct parse *p, enum word word, bool entry, struct span where)
{
    begin_faces(p, word);
    p->blocks =
        must_grow(p->blocks, p->block_count, &p->block_capacity, sizeof *p->blocks);
    p->blocks[p->block_count++] =
        (struct parse_block){word, entry, p->function, where, arena_mark(p->arena), NULL};
    p->function = false;
}

// Blocks of an object's keyword that are parts of something else.
static bool is_part(const struct parse *p, enum word w)
{
    if (!p->block_count)
        return false;
    const struct parse_block *outer = &p->blocks[p->block_count - 1];
    if (outer->entry)
        return true;
    switch (outer->word) {
    case WORD_blob:
    case WORD_contained_by: return true;
    case WORD_mesh: return w == WORD_triangle || w == WORD_smooth_triangle;
    case WORD_pigment:
    case WORD_normal:
    case WORD_texture:
    case WORD_density:
    case WORD_pattern:
    case WORD_pigment_pattern:
    case WORD_interior_texture:
    case WORD_function: return w == WORD_object;
    default: return false;
    }
}

// A finished object needs its text no more, all of which was made after the mark.
static struct ast *finish_block(struct stream *s, struct ast *node,
                                struct arena_mark mark)
{
    struct ast *done = s->host.finish(s->host.user, node);
    if (!done)
        done = node;
    if (done->kind != AST_VALUE)
        return done;
    struct ast keep = *done;
    arena_rewind(s->nodes, mark);
    struct ast *n = ast_new(s->nodes, AST_VALUE, keep.where);
    n->text = keep.text;
    n->len = keep.len;
    n->value = keep.value;
    return n;
}

// Takes a triangle of a mesh in, after which its text, made after the mark, is gone.
static struct ast *take_face(struct parse *p, const struct parse_block *mesh,
                             const struct ast *block, struct arena_mark mark)
{
    const struct span where = block->where;
    const uint16_t word = block->word;
    p->in->host.face(p->in->host.user, mesh->faces, block);
    arena_rewind(p->arena, mark);
    p->before_faces = mark;
    struct ast *n = ast_new(p->arena, AST_FACES, where);
    n->word = word;
    n->faces = mesh->faces;
    return n;
}

bool parse_joins(struct parse *p, struct ast *last, const struct ast *item)
{
    if (item->kind != AST_FACES || !last || last->kind != AST_FACES ||
        item->faces != last->faces)
        return false;
    last->comma_after = 0;
    arena_rewind(p->arena, p->before_faces);
    return true;
}

// At a closing brace.
struct ast *parse_close(struct parse *p, struct ast *node)
{
    struct parse_block b = p->blocks[--p->block_count];
    p->function = b.function;
    enum word w = (enum word)node->word;
    const struct parse_block *mesh = node->kind == AST_BLOCK ? mesh_around(p, w) : NULL;
    if (mesh)
        return take_face(p, mesh, node, b.mark);
    if (node->kind != AST_BLOCK || word_class(w) != CLASS_OBJECTS || is_part(p, w))
        return node;
    return finish_block(p->in, node, b.mark);
}

static struct ast *literal(struct stream *s, const struct token *t, bool part)
{
    struct arena_mark mark = arena_mark(s->nodes);
    struct ast *n = literal_read(s->nodes, &s->words, t, &s->host);
    if (part || word_class((enum word)t->word) != CLASS_OBJECTS)
        return n;
    return finish_block(s, n, mark);
}

struct ast *parse_literal(struct parse *p)
{
    const enum word w = (enum word)p->now->word;
    begin_faces(p, w);
    const struct parse_block *mesh = mesh_around(p, w);
    if (!mesh)
        return literal(p->in, p->now, is_part(p, w));
    const struct arena_mark mark = arena_mark(p->arena);
    return take_face(p, mesh, literal_read(p->arena, &p->in->words, p->now, &p->in->host),
                     mark);
}

struct ast *parse_finish(struct parse *p, struct ast *node)
{
    bool plain = node->kind == AST_CALL &&
                 (node->word == WORD_pwr || node->word == WORD_internal ||
                  node->word == WORD_sum || node->word == WORD_prod);
    if (plain || (p->function && node->kind != AST_INDEX))
        return node;
    struct ast *done = p->in->host.finish(p->in->host.user, node);
    return done ? done : node;
}

void parse_check_first(struct parse *p, const struct ast *n)
{
    while (n && !n->parens) {
        switch (n->kind) {
        case AST_BINARY:
        case AST_MEMBER: n = n->left; break;
        case AST_CONDITIONAL: n = n->list; break;
        case AST_WORD:
            if (n->word != WORD_color && n->word != WORD_colour)
                return;
            n = n->next;
            break;
        case AST_CONSTANT:
            if (n->word == WORD_t)
                diag_hint(p->in->diags, DIAG_T_FIRST, n->where,
                          "it can in parentheses, (t), or as 1*t", 0);
            return;
        default: return;
        }
    }
}

void parse_old_semicolon(struct stream *s, struct span where)
{
    if (!s->old_semicolon)
        diag_at(s->diags, DIAG_OLD_SEMICOLON, where, 0);
    s->old_semicolon = true;
}

// `#declare A = 5` without the ';'. Names and array elements of other types than
// numbers need none, which only eval can tell.
void parse_missing_semicolon(struct parse *p, const struct ast *value)
{
    if (value && (value->kind == AST_VALUE || value->kind == AST_INDEX) &&
        !value->parens && p->last->kind == ']')
        return;
    struct span where = p->last->where;
    where.begin = where.end > where.begin ? where.end - 1 : where.end;
    bool compares = p->now->where.file == p->last->where.file && raw_kind(p->in) == '<';
    const char *hint = compares ? "a comparison here needs parentheses around it" : NULL;
    if (p->in->version < 3.5)
        parse_old_semicolon(p->in, where);
    else
        diag_hint(p->in->diags, DIAG_SEMICOLON, where, hint, 0);
    while (compares && raw_kind(p->in) != TOK_END && raw_kind(p->in) != '#' &&
           raw_kind(p->in) != '}')
        if (raw_take(p->in).kind == ';')
            return;
}

// After an error: to where the broken statement, right side or list ends.
static void skip_broken(struct parse *p)
{
    struct stream *s = p->in;
    if (p->now->kind == TOK_STOP)
        return;
    if (p->braces < 0 || (p->now->kind == TOK_END && !s->stopped)) {
        stream_give_back(s, *p->now);
        return;
    }
    bool parens = p->start == TOK_START_CONDITION || p->start == TOK_START_LIST ||
                  p->start == TOK_START_ITEMS;
    if (p->start == TOK_START_LIST || p->start == TOK_START_ITEMS)
        p->nest++;
    int last = p->now->kind;
    while (!s->stopped) {
        if (p->braces <= 0 && (last == ';' || last == '}' || last == TOK_LITERAL))
            break;
        if (parens && p->nest <= 0)
            break;
        struct token next = raw_peek(s);
        if (next.kind == TOK_END || (next.kind == '#' && p->braces <= 0) ||
            (next.kind == '}' && p->braces <= 0))
            break;
        if (p->braces <= 0 && !parens &&
            (next.kind == TOK_LITERAL || next.kind == TOK_NAMED ||
             (next.kind == TOK_WORD && raw_peek_second(s).kind == '{')))
            break;
        struct token t = stream_next(s);
        if (t.kind == TOK_END)
            break;
        last = t.kind;
        parse_note_brackets(p, &t);
    }
    if (p->start == TOK_START_RVALUE)
        raw_take_if(s, ';');
}

static bool is_bounded(int start)
{
    return start == TOK_START_RVALUE || start == TOK_START_ARGUMENT;
}

struct ast *parse_run(struct stream *in, int start, bool *ok)
{
    struct parse p = {
        .in = in,
        .arena = in->nodes,
        .start = start,
        .bounded = is_bounded(start),
    };
    p.slot[0].kind = -1;
    p.now = p.last = &p.slot[0];
    *ok = false;
    if (in->runs == PARSE_RUNS_MAX) {
        diag_at(in->diags, DIAG_TOO_DEEP, raw_peek(in).where, "calls inside expressions",
                (int)PARSE_RUNS_MAX);
        in->stopped = true;
        return NULL;
    }
    in->runs++;
    int code = sdl_parse(&p);
    in->runs--;
    free(p.blocks);
    *ok = code == 0 && !p.failed;
    if (code == 2 && !p.failed && !in->stopped) {
        diag_at(in->diags, DIAG_TOO_DEEP, p.now->where, "brackets", (int)PARSE_NEST_MAX);
        in->stopped = true;
    }
    if (!*ok)
        skip_broken(&p);
    return *ok ? p.result : NULL;
}

// The old directives without their '#'.
static bool run_bare_directive(struct stream *s, struct token t)
{
    if (t.word != WORD_declare && t.word != WORD_include && t.word != WORD_version &&
        t.word != WORD_default)
        return false;
    struct arena_mark mark = arena_mark(s->nodes);
    diag_at(s->diags, DIAG_BARE_DIRECTIVE, t.where, word_text((enum word)t.word));
    if (t.word == WORD_declare)
        directive_declare(s, t);
    else if (t.word == WORD_include)
        directive_include(s, t);
    else if (t.word == WORD_version)
        directive_version(s, t);
    else
        directive_default(s, t);
    arena_rewind(s->nodes, mark);
    return true;
}

// A name nobody declared starts no statement: a misspelt keyword with its braces, or
// a call of a macro that does not exist.
static void skip_unknown(struct stream *s, struct token name)
{
    struct token next = raw_peek(s);
    parse_unknown_word(s, &name, next.kind == '(');
    if (next.kind == '{' || next.kind == '(')
        parse_skip_group(s);
}

struct ast *parse_item(struct stream *s)
{
    arena_rewind(s->nodes, s->statement);
    for (;;) {
        struct token t = stream_next(s);
        if (t.kind == TOK_END)
            return NULL;
        stream_ask(s, t.where);
        if (t.word && run_bare_directive(s, t))
            continue;
        if (t.kind == TOK_NAME && !t.value) {
            skip_unknown(s, t);
            continue;
        }
        if (t.kind == ';' || t.kind == '}' || t.kind == ')' || t.kind == '>' ||
            t.kind == ']') {
            diag_at(s->diags, DIAG_STRAY_TOKEN, t.where, t.kind);
            continue;
        }
        if (t.kind == TOK_LITERAL)
            return literal(s, &t, false);
        bool ok;
        stream_give_back(s, t);
        struct ast *n = parse_run(s, TOK_START_STATEMENT, &ok);
        if (ok && n)
            return n;
    }
}
