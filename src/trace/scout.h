#ifndef TRACE_SCOUT_H
#define TRACE_SCOUT_H

#include "trace/tracer.h"

// Rays whose light nobody looks at: they find where light by way of others is wanted
// (RENDER_SCOUT). A hit that asks for it on one side alone, and from which no ray goes on, need
// not be shaded where it is known; that is found eight hits at a time.

// Finds the surfaces all of whose hits are such.
void scout_compile(struct job *job, struct arena *a);
// Marks the hits of the wave that need not be shaded (tracer.settled).
void scout_settle(struct tracer *t);

#endif
