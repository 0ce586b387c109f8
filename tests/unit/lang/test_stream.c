#include "test.h"

#include <stdbool.h>
#include <stdlib.h>

#include "base/arena.h"
#include "lang/bulk.h"
#include "lang/parse.h"
#include "lang/stream.h"

// A host with numbers only: enough to drive every directive.
struct value {
    double number;
    bool is_object;
};

struct symbol {
    char name[32];
    struct value *value;
    void *macro;
    int scope;
};

struct fake {
    struct arena *arena;
    struct symbol symbol[4096];
    int count, scope;
    char log[4096]; // what #debug said
    struct diag_sink diags;
    int codes[64];
    int finished;
};

static void emit(void *user, const struct diag *d)
{
    struct fake *f = user;
    f->codes[f->diags.errors + f->diags.warnings < 64
                 ? f->diags.errors + f->diags.warnings
                 : 63] = (int)d->code;
}

static struct symbol *find(struct fake *f, const char *name, size_t len)
{
    for (int i = f->count; i-- > 0;)
        if (strlen(f->symbol[i].name) == len && !memcmp(f->symbol[i].name, name, len))
            return &f->symbol[i];
    return NULL;
}

static struct name_info lookup(void *user, const char *name, size_t len)
{
    struct symbol *s = find(user, name, len);
    if (!s || (!s->value && !s->macro))
        return (struct name_info){.class = NAME_UNDECLARED};
    if (s->macro)
        return (struct name_info){.class = NAME_MACRO, .macro = s->macro};
    return (struct name_info){.class = s->value->is_object ? NAME_OBJECT : NAME_VALUE,
                              .value = s->value};
}

static bool number(void *user, const struct ast *n, double *out)
{
    double a = 0, b = 0;
    switch (n->kind) {
    case AST_NUMBER: *out = n->number; return true;
    case AST_VALUE: *out = n->value->number; return true;
    case AST_BINARY:
        if (!number(user, n->left, &a) || !number(user, n->right, &b))
            return false;
        *out = n->op == '+'   ? a + b
               : n->op == '-' ? a - b
               : n->op == '*' ? a * b
               : n->op == '<' ? a < b
               : n->op == '=' ? a == b
                              : 0;
        return true;
    case AST_UNARY:
        if (!number(user, n->left, &a))
            return false;
        *out = -a;
        return true;
    default: return false;
    }
}

static bool string(void *user, const struct ast *n, const char **out)
{
    struct fake *f = user;
    if (n->kind != AST_STRING)
        return false;
    *out = arena_strndup(f->arena, n->text, n->len);
    return true;
}

static bool is_declared(void *user, const struct lvalue *n)
{
    struct symbol *s = find(user, n->name, n->len);
    return s && (s->value || s->macro);
}

static struct symbol *make(struct fake *f, const struct lvalue *to)
{
    struct symbol *s = find(f, to->name, to->len);
    if (s && (!to->local || s->scope == f->scope))
        return s;
    s = &f->symbol[f->count++];
    *s = (struct symbol){.scope = f->scope};
    memcpy(s->name, to->name, to->len);
    return s;
}

static bool declare_begin(void *user, struct lvalue *to)
{
    if (to->local)
        make(user, to);
    return true;
}

static bool declare_number(void *user, const struct lvalue *to, double v)
{
    struct fake *f = user;
    struct value *value = arena_new_struct(f->arena, struct value);
    value->number = v;
    make(f, to)->value = value;
    return true;
}

static bool declare(void *user, const struct lvalue *to, const struct ast *items)
{
    double v = -1;
    if (items->kind == AST_VALUE && ((const struct value *)items->value)->is_object) {
        declare_number(user, to, 0);
        make(user, to)->value->is_object = true;
        return true;
    }
    return (items->kind == AST_BLOCK || number(user, items, &v)) &&
           declare_number(user, to, v);
}

static bool define_macro(void *user, const char *name, size_t len, struct span where,
                         void *macro)
{
    make(user, &(struct lvalue){.name = name, .len = len, .where = where})->macro = macro;
    return true;
}

static bool enter_scope(void *user, struct span where)
{
    (void)where;
    ((struct fake *)user)->scope++;
    return true;
}

static void leave_scope(void *user)
{
    struct fake *f = user;
    int keep = 0;
    for (int i = 0; i < f->count; i++)
        if (f->symbol[i].scope < f->scope || f->symbol[i].macro)
            f->symbol[keep++] = f->symbol[i];
    f->count = keep;
    f->scope--;
}

