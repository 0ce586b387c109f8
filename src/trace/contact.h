#ifndef TRACE_CONTACT_H
#define TRACE_CONTACT_H

// Clear bodies in contact (water in a glass, lenses that are cemented): where faces of two of
// them lie in one place a ray crosses both at once, with no gap between, which rounding would
// else open for some rays and not for others. How it bends and what is mirrored follow from the
// interiors before and behind all of them; each takes away its part of the light.
#include "trace/shade.h"

struct contact {
    struct crossing_sides sides;
    // Of the other faces, and of the ways through interiors that end there.
    struct rgb pass;
};

// What is in contact where the shading's hit is, in the tracer's arena; NULL: nothing.
const struct contact *contact_at(const struct shading *s);
// What light that goes on through the shading's hit crosses.
struct crossing_sides shading_crosses(const struct shading *s);

#endif
