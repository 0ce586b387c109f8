#include <math.h>
#include <string.h>

#include "lang/parse_state.h"
#include "lang/stream_state.h"
#include "parser.h"

static const double TRUTH = 1e-10; // language 3: EPS

static bool opens(enum word w)
{
    return w == WORD_if || w == WORD_ifdef || w == WORD_ifndef || w == WORD_while ||
           w == WORD_for || w == WORD_switch || w == WORD_macro;
}

// Moves past skipped text: until `depth` directives are closed, or before that to an
// #else, #elseif, #case or #range of the innermost one, whose word is *stop. False at
// the end of the text.
bool directive_skip(struct stream *s, uint32_t depth, bool stop_at_else,
                    bool stop_at_case, struct token *stop)
{
    struct cursor *c = &s->cursors[s->cursor_count - 1];
    while (c->at < c->count) {
        const struct lexeme *t = &c->tokens[c->at++];
        s->steps++;
        if (t->kind != '#' || c->at >= c->count)
            continue;
        cursor_token(c, c->at++, stop);
        enum word w = (enum word)stop->word;
        if (opens(w))
            depth++;
        else if (w == WORD_end && --depth == 0)
            return true;
        else if (depth == 1 && stop_at_else && (w == WORD_else || w == WORD_elseif))
            return true;
        else if (depth == 1 && stop_at_case &&
                 (w == WORD_case || w == WORD_range || w == WORD_else))
            return true;
    }
    return false;
}

static void pop_frame(struct stream *s) { s->frame_count--; }

static void report_open_frame(struct stream *s)
{
    const struct frame *f = &s->frames[s->frame_count - 1];
    diag_at(s->diags, DIAG_MISSING_END, f->opener, word_text(f->word));
    pop_frame(s);
}

// At the end of a file or macro body. Only an include may leave an #if open, for
// its includer to close.
void directive_end_of_cursor(struct stream *s, struct cursor *c)
{
    bool main_file = c == &s->cursors[0];
    uint32_t i = c->frames;
    for (; i < s->frame_count; i++)
        if (main_file || s->frames[i].kind >= FRAME_WHILE)
            break;
    while (i < s->frame_count)
        report_open_frame(s);
}

bool directive_number(struct stream *s, int start, double *out)
{
    bool ok;
    struct calc_result r;
    *out = 0;
    if (start == TOK_START_CONDITION) {
        enum calc_outcome outcome = stream_calculate(s, CALC_CONDITION, false, &r);
        if (outcome == CALC_DONE)
            *out = r.number;
        if (outcome != CALC_NONE)
            return outcome == CALC_DONE;
    }
    const struct ast *e = parse_run(s, start, &ok);
    return ok && e && s->host.number(s->host.user, e, out);
}

static bool truth(struct stream *s)
{
    double v;
    return directive_number(s, TOK_START_CONDITION, &v) && fabs(v) > TRUTH;
}

static bool is_defined(struct stream *s, const char *directive)
{
    struct lvalue name;
    bool known = false;
    if (!raw_expect(s, '(', "'('", directive))
        return false;
    if (raw_word(s) != WORD_NONE)
        raw_take(s); // reserved words are in no table
    else if (raw_lvalue(s, &name, directive))
        known = s->host.is_declared(s->host.user, &name);
    raw_expect(s, ')', "')'", directive);
    return known;
}

// A condition that runs into the end of its text has closed every directive, its own
// too. `frames`: how many were open with it.
static bool still_open(const struct stream *s, uint32_t frames)
{
    return s->frame_count >= frames;
}

// To the branch of an #if that is taken, or past its #end.
static void find_branch(struct stream *s)
{
    struct token stop;
    const uint32_t frames = s->frame_count;
    while (still_open(s, frames)) {
        if (!directive_skip(s, 1, true, false, &stop)) {
            report_open_frame(s);
            return;
        }
        if (stop.word == WORD_else)
            return;
        if (stop.word == WORD_end) {
            pop_frame(s);
            return;
        }
        if (truth(s))
            return;
    }
}

