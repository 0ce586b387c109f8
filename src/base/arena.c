#include "base/arena.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"

struct block {
    struct block *prev;
    size_t used, size;
    _Alignas(64) unsigned char data[];
};

enum { BLOCK_MAX = 16 << 20 }; // blocks double up to this size

// In the arena itself, so that a record goes with the memory it was made for.
struct ending {
    void (*done)(void *data);
    void *data;
    struct ending *prev;
    struct block *block;
    size_t used; // of the block, before the record
};

struct arena {
    struct block *head;
    struct ending *last;
    size_t size; // of all blocks
};

static struct block *block_new(struct block *prev, size_t size)
{
    size = (size + 63) & ~(size_t)63;
    struct block *b = must_align(_Alignof(struct block), 1, sizeof *b + size);
    b->prev = prev;
    b->used = 0;
    b->size = size;
    return b;
}

struct arena *arena_new(size_t first_block)
{
    struct arena *a = must_calloc(1, sizeof *a);
    a->head = block_new(NULL, first_block);
    a->size = a->head->size;
    return a;
}

static void end_last(struct arena *a)
{
    struct ending *e = a->last;
    a->last = e->prev;
    e->done(e->data);
}

void arena_free(struct arena *a)
{
    if (!a)
        return;
    while (a->last)
        end_last(a);
    for (struct block *b = a->head, *prev; b; b = prev) {
        prev = b->prev;
        free(b);
    }
    free(a);
}

size_t arena_size(const struct arena *a) { return a->size; }

static void drop_head(struct arena *a)
{
    struct block *b = a->head;
    while (a->last && a->last->block == b)
        end_last(a);
    a->head = b->prev;
    a->size -= b->size;
    free(b);
}

void arena_reset(struct arena *a)
{
    while (a->head->prev)
        drop_head(a);
    while (a->last)
        end_last(a);
    a->head->used = 0;
}

struct arena_mark arena_mark(const struct arena *a)
{
    return (struct arena_mark){a->head, a->head->used};
}

void arena_rewind(struct arena *a, struct arena_mark mark)
{
    while (a->head != mark.block)
        drop_head(a);
    while (a->last && a->last->block == a->head && a->last->used >= mark.used)
        end_last(a);
    a->head->used = mark.used;
}

static void *alloc(struct arena *a, size_t size, size_t align)
{
    if (size > SIZE_MAX / 4)
        out_of_memory();
    struct block *b = a->head;
    size_t at = (b->used + align - 1) & ~(align - 1);
    if (at > b->size || b->size - at < size) {
        size_t next = b->size < BLOCK_MAX ? 2 * b->size : BLOCK_MAX;
        b = a->head = block_new(b, size > next ? size : next);
        a->size += b->size;
        at = 0;
    }
    b->used = at + size;
    return memset(b->data + at, 0, size);
}

void *arena_alloc(struct arena *a, size_t size)
{
    return alloc(a, size, _Alignof(max_align_t));
}

void *arena_alloc_aligned(struct arena *a, size_t size, size_t align)
{
    return alloc(a, size, align);
}

void *arena_alloc_array(struct arena *a, size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes))
        out_of_memory();
    return arena_alloc(a, bytes);
}

void *arena_grow(struct arena *a, void *array, uint32_t count, uint32_t *capacity,
                 size_t size)
{
    if (count < *capacity)
        return array;
    *capacity = capacity_doubled(*capacity);
    void *more = arena_alloc_array(a, *capacity, size);
    if (array)
        memcpy(more, array, count * size);
    return more;
}

void arena_at_end(struct arena *a, void (*done)(void *data), void *data)
{
    struct ending *e = arena_alloc(a, sizeof *e);
    *e = (struct ending){done, data, a->last, a->head,
                         (size_t)((unsigned char *)e - a->head->data)};
    a->last = e;
}

char *arena_strndup(struct arena *a, const char *s, size_t len)
{
    char *p = arena_alloc(a, len + 1);
    memcpy(p, s, len);
    return p;
}

char *arena_printf(struct arena *a, const char *fmt, ...)
{
    va_list ap, ap2;
    va_start(ap, fmt);
    va_copy(ap2, ap);
    const int n = vsnprintf(NULL, 0, fmt, ap);
    va_end(ap);
    if (n < 0) // longer than INT_MAX, or not of this locale
        out_of_memory();
    char *s = arena_alloc(a, (size_t)n + 1);
    vsnprintf(s, (size_t)n + 1, fmt, ap2);
    va_end(ap2);
    return s;
}
