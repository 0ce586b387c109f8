#include "base/source.h"

#include <string.h>

#include "base/arena.h"

enum { EXPANSIONS_MAX = 1 << 20 };

void source_map_init(struct source_map *m, struct arena *arena)
{
    *m = (struct source_map){.arena = arena, .expansion_count = 1};
}

uint32_t source_add(struct source_map *m, const char *name, const char *text, size_t len,
                    struct span included_at)
{
    struct source_file *f = arena_new_struct(m->arena, struct source_file);
    f->name = name;
    f->text = text;
    f->len = (uint32_t)len;
    f->included_at = included_at;
    f->arena = m->arena;
    m->file = arena_grow(m->arena, m->file, m->count, &m->capacity, sizeof *m->file);
    m->file[m->count] = f;
    return m->count++;
}

static void find_lines(struct source_file *f)
{
    f->line_count = 1;
    for (size_t i = 0; i < f->len; i++)
        f->line_count += f->text[i] == '\n';
    f->line_start = arena_new_array(f->arena, uint32_t, f->line_count);
    const char *at = f->text;
    for (uint32_t line = 1; line < f->line_count; line++) {
        at = (const char *)memchr(at, '\n', f->len - (size_t)(at - f->text)) + 1;
        f->line_start[line] = (uint32_t)(at - f->text);
    }
}

struct source_line source_line(struct source_file *f, uint32_t offset)
{
    if (!f->line_start)
        find_lines(f);
    uint32_t lo = 0, hi = f->line_count;
    while (hi - lo > 1) {
        uint32_t mid = lo + (hi - lo) / 2;
        if (f->line_start[mid] <= offset)
            lo = mid;
        else
            hi = mid;
    }
    const bool last = lo + 1 == f->line_count;
    const bool before = f->header && lo == 0;
    return (struct source_line){before ? f->header : f->name, lo + !f->header,
                                f->line_start[lo],
                                last ? f->len : f->line_start[lo + 1] - 1};
}

uint32_t source_expand(struct source_map *m, const char *macro, struct span called_at)
{
    uint32_t *last = &m->expansion_at[(called_at.begin + 31 * called_at.file +
                                       127 * called_at.expansion) %
                                      EXPANSIONS_KEPT];
    if (*last) {
        const struct expansion *e = &m->expansions[*last];
        const struct span s = e->called_at;
        if (e->macro == macro && s.begin == called_at.begin && s.end == called_at.end &&
            s.file == called_at.file && s.expansion == called_at.expansion)
            return *last;
    }
    if (m->expansion_count >= EXPANSIONS_MAX)
        return 0;
    m->expansions = arena_grow(m->arena, m->expansions, m->expansion_count,
                               &m->expansion_capacity, sizeof *m->expansions);
    m->expansions[m->expansion_count] = (struct expansion){macro, called_at};
    return *last = m->expansion_count++;
}
