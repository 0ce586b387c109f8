#ifndef BASE_ARENA_H
#define BASE_ARENA_H

#include <stddef.h>
#include <stdint.h>

// A region of memory freed all at once. Everything a stage builds for the next
// one (tokens, AST, scene) lives in an arena; nothing in it is freed alone.
struct arena;

struct arena *arena_new(size_t first_block);
void arena_free(struct arena *a);
void arena_reset(struct arena *a); // forgets everything, keeps the first block

// Forgets what was allocated since the mark was taken; marks nest like calls.
struct arena_mark {
    void *block;
    size_t used;
};

struct arena_mark arena_mark(const struct arena *a);
void arena_rewind(struct arena *a, struct arena_mark mark);

// Zeroed memory, aligned for any type (or to `align`, a power of two up to 64).
// Aborts the process when out of memory.
void *arena_alloc(struct arena *a, size_t size);
void *arena_alloc_aligned(struct arena *a, size_t size, size_t align);
void *arena_alloc_array(struct arena *a, size_t count, size_t size);
// Room for one item behind the first `count` of an array that holds `*capacity`: the same
// array (NULL: none yet), or a copy of twice the size. The old one stays in the arena.
void *arena_grow(struct arena *a, void *array, uint32_t count, uint32_t *capacity,
                 size_t size);
// Bytes that the arena holds of the system's memory.
size_t arena_size(const struct arena *a);
char *arena_strndup(struct arena *a, const char *s, size_t len);
char *arena_printf(struct arena *a, const char *fmt, ...)
    __attribute__((format(printf, 2, 3)));

// Calls done(data) when the memory is freed that was current at the call: for what in an
// arena holds on to something else.
void arena_at_end(struct arena *a, void (*done)(void *data), void *data);

#define arena_new_struct(a, type)   ((type *)arena_alloc((a), sizeof(type)))
#define arena_new_array(a, type, n) ((type *)arena_alloc_array((a), (n), sizeof(type)))

#endif
