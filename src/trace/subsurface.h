#ifndef TRACE_SUBSURFACE_H
#define TRACE_SUBSURFACE_H

#include "trace/shade.h"

// Light that goes in beside the point that is seen and comes out there (spec/lighting.md
// 13; Jensen and others 2001): replaces the diffuse light of a layer.
void shade_subsurface(struct shading *s, const struct layer *l);
// What a job keeps for it (subsurface_plan.c).
const struct subsurface_plan *subsurface_plan_new(const struct job *job, struct arena *a);

#endif
