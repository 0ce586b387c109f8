#include "test.h"

#include <stdlib.h>

#include "base/arena.h"
#include "eval/eval.h"

struct output {
    char text[4096];
    size_t len;
    unsigned errors;
};

static void collect(void *user, enum word directive, const char *text)
{
    (void)directive;
    struct output *o = user;
    o->len += (size_t)snprintf(o->text + o->len, sizeof o->text - o->len, "%s", text);
}

static void show(void *user, const struct diag *d)
{
    (void)user;
    print_message("%s\n", d->message);
}

// What #debug said; NULL after an error.
static bool run(const char *text, struct output *o)
{
    struct arena *a = arena_new(1 << 16);
    struct source_map sources;
    struct scene scene = {0};
    struct diag_sink sink = {.emit = show};
    struct eval_options options = {.message = collect, .message_user = o};
    o->len = 0;
    o->text[0] = 0;
    source_map_init(&sources, a);
    uint32_t file = source_add(&sources, "t.pov", text, strlen(text), (struct span){0});
    bool ok = eval_scene(a, &sources, file, &sink, &options, &scene);
    o->errors = sink.errors;
    arena_free(a);
    return ok;
}

// Rows: an expression of the language and its text. spec/language Appendix B.
static const char *const rows[][2] = {
    {"str(vlength(<1,2>+2),0,5)", "5.00000"},
    {"str(vlength(2+<1,2>),0,5)", "5.38516"},
    {"str(vlength(2*<1,2>),0,5)", "4.47214"},
    {"vstr(3,vrotate(<1,2,3>,<10,20,30>),\" \",0,6)", "1.067425 2.289059 2.760581"},
    {"vstr(3,vturbulence(2,0.5,6,<.3,.5,.7>),\" \",0,6)", "0.091181 -0.215476 0.213181"},
    {"str(2.5,0,0)", "2"},
    {"str(1.2,-8,3)", "0001.200"},
    {"str(1.5,0,-1)", "1.500000"},
    {"vstr(3,5,\";\",0,1)", "5.0;0.0;0.0"},
    {"str(strcmp(\"a\",\"c\"),0,0)", "-2"},
    {"concat(\"a\",chr(65),substr(\"hello\",2,3),strupr(\"x\"))", "aAellX"},
    {"str(rand(seed(0)),0,17)", "0.00000287429429658"},
    {"str(rand(seed(-1)),0,17)", "0.57801287355320830"},
    {"str(rand(seed(3.9)),0,17)", "0.26597287698322275"},
    {"str((1 < 2 ? 10 : 20),0,0)", "10"},
    {"str(select(-1,1,2,3)+min(4,2,3)+max(4,2)+mod(7,4)+div(-7,2),0,0)", "7"},
    {"str(bitwise_xor(12,10)+bitwise_and(12,10)+bitwise_or(12,10),0,0)", "28"},
    {"str(-<1,2,3>.y + val(\"1.5x\") + asc(\"A\"),0,1)", "64.5"},
};

static void check_values(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct output o;
        char text[400], want[100];
        snprintf(text, sizeof text, "#debug concat(%s,\"\\n\")", rows[i][0]);
        snprintf(want, sizeof want, "%s\n", rows[i][1]);
        assert_true(run(text, &o));
        assert_string_equal(o.text, want);
    }
}

