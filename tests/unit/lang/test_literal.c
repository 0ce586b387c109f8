#include "test.h"

#include <stdbool.h>
#include <stdlib.h>

#include "base/arena.h"
#include "lang/literal.h"
#include "lang/parse.h"
#include "lang/scan.h"
#include "lang/stream.h"

// Blocks that are taken whole (lang/literal.h) against the same text through the grammar: the
// same nodes at the same places, and of mistakes the same messages.

enum { STATEMENTS_MAX = 64, MESSAGES_MAX = 64 };

struct outcome {
    struct arena *arena;
    struct diag_sink diags;
    struct ast *statement[STATEMENTS_MAX];
    int statements, messages;
    struct {
        int code;
        struct span where;
        char text[80];
    } message[MESSAGES_MAX];
    uint64_t steps;
};

static void emit(void *user, const struct diag *d)
{
    struct outcome *o = user;
    if (o->messages == MESSAGES_MAX)
        return;
    o->message[o->messages].code = (int)d->code;
    o->message[o->messages].where = d->where;
    snprintf(o->message[o->messages++].text, sizeof o->message[0].text, "%s", d->message);
}

static struct name_info lookup(void *user, const char *name, size_t len)
{
    static const char *const blocks[] = {"T", "S2", "Block_3"};
    (void)user;
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++)
        if (strlen(blocks[i]) == len && memcmp(blocks[i], name, len) == 0)
            return (struct name_info){.class = i == 1 ? NAME_OBJECT : NAME_BLOCK,
                                      .value = (const void *)blocks[i]};
    if (len == 1 && *name == 'V')
        return (struct name_info){.class = NAME_VALUE, .value = (const void *)blocks};
    return (struct name_info){.class = NAME_UNDECLARED};
}

static bool number(void *user, const struct ast *n, double *out)
{
    (void)user;
    (void)n;
    *out = 1;
    return true;
}

static struct ast *finish(void *user, struct ast *n)
{
    (void)user;
    return n;
}

static bool may_go_on(void *user, struct span where, uint64_t steps)
{
    struct outcome *o = user;
    (void)where;
    o->steps = steps;
    return true;
}

static enum calc_outcome calculate(void *user, const struct calc_place *at,
                                   struct calc_result *out)
{
    (void)user;
    (void)at;
    (void)out;
    return CALC_NONE;
}

// whole: blocks may be taken whole (the stream makes that, like vectors, depend on a host that
// calculates).
static struct outcome *run(const char *text, bool whole)
{
    struct outcome *o = calloc(1, sizeof *o);
    o->arena = arena_new(1 << 12);
    o->diags = (struct diag_sink){.emit = emit, .user = o, .errors_max = 20};
    struct source_map sources;
    source_map_init(&sources, o->arena);
    uint32_t file = source_add(&sources, "t.pov", text, strlen(text), (struct span){0});
    struct stream_host host = {.user = o,
                               .lookup = lookup,
                               .number = number,
                               .finish = finish,
                               .may_go_on = may_go_on,
                               .calculate = whole ? calculate : NULL};
    struct stream *s = stream_new(o->arena, &sources, file, &o->diags, host);
    for (struct ast *n; (n = parse_item(s)) && o->statements < STATEMENTS_MAX;)
        o->statement[o->statements++] = ast_copy(o->arena, n);
    stream_free(s);
    return o;
}

static void outcome_free(struct outcome *o)
{
    arena_free(o->arena);
    free(o);
}

static bool same_span(struct span a, struct span b)
{
    return a.file == b.file && a.begin == b.begin && a.end == b.end &&
           a.expansion == b.expansion;
}

static double plain(const struct ast *n)
{
    return n->kind == AST_UNARY && n->op == '-' ? -n->left->number : n->number;
}

static bool same(const struct ast *a, const struct ast *b);

static bool same_lists(const struct ast *a, const struct ast *b)
{
    for (; a && b; a = a->next, b = b->next)
        if (!same(a, b))
            return false;
    return !a && !b;
}

