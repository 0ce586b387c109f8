#include "scene/boundary.h"

#include <stdlib.h>

#include "base/memory.h"

struct boundary *boundary_list_add(struct boundary_list *l, double t, double dt,
                                   enum crossing c, uint32_t part)
{
    l->at = must_grow(l->at, l->count, &l->capacity, sizeof *l->at);
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