static void run_if(struct stream *s, struct token word)
{
    stream_push_frame(s, FRAME_IF, &word);
    const uint32_t frames = s->frame_count;
    bool taken = word.word == WORD_if      ? truth(s)
                 : word.word == WORD_ifdef ? is_defined(s, "#ifdef")
                                           : !is_defined(s, "#ifndef");
    if (!taken && still_open(s, frames))
        find_branch(s);
}

static bool case_matches(struct stream *s, enum word w, double value)
{
    double v, hi;
    if (w == WORD_case)
        return directive_number(s, TOK_START_CONDITION, &v) && fabs(value - v) < TRUTH;
    bool ok;
    if (!raw_expect(s, '(', "'('", "#range"))
        return false;
    struct ast *list = parse_run(s, TOK_START_LIST, &ok);
    if (!ok)
        return false;
    if (!list || !list->next || list->next->next) {
        diag_at(s->diags, DIAG_RANGE, list ? list->where : raw_peek(s).where, 0);
        return false;
    }
    return s->host.number(s->host.user, list, &v) &&
           s->host.number(s->host.user, list->next, &hi) && v <= value && value <= hi;
}

static bool is_middle(enum word w)
{
    return w == WORD_else || w == WORD_elseif || w == WORD_end || w == WORD_break;
}

// To the first #case or #range, which only other directives may stand before: these are run.
static void begin_switch(struct stream *s, uint32_t frames)
{
    while (still_open(s, frames) && !s->stopped) {
        stream_pop_finished(s);
        const bool own = s->frame_count == frames, hash = raw_kind(s) == '#';
        const enum word w = hash ? (enum word)raw_peek_second(s).word : WORD_NONE;
        if (raw_kind(s) == TOK_END || (own && (w == WORD_case || w == WORD_range)))
            return;
        if (!hash || (own && is_middle(w))) {
            diag_at(s->diags, DIAG_NO_CASE, raw_peek(s).where, 0);
            return;
        }
        const struct token t = raw_take(s);
        stream_run_directive(s, &t);
    }
}

static void run_switch(struct stream *s, struct token word)
{
    double value;
    bool ok = directive_number(s, TOK_START_CONDITION, &value);
    stream_push_frame(s, FRAME_SWITCH, &word)->value = value;
    struct token stop;
    const uint32_t frames = s->frame_count;
    begin_switch(s, frames);
    while (still_open(s, frames)) {
        if (!directive_skip(s, 1, false, true, &stop)) {
            report_open_frame(s);
            return;
        }
        if (stop.word == WORD_end) {
            pop_frame(s);
            return;
        }
        if (stop.word == WORD_else ||
            (case_matches(s, (enum word)stop.word, value) && ok))
            return;
    }
}

static void skip_rest(struct stream *s, uint32_t depth)
{
    struct token stop;
    if (!directive_skip(s, depth, false, false, &stop))
        report_open_frame(s);
    else
        pop_frame(s);
}

static void run_while(struct stream *s, struct token word)
{
    struct frame *f = stream_push_frame(s, FRAME_WHILE, &word);
    f->back = s->cursors[s->cursor_count - 1].at;
    const uint32_t frames = s->frame_count;
    if (!truth(s) && still_open(s, frames))
        skip_rest(s, 1);
}

static struct lvalue for_variable(const struct token *t)
{
    return (struct lvalue){
        .name = t->text, .len = t->len, .where = t->where, .local = true};
}

static bool for_head(struct stream *s, struct lvalue *variable, double bound[3])
{
    struct token name;
    bool ok = raw_expect(s, '(', "'('", "#for");
    if (!ok || !raw_expect_name(s, &name, "#for"))
        return false;
    *variable = for_variable(&name);
    raw_take_if(s, ',');
    const struct ast *n = parse_run(s, TOK_START_LIST, &ok);
    int count = 0;
    bound[2] = 1;
    for (; ok && n; n = n->next, count++)
        ok = count < 3 && s->host.number(s->host.user, n, &bound[count]);
    if (count < 2 || (ok && fabs(bound[2]) < TRUTH)) {
        diag_at(s->diags, ok && count >= 2 ? DIAG_FOR_STEP : DIAG_FOR, name.where, 0);
        return false;
    }
    return ok;
}

static bool for_goes_on(double v, double end, double step)
{
    return step > 0 ? v < end + TRUTH : v > end - TRUTH;
}

