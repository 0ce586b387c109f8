// What the grammar finds wrong, in words, and what may have been meant.
#include <ctype.h>
#include <string.h>

#include "lang/parse_state.h"
#include "lang/stream_state.h"
#include "parser.h"

static const char *undeclared_hint(struct stream *s, const struct token *t,
                                   enum undeclared_kind kind, const char *word)
{
    return s->host.undeclared
               ? s->host.undeclared(s->host.user, t->text, t->len, kind, word)
               : NULL;
}

// The name of a built-in function that is close to the token's.
static const char *closest_function(const struct token *t)
{
    const char *names[WORD_COUNT];
    size_t n = 0;
    for (enum word w = WORD_NONE + 1; w < WORD_COUNT; w++) {
        enum word_class c = word_class(w);
        if (c == CLASS_FLOAT_FUNCTIONS || c == CLASS_VECTOR_FUNCTIONS ||
            c == CLASS_STRING_FUNCTIONS)
            names[n++] = word_text(w);
    }
    return diag_closest(t->text, t->len, names, n);
}

void parse_undeclared(struct stream *s, const struct token *t, bool call)
{
    const char *word = call ? closest_function(t) : NULL;
    const char *hint =
        undeclared_hint(s, t, call ? UNDECLARED_CALL : UNDECLARED_VALUE, word);
    if (!hint && call) // a function of the scene's own
        hint = undeclared_hint(s, t, UNDECLARED_VALUE, NULL);
    diag_hint(s->diags, DIAG_UNDECLARED, t->where, hint, (int)t->len, t->text);
}

// What stands for a word of other versions or programs.
static const char *word_gone(const struct token *t)
{
    static const char *const gone[][2] = {
        {"halo", "POV-Ray has no halos since 3.1: media in an interior replace them"},
        {"light", "did you mean 'light_source'?"},
        {"glow", "a word of MegaPOV: emitting media in a hollow object come close"},
        {"motion_blur", "a word of MegaPOV: average the frames of a short animation"},
        {"dictionary", "a word of POV-Ray 3.8"},
    };
    for (size_t i = 0; i < sizeof gone / sizeof *gone; i++)
        if (strlen(gone[i][0]) == t->len && memcmp(gone[i][0], t->text, t->len) == 0)
            return gone[i][1];
    return NULL;
}

void parse_unknown_word(struct stream *s, const struct token *t, bool call)
{
    // Once for each name: a macro whose include is missing is called many times.
    if (call && stream_was_reported(s, t->text, t->len))
        return;
    if (call)
        stream_set_reported(s, t->text, t->len);
    const char *hint = word_gone(t), *near = NULL;
    if (!call && !hint)
        near = diag_closest(t->text, t->len, word_list(), WORD_COUNT - 1);
    if (near)
        hint = arena_printf(s->nodes, "did you mean '%s'?", near);
    if (!hint)
        hint = undeclared_hint(s, t, call ? UNDECLARED_MACRO : UNDECLARED_VALUE, NULL);
    diag_hint(s->diags, DIAG_UNKNOWN_WORD, t->where, hint, (int)t->len, t->text);
}

static const char *token_text(struct parse *p, const struct token *t)
{
    switch (t->kind) {
    case TOK_END: return "end of the file";
    case TOK_NUMBER: return "number";
    case TOK_STRING: return "string";
    case TOK_BULK: return "vectors";
    case TOK_NAME:
        if (!t->len)
            return "expression";
        // fallthrough
    default: return arena_printf(p->arena, "'%.*s'", (int)t->len, t->text);
    }
}

static void expected_text(char *out, size_t size, const int *kinds, int count)
{
    static const struct {
        int kind;
        const char *text;
    } names[] = {
        {TOK_NUMBER, "a number or vector"},
        {TOK_STRING, "a string"},
        {'{', "'{'"},
        {'}', "'}'"},
        {')', "')'"},
        {']', "']'"},
        {'>', "'>'"},
        {'(', "'('"},
        {';', "';'"},
        {',', "','"},
        {':', "':'"},
    };
    const char *found[sizeof names / sizeof *names];
    size_t n = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        for (int k = 0; k < count; k++)
            if (kinds[k] == names[i].kind && n < 4)
                found[n++] = names[i].text;
    size_t len = 0;
    out[0] = 0;
    for (size_t i = 0; i < n && len < size; i++)
        len += (size_t)snprintf(out + len, size - len, "%s%s",
                                i == 0      ? ", expected "
                                : i + 1 < n ? ", "
                                            : " or ",
                                found[i]);
}

