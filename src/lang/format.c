#include "lang/format.h"

#include <stdlib.h>

#include "base/memory.h"
#include "lang/lexeme.h"
#include "lang/lexer.h"

enum { DEPTH_MAX = 60 }; // deeper lines are indented no further

struct format {
    const struct source_file *file;
    const struct lexeme *tokens;
    uint32_t count, at; // the next token
    int depth;          // open braces, brackets and directives
    int *frame;         // `depth` inside each open directive when it began
    uint32_t frames, capacity;
    int last;        // kind of the token before `at`; 0: none
    uint32_t opaque; // a token or comment covers the text up to here
    int width;
    FILE *out;
};

static bool opens_directive(enum word w)
{
    return w == WORD_if || w == WORD_ifdef || w == WORD_ifndef || w == WORD_while ||
           w == WORD_for || w == WORD_switch || w == WORD_macro;
}

static bool middle(enum word w)
{
    return w == WORD_else || w == WORD_elseif || w == WORD_case || w == WORD_range;
}

static enum word directive_at(const struct format *f, uint32_t i)
{
    bool is = i + 1 < f->count && f->tokens[i].kind == '#';
    return is ? lexeme_word(&f->tokens[i + 1]) : WORD_NONE;
}

static bool is_opener(int kind) { return kind == '{' || kind == '(' || kind == '['; }

static bool is_closer(int kind) { return kind == '}' || kind == ')' || kind == ']'; }

static void open_frame(struct format *f)
{
    f->frame = must_grow(f->frame, f->frames, &f->capacity, sizeof *f->frame);
    f->frame[f->frames++] = ++f->depth;
}

// What a token does to the depth. Each branch of an #if begins as deep as the first:
// `#if (A) union { #else merge { #end`.
static void pass(struct format *f, uint32_t i)
{
    int kind = f->tokens[i].kind;
    enum word w = directive_at(f, i);
    f->depth += is_opener(kind) - is_closer(kind);
    if (opens_directive(w)) {
        open_frame(f);
    } else if (middle(w) && f->frames) {
        f->depth = f->frame[f->frames - 1];
    } else if (w == WORD_end && f->frames) {
        f->frames--;
        f->depth--;
    }
    f->last = kind;
}

// The end of the comment that begins at `i`, or `i`.
static uint32_t comment_end(const char *text, uint32_t i, uint32_t end)
{
    if (i + 1 >= end || text[i] != '/')
        return i;
    if (text[i + 1] == '/') {
        while (i < end && text[i] != '\n' && text[i] != '\r')
            i++;
        return i;
    }
    if (text[i + 1] != '*')
        return i;
    int open = 0;
    do {
        bool two = i + 1 < end;
        if (two && text[i] == '/' && text[i + 1] == '*') {
            open++;
            i += 2;
        } else if (two && text[i] == '*' && text[i + 1] == '/') {
            open--;
            i += 2;
        } else {
            i++;
        }
    } while (open && i < end);
    return i;
}

// Takes the tokens that begin before `end`, and notes how far the last one, or a comment
// that begins before `end`, reaches.
static void take_line(struct format *f, uint32_t begin, uint32_t end)
{
    uint32_t i = begin > f->opaque ? begin : f->opaque;
    while (i < end) {
        uint32_t comment = comment_end(f->file->text, i, f->file->len);
        if (f->at < f->count && f->tokens[f->at].begin == i) {
            pass(f, f->at);
            i += lexeme_len(&f->tokens[f->at++]);
        } else {
            i = comment > i ? comment : i + 1;
        }
    }
    f->opaque = i;
}

// Whether a line that goes on after this token belongs to the line before.
static bool continues_after(int kind)
{
    return kind == '=' || kind == '+' || kind == '-' || kind == '*' || kind == '/' ||
           kind == '?' || kind == '&' || kind == '|';
}

// A line that closes what is open stands as deep as the line that opened it.
static int indent_of(const struct format *f, uint32_t end)
{
    int depth = f->depth;
    uint32_t i = f->at;
    bool first = i < f->count && f->tokens[i].begin < end;
    enum word w = first ? directive_at(f, i) : WORD_NONE;
    if (first && middle(w) && f->frames)
        depth = f->frame[f->frames - 1] - 1;
    else if (w == WORD_end && f->frames)
        depth--;
    else if (continues_after(f->last) && first && f->tokens[i].kind != '{')
        depth++;
    for (; i < f->count && f->tokens[i].begin < end && is_closer(f->tokens[i].kind); i++)
        depth--;
    return depth < 0 ? 0 : depth > DEPTH_MAX ? DEPTH_MAX : depth;
}

static uint32_t line_end(const struct source_file *s, uint32_t at)
{
    while (at < s->len && s->text[at] != '\n' && s->text[at] != '\r')
        at++;
    return at;
}

static bool is_blank(char c) { return c == ' ' || c == '\t'; }

static void format_line(struct format *f, uint32_t begin, uint32_t end)
{
    const char *text = f->file->text;
    uint32_t from = begin, to = end;
    if (f->opaque <= begin) {
        while (from < end && is_blank(text[from]))
            from++;
        if (from < end)
            fprintf(f->out, "%*s", f->width * indent_of(f, end), "");
    }
    take_line(f, from, end);
    if (f->opaque <= end)
        while (to > from && is_blank(text[to - 1]))
            to--;
    fwrite(text + from, 1, to - from, f->out);
}

bool format_source(struct source_map *sources, uint32_t file, struct diag_sink *diags,
                   int width, FILE *out)
{
    struct format f = {.file = sources->file[file], .width = width, .out = out};
    unsigned errors = diags->errors;
    struct word_table words;
    word_table_init(&words);
    struct lexeme *tokens = lex_file(sources, file, diags, &words, NULL, &f.count);
    f.tokens = tokens;
    const struct source_file *s = f.file;
    for (uint32_t at = 0; at < s->len && diags->errors == errors;) {
        uint32_t end = line_end(s, at), next = end;
        format_line(&f, at, end);
        if (next < s->len && s->text[next] == '\r')
            next++;
        if (next < s->len && s->text[next] == '\n')
            next++;
        fwrite(s->text + end, 1, next - end, out);
        at = next;
    }
    free(f.frame);
    free(tokens);
    return diags->errors == errors;
}
