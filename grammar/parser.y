%require "3.6"
%expect 0
%define api.pure full
%define api.prefix {sdl_}
%define api.token.prefix {TOK_}
%define api.value.type union
%define api.location.type {struct span}
%define parse.error custom
%locations
%param {struct parse *p}

%code requires {
#include "base/source.h"
#include "lang/ast.h"

struct parse;
}

%code {
#include <string.h>

#include "lang/parse_state.h"
#include "nodes.h"

// Small, since directives inside expressions run the grammar inside itself; it
// grows on the heap.
#define YYINITDEPTH 24
#define YYMAXDEPTH 16000

#define YYLLOC_DEFAULT(Cur, Rhs, N)                                                      \
    ((Cur) = (N) == 1 ? YYRHSLOC(Rhs, 1)                                                 \
             : (N)    ? span_join(YYRHSLOC(Rhs, 1), YYRHSLOC(Rhs, N))                    \
                 : (struct span){YYRHSLOC(Rhs, 0).file, YYRHSLOC(Rhs, 0).end,            \
                                 YYRHSLOC(Rhs, 0).end, YYRHSLOC(Rhs, 0).expansion})

static int sdl_lex(SDL_STYPE *value, struct span *where, struct parse *p);
static void sdl_error(struct span *where, struct parse *p, const char *message);

#define COMMA(list, where)                                                               \
    do {                                                                                 \
        if (!comma(list)) {                                                              \
            sdl_error(&(where), p, "this comma has nothing before it");                  \
            YYABORT;                                                                     \
        }                                                                                \
    } while (0)

// A setting of old scenes, outside of global_settings { }.
#define BARE(what, where)                                                                \
    do {                                                                                 \
        if (!parse_is_bare(p, (enum word)(what), where))                                 \
            YYABORT;                                                                     \
    } while (0)
}

%token END 0 "the end of the file"
%token START_STATEMENT START_CONDITION START_LIST START_ITEMS START_SUBSCRIPT
%token START_STRING START_BRACES START_RVALUE START_ARGUMENT START_ELEMENTS
%token STRAY STOP
%token LE "<=" GE ">=" NE "!=" LESS GREATER
%token MORE                     // a ']' with '[' after it
%token PLUS MINUS               // signs that begin a value (language 1.0)
%token <size_t> WORD CONSTANT CALL1 CALL STRING_CALL XYZ COLOR RGB PART GRAY
%token <size_t> FUNCTION ARRAY
%token LITERAL                  // a whole block (lang/literal.h)
%token NAMED                    // the same with names; the stream makes a LITERAL of it
%token <struct ast *> NUMBER VECTOR3 BULK STRING NAME STRING_NAME OTHER_NAME ARRAY_NAME FUNCTION_NAME

%type <struct ast *> statement block function_block function_body params size entry
%type <struct ast *> full compare value arith unary primary vector string string_or_arith
%type <struct ast *> item arg element call subs array
%type <struct ast *> items args arg_list components names colour parts colour_start
%type <struct ast *> sub_list dims elements element_list
%type <struct ast *> logic xlogic xcompare sizes
%type <size_t> member
%type <size_t> relop xrelop

%token END_OF_TOKENS            // the last; never read
%precedence VALUE_ENDS          // a value ends only where no operator follows
%precedence PART
%precedence '('
%left '+' '-'
%left '*' '/'

%%

// The pseudo-token chooses what to read; what the last token completes is accepted
// without looking at the next one, which might run a directive too early.
start:
    START_STATEMENT statement           { p->result = $2; YYACCEPT; }
  | START_STATEMENT END                 { p->result = NULL; YYACCEPT; }
  | START_CONDITION '(' full ')'        { p->result = $3; YYACCEPT; }
  | START_LIST args ')'                 { p->result = all($2); YYACCEPT; }
  | START_ITEMS items ')'               { p->result = all($2); YYACCEPT; }
  | START_SUBSCRIPT value close         { p->result = $2; YYACCEPT; }
  | START_STRING string                 { p->result = $2; YYACCEPT; }
  | START_STRING subs                   { p->result = $2; YYACCEPT; }
  | START_BRACES '{' braces items '}'   { p->result = all($4); YYACCEPT; }
  | START_RVALUE colour ';'
    {
        p->result = all($2);
        parse_check_first(p, p->result);
        YYACCEPT;
    }
  | START_RVALUE colour STOP
    {
        p->result = all($2);
        parse_check_first(p, p->result);
        parse_missing_semicolon(p, p->result->next ? NULL : p->result);
        YYACCEPT;
    }
  | START_RVALUE whole                  { YYACCEPT; }
  | START_ARGUMENT colour STOP
    {
        p->result = all($2);
        parse_check_first(p, p->result);
        YYACCEPT;
    }
  | START_ARGUMENT whole                { YYACCEPT; }
  | START_ELEMENTS '{' elements '}'
    {
        p->result = of_list(p, AST_ENTRY, @$, WORD_NONE, all($3));
        YYACCEPT;
    }
  ;

