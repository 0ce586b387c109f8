// The tokens that the grammar is given: where a right side ends, which expressions are taken
// whole, what stands for a name that nobody declared.
#include "lang/parse_state.h"
#include "lang/stream_state.h"
#include "parser.h"

static const double SUM_VERSION = 1.5; // of the language, the first with sums

// Whether a directive may stand in the middle of a right side after a complete
// operand: only branches; anything else ends it (language 3.1).
static bool directive_continues(struct stream *s)
{
    switch (raw_peek_second(s).word) {
    case WORD_if:
    case WORD_ifdef:
    case WORD_ifndef:
    case WORD_switch: return true;
    case WORD_else:
    case WORD_elseif:
    case WORD_case:
    case WORD_range:
    case WORD_end:
        return s->frame_count && s->frames[s->frame_count - 1].kind <= FRAME_SWITCH;
    default: return false;
    }
}

// Whether a right side goes on with this token after a complete operand.
static bool continues(const struct parse *p, int kind)
{
    return kind == '+' || kind == '-' || kind == '*' || kind == '/' || kind == '.' ||
           kind == '?' || kind == ':' || kind == TOK_PART ||
           kind == '{' || // `function (a, b) {`
           (kind == ';' && p->start == TOK_START_RVALUE);
}

void parse_note_brackets(struct parse *p, const struct token *t)
{
    const int kind = t->kind;
    if (kind == '(' && p->parens == 0)
        p->paren = t->where;
    if (kind == '(' || kind == '[' || kind == '{')
        p->nest++;
    else if (kind == ')' || kind == ']' || kind == TOK_MORE || kind == '}')
        p->nest--;
    else if (p->nest == 0 && kind == '<')
        p->vectors++;
    else if (p->nest == 0 && kind == '>')
        p->vectors--;
    p->parens += (kind == '(') - (kind == ')');
    p->braces += (kind == '{') - (kind == '}');
}

static bool completes(const struct parse *p, int kind)
{
    return kind == TOK_NUMBER || kind == TOK_STRING || kind == TOK_NAME ||
           kind == TOK_STRING_NAME || kind == TOK_OTHER_NAME || kind == TOK_CONSTANT ||
           kind == TOK_VECTOR3 || kind == ')' || kind == ']' || kind == '>' ||
           kind == '}' || kind == TOK_LITERAL || p->after_period;
}

// Whether an expression can begin with the next token, and belong to none before it.
static bool expression_begins(const struct parse *p)
{
    int last = p->now->kind, next = raw_kind(p->in);
    if (last == '+' || last == '-' || last == '*' || last == '/' || last == '!' ||
        last == '.' || (last == 0 && p->start == TOK_START_STATEMENT))
        return false;
    switch (next) {
    case TOK_NUMBER:
    case TOK_NAME:
    case TOK_CONSTANT:
    case TOK_WORD: return true;
    case TOK_VECTOR3:
    case '<':
    case '-':
    case '+':
    case '!': return !p->operand;
    case '(':
        return last == 0 || last == ',' || last == TOK_WORD || last == TOK_RGB ||
               last == TOK_COLOR || last == TOK_PART;
    default: return false;
    }
}

// Whether a number or vector comes that is all of its expression.
static bool is_literal(const struct stream *s)
{
    const struct cursor *c = &s->cursors[s->cursor_count - 1];
    if (c->at + 1 >= c->count ||
        (c->tokens[c->at].kind != TOK_NUMBER && c->tokens[c->at].kind != TOK_VECTOR3))
        return false;
    switch (c->tokens[c->at + 1].kind) {
    case ',':
    case '}':
    case '>':
    case ')':
    case ']':
    case ';':
    case TOK_WORD:
    case TOK_NAMED:
    case TOK_LITERAL: return true;
    default: return false;
    }
}

