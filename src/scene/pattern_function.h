#ifndef SCENE_PATTERN_FUNCTION_H
#define SCENE_PATTERN_FUNCTION_H

#include "scene/tape.h"
#include "scene/texture.h"

// Patterns and pigments as functions of the scene: externs of x, y, z, whose data
// pattern_function and pigment_function make. Values are those of pattern_value and
// pigment_color where no surface is; bounds are those of their formulas.
extern const struct tape_extern pattern_extern, pigment_extern;

// p is kept; `work` holds what is needed meanwhile.
const void *pattern_function(struct arena *a, struct arena *work,
                             const struct pattern *p);
const void *pigment_function(struct arena *a, struct arena *work,
                             const struct pigment *p);

#endif