static void run_for(struct stream *s, struct token word)
{
    double bound[3] = {0, 0, 1};
    struct lvalue variable = {0};
    bool ok = for_head(s, &variable, bound);
    struct frame *f = stream_push_frame(s, FRAME_FOR, &word);
    f->back = s->cursors[s->cursor_count - 1].at;
    f->variable = variable;
    if (ok && s->host.advance)
        f->name = s->host.name_of(s->host.user, variable.name, variable.len);
    f->end = bound[1];
    f->step = bound[2];
    if (ok)
        ok = s->host.declare_number(s->host.user, &variable, bound[0]);
    if (!ok || !for_goes_on(bound[0], bound[1], bound[2]))
        skip_rest(s, 1);
}

static bool for_before_end(double v, const struct frame *f)
{
    return f->step > 0 ? v <= f->end + TRUTH : v >= f->end - TRUTH;
}

static bool for_step(struct stream *s, const struct frame *f)
{
    const struct lvalue to = f->variable;
    double v;
    if (f->name && s->host.advance(s->host.user, f->name, f->step, &v))
        return for_before_end(v, f);
    struct name_info info = s->host.lookup(s->host.user, to.name, to.len);
    struct ast *n = ast_new(s->nodes, info.value ? AST_VALUE : AST_UNDECLARED, to.where);
    n->text = to.name;
    n->len = (uint16_t)to.len;
    n->value = info.value;
    if (!s->host.number(s->host.user, n, &v))
        return false;
    v += f->step;
    if (!s->host.declare_number(s->host.user, &to, v))
        return false;
    return for_before_end(v, f);
}

static void run_end(struct stream *s)
{
    struct frame f = s->frames[s->frame_count - 1];
    struct cursor *c = &s->cursors[s->cursor_count - 1];
    const uint32_t after = c->at, frames = s->frame_count;
    bool again = false;
    if (f.kind == FRAME_WHILE) {
        c->at = f.back;
        again = truth(s);
    } else if (f.kind == FRAME_FOR && (again = for_step(s, &f))) {
        c->at = f.back;
    }
    if (again || !still_open(s, frames))
        return;
    if (f.kind == FRAME_WHILE && s->cursor_count - 1 == f.cursor)
        s->cursors[f.cursor].at = after;
    pop_frame(s);
}

static void run_break(struct stream *s, struct token word)
{
    struct cursor *c = &s->cursors[s->cursor_count - 1];
    uint32_t depth = 0;
    for (uint32_t i = s->frame_count; i-- > c->frames;) {
        depth++;
        if (s->frames[i].kind == FRAME_IF)
            continue;
        s->frame_count = i + 1;
        skip_rest(s, depth);
        return;
    }
    if (c->macro) {
        s->frame_count = c->frames;
        c->at = c->count;
        return;
    }
    diag_at(s->diags, DIAG_STRAY_DIRECTIVE, word.where, "break");
}

// #else and so on met while a branch runs: the branch ends here, or for the cases of
// a #switch falls through.
static void run_middle(struct stream *s, struct token word)
{
    uint32_t first = s->cursors[s->cursor_count - 1].frames;
    const struct frame *f = s->frame_count ? &s->frames[s->frame_count - 1] : NULL;
    bool of_switch = word.word == WORD_case || word.word == WORD_range;
    bool here = f && (s->frame_count > first || (f->kind == FRAME_IF && !of_switch));
    if (here && word.word == WORD_end) {
        if (f->kind >= FRAME_WHILE && f->cursor != s->cursor_count - 1)
            here = false;
        else
            run_end(s);
    } else if (here && f->kind == FRAME_SWITCH && word.word != WORD_elseif) {
        if (of_switch)
            case_matches(s, (enum word)word.word, f->value); // only to read past it
    } else if (here && f->kind == FRAME_IF && !of_switch) {
        skip_rest(s, 1);
    } else {
        here = false;
    }
    if (!here)
        diag_at(s->diags, DIAG_STRAY_DIRECTIVE, word.where,
                word_text((enum word)word.word));
}