// Takes a whole expression as if it were one number or vector.
static bool take_calculated(struct parse *p, struct token *t)
{
    struct calc_result r;
    struct stream *s = p->in;
    if (!s->host.calculate || s->pending_set || !expression_begins(p) || is_literal(s))
        return false;
    struct token first = raw_peek(s);
    enum calc_outcome outcome = stream_calculate(s, CALC_ITEM, false, &r);
    if (outcome == CALC_NONE)
        return false;
    *t = first;
    t->kind = TOK_NAME;
    t->word = WORD_NONE;
    t->len = 0; // its text is no name
    t->value = NULL;
    if (outcome == CALC_DONE && r.width == 1) {
        t->kind = TOK_NUMBER;
        t->number = r.number;
    } else if (outcome == CALC_DONE) {
        t->value = r.value;
    }
    return true;
}

// Where the next token comes from, at a place where the right side may end.
static void take_next(struct parse *p, struct token *t)
{
    struct stream *s = p->in;
    bool end_possible = p->bounded && p->operand && p->nest == 0 && p->vectors == 0;
    if (end_possible && raw_kind(s) == '#' && !directive_continues(s)) {
        *t = raw_peek(s);
        t->kind = TOK_STOP;
    } else if (end_possible) {
        stream_take(s, t);
        if (!continues(p, t->kind)) {
            stream_give_back(s, *t);
            t->kind = TOK_STOP;
        }
    } else if (p->function || !take_calculated(p, t)) {
        stream_take(s, t);
    }
}

void parse_skip_group(struct stream *s)
{
    int depth = 0;
    do {
        struct token t = stream_next(s);
        if (t.kind == TOK_END)
            return;
        depth += t.kind == '{' || t.kind == '(' || t.kind == '[';
        depth -= t.kind == '}' || t.kind == ')' || t.kind == ']' || t.kind == TOK_MORE;
    } while (depth > 0);
}

// A name nobody declared, with what was to be its subscripts or arguments: one error, not one
// more for each bracket. Nor is one said of a name whose declaration had an error.
static void take_undeclared(struct parse *p, struct token *t)
{
    struct stream *s = p->in;
    int open = raw_kind(s);
    bool group = open == '(' || open == '[';
    bool reported = stream_was_reported(s, t->text, t->len);
    if (!group && !reported)
        return;
    if (!reported)
        parse_undeclared(s, t, open == '(');
    while (!s->stopped && (raw_kind(s) == '[' || raw_kind(s) == '('))
        parse_skip_group(s);
    t->len = 0; // reported
}

// Before version 1.5 there were no sums: `<1 -2 3>` has three components.
static int sign(const struct parse *p, int kind)
{
    if (p->in->version >= SUM_VERSION || !p->operand || p->parens > 0)
        return kind;
    return kind == '-' ? TOK_MINUS : kind == '+' ? TOK_PLUS : kind;
}

int parse_token(struct parse *p, struct span *where)
{
    if (p->now->kind < 0) { // the first: what to read
        p->now->kind = 0;
        *where = raw_peek(p->in).where;
        where->end = where->begin;
        return p->start;
    }
    struct token *t = &p->slot[p->now == &p->slot[0]];
    take_next(p, t);
    if (t->kind == TOK_NAME && !t->value && t->len && !p->function)
        take_undeclared(p, t);
    t->kind = sign(p, t->kind);
    if (t->kind != TOK_STOP) {
        parse_note_brackets(p, t);
        p->operand = completes(p, t->kind);
        p->after_period = t->kind == '.';
    }
    if (p->nest > PARSE_NEST_MAX) {
        diag_at(p->in->diags, DIAG_TOO_DEEP, t->where, "brackets", (int)PARSE_NEST_MAX);
        p->failed = true;
        p->in->stopped = true;
        t->kind = TOK_END;
    }
    if (p->function && t->kind == '<')
        t->kind = TOK_LESS;
    else if (p->function && t->kind == '>')
        t->kind = TOK_GREATER;
    p->last = p->now;
    p->now = t;
    where->file = t->where.file;
    where->begin = t->where.begin;
    where->end = t->where.end;
    where->expansion = t->where.expansion;
    return t->kind;
}
