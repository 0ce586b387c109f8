#ifndef LANG_STREAM_H
#define LANG_STREAM_H

#include <stdbool.h>

#include "base/diag.h"
#include "lang/ast.h"
#include "lang/token.h"

struct arena;
struct value;

// What a name stands for at the moment its token is read; tells the grammar how
// to take what follows ('(' after a function, '[' after an array).
enum name_class {
    NAME_UNDECLARED,
    NAME_VALUE, // number, vector, colour, or anything copied whole
    NAME_STRING,
    NAME_FUNCTION, // declared function or spline: NAME '(' starts a call
    NAME_ARRAY,    // NAME '[' starts a subscript
    NAME_MACRO,    // the stream expands it; the grammar never sees it
    NAME_OBJECT,   // object
    NAME_BLOCK,    // texture, pigment, transform, map, ...: any other block value
};

struct name_info {
    enum name_class class;
    const struct value *value; // the value now, until something is assigned
    void *macro;               // NAME_MACRO: what define_macro stored
    bool deprecated;           // the host wants to be told of its use
};

// A place an assignment goes to: a name, with subscripts for an array element.
struct lvalue {
    const char *name;
    size_t len;
    struct span where;
    const struct ast *index; // list of subscripts, or NULL
    bool local;              // #local
    uint32_t scope;          // host's: how many scopes were open before the right side,
                             // which may end inside a macro it calls; 0: all of now
    bool deprecated;         // `#declare deprecated`: its first use warns
    const struct ast *deprecated_text; // AST_STRING, or NULL for a standard text
};

// One macro argument: by reference when it is a single name or array element,
// else a value.
struct macro_argument {
    bool by_reference;
    struct lvalue reference;
    const struct ast *rvalue; // list of items when not by reference
};

// Where an expression may be taken straight from tokens instead of through the grammar.
enum calc_kind {
    CALC_ITEM,       // a number or vector among the items of a block
    CALC_ARGUMENT,   // of a macro, to its ',' or ')'
    CALC_CONDITION,  // in parentheses
    CALC_ASSIGNMENT, // NAME = value ;
};

struct calc_place {
    enum calc_kind kind;
    bool local;   // CALC_ASSIGNMENT: #local
    bool goes_on; // what follows the end of these tokens may belong to the expression
    const struct lexeme *tokens;
    uint32_t count;
    const char *text;  // of the file
    uint32_t *slot;    // the host's, 0 at first: what it knows of this place
    struct span where; // file and expansion of the tokens
};

struct calc_result {
    uint32_t used;             // tokens
    int width;                 // 0: failed
    double number;             // width 1
    const struct value *value; // wider
};

enum calc_outcome {
    CALC_NONE, // left to the grammar: nothing has happened
    CALC_DONE,
    CALC_FAILED, // and reported; `used` tokens belong to it all the same
};

// What a name that is not declared was to be.
enum undeclared_kind {
    UNDECLARED_VALUE,
    UNDECLARED_MACRO,
    UNDECLARED_CALL, // a macro or a function
};

// How the stream asks for the worth of expressions and where names are kept;
// eval/ fills it in, so that lang/ need not know eval/. All report their own
// errors; false or NULL means the statement had an error and was dropped. Nodes
// handed over are good until the function returns.
struct stream_host {
    void *user;
    struct name_info (*lookup)(void *user, const char *name, size_t len);
    // The value of a lookup to keep for as long as nodes are; may be NULL: they are kept.
    const struct value *(*hold)(void *user, const struct value *value);
    // What to say of a name that is not declared; NULL: nothing, as without it.
    // `word`: the closest of the language, or NULL.
    const char *(*undeclared)(void *user, const char *name, size_t len,
                              enum undeclared_kind kind, const char *word);
    void (*deprecated)(void *user, const char *name, size_t len, struct span where);
    bool (*number)(void *user, const struct ast *expr, double *out);      // width 1
    bool (*string)(void *user, const struct ast *expr, const char **out); // terminated
    bool (*path)(void *user, const struct ast *expr, const char **out);   // no escapes
    bool (*is_declared)(void *user, const struct lvalue *name); // #ifdef, defined()