static bool among(int kind, const int *expected, int count)
{
    for (int i = 0; i < count; i++)
        if (expected[i] == kind)
            return true;
    return false;
}

// What people used to other languages write; NULL: something else.
static const char *habit_hint(int kind, int last, const int *expected, int count)
{
    if (kind == '=' && last == '=')
        return "equality is written with one '='";
    if ((kind == '&' || kind == '|') && last == kind)
        return "'and' is one '&', 'or' is one '|'";
    if (kind == '=' && (last == TOK_WORD))
        return "a setting's value follows its name, without a '='";
    if (kind == ';' && among('}', expected, count))
        return "items in braces have no ';' between them";
    if (kind == ',' && among(')', expected, count))
        return "the parts of a vector are written in < >";
    if ((kind == TOK_NAME || kind == TOK_WORD) && among(TOK_STRING, expected, count) &&
        !among(TOK_NUMBER, expected, count))
        return "strings, as names of files, are written in double quotes";
    if (kind == '<' && among(TOK_STRING, expected, count) &&
        !among(TOK_NUMBER, expected, count))
        return "names of files are written in double quotes";
    if (kind == TOK_STRING && last == '+')
        return "concat() joins strings";
    if (kind == '+' && (last == TOK_STRING || last == TOK_STRING_NAME))
        return "concat() joins strings";
    if (kind == '[' && last == TOK_NAME)
        return "what stands before it is no array";
    return NULL;
}

// Whether a line begins with an object or another block that stands for itself.
static bool begins_statement(const char *line, size_t n)
{
    static const enum word words[] = {
        WORD_background, WORD_blob,           WORD_box,          WORD_camera,
        WORD_cone,       WORD_cylinder,       WORD_difference,   WORD_disc,
        WORD_fog,        WORD_height_field,   WORD_intersection, WORD_isosurface,
        WORD_lathe,      WORD_light_source,   WORD_mesh,         WORD_mesh2,
        WORD_object,     WORD_plane,          WORD_prism,        WORD_sky_sphere,
        WORD_sphere,     WORD_text,           WORD_torus,        WORD_triangle,
        WORD_union,      WORD_global_settings};
    size_t len = 0;
    while (len < n && (isalnum((unsigned char)line[len]) || line[len] == '_'))
        len++;
    size_t brace = len;
    while (brace < n && line[brace] == ' ')
        brace++;
    const enum word w = word_find(line, len);
    for (size_t i = 0;
         brace < n && line[brace] == '{' && i < sizeof words / sizeof *words; i++)
        if (w == words[i])
            return true;
    return false;
}

static size_t indentation(const char *line, size_t n)
{
    size_t k = 0;
    while (k < n && (line[k] == ' ' || line[k] == '\t'))
        k++;
    return k;
}

// Of a block that the file ends in: the line of a statement within it that is indented no
// deeper, before which the brace may be missing; NULL: none is.
static const char *brace_hint(struct stream *s, const struct parse_block *b)
{
    struct source_file *f = s->sources->file[b->where.file];
    struct source_line l = source_line(f, b->where.begin);
    const size_t own = indentation(f->text + l.begin, l.end - l.begin);
    while (l.end + 1 < f->len) {
        l = source_line(f, l.end + 1);
        const char *line = f->text + l.begin;
        const size_t n = l.end - l.begin, in = indentation(line, n);
        if (in <= own && begins_statement(line + in, n - in))
            return arena_printf(s->nodes, "perhaps before line %u", l.number);
    }
    return NULL;
}

// Of what was taken whole, the token that is in the way.
static struct token first_of(const struct token *t)
{
    struct token first = *t;
    if (t->kind == TOK_LITERAL || t->kind == TOK_VECTOR3) {
        first.kind = t->kind == TOK_LITERAL ? TOK_WORD : '<';
        first.len =
            t->kind == TOK_LITERAL ? (uint16_t)strlen(word_text((enum word)t->word)) : 1;
        first.where.end = first.where.begin + first.len;
    }
    return first;
}

