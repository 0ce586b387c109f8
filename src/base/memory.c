#include "base/memory.h"

#include <stdio.h>

void out_of_memory(void)
{
    fputs("lambert: out of memory\n", stderr);
    abort();
}

// At least 1, so that NULL means that there is no memory.
static size_t bytes_of(size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes))
        out_of_memory();
    return bytes ? bytes : 1;
}

static void *checked(void *at)
{
    if (!at)
        out_of_memory();
    return at;
}

void *must_malloc(size_t count, size_t size)
{
    return checked(malloc(bytes_of(count, size)));
}

void *must_calloc(size_t count, size_t size)
{
    return checked(calloc(1, bytes_of(count, size)));
}

void *must_realloc(void *at, size_t count, size_t size)
{
    return checked(realloc(at, bytes_of(count, size)));
}

void *must_align(size_t align, size_t count, size_t size)
{
    const size_t bytes = bytes_of(count, size);
    if (bytes > SIZE_MAX - align)
        out_of_memory();
    return checked(aligned_alloc(align, (bytes + align - 1) & ~(align - 1)));
}

uint32_t capacity_doubled(uint32_t capacity)
{
    enum { FIRST = 16 };
    if (capacity > UINT32_MAX / 2)
        out_of_memory();
    return capacity ? 2 * capacity : FIRST;
}

void *memory_double(void *at, uint32_t *capacity, size_t size)
{
    *capacity = capacity_doubled(*capacity);
    return must_realloc(at, *capacity, size);
}
