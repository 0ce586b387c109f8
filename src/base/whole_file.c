#include "base/whole_file.h"

#include <errno.h>
#include <unistd.h>

bool whole_file_begin(struct whole_file *w, const char *path)
{
    enum { TRIES = 100 };
    w->path = path;
    w->f = NULL;
    for (int i = 0; i < TRIES; i++) {
        const int n =
            snprintf(w->name, sizeof w->name, "%s.%ld-%d.part", path, (long)getpid(), i);
        if (n < 0 || (size_t)n >= sizeof w->name) {
            errno = ENAMETOOLONG;
            return false;
        }
        w->f = fopen(w->name, "wbx");
        if (w->f || errno != EEXIST)
            break;
    }
    return w->f;
}

bool whole_file_end(struct whole_file *w, bool ok)
{
    ok = ok && fflush(w->f) == 0;
    const int why = errno;
    const bool closed = fclose(w->f) == 0;
    if (ok && closed && rename(w->name, w->path) == 0)
        return true;
    const int late = ok ? errno : why;
    remove(w->name);
    errno = late;
    return false;
}
