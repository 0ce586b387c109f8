#include "scene/boundary.h"

#include <stdlib.h>

struct boundary *boundary_list_add(struct boundary_list *l, double t, double dt,
                                   enum crossing c, uint32_t part)
{
    if (l->count == l->capacity) {
        uint32_t capacity = l->capacity ? 2 * l->capacity : 16;
        struct boundary *at = realloc(l->at, capacity * sizeof *at);
        if (!at)
            abort();
        l->at = at;
        l->capacity = capacity;
    }
    struct boundary *b = &l->at[l->count++];
    *b = (struct boundary){
        .t = t, .dt = dt, .part = part, .crossing = (uint8_t)c, .drawn = 1};
    return b;
}

void boundary_list_free(struct boundary_list *l)
{
    free(l->at);
    *l = (struct boundary_list){0};
}