static bool bind_argument(void *user, const char *name, size_t len,
                          const struct macro_argument *a)
{
    double v;
    if (a->by_reference)
        v = find(user, a->reference.name, a->reference.len)->value->number;
    else if (!number(user, a->rvalue, &v))
        return false;
    return declare_number(user, &(struct lvalue){.name = name, .len = len, .local = true},
                          v);
}

static struct ast *finish(void *user, struct ast *n)
{
    struct fake *f = user;
    f->finished++;
    if (n->kind == AST_BLOCK) {
        struct value *v = arena_new_struct(f->arena, struct value);
        v->is_object = true;
        n->kind = AST_VALUE;
        n->value = v;
    }
    return n;
}

static bool message(void *user, enum word w, struct span where, const char *text)
{
    struct fake *f = user;
    (void)w;
    (void)where;
    strncat(f->log, text, sizeof f->log - strlen(f->log) - 1);
    return true;
}

static bool version(void *user, struct span where, double v)
{
    (void)user;
    (void)where;
    (void)v;
    return true;
}

static bool defaults(void *user, const struct ast *items)
{
    (void)user;
    (void)items;
    return true;
}

static bool undef(void *user, const struct lvalue *n)
{
    struct symbol *s = find(user, n->name, n->len);
    if (s)
        s->value = NULL;
    return true;
}

// Runs a text; returns the number of statements.
static int run(struct fake *f, const char *text)
{
    memset(f, 0, sizeof *f);
    f->arena = arena_new(1 << 16);
    f->diags = (struct diag_sink){.emit = emit, .user = f};
    struct source_map sources;
    source_map_init(&sources, f->arena);
    uint32_t file = source_add(&sources, "t.pov", text, strlen(text), (struct span){0});
    struct stream_host host = {.user = f,
                               .lookup = lookup,
                               .number = number,
                               .string = string,
                               .path = string,
                               .is_declared = is_declared,
                               .declare_begin = declare_begin,
                               .declare = declare,
                               .declare_number = declare_number,
                               .undef = undef,
                               .define_macro = define_macro,
                               .enter_scope = enter_scope,
                               .leave_scope = leave_scope,
                               .bind_argument = bind_argument,
                               .finish = finish,
                               .message = message,
                               .version = version,
                               .defaults = defaults};
    struct stream *s = stream_new(f->arena, &sources, file, &f->diags, host);
    int count = 0;
    while (parse_item(s))
        count++;
    stream_free(s);
    arena_free(f->arena);
    return count;
}

static void check(const char *text, int statements, const char *log)
{
    struct fake *f = malloc(sizeof *f);
    int count = run(f, text);
    if (f->diags.errors || count != statements || strcmp(f->log, log))
        fail_msg("%s: %u errors, %d statements, log '%s'", text, f->diags.errors, count,
                 f->log);
    free(f);
}

static void check_error(const char *text, int code)
{
    struct fake *f = malloc(sizeof *f);
    run(f, text);
    bool found = f->diags.errors == 1 && (f->codes[0] == code || f->codes[1] == code);
    if (!found)
        fail_msg("%s: %u errors, first %d", text, f->diags.errors,
                 f->codes[0] ? f->codes[0] : f->codes[1]);
    free(f);
}

static void branches(void **state)
{
    (void)state;
    check("#if(1) #debug \"a\" #else #debug \"b\" #end", 0, "a");
    check("#if(0) #debug \"a\" #elseif(2<3) #debug \"b\" #else #debug \"c\" #end", 0,
          "b");
    check("#ifdef(X) #debug \"a\" #end #declare X=1; #ifdef(X) #debug \"b\" #end", 0,
          "b");
    check(
        "#switch(2) #case(1) #debug \"1\" #case(2) #debug \"2\" #range(8,9) #debug \"3\" "
        "#break #else #debug \"4\" #end",
        0, "23");
}

static void loops(void **state)
{
    (void)state;
    check("#declare N=0; #while(N<3) #debug \"w\" #declare N=N+1; #end", 0, "www");
    check("#for(I,0,1,0.5) #debug \"f\" #end", 0, "fff");
    check("#for(I,1,9) #if(I=3) #break #end #debug \"f\" #end", 0, "ff");
    check("#for(I,1,3) sphere { <I,0,0>, 1 } #end", 3, "");
}

static void macros(void **state)
{
    (void)state;
    check("#macro M(A,B) #if(A=3) #debug \"y\" #end #local A=9; #end M(1+2,0)", 0, "y");
    check("#macro F(N) #if(N<1) #debug \"z\" #else F(N-1) #end #end F(1000)", 0, "z");
    check("#macro F(N) #if(N=0) 1 #else #local R = (F(N-1)); R #end #end "
          "#declare A = (F(60)); #if(A=1) #debug \"k\" #end",
          0, "k");
    check("#macro O() } #end union { sphere { 0, 1 O() O()", 1, "");
}

