// Smaller elements where light changes fast: cells are quartered after a solution.
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "radiosity/patches.h"

// The elements that a cell had before it was quartered.
struct quartered {
    uint32_t element[2];
};

// Takes the elements of quartered cells out; their places in the list of those kept.
static uint32_t keep_whole(struct patches *p, uint32_t *origin)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < p->element_count; i++) {
        struct cell *c = &p->cell[p->element_cell[i] / 2];
        if (c->child)
            continue;
        c->element[p->element_cell[i] & 1] = kept;
        p->element[kept] = p->element[i];
        p->element_cell[kept] = p->element_cell[i];
        origin[kept++] = i;
    }
    p->element_count = kept;
    return kept;
}

uint32_t *patches_refine(struct patches *p, const bool *split)
{
    const uint32_t before = p->element_count, first = p->cell_count;
    uint32_t count = 0;
    struct quartered *q = must_malloc(before + 1, sizeof *q);
    uint32_t *origin = must_malloc(before + 1, sizeof *origin);
    for (uint32_t i = 0; i < before; i++) {
        const uint32_t index = p->element_cell[i] / 2;
        struct cell *c = &p->cell[index];
        if (!split[i] || c->child)
            continue;
        memcpy(q[count].element, c->element, sizeof q[count].element);
        // A side without an element stays without.
        for (int side = 0; side < 2; side++)
            if (c->element[side] == ELEMENT_NONE)
                c->dead |= (uint8_t)(1u << side);
        c->element[0] = c->element[1] = ELEMENT_NONE;
        c->from = count++;
        cell_split(p, index);
    }
    const uint32_t kept = keep_whole(p, origin);
    elements_add(p, first);
    origin = must_realloc(origin, p->element_count + 1, sizeof *origin);
    for (uint32_t i = kept; i < p->element_count; i++)
        origin[i] =
            q[p->cell[p->element_cell[i] / 2].from].element[p->element_cell[i] & 1];
    free(q);
    patches_enclosure(p);
    patches_connect(p);
    return origin;
}