static bool starts_directive(enum word w)
{
    static const enum word other[] = {
        WORD_else,   WORD_elseif,  WORD_end,   WORD_case,    WORD_range,
        WORD_break,  WORD_declare, WORD_local, WORD_include, WORD_version,
        WORD_debug,  WORD_warning, WORD_error, WORD_render,  WORD_statistics,
        WORD_fopen,  WORD_fclose,  WORD_read,  WORD_write,   WORD_undef,
        WORD_default};
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        if (w == other[i])
            return true;
    return opens(w);
}

// Returns the directive that is meant, WORD_NONE when none is near.
static enum word unknown(struct stream *s, struct token word)
{
    static const char *const names[] = {
        "break",      "case",    "debug",  "declare", "default", "else",  "elseif",
        "end",        "error",   "fclose", "fopen",   "for",     "if",    "ifdef",
        "ifndef",     "include", "local",  "macro",   "range",   "read",  "render",
        "statistics", "switch",  "undef",  "version", "warning", "while", "write"};
    const char *near = NULL;
    static const char *const foreign[][2] = {
        // not slips for what is closest to them
        {"fi", "end"},      {"endif", "end"},      {"elif", "elseif"},
        {"set", "declare"}, {"define", "declare"}, {"import", "include"}};
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++)
        if (word.len == strlen(foreign[i][0]) &&
            memcmp(word.text, foreign[i][0], word.len) == 0)
            near = foreign[i][1];
    if (!near && word.len)
        near = diag_closest(word.text, word.len, names, sizeof names / sizeof *names);
    const char *hint = near ? arena_printf(s->nodes, "did you mean '#%s'?", near) : NULL;
    diag_hint(s->diags, DIAG_UNKNOWN_DIRECTIVE, word.where, hint, (int)word.len,
              word.text);
    return near ? word_find(near, strlen(near)) : WORD_NONE;
}

static void dispatch(struct stream *s, struct token word)
{
    switch (word.word) {
    case WORD_if:
    case WORD_ifdef:
    case WORD_ifndef: run_if(s, word); break;
    case WORD_else:
    case WORD_elseif:
    case WORD_end:
    case WORD_case:
    case WORD_range: run_middle(s, word); break;
    case WORD_switch: run_switch(s, word); break;
    case WORD_while: run_while(s, word); break;
    case WORD_for: run_for(s, word); break;
    case WORD_break: run_break(s, word); break;
    case WORD_macro: macro_define(s, word); break;
    case WORD_declare:
    case WORD_local: directive_declare(s, word); break;
    case WORD_include: directive_include(s, word); break;
    case WORD_version: directive_version(s, word); break;
    case WORD_default: directive_default(s, word); break;
    case WORD_undef:
    case WORD_debug:
    case WORD_warning:
    case WORD_error:
    case WORD_render:
    case WORD_statistics:
    case WORD_fopen:
    case WORD_fclose:
    case WORD_read:
    case WORD_write: directive_output(s, word); break;
    default:
        word.word = unknown(s, word);
        if (word.word != WORD_NONE) // else the rest of it would give more errors
            dispatch(s, word);
    }
}

// `declare NAME = number;` is most of what loops do: it is taken without its tokens being
// made.
static bool directive_assign(struct stream *s)
{
    struct calc_result r;
    enum word w = raw_word(s);
    if ((w != WORD_declare && w != WORD_local) || s->pending_set)
        return false;
    struct cursor *c = &s->cursors[s->cursor_count - 1];
    if (c->at >= c->count)
        return false;
    c->at++;
    struct token name;
    switch (stream_calculate(s, CALC_ASSIGNMENT, w == WORD_local, &r)) {
    case CALC_NONE: c->at--; return false;
    case CALC_DONE: return true;
    case CALC_FAILED: break;
    }
    cursor_token(c, c->at - r.used, &name);
    stream_set_reported(s, name.text, name.len);
    return true;
}

void directive_run(struct stream *s, struct token hash)
{
    const int next = raw_kind(s);
    const enum word w = raw_word(s);
    // Before other words and marks POV-Ray passes over it, too.
    if ((w != WORD_NONE && !starts_directive(w)) || (next < 256 && next != 0)) {
        diag_at(s->diags, DIAG_LONE_HASH, hash.where, 0);
        return;
    }
    if (directive_assign(s))
        return;
    struct token word = raw_take(s);
    word.where = span_join(hash.where, word.where);
    dispatch(s, word);
}
