#ifndef EVAL_FILE_IO_H
#define EVAL_FILE_IO_H

#include <stdbool.h>

#include "base/source.h"

struct eval;

// Where the scene itself put a file of this name; NULL: it wrote none.
const char *file_written(const struct eval *e, const char *name);

bool file_may_write(const struct eval *e, const char *path);
// The real path of a file to write, in a folder that is there; NULL after an error.
const char *file_to_write(struct eval *e, const char *name, struct span where);

#endif