    // #declare / #local: begin makes the empty local entry before the right side
    // is read (spec/language 3.2); assign stores it. items: one node or a list
    // (`rgb <1,0,0> filter 0.5`, `texture{} texture{}`).
    bool (*declare_begin)(void *user, struct lvalue *to);
    bool (*declare)(void *user, const struct lvalue *to, const struct ast *items);
    bool (*declare_number)(void *user, const struct lvalue *to, double v); // #for
    // The same the short way, where the name holds a number of this scope: adds to it.
    // `name`: the host's, from name_of. False: nothing has happened.
    void *(*name_of)(void *user, const char *name, size_t len);
    bool (*advance)(void *user, void *name, double by, double *out);
    bool (*declare_array)(
        void *user, const struct lvalue *to, const struct ast *sizes,
        const struct ast *elements); // elements: nested AST_ENTRY or NULL
    // The short way for what is simple; NULL: everything goes through the grammar.
    enum calc_outcome (*calculate)(void *user, const struct calc_place *at,
                                   struct calc_result *out);
    bool (*undef)(void *user, const struct lvalue *name);
    bool (*define_macro)(void *user, const char *name, size_t len, struct span where,
                         void *macro);

    // Symbol tables: one per include file and macro call in progress. Arguments are
    // bound after enter_scope, and each at once: a reference means the entry visible
    // from below the new scope (M(B, A) may call `#macro M(A, B)`), its subscripts
    // those of now.
    bool (*enter_scope)(void *user, struct span where);
    void (*leave_scope)(void *user);
    bool (*bind_argument)(void *user, const char *parameter, size_t len,
                          const struct macro_argument *argument);

    // An expression or block the grammar has just finished, to be evaluated at its
    // closing token (calls with side effects, objects): returns the node to keep,
    // which may be `node` overwritten in place. An AST_INDEX comes with all its
    // subscripts. Blocks that only look like objects (the components of a blob,
    // triangles of a mesh, contained_by shapes, the object pattern) do not come here.
    struct ast *(*finish)(void *user, struct ast *node);
    // The triangles of a mesh are taken in at their closing tokens, so that none waits for
    // the last: faces begins such a list, which lives in the stream's arena, and face adds
    // the finished block. Both NULL: they stay in the mesh's block.
    void *(*faces)(void *user);
    void (*face)(void *user, void *faces, const struct ast *block);

    // #debug #warning #error #render #statistics
    bool (*message)(void *user, enum word directive, struct span where, const char *text);
    bool (*version)(void *user, struct span where, double version);
    // Asked before each statement, directive and macro call; may be NULL. False, with a
    // report: nothing more is read.
    bool (*may_go_on)(void *user, struct span where, uint64_t steps);
    bool (*defaults)(void *user, const struct ast *items); // #default { }
    // #fopen (items: the path, then AST_WORD read, write or append), #fclose (none),
    // #read (items: places to assign, each an AST_UNDECLARED or AST_VALUE with its
    // name, or an AST_INDEX), #write (items: values, and AST_WORD uint8 ...).
    bool (*file_io)(void *user, enum word directive, struct span where,
                    const struct lvalue *handle, const struct ast *items);
    // Finds and reads an include file through the library path: sets name as found,
    // text and len (in the source arena). False: not found (reported).
    // The text is followed by two zero bytes and may be written to.
    bool (*open_include)(void *user, const char *name, struct span where,
                         const char **found, const char **text, size_t *len);
};

// Runs the #-directives and macros: hands the grammar a token sequence in which
// every #if has been decided and every loop unrolled. The grammar never sees a '#'.
struct stream;

struct stream *stream_new(struct arena *a, struct source_map *sources, uint32_t file,
                          struct diag_sink *diags, struct stream_host host);
// Of the language, until a #version says another (3.7).
void stream_set_version(struct stream *s, double version);
void stream_free(struct stream *s); // arena memory stays
// Where the nodes are made: for finish, and for scratch that need not outlive the
// host call.
struct arena *stream_arena(struct stream *s);
struct token stream_next(struct stream *s);
void stream_take(struct stream *s, struct token *out); // the same, written in place

#endif
