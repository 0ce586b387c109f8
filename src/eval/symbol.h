#ifndef EVAL_SYMBOL_H
#define EVAL_SYMBOL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "eval/value.h"

// Names and what they stand for: a stack of scopes (global, then one per open
// include and macro call), searched newest first (spec/language 3.3).
struct symbol_tables;
struct symbol;

// Where a value is kept: a name, or one element of an array.
struct place {
    struct symbol *symbol; // NULL: none
    struct array_value *array;
    uint32_t index;
};

struct symbol_tables *symbols_new(void);
void symbols_free(struct symbol_tables *t);

uint32_t symbols_depth(const struct symbol_tables *t); // 1: only the global scope
void symbols_enter(struct symbol_tables *t);
void symbols_leave(struct symbol_tables *t);

// The newest entry of a name in scopes 1..depth, references followed; one with
// neither symbol nor array when there is none.
struct place symbols_find(struct symbol_tables *t, const char *name, size_t len,
                          uint32_t depth);
// The entry in the current (local) or the global scope, made if it is not there.
struct place symbols_make(struct symbol_tables *t, const char *name, size_t len,
                          bool local);
// For those who keep names: the name itself, and the newest entry of it.
struct name;
struct name *symbols_name(struct symbol_tables *t, const char *text, size_t len);
struct place symbols_place(const struct symbol_tables *t, const struct name *name);
// Where an assignment to the name goes; the entry is made if it is not there.
struct place symbols_place_for(struct symbol_tables *t, struct name *name, bool local);
// NULL: none, or a number or string.
const struct value *symbol_value(const struct symbol *s);
const struct value *symbol_number(const struct symbol *s); // in place; NULL: no number
const struct value *symbol_string(const struct symbol *s); // likewise
// Adds to a string in place; `text` is none of its own.
void symbol_append(struct arena *a, struct symbol *s, const char *text);
// Adds to a float of the innermost scope; false: there is none.
bool symbols_advance(struct symbol_tables *t, struct name *name, double by, double *out);
// Assigns a number unless the name is a macro's or a function's.
bool symbol_set_number(struct symbol *s, const struct value *v);
bool symbol_takes_number(const struct symbol *s);
// The same in one of the open scopes; 1: the global one.
struct place symbols_make_at(struct symbol_tables *t, const char *name, size_t len,
                             uint32_t scope);
// Makes a name of the current scope stand for another place.
void symbols_refer(struct symbol_tables *t, const char *name, size_t len,
                   struct place to);
// Removes the newest entry; false when there is none.
bool symbols_remove(struct symbol_tables *t, const char *name, size_t len);

static inline bool place_found(struct place p) { return p.symbol || p.array; }
// The value now, immutable: numbers and strings are copied into `copies`.
// NULL: nothing was assigned yet.
const struct value *place_get(struct arena *copies, struct place p);
// The same, for as long as nothing is assigned.
const struct value *place_peek(struct arena *copies, struct place p);
// What place_peek gave, for longer.
const struct value *value_hold(struct arena *copies, const struct value *v);
// False when an array element would change its kind. Numbers and strings are copied: the
// place needs no memory for a number, and for a string that of the longest it held.
bool place_set(struct arena *a, struct place p, const struct value *v);
void place_clear(struct place p);

// The declared name, or macro, closest to a word, for hints; NULL: none is close.
const char *symbols_closest(const struct symbol_tables *t, const char *name, size_t len,
                            bool macros_only);

#endif