static void statements(void **state)
{
    (void)state;
    check("#declare T = texture { } texture { } #declare S = sphere { 0, 1 } S "
          "object { S rotate <1,2,3>*2 translate -y }",
          2, "");
    check("difference { #if(1) union { #end box{<0,0,0><1,1,1>} #if(1) } #end }", 1, "");
    check("#declare F = function (a, b) { a*b < 3 & sin(a)=1 } "
          "polynomial { 2, xyz(2,0,0):1, xyz(0,0,0):-1 }",
          1, "");
    check("isosurface { function { x*x + select(y<1, 2, 3) - z } }", 1, "");
}

static void errors(void **state)
{
    (void)state;
    check_error("spere { 0, 1 } sphere { 0, 1 }", DIAG_UNKNOWN_WORD);
    check_error("#declare A = 5 #declare B = 6;", DIAG_SEMICOLON);
    check_error("#if(1) sphere { 0, 1 }", DIAG_MISSING_END);
    check_error("sphere { 0, 1", DIAG_UNCLOSED);
    check_error("#end", DIAG_STRAY_DIRECTIVE);
    check_error("#macro M(A) #end M(1,2)", DIAG_ARGUMENT_COUNT);
    check_error("sphere { 0; 1 } box { 0, 1 }", DIAG_UNEXPECTED);
    check_error("/* /* */ sphere", DIAG_OPEN_COMMENT);
    char *deep = malloc(8001);
    memset(deep, '(', 8000);
    deep[8000] = 0;
    memcpy(deep, "#declare A = ", 13);
    check_error(deep, DIAG_TOO_DEEP);
    free(deep);
}

// Which contents of a block are taken whole, and to which byte.
static void bulk(void **state)
{
    (void)state;
    static const struct {
        enum word block;
        const char *text;
        bool taken;
    } cases[] = {
        {WORD_vertex_vectors, " 2, <1, -2.5, 3e2>,\n<.5,4.,-1E-3> }", true},
        {WORD_vertex_vectors, "1 <1,2,3>}", true},
        {WORD_uv_vectors, "1, <0.5, 1>, }", true},
        {WORD_face_indices, "2 <0, 1, 2> <2, 1, 0>\t}", true},
        {WORD_uv_vectors, "1, <0, 1, 2>}", false},
        {WORD_face_indices, "1, <0, 1, 2>, 5}", false},
        {WORD_face_indices, "1, <0, 1., 2>}", false},
        {WORD_face_indices, "1, <0, 1, 4294967296>}", false},
        {WORD_vertex_vectors, "2, <1, 2, 3>}", false},
        {WORD_vertex_vectors, "1, <1, 2, 3>, <1, 2, 3>}", false},
        {WORD_vertex_vectors, "1, <1, 2, 3>", false},
        {WORD_vertex_vectors, "1, <1, 2, 3", false},
        {WORD_vertex_vectors, "1, <1, 2, 3e>}", false},
        {WORD_vertex_vectors, "1, <1, 2, 3..>}", false},
        {WORD_vertex_vectors, "1, <1, 2, .>}", false},
        {WORD_vertex_vectors, "1, <1, 2, 3+1>}", false},
        {WORD_vertex_vectors, "1, <1 2 3>}", false},
        {WORD_vertex_vectors, "1, <1, 2, A>}", false},
        {WORD_vertex_vectors, "1,, <1, 2, 3>}", false},
        {WORD_vertex_vectors, "1, // one\n<1, 2, 3>}", false},
        {WORD_vertex_vectors, "999999999, <1, 2, 3>}", false},
        {WORD_vertex_vectors, "0 }", false},
        {WORD_sphere, "1, <1, 2, 3>}", false},
    };
    struct arena *a = arena_new(1 << 10);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *text = cases[i].text, *brace = strchr(text, '}');
        struct bulk b;
        const size_t n = bulk_scan(a, cases[i].block, text, strlen(text), &b);
        assert_int_equal(n, cases[i].taken ? (size_t)(brace - text) : 0);
    }
    struct bulk b;
    const char *text = cases[0].text;
    static const double want[] = {1, -2.5, 300, 0.5, 4, -0.001};
    assert_true(bulk_scan(a, WORD_vertex_vectors, text, strlen(text), &b) > 0);
    assert_int_equal(b.count, 2);
    assert_null(b.index);
    assert_memory_equal(b.number, want, sizeof want);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(branches),   cmocka_unit_test(loops),  cmocka_unit_test(macros),
        cmocka_unit_test(statements), cmocka_unit_test(errors), cmocka_unit_test(bulk)};
    return cmocka_run_group_tests_name("stream", tests, NULL, NULL);
}