// a may have vectors that were taken whole.
static bool same(const struct ast *a, const struct ast *b)
{
    if (!same_span(a->where, b->where) || a->comma_after != b->comma_after ||
        a->parens != b->parens)
        return false;
    if (a->kind == AST_VECTOR3 && b->kind == AST_VECTOR) {
        const struct ast *c = b->list;
        for (int i = 0; i < 3; i++, c = c->next) {
            const double v = c ? plain(c) : 0;
            if (!c || memcmp(&a->vector[i], &v, sizeof v))
                return false;
        }
        return !c;
    }
    if (a->kind != b->kind || a->word != b->word || a->op != b->op)
        return false;
    switch (a->kind) {
    case AST_NUMBER: return memcmp(&a->number, &b->number, sizeof a->number) == 0;
    case AST_UNARY:
    case AST_MEMBER: return same(a->left, b->left);
    case AST_BINARY: return same(a->left, b->left) && same(a->right, b->right);
    case AST_STRING:
    case AST_UNDECLARED:
    case AST_VALUE: return a->len == b->len && a->value == b->value;
    default: return same_lists(a->list, b->list);
    }
}

static void print(const struct outcome *o, const char *name)
{
    fprintf(stderr, "%s:\n", name);
    for (int i = 0; i < o->statements; i++)
        ast_print(o->statement[i], stderr, 2);
    for (int i = 0; i < o->messages; i++)
        fprintf(stderr, "  %u-%u: %s\n", o->message[i].where.begin,
                o->message[i].where.end, o->message[i].text);
}

static void compare(const char *text)
{
    struct outcome *a = run(text, true), *b = run(text, false);
    bool ok = a->statements == b->statements && a->messages == b->messages;
    for (int i = 0; ok && i < a->statements; i++)
        ok = same(a->statement[i], b->statement[i]);
    for (int i = 0; ok && i < a->messages; i++)
        ok = a->message[i].code == b->message[i].code &&
             same_span(a->message[i].where, b->message[i].where) &&
             strcmp(a->message[i].text, b->message[i].text) == 0;
    if (!ok) {
        print(a, "taken whole");
        print(b, "through the grammar");
        fail_msg("%s", text);
    }
    outcome_free(a);
    outcome_free(b);
}

static const struct {
    const char *text; // after `sphere`
    uint32_t tokens;  // 0: not taken
} cases[] = {
    {" { <1, -2.5, 3e2>, .5 }", 6},
    {"{<0,0,0>1.}", 5},
    {"\n{\t<0, 0, 0>, 1\n  texture { pigment { rgb <1, 0, 0> } }\r\n}", 14},
    {"{ <0,0,0>, 1 pigment { color red 1 green .5 filter 0.25 } no_shadow }", 17},
    {"{ <0,0,0>, 1 translate <1, 2, 3> scale 2 }", 10},
    {"{ <0,0,0> <1,1,1>, 1, }", 8},
    {"{ }", 3},
    {"{ 0, 1 finish { ambient 0.1 diffuse 0.8 phong 1 } hollow }", 16},
    {" ", 0},
    {" 1 }", 0},
    {"{ <0,0,0>, 1", 0},
    {"{ <0,0,0>, R }", 0},
    {"{ <0,0,0>, 1*2 }", 0},
    {"{ <0,0,0>, -1 }", 0},
    {"{ <0,0,0>*2, 1 }", 0},
    {"{ <0,0,0>.x, 1 }", 0},
    {"{ <0,0>, 1 }", 10},
    {"{ 1 uv_vectors < 0 ,1.5>,<-1, 0><.5,-1e-2> }", 23},
    {"{ <0,--1>, 1 }", 0},
    {"{ <0,0>= 1 }", 0},
    {"{ <0 1>, 1 }", 0},
    {"{ <0,0,0>, 1 texture { T } }", 10},
    {"{ <0,0,0>, 1 texture { T scale 2 } texture { Block_3 finish { phong 1 } } }", 21},
    {"{ <0,0,0>, 1 texture_list { T T, T } pigment { Undeclared rgb 1e0 } }", 19},
    {"{ <0,0,0>, 1 texture { V translate <1, 2, 3> uv_vectors <-1, .5> } }", 19},
    {"{ <0,0,0>, 1 texture_list { T T T T T } }", 0},
    {"{ <0,0,0>, 1 texture { , T } }", 0},
    {"{ <0,0,0>, 1 texture { T T } }", 0},
    {"{ <0,0,0>, 1 texture { T.x } }", 0},
    {"{ <0,0,0>, 1 texture { T(1) } }", 0},
    {"{ <0,0,0>, 1 texture { T + 1 } }", 0},
    {"{ <0,0,0>, 1 texture { rgb T } }", 0},
    {"{ <0,0,0>, 1 scale { T } }", 0},
    {"{ <0,0,0,0>, 1 }", 0},
    {"{ x, 1 }", 0},
    {"{ <0,0,0>,, 1 }", 0},
    {"{ , <0,0,0>, 1 }", 0},
    {"{ <0,0,0>, 1 // one\n }", 0},
    {"{ <0,0,0>, 1 #if (1) #end }", 0},
    {"{ <0,0,0>, 1.5.5 }", 0},
    {"{ <0,0,0>, 1e }", 0},
    {"{ 1 <0,0,0> }", 0},
    {"{ filter <0,0,0> }", 0},
    {"{ <0,0,0>, 1 pigment { image_map { png \"a.png\" } } }", 0},
    {"{ <0,0,0>, 1 pigment { function { x } } }", 0},
    {"{ <0,0,0>, 1 clipped_by { box { <0,0,0>, <1,1,1> } } }", 0},
    {"{ <0,0,0>, 1 declare { } }", 0},
    {"{ <0,0,0>, 1 vertex_vectors { 1 } }", 0},
    {"{ <0,0,0>, sin(1) }", 0},
    {"{ <0,0,0>, 1 ; }", 0},
    {"{ <0,0,0>, 1 rgbx 1 }", 0},
    {"{ a { b { c { d { e { f { g { 1 } } } } } } } }", 0},
    {"{ open { open { open { open { open { open { 1 } } } } } } }", 22},
    {"{ open { open { open { open { open { open { open { 1 } } } } } } } }", 0},
};

