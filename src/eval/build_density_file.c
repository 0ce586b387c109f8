#include "eval/build.h"

#include "eval/expr.h"
#include "scene/density_grid.h"

// density_file "name.df3".

void build_density_file(struct args *a, struct pattern *p)
{
    struct arena *arena = a->b->arena;
    const char *name, *path, *data = NULL;
    size_t size = 0;
    if (!args_take(a, WORD_df3)) {
        args_error(a, args_span(a), "df3 is expected");
        return;
    }
    const struct span where = args_span(a);
    if (!args_string(a, "file name", &name) ||
        !args_find_file(a, "density file", name, "df3", &path))
        return;
    struct density_grid *g = arena_new_struct(arena, struct density_grid);
    if (!file_read(arena, path, &data, &size))
        args_error(a, where, arena_printf(arena, "'%s' cannot be read", path));
    else if (!density_grid_init(g, (const uint8_t *)data, size))
        args_error(a, where,
                   arena_printf(arena,
                                "'%s' is damaged: its length does not fit its sizes",
                                path));
    else
        p->density = g;
}
