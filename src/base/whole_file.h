#ifndef BASE_WHOLE_FILE_H
#define BASE_WHOLE_FILE_H

#include <stdbool.h>
#include <stdio.h>

// A file that appears under its name when all of it was written; until then an older one
// of that name stays as it was.
struct whole_file {
    FILE *f;
    const char *path;
    char name[4096]; // in the meantime
};

// False: errno tells why. The path stays valid until the end.
bool whole_file_begin(struct whole_file *w, const char *path);
// ok: what was written so far was written. False: nothing has changed, errno tells why.
bool whole_file_end(struct whole_file *w, bool ok);

#endif
