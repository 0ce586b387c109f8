#ifndef EVAL_INCLUDE_HINT_H
#define EVAL_INCLUDE_HINT_H

#include <stddef.h>

#include "lang/stream.h"

struct eval;

// What to say of a name that is not declared: the
// include of the library path that declares it; else `word`, the closest of the language,
// unless NULL; else the closest name that is declared, here or there. Reads includes: for
// errors only. In e->parse.
const char *undeclared_hint(struct eval *e, const char *name, size_t len,
                            enum undeclared_kind kind, const char *word);

// Of an include that was not found: the closest name there is; NULL: none. As above.
const char *include_hint(struct eval *e, const char *name);

#endif