// Statements and what they print.
static const char *const scripts[][2] = {
    {"#declare C = rgb 0.1; #debug str(C.red,0,15)", "0.100000001490116"},
    {"#declare n=0; #for(i,0,1,.1) #declare n=n+1; #end #debug str(n,0,0)", "11"},
    {"#macro A(x1) x1+1 #end #debug str(A(3)*2,0,0)", "5"},
    {"#macro M(P) #declare P = 7; #end #declare Q = 1; M(Q) #debug str(Q,0,0)", "7"},
    {"#macro M(P) #declare P = 7; #end #declare Q = 1; M((Q)) #debug str(Q,0,0)", "1"},
    {"#declare A = array[2][2] {{1,2},{3,4}} #declare B = A; #declare B[1][0] = 9;"
     "#debug str(A[1][0]*10+B[1][0],0,0)",
     "39"},
    {"#declare F = function(n){sum(i,1,n,i*i)} #debug vstr(3,<F(3),F(2.5),F(0)>,\" "
     "\",0,0)",
     "14 5 0"},
    {"#declare F = function{x>1 & y<2 | z}"
     "#debug vstr(3,<F(2,1,0),F(0,1,3),F(2,3,0)>,\" \",0,0)",
     "1 1 0"},
    {"#declare F = function{2*-x + -(y) - +z} #debug str(F(1,2,3),0,0)", "-7"},
    {"#declare S = spline{natural_spline 0,0 1,1 2,0 3,5}"
     "#debug vstr(3,<S(.5).x,S(1.5).x,S(2.5).x>,\" \",0,2)",
     "0.85 0.20 1.85"},
    {"#declare F = function{internal(61)} #declare G = function{internal(57)}"
     "#declare H = function(a,b){F(a,b,0,1) + G(a,b,0)}"
     "#debug vstr(3,<F(3,4,0,1),G(3,4,0),H(3,4)>,\" \",0,2)",
     "4.00 5.00 9.00"},
    {"#declare F = function{pigment{rgb <1,.5,.25>}} #declare P = function{pigment{}}"
     "#declare G = function(a){F(a,a,a).gray + P(a,a,a).red + F(0,0,0).transmit}"
     "#debug vstr(3,<F(0,0,0).gray,F(1,1,1).y,G(1)>,\" \",0,6)",
     "0.620000 0.500000 0.620000"},
    {"#declare Q = function{pigment{checker rgb 1 rgb <.2,.3,.4> scale 2}}"
     "#debug vstr(5,Q(2.1,.2,.3),\",\",0,8)",
     "0.20000000,0.30000001,0.40000001,0.00000000,0.00000000"},
    // As POV-Ray 3.7 gives them.
    {"#declare S = function{pattern{bozo turbulence .3 scale .7 frequency 2 phase .3"
     " sine_wave}} #declare X = function{pattern{checker scale .3}}"
     "#declare L = function{pattern{leopard}}"
     "#debug concat(str(S(.1,.2,.7),0,12),str(X(.1,.2,.7),2,0),str(X(.4,.2,.1),2,0),"
     "str(L(.1,.3,.7),0,12))",
     "0.976496856000 0 10.120078723301"},
    {"#debug \"a\\nb\"", "a\nb"},
    // The right side ends before the macro that gives it does.
    {"#macro V() <1,2,3>; #end #macro M() #local A = V() #debug vstr(3,A,\",\",0,0) #end "
     "M()",
     "1,2,3"},
    {"#macro V() #local A = 5; <A,2,3>; #end #declare A = V() #debug vstr(3,A,\",\",0,0)",
     "5,2,3"},
    {"#macro T() transform{rotate x} #end #macro M() #local A = T(); #ifdef(A)"
     " #debug \"there\" #end #end M()",
     "there"},
    {"#declare A = <1,2#>; #default { normal { bumps bump_size 2 } } #debug str(A.v,0,0)",
     "2"},
    {"#ifdef(lambert) #debug \"yes\" #else #debug \"no\" #end", "yes"},
};

static void check_scripts(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scripts / sizeof *scripts; i++) {
        struct output o;
        char text[2000], want[200];
        snprintf(text, sizeof text, "%s #debug \"\\n\"", scripts[i][0]);
        snprintf(want, sizeof want, "%s\n", scripts[i][1]);
        assert_true(run(text, &o));
        assert_string_equal(o.text, want);
    }
}

static void errors_are_reported_once(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "#declare A = sqrt(-1);",
        "#declare A = 1 + ln(0)*2;",
        "#debug str(sqrt(-1),0,0)",
        "#declare F = function(a){a} #declare A = F(1,2);",
        "sphere { <0,sqrt(-1),0>, 1 }",
        "#declare A = <1,sqrt(-1),3>;",
        "#declare A = concat(chr(70000),\"x\");",
        "sphere { 0, sqrt(-1) pigment { rgb 1 } }",
        "sphere { 0, 1 translate ln(0) }",
        "#if (sqrt(-1)) #end",
        "#debug concat(\"a\",str(sqrt(-1),0,0))",
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct output o;
        assert_false(run(bad[i], &o));
        print_message("%s\n", bad[i]);
        assert_int_equal(o.errors, 1);
    }
}

static void lines_are_whole(void **state)
{
    (void)state;
    struct output o;
    assert_true(run("#debug \"a\" #debug \"b\\nc\\nd\" #debug \"e\"", &o));
    assert_string_equal(o.text, "ab\nc\n");
}

// As POV-Ray 3.7 shows them.
static void version_sets_noise(void **state)
{
    (void)state;
    struct output o;
    assert_true(run("#declare F = function{internal(76)} #macro S()"
                    " #debug concat(str(F(.3,.4,.5),0,8),\"\\n\") #end"
                    " S() #version 3.1; S() #version 3.7; S()"
                    " global_settings{noise_generator 3} S() #version 3.1; S()",
                    &o));
    assert_string_equal(o.text, "0.47587127\n0.41903170\n0.47587127\n"
                                "0.67807531\n0.67807531\n");
}

static void errors_are_reported(void **state)
{
    (void)state;
    static const char *const bad[] = {
        "#declare A = B;",
        "#declare A = array[2]; #declare A[2] = 1;",
        "#local A = A + 1;",
        "#declare A = sqrt(-1);",
        "#declare F = function{internal(79)}",
        "#declare F = function{pattern{slope y}}",
        "#declare F = function(a){pattern{bozo}}",
        "#error \"stop\" #debug \"more\"",
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct output o;
        assert_false(run(bad[i], &o));
        assert_string_equal(o.text, "");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_values),        cmocka_unit_test(check_scripts),
        cmocka_unit_test(errors_are_reported), cmocka_unit_test(errors_are_reported_once),
        cmocka_unit_test(lines_are_whole),     cmocka_unit_test(version_sets_noise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
