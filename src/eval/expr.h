#ifndef EVAL_EXPR_H
#define EVAL_EXPR_H

#include "eval/eval.h"

// Parts of expression evaluation that the files of eval/ share.

// Wanted width 1 first, then widened: the contexts that take a whole expression
// (spec/language 2.3 and 2.4, "full").
bool eval_full(struct eval *e, const struct ast *n, int wanted, double out[5],
               int *width);
bool eval_truth(double v);
bool eval_compare(int op, double a, double b); // also '&' and '|'
int member_index(enum word w);                 // of `.x`, `.red` ...; -1: `.gray`
// Added to a subscript before it is truncated.
#define INDEX_SLACK 1e-10
// Repeats a single number, pads others with 0.
void number_widen(double *n, int *width, int wanted);

// The value an item names: a declared name, an array element. NULL: it names none,
// or (reported) the element is not there.
const struct value *eval_named(struct eval *e, const struct ast *n);
bool ast_is_string(const struct ast *n);

// A built-in function's result: a number of width 1 or 3, or a string, which like the
// node is good until the statement ends.
struct call_result {
    int width; // 0: a string
    double n[5];
    const char *text;
};
bool eval_call(struct eval *e, const struct ast *n, struct call_result *out);
bool word_is_string_function(enum word w);
// A declared function or spline with arguments.
bool eval_apply(struct eval *e, const struct ast *n, double out[5], int *width);

double random_next(struct eval *e, double stream, struct span where, bool *ok);
double random_seed(struct eval *e, double seed);
double number_to_int(double v); // truncated; out of 32 bits: -2147483648

// Where an assignment or reference goes: all names in scopes 1..depth.
struct place;
struct place eval_place(struct eval *e, const struct lvalue *to, uint32_t depth);
bool eval_index(struct eval *e, struct place base, const struct ast *index,
                struct span where, struct place *out);

// Whether `more` bytes still fit what the caller allows; reports.
bool eval_has_memory(struct eval *e, struct span where, size_t more);

bool eval_assign(struct eval *e, const struct lvalue *to, const struct value *v);

// #debug, #warning, #error and so on, as stream_host.message.
bool eval_message(void *user, enum word directive, struct span where, const char *text);
// `#declare deprecated`: its name is to be warned of; stream_host.deprecated does so once.
void eval_deprecate(struct eval *e, const struct lvalue *to);
void eval_deprecated(void *user, const char *name, size_t len, struct span where);

// #fopen, #fclose, #read and #write, as stream_host.file_io.
bool eval_file_io(void *user, enum word directive, struct span where,
                  const struct lvalue *handle, const struct ast *items);
void files_close(struct eval *e); // what the scene left open

struct stream_host eval_host(struct eval *e);
// The file's text through the library path (spec/language 3.11); NULL: not found.
// NULL also when it may not be read; file_hint then says so, else it is NULL.
const char *file_hint(const struct eval *e);
const char *file_find(struct eval *e, const char *name, const char *const *extensions);
bool file_read(struct arena *a, const char *path, const char **text, size_t *len);

#endif
