#ifndef EVAL_INCLUDE_HINT_H
#define EVAL_INCLUDE_HINT_H

#include <stdbool.h>
#include <stddef.h>

struct eval;

// What to say of a name (a macro, when one was to be called) that is not declared: the
// include of the library path that declares it; else `word`, the closest of the language,
// unless NULL; else the closest name that is declared, here or there. Reads includes: for
// errors only. In e->parse.
const char *undeclared_hint(struct eval *e, const char *name, size_t len, bool macro,
                            const char *word);

// Of an include that was not found: the closest name there is; NULL: none. As above.
const char *include_hint(struct eval *e, const char *name);

#endif
