#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H

#include <stdlib.h>

// Zeroed memory for what cannot go on without; freed by free().
static inline void *must_calloc(size_t count, size_t size)
{
    void *p = calloc(count ? count : 1, size);
    if (!p)
        abort();
    return p;
}

// As realloc, for what cannot go on without; count > 0.
static inline void *must_realloc(void *at, size_t count, size_t size)
{
    at = realloc(at, count * size);
    if (!at)
        abort();
    return at;
}

#endif