static void taken(void **state)
{
    (void)state;
    struct word_table words;
    word_table_init(&words);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *text = cases[i].text;
        struct named_literal l = {.len = 0};
        const size_t n = literal_scan(&words, WORD_sphere, text, strlen(text), &l);
        if (n != (cases[i].tokens ? strlen(text) : 0) ||
            (n && l.tokens != cases[i].tokens))
            fail_msg("%s: %zu bytes, %u tokens", text, n, l.tokens);
    }
    struct named_literal tokens;
    assert_int_equal(literal_scan(&words, WORD_default, "{ }", 3, &tokens), 0);
    assert_int_equal(literal_scan(&words, WORD_function, "{ 1 }", 5, &tokens), 0);
    assert_int_equal(literal_scan(&words, WORD_uv_vectors, "{ 1 }", 5, &tokens), 0);
    assert_true(
        literal_scan(&words, WORD_global_settings, "{ assumed_gamma 1 }", 19, &tokens));
}

static void same_as_grammar(void **state)
{
    (void)state;
    char text[400];
    static const char *const around[][2] = {
        {"sphere", ""},
        {"union { sphere", "}"},
        {"blob { sphere", " }"},
        {"object { S2 translate <1, 2, 3> texture { T } } mesh { object", " }"},
        {"texture", " object { S2 } object { V } object { T }"},
        {"box { <0,0,0>, <1,1,1> } sphere", " box { <0,0,0>, <1,1,1> }"},
        {"pigment { object { sphere", " rgb 1 } }"},
        {"union { 1 2 sphere", "} }"},
        {"sin(sphere", ")"},
        {"union { sphere", "sphere { 0, } } sphere { x, 1 }"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (size_t k = 0; k < sizeof around / sizeof *around; k++) {
            snprintf(text, sizeof text, "%s%s%s", around[k][0], cases[i].text,
                     around[k][1]);
            compare(text);
        }
}

static uint32_t next(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*state >> 33);
}

// Texts with a few bytes changed, mistakes most of them.
static void mutants_as_grammar(void **state)
{
    (void)state;
    static const char base[] =
        "sphere { <1, -2, 3>, 0.5 texture { pigment { rgb <1, 0, "
        "0> filter 0.5 } finish { phong 1 "
        "} } translate <1, 2, 3> no_shadow } box { <0, 0, 0>, <1, "
        "1, 1> pigment { color red 1 } }\n"
        "object { S2 texture { T scale 2 } translate <1, 2, 3> } box { "
        "<1, 1, 1>, <2, 2, 2> texture { V } uv_vectors <0, -1> }\n"
        "union { cone { <0, 0, 0>, 1, <1, 1, 1>, 0 open } }\n";
    static const char bytes[] = "{}<>,;.-+*()[]=e019 \n\t#\"/xrRS_&?:";
    static const char *const tokens[] = {
        "sphere ",   "texture ",       "pigment {", " rgb ", "x",       "1",     " open ",
        "<0, 1, 2>", " box { 0, 1 } ", " 1 ",       "T ",    " { S2 }", "<1, 2>"};
    uint64_t random = 1;
    for (int n = 0; n < 20000; n++) {
        char text[sizeof base + 200];
        memcpy(text, base, sizeof base);
        for (uint32_t times = 1 + next(&random) % 3; times; times--) {
            const size_t len = strlen(text), at = next(&random) % len;
            const char *with = tokens[next(&random) % (sizeof tokens / sizeof *tokens)];
            switch (next(&random) % 4) {
            case 0: text[at] = bytes[next(&random) % (sizeof bytes - 1)]; break;
            case 1: memmove(text + at, text + at + 1, len - at); break;
            case 2:
                memmove(text + at + strlen(with), text + at, len - at + 1);
                memcpy(text + at, with, strlen(with));
                break;
            default:
                memmove(text + at + 1, text + at, len - at + 1);
                text[at] = bytes[next(&random) % (sizeof bytes - 1)];
            }
        }
        compare(text);
    }
}

// Limits on reading count what a block stands for.
static void steps(void **state)
{
    (void)state;
    const char *text =
        "sphere { <1, 2, 3>, 4 } sphere { <1, 2, 3>, 4 pigment { rgb 1 } } open { }";
    struct outcome *a = run(text, true);
    assert_int_equal(a->statements, 3);
    assert_int_equal(a->steps, 6 + 11 + 3);
    outcome_free(a);
}

static size_t random_number(uint64_t *random, char *out)
{
    size_t n = 0;
    const uint32_t digits = next(random) % 20, places = next(random) % 20;
    if (next(random) % 4 == 0)
        out[n++] = '-';
    for (uint32_t i = 0; i < digits; i++)
        out[n++] = (char)('0' + next(random) % 10);
    if (places || !digits || next(random) % 2)
        out[n++] = '.';
    for (uint32_t i = 0; i < places || (!digits && !i); i++)
        out[n++] = (char)('0' + next(random) % 10);
    if (next(random) % 4 == 0) {
        static const char *const signs[] = {"e", "E+", "e-"};
        n += (size_t)sprintf(out + n, "%s%u", signs[next(random) % 3],
                             next(random) % (next(random) % 8 ? 40 : 400));
    }
    out[n] = 0;
    return n;
}

// The same bits as the C library's.
static void numbers(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int i = 0; i < 500000; i++) {
        char text[120];
        const size_t len = random_number(&random, text);
        const double want = strtod(text, NULL);
        text[len] = ',';
        struct scan s = {text, text + len + 1};
        double got, unsigned_got;
        const bool minus = text[0] == '-';
        if (!scan_number(&s, &got) || s.at != text + len ||
            memcmp(&got, &want, sizeof got))
            fail_msg("%s %.17g %.17g", text, got, want);
        s.at = text;
        assert_true(scan_number(&s, NULL) && s.at == text + len);
        unsigned_got = number_parse(text + minus, len - minus);
        got = minus ? -unsigned_got : unsigned_got;
        if (memcmp(&got, &want, sizeof got))
            fail_msg("number_parse: %s %.17g %.17g", text, got, want);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taken), cmocka_unit_test(same_as_grammar),
        cmocka_unit_test(mutants_as_grammar), cmocka_unit_test(steps),
        cmocka_unit_test(numbers)};
    return cmocka_run_group_tests_name("literal", tests, NULL, NULL);
}
