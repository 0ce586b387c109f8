// Rays on their way to be traced, in queues.
#include "trace/wave.h"

#include <stdlib.h>

#include "base/memory.h"

void path_queue_reserve(struct path_queue *q, uint32_t count)
{
    while (q->count + count > q->capacity) {
        q->capacity = q->capacity ? 2 * q->capacity : 256;
        q->at = must_realloc(q->at, q->capacity, sizeof *q->at);
        q->order = must_realloc(q->order, q->capacity, sizeof *q->order);
    }
}

struct path *path_queue_add(struct path_queue *q)
{
    path_queue_reserve(q, 1);
    q->order[q->count] = q->count;
    return &q->at[q->count++];
}

void path_queue_free(struct path_queue *q)
{
    free(q->at);
    free(q->order);
}

void path_emit(struct tracer *t, const struct path *path)
{
    if (!path_counts(t->job, path->level, path->weight))
        return;
    struct path *p = path_queue_add(t->wave.next);
    *p = *path;
    p->parent = (uint16_t)t->slot;
    p->key = 0;
}

void power_emit(struct tracer *t, const struct path *path, struct rgb factor,
                float exponent)
{
    if (!path_counts(t->job, path->level, path->weight))
        return;
    t->power = must_grow(t->power, t->power_count, &t->power_capacity, sizeof *t->power);
    t->power[t->power_count++] =
        (struct power_request){*path, factor, exponent, path->sample};
}

void path_queue_sort(struct path_queue *q, uint32_t first)
{
    uint32_t begin[BATCH_SIZE + 1] = {0};
    bool sorted = true;
    for (uint32_t i = first + 1; i < q->count && sorted; i++)
        sorted = q->at[i - 1].parent <= q->at[i].parent;
    if (sorted)
        return;
    for (uint32_t i = first; i < q->count; i++)
        begin[q->at[i].parent + 1]++;
    for (int i = 1; i <= BATCH_SIZE; i++)
        begin[i] += begin[i - 1];
    for (uint32_t i = first; i < q->count; i++)
        q->order[first + begin[q->at[i].parent]++] = i;
}