braces: %empty { parse_open(p, WORD_default, false, @$); } ;

// Right sides complete in themselves.
whole:
    block                               { p->result = $1; }
  | OTHER_NAME                          { p->result = $1; }
  | string                              { p->result = $1; }
  | WORD OTHER_NAME
    {
        p->result = word(p, @1, $1);
        p->result->next = $2;
    }
  ;

statement:
    block
  | OTHER_NAME
  | NAME
  | subs
  | WORD NUMBER                         { BARE($1, @1); $$ = of_list(p, AST_BLOCK, @$, $1, $2); }
  | WORD NAME                           { BARE($1, @1); $$ = of_list(p, AST_BLOCK, @$, $1, $2); }
  ;

block:
    WORD '{' { parse_open(p, $1, false, @1); } items '}'
    {
        $$ = parse_close(p, of_list(p, AST_BLOCK, @$, $1, all($4)));
    }
  | LITERAL                             { $$ = parse_literal(p); }
  | function_block
  ;

function_block:
    FUNCTION '{' in_function function_body '}'
    {
        $$ = parse_close(p, of_list(p, AST_BLOCK, @$, WORD_function, $4));
    }
  | FUNCTION '(' params ')' '{' in_function function_body '}'
    {
        $3->next = $7;
        $$ = parse_close(p, of_list(p, AST_BLOCK, @$, WORD_function, $3));
    }
  | FUNCTION sizes '{' in_function function_body '}'
    {
        $2->next->next = $5;
        $$ = parse_close(p, of_list(p, AST_BLOCK, @$, WORD_function, $2));
    }
  ;

in_function:
    %empty
    {
        parse_open(p, WORD_function, false, @$);
        p->function = true;
    }
  ;

function_body: full | block ;

params:
    names
    {
        $$ = of_list(p, AST_ENTRY, @$, WORD_NONE, all($1));
    }
  ;

names:
    %empty                              { $$ = NULL; }
  | names NAME                          { $$ = append($1, $2); }
  | names STRING_NAME                   { $$ = append($1, $2); }
  | names OTHER_NAME                    { $$ = append($1, $2); }
  | names CONSTANT
    {
        $$ = append($1, of_list(p, AST_CONSTANT, @2, $2, NULL));
    }
  | names ','                           { $$ = $1; COMMA($1, @2); }
  ;

// The two sizes of an image made by a function.
sizes:
    size ',' size
    {
        $$ = $1;
        $$->comma_after = 1;
        $$->next = $3;
    }
  ;

size:
    NUMBER
  | NAME
  | subs
  | size '*' unary                      { $$ = binary(p, @$, '*', $1, $3); }
  | size '/' unary                      { $$ = binary(p, @$, '/', $1, $3); }
  ;

items:
    %empty                              { $$ = NULL; }
  | items item
    {
        $$ = parse_joins(p, $1, $2) ? $1 : append($1, $2);
    }
  | items ','                           { $$ = $1; COMMA($1, @2); }
  ;

item:
    value
  | BULK
  | string
  | OTHER_NAME
  | block
  | entry
  | WORD                                { $$ = word(p, @1, $1); }
  | COLOR                               { $$ = word(p, @1, $1); }
  | RGB                                 { $$ = word(p, @1, $1); }
  | PART                                { $$ = word(p, @1, $1); }
  | GRAY                                { $$ = word(p, @1, $1); }
  | CALL1 %prec VALUE_ENDS              { $$ = word(p, @1, $1); } // of julia_fractal
  | XYZ '(' args ')' ':' value
    {
        $$ = of_list(p, AST_CALL, @$, WORD_xyz, all(append($3, $6)));
    }
  ;

entry:
    '[' { parse_open(p, WORD_NONE, true, @1); } items close
    {
        $$ = parse_close(p, of_list(p, AST_ENTRY, @$, WORD_NONE, all($3)));
    }
  ;

close: ']' | MORE ;

// Two levels (language 2.3): `full` has every comparison; `value` stands where a
// '<' after an operand starts the next vector.
full:
    logic
  | logic '?' full ':' full             { $$ = conditional(p, @$, $1, $3, $5); }
  ;

