#ifndef BASE_SOURCE_H
#define BASE_SOURCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct arena;

// A half-open byte range [begin, end) of one source file. `expansion` is the
// macro call whose body the text was read for (an index into source_map's
// expansions; 0 = none), so that a message can name the calls that led to it.
struct span {
    uint32_t file, begin, end, expansion;
};

struct source_file {
    const char *name;   // as used to open it
    const char *header; // what put a line before the file's first; NULL: nothing did
    const char *text;
    uint32_t len;
    bool
        ended; // two zero bytes follow, and the text may be written to (but is not left so)
    struct arena *arena;
    uint32_t *line_start; // byte offset of each line; NULL until somebody asks
    uint32_t line_count;
    struct span included_at; // where the #include stood; end == 0 for the main file
};

struct expansion {
    const char *macro;
    struct span called_at; // its own `expansion` is the enclosing call
};

enum { EXPANSIONS_KEPT = 256 };

// Every file read for one scene and every macro call; grows, never shrinks.
struct source_map {
    struct arena *arena;
    struct source_file **file;
    uint32_t count, capacity;
    struct expansion *expansions;
    uint32_t expansion_count, expansion_capacity;
    uint32_t
        expansion_at[EXPANSIONS_KEPT]; // the last of each remainder of the place, or 0
};

void source_map_init(struct source_map *m, struct arena *arena);
uint32_t source_add(struct source_map *m, const char *name, const char *text, size_t len,
                    struct span included_at);

struct source_line {
    const char *name;    // of the file, or of what put the line before it
    uint32_t number;     // 1 is the file's first
    uint32_t begin, end; // without its newline
};

// The line that a byte is in. Not for two threads at once.
struct source_line source_line(struct source_file *f, uint32_t offset);

// Records a macro call and returns its id, mostly the same one for a call that comes
// again (in a loop); 0 (no trace) once EXPANSIONS_MAX are
// recorded, so that a scene with millions of calls does not pay for messages.
uint32_t source_expand(struct source_map *m, const char *macro, struct span called_at);

static inline struct span span_join(struct span a, struct span b)
{
    if (a.file == b.file && b.end > a.begin)
        a.end = b.end;
    return a;
}

#endif
