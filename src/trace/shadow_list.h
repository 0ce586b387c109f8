#ifndef TRACE_SHADOW_LIST_H
#define TRACE_SHADOW_LIST_H

#include "trace/tracer.h"

// Shadow rays among transparent objects whose crossings with a ray are all found on one
// walk of the tree: light is dimmed surface by surface, with the bits of trace/shadow.c.
struct shadow_list;

struct shadow_list *shadow_list_new(void);
void shadow_list_free(struct shadow_list *l);
// Takes the lanes of the eight rays of the batch from `first` on; returns those that it
// leaves to others.
unsigned shadow_list_take(struct tracer *t, const struct shadow_batch *b, uint32_t first,
                          unsigned lanes);
// Multiplies into b->pass what the rays taken are dimmed by.
void shadow_list_end(struct tracer *t, const struct shadow_batch *b);

#endif