// The bracket that must be closed before what was found; NULL: that is not what is wrong.
static const char *open_bracket(int kind, const int *expected, int count)
{
    if (kind != '}' && kind != '{' && kind != ';' && kind != TOK_END)
        return NULL;
    if (among(']', expected, count))
        return "]";
    if (among(')', expected, count))
        return ")";
    // Behind a value alone it may be "greater than".
    return among('>', expected, count) && among(',', expected, count) ? ">" : NULL;
}

static bool report_bracket(struct parse *p, const struct token *t, const char *bracket)
{
    struct stream *s = p->in;
    const struct parse_block *b = p->block_count ? &p->blocks[p->block_count - 1] : NULL;
    const struct span *opened = *bracket == ')' && p->parens > 0   ? &p->paren
                                : *bracket == ']' && b && b->entry ? &b->where
                                                                   : NULL;
    if (t->kind == TOK_END && !opened)
        return false;
    if (t->kind == TOK_END)
        diag_report(s->diags, DIAG_UNCLOSED, t->where, opened, NULL,
                    *bracket == ')' ? "(" : "[", bracket);
    else
        diag_report(s->diags, DIAG_MISSING, t->where, opened, NULL, bracket,
                    arena_printf(p->arena, "before this '%c'", t->kind));
    return true;
}

static bool has_braces(enum word w)
{
    const enum word_class c = word_class(w);
    return c == CLASS_OBJECTS || c == CLASS_VALUE_BLOCKS ||
           c == CLASS_OTHER_SCENE_LEVEL_BLOCKS;
}

static void report_brace(struct parse *p, enum word w, struct span where)
{
    p->failed = true;
    diag_at(p->in->diags, DIAG_MISSING, where, "{",
            arena_printf(p->arena, "after '%s'", word_text(w)));
}

bool parse_is_bare(struct parse *p, enum word word, struct span where)
{
    if (!has_braces(word))
        return true;
    report_brace(p, word, where);
    return false;
}

// A string among numbers is read as far as a comparison goes.
static bool is_stray_string(const struct token *last, const int *expected, int count)
{
    return (last->kind == TOK_STRING || last->kind == TOK_STRING_NAME) &&
           among(TOK_LE, expected, count) && !among(TOK_STRING, expected, count);
}

void parse_syntax_error(struct parse *p, const int *expected, int count)
{
    struct stream *s = p->in;
    if (p->failed || s->stopped)
        return;
    p->failed = true;
    const struct token *t = p->now, *last = p->last;
    const struct token first = first_of(t);
    t = &first;
    if (t->kind == '{' && last->kind == TOK_NAME && !last->value && last->len) {
        parse_unknown_word(s, last, false);
        return;
    }
    if ((t->kind == '(' || t->kind == '[') && last->kind == TOK_NAME && !last->value &&
        last->len) { // within a function
        parse_undeclared(s, last, t->kind == '(');
        return;
    }
    if (t->kind == TOK_END && p->block_count) {
        const struct parse_block *b = &p->blocks[p->block_count - 1];
        diag_report(s->diags, DIAG_UNCLOSED, t->where, &b->where,
                    b->entry ? NULL : brace_hint(s, b),
                    b->entry ? "[" : word_text(b->word), b->entry ? "]" : "}");
        return;
    }
    if (t->kind == TOK_END && s->diags->errors)
        return; // a string that has no end has taken the rest
    const char *bracket = open_bracket(t->kind, expected, count);
    if (bracket && report_bracket(p, t, bracket))
        return;
    if (p->start == TOK_START_STATEMENT && last->kind == TOK_WORD &&
        among('{', expected, count) && has_braces((enum word)last->word)) {
        report_brace(p, (enum word)last->word, last->where);
        return;
    }
    if (is_stray_string(last, expected, count)) {
        diag_at(s->diags, DIAG_EXPECTED_NUMBER, last->where, "a string");
        return;
    }
    char text[256];
    expected_text(text, sizeof text, expected, count);
    diag_hint(s->diags, DIAG_UNEXPECTED, t->where,
              habit_hint(t->kind, last->kind, expected, count), token_text(p, t), text);
}