logic:
    compare
  | logic '&' compare                   { $$ = binary(p, @$, '&', $1, $3); }
  | logic '|' compare                   { $$ = binary(p, @$, '|', $1, $3); }
  ;

compare:
    arith
  | compare relop string_or_arith       { $$ = binary(p, @$, $2, $1, $3); }
  | string relop string_or_arith        { $$ = binary(p, @$, $2, $1, $3); }
  ;

string_or_arith: string | arith ;

relop: xrelop | '<' { $$ = '<'; } | '>' { $$ = '>'; } ;

xrelop:
    '='                                 { $$ = '='; }
  | LE                                  { $$ = OP_LE; }
  | GE                                  { $$ = OP_GE; }
  | NE                                  { $$ = OP_NE; }
  | LESS                                { $$ = '<'; }
  | GREATER                             { $$ = '>'; }
  ;

value:
    xlogic %prec VALUE_ENDS
  | xlogic '?' full ':' value           { $$ = conditional(p, @$, $1, $3, $5); }
  ;

xlogic:
    xcompare
  | xlogic '&' xcompare                 { $$ = binary(p, @$, '&', $1, $3); }
  | xlogic '|' xcompare                 { $$ = binary(p, @$, '|', $1, $3); }
  ;

xcompare:
    arith %prec VALUE_ENDS
  | xcompare xrelop arith %prec VALUE_ENDS { $$ = binary(p, @$, $2, $1, $3); }
  ;

arith:
    arith '+' arith                     { $$ = binary(p, @$, '+', $1, $3); }
  | arith '-' arith                     { $$ = binary(p, @$, '-', $1, $3); }
  | arith '*' arith                     { $$ = binary(p, @$, '*', $1, $3); }
  | arith '/' arith                     { $$ = binary(p, @$, '/', $1, $3); }
  | unary
  ;

unary:
    '-' unary                { $$ = unary(p, @$, '-', $2); }
  | '+' unary                { $$ = unary(p, @$, '+', $2); }
  | MINUS unary              { $$ = unary(p, @$, '-', $2); }
  | PLUS unary               { $$ = unary(p, @$, '+', $2); }
  | '!' unary                { $$ = unary(p, @$, '!', $2); }
  | primary
  ;

primary:
    NUMBER
  | NAME
  | CONSTANT                            { $$ = of_list(p, AST_CONSTANT, @1, $1, NULL); }
  | call
  | subs
  | vector
  | '(' full ')'                        { $$ = $2; $$->parens = 1; }
  | primary '.' member
    {
        $$ = ast_new(p->arena, AST_MEMBER, @$);
        $$->word = (uint16_t)$3;
        $$->left = $1;
    }
  ;

member: CONSTANT | PART | GRAY ;

vector:
    VECTOR3
  | '<' components '>'                  { $$ = of_list(p, AST_VECTOR, @$, WORD_NONE, all($2)); }
  ;

components:
    value                               { $$ = one($1); }
  | components value                    { $$ = append($1, $2); }
  | components ','                      { $$ = $1; COMMA($1, @2); }
  ;

call:
    CALL1 '(' full ')'
    {
        $$ = parse_finish(p, of_list(p, AST_CALL, @$, $1, $3));
    }
  | CALL '(' args ')'
    {
        $$ = parse_finish(p, of_list(p, AST_CALL, @$, $1, all($3)));
    }
  | FUNCTION_NAME '(' args ')'
    {
        $$ = parse_finish(p, with_list($1, AST_APPLY, @$, all($3)));
    }
  ;

string:
    STRING
  | STRING_NAME
  | STRING_CALL '(' args ')'
    {
        $$ = parse_finish(p, of_list(p, AST_CALL, @$, $1, all($3)));
    }
  ;

args:
    %empty                              { $$ = NULL; }
  | arg_list
  ;

arg_list:
    arg                                 { $$ = one($1); }
  | arg_list arg                        { $$ = append($1, $2); }
  | arg_list ','                        { $$ = $1; COMMA($1, @2); }
  ;

arg:
    value
  | string
  | OTHER_NAME
  | WORD                                { $$ = word(p, @1, $1); }
  ;

subs:
    ARRAY_NAME sub_list
    {
        $$ = parse_finish(p, with_list($1, AST_INDEX, @$, all($2)));
    }
  ;

sub_list:
    '[' value ']'                       { $$ = one($2); }
  | '[' value MORE sub_list
    {
        $2->next = $4->next;
        $4->next = $2;
        $$ = $4;
    }
  ;

