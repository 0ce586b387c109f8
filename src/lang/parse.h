#ifndef LANG_PARSE_H
#define LANG_PARSE_H

#include "lang/ast.h"
#include "lang/stream.h"

// Reads the next statement of the scene from the stream: a block, a name standing
// as a statement, or an old bare directive. After a syntax error it reports, skips
// to where a statement can start, and goes on with the next. NULL at the end of
// the input or when the error limit is reached.
struct ast *parse_item(struct stream *s);

#endif
