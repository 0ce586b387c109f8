// Libraries that are loaded when they are needed.
#include "base/library.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

bool library_load(const char *file, const char *const *names, size_t count,
                  void *pointers, char *why, size_t why_size)
{
    void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    for (size_t i = 0; library && i < count; i++) {
        void *function = dlsym(library, names[i]);
        if (!function)
            library = NULL;
        else // POSIX gives both kinds of pointers the same bits
            memcpy((char *)pointers + i * sizeof function, &function, sizeof function);
    }
    if (!library) {
        const char *error = dlerror();
        snprintf(why, why_size, "%s", error ? error : file);
    }
    return library;
}