// first { part }, kept flat (language 2.6).
colour:
    value %prec VALUE_ENDS              { $$ = one($1); }
  | value parts %prec VALUE_ENDS        { $$ = join(one($1), $2); }
  | colour_start %prec VALUE_ENDS
  | colour_start parts %prec VALUE_ENDS { $$ = join($1, $2); }
  ;

colour_start:
    RGB value                           { $$ = append(one(word(p, @1, $1)), $2); }
  | PART value                          { $$ = append(one(word(p, @1, $1)), $2); }
  | COLOR value                         { $$ = append(one(word(p, @1, $1)), $2); }
  | COLOR RGB value
    {
        $$ = append(append(one(word(p, @1, $1)), word(p, @2, $2)), $3);
    }
  | COLOR PART value
    {
        $$ = append(append(one(word(p, @1, $1)), word(p, @2, $2)), $3);
    }
  ;

parts:
    PART value                          { $$ = append(one(word(p, @1, $1)), $2); }
  | parts PART value
    {
        $$ = append(append($1, word(p, @2, $2)), $3);
    }
  ;

array:
    ARRAY dims '{' elements '}'
    {
        struct ast *sizes = of_list(p, AST_ENTRY, @2, WORD_NONE, all($2));
        sizes->next = of_list(p, AST_ENTRY, span_join(@3, @5), WORD_NONE, all($4));
        $$ = of_list(p, AST_BLOCK, @$, WORD_array, sizes);
    }
  ;

dims: sub_list ;

elements:
    %empty                              { $$ = NULL; }
  | BULK                                { $$ = one($1); }
  | element_list
  ;

element_list:
    element                             { $$ = one($1); }
  | element_list element                { $$ = add_element(p, $1, $2); }
  | element_list ','                    { $$ = $1; COMMA($1, @2); }
  ;

element:
    colour %prec VALUE_ENDS
    {
        $$ = element(p, $1);
        parse_check_first(p, $$);
    }
  | string
  | OTHER_NAME
  | block
  | array
  | '{' elements '}'                    { $$ = of_list(p, AST_ENTRY, @$, WORD_NONE, all($2)); }
  ;

%%

static int sdl_lex(SDL_STYPE *value, struct span *where, struct parse *p)
{
    int kind = parse_token(p, where);
    const struct token *t = p->now;
    enum ast_kind node;
    switch (kind) {
    case TOK_VECTOR3:
        value->TOK_VECTOR3 = ast_new(p->arena, AST_VECTOR3, *where);
        value->TOK_VECTOR3->vector = t->vector;
        return kind;
    case TOK_BULK:
        value->TOK_BULK = ast_new(p->arena, AST_BULK, *where);
        value->TOK_BULK->bulk = t->bulk;
        return kind;
    case TOK_NUMBER:
        value->TOK_NUMBER = ast_new(p->arena, AST_NUMBER, *where);
        value->TOK_NUMBER->number = t->number;
        return kind;
    case TOK_STRING:
        node = AST_STRING;
        break;
    case TOK_NAME:
    case TOK_STRING_NAME:
    case TOK_OTHER_NAME:
    case TOK_ARRAY_NAME:
    case TOK_FUNCTION_NAME:
        node = t->value || !t->len ? AST_VALUE : AST_UNDECLARED;
        break;
    default:
        value->TOK_WORD = t->word;
        return kind;
    }
    struct ast *n = ast_new(p->arena, node, *where);
    n->text = t->text;
    n->len = t->len;
    n->value = t->value;
    if (node == AST_VALUE && !t->value) // a calculation that failed
        n->op = OP_FAILED;
    value->TOK_NAME = n;
    return kind;
}

static void sdl_error(struct span *where, struct parse *p, const char *message)
{
    if (strcmp(message, "memory exhausted") == 0) // parse_run says it
        return;
    if (!p->failed)
        diag_at(stream_diags(p->in), DIAG_SYNTAX, *where, message);
    p->failed = true;
}

static int yyreport_syntax_error(const yypcontext_t *ctx, struct parse *p)
{
    enum { MAX = 128 };
    yysymbol_kind_t want[MAX];
    int kinds[MAX];
    int n = yypcontext_expected_tokens(ctx, want, MAX);
    for (int i = 0; i < n; i++) { // back to token numbers, which the rest of lang/ knows
        kinds[i] = 0;
        for (int c = 1; c < TOK_END_OF_TOKENS; c++)
            if (YYTRANSLATE(c) == want[i])
                kinds[i] = c;
    }
    parse_syntax_error(p, kinds, n);
    return 0;
}
