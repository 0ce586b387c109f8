#ifndef LANG_AST_H
#define LANG_AST_H

#include <stdint.h>
#include <stdio.h>

#include "base/source.h"
#include "lang/token.h"

struct arena;
struct value; // eval/value.h; opaque here

enum ast_kind {
    AST_NUMBER,      // number
    AST_STRING,      // text, len: between the quotes, escapes unresolved
    AST_VALUE,       // value: a declared name as it was when read, an array element,
                     // a finished call, a finished object; text/len: the name
    AST_UNDECLARED,  // text, len: a name nobody declared
    AST_WORD,        // word: a reserved word standing as an item (`rgb`, `rotate`, `open`)
    AST_CONSTANT,    // word: x y z t u v pi clock true false yes no on off version ...
    AST_VECTOR,      // list: 2..5 components (more for matrix and poly)
    AST_UNARY,       // op ('-' '!' '+'), left
    AST_BINARY,      // op ('+' '-' '*' '/' '<' '>' '=' '&' '|', OP_LE.. ), left, right
    AST_CONDITIONAL, // list: condition, if true, if false
    AST_MEMBER,      // left, word: .x .red .gray ...
    AST_CALL,        // word: a built-in function; list: arguments
    AST_APPLY,       // value: a declared function or spline; list: arguments
    AST_INDEX,       // value: an array; list: subscripts (only where it must stay lazy)
    AST_BLOCK,       // word: keyword; list: items in braces
    AST_ENTRY,       // list: items in [ ]
};

enum ast_op { OP_LE = 256, OP_GE, OP_NE };

// One node type; `kind` says which members hold. Lists are linked through `next`
// in source order. Nodes live in the parser's arena and never change.
struct ast {
    enum ast_kind kind;
    struct span where;
    uint16_t word;
    uint16_t op;
    uint8_t parens;      // the expression stood in parentheses
    uint8_t comma_after; // an item followed by ','
    uint16_t len;
    struct ast *next;
    union {
        double number;
        const char *text; // STRING, UNDECLARED, and the name of a VALUE
        struct ast *left;
    };
    union {
        const struct value *value;
        struct ast *right;
        struct ast *list;
    };
};

struct ast_list {
    struct ast *first, *last;
    uint32_t count;
};

struct ast *ast_new(struct arena *a, enum ast_kind kind, struct span where);
struct ast_list ast_append(struct ast_list list, struct ast *node);
// As an indented tree, one node a line, stable: --dump-ast.
void ast_print(const struct ast *node, FILE *out, int indent);

#endif
