#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

// Memory for what cannot go on without: when there is none, or `count` items of `size` bytes
// are more than memory can be, these say so and abort the process. They never return NULL,
// for no items either. free() takes it back.
void *must_malloc(size_t count, size_t size);
void *must_calloc(size_t count, size_t size); // zeroed
void *must_realloc(void *at, size_t count, size_t size);
void *must_align(size_t align, size_t count, size_t size); // to a power of two

_Noreturn void out_of_memory(void);

// Twice the items, at least 16; aborts where their number would not fit.
uint32_t capacity_doubled(uint32_t capacity);
// must_realloc to so many.
void *memory_double(void *at, uint32_t *capacity, size_t size);

// Room for one item behind the first `count` of an array that holds `*capacity`.
static inline void *must_grow(void *at, uint32_t count, uint32_t *capacity, size_t size)
{
    return count < *capacity ? at : memory_double(at, capacity, size);
}

#endif
