#ifndef EVAL_FILE_IO_H
#define EVAL_FILE_IO_H

struct eval;

// Where the scene itself put a file of this name; NULL: it wrote none.
const char *file_written(const struct eval *e, const char *name);

#endif
