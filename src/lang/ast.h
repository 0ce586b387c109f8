#ifndef LANG_AST_H
#define LANG_AST_H

#include <stdint.h>
#include <stdio.h>

#include "base/source.h"
#include "lang/token.h"

struct arena;
struct bulk;  // lang/bulk.h
struct value; // eval/value.h; opaque here

// What the parser makes of the text. Blocks are generic: a keyword and the items in
// its braces; eval/ gives them meaning. Some forms worth knowing:
//  - `function (a, b) { body }`: AST_BLOCK of WORD_function; its list is an AST_ENTRY
//    of the parameter names if there are parentheses, for the image form
//    `function w, h { body }` the two sizes, and last the body: an expression or a
//    nested block. Undeclared names in the body are AST_UNDECLARED. Calls in it are
//    not given to stream_host.finish; array elements are.
//  - `array[2][3] { ... }` as a macro argument or inside an initialiser: AST_BLOCK of
//    WORD_array; list: an AST_ENTRY of sizes, then the AST_ENTRY of elements if any.
//  - array elements `{ a, { b, c } }`: an AST_ENTRY for each pair of braces; an element
//    of several items (`rgb 1 filter 0.5`, two textures in a row) is an AST_BLOCK of
//    WORD_NONE holding the items.
//  - `xyz(1, 2, 3): 4` (polynomial): AST_CALL of WORD_xyz with four arguments;
//    `pwr(2, 3)` (julia_fractal): AST_CALL of WORD_pwr. Neither goes to finish.
//  - `max_trace_level 5` at scene level: AST_BLOCK of that word with the one item.
//  - `defined(NAME)` is an AST_NUMBER, 0 or 1: it is decided when read.
enum ast_kind {
    AST_NUMBER,     // number
    AST_STRING,     // text, len: between the quotes, escapes unresolved
    AST_VALUE,      // value: a declared name as it was when read, an array element,
                    // a finished call, a finished object; text/len: the name, if any
    AST_UNDECLARED, // text, len: a name nobody declared
    AST_WORD,       // word: a reserved word standing as an item (`rgb`, `rotate`, `open`)
    AST_CONSTANT,   // word: x y z t u v pi clock true false yes no on off version ...
    AST_VECTOR,     // list: 2..5 components (more for matrix and poly)
    AST_VECTOR3,    // vector: three components, written as plain numbers
    AST_BULK,       // bulk: all vectors of a block of mesh2
    AST_FACES, // faces: triangles of a mesh, one after the other, that were taken in; word: the
               // first's
    AST_UNARY,       // op ('-' '!' '+'), left
    AST_BINARY,      // op ('+' '-' '*' '/' '<' '>' '=' '&' '|', OP_LE.. ), left, right
    AST_CONDITIONAL, // list: condition, if true, if false
    AST_MEMBER,      // left, word: .x .red .gray ...
    AST_CALL,        // word: a built-in function; list: arguments
    AST_APPLY,       // value, text/len: a declared function or spline; list: arguments
    AST_INDEX,       // value, text/len: an array; list: all subscripts
    AST_BLOCK,       // word: keyword; list: items in braces
    AST_ENTRY,       // list: items in [ ]
};

// OP_FAILED: of an AST_VALUE without a value, whose error was reported.
enum ast_op { OP_LE = 256, OP_GE, OP_NE, OP_FAILED };

// One node type; `kind` says which members hold. Lists are linked through `next`
// in source order. Nodes live in the stream's own arena: a node is good until the
// host function it was given to returns (a statement: until the next parse_item).
// Whoever needs it longer takes an ast_copy.
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
        const char *text; // STRING, UNDECLARED, and the name of VALUE, APPLY, INDEX
        struct ast *left;
        const double *vector; // VECTOR3
        const struct bulk *bulk;
        void *faces; // what stream_host.faces returned
    };
    union {
        struct ast *right;
        struct ast *list;
    };
    const struct value *value;
};

struct ast_list {
    struct ast *first, *last;
    uint32_t count;
};

struct ast *ast_new(struct arena *a, enum ast_kind kind, struct span where);
struct ast_list ast_append(struct ast_list list, struct ast *node);
int ast_count(const struct ast *first); // it and those after it
// A deep copy of one node, without what follows it. Text stays in the source.
struct ast *ast_copy(struct arena *a, const struct ast *node);
// As an indented tree, one node a line, stable: --dump-ast.
void ast_print(const struct ast *node, FILE *out, int indent);

#endif
