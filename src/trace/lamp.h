#ifndef TRACE_LAMP_H
#define TRACE_LAMP_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "math/vec.h"
#include "scene/light.h"

struct window;

// A light prepared for rendering: what does not change from point to point.
struct lamp {
    const struct light *light;
    const struct window *window;    // that it shines through; NULL: none
    double cos_radius, cos_falloff; // spots
    uint32_t index;                 // over all lamps of the render
    bool inert;                     // adds nothing, as if it were black
    bool dull;                      // makes no highlights
};

void lamp_init(struct lamp *lamp, const struct light *light, uint32_t index);

// A light as seen from a point (spec/lighting.md 8.2): unit direction towards it,
// distance (negative beyond a parallel light's plane) and unshadowed colour.
struct lamp_view {
    struct vec3 l;
    double distance;
    struct rgb color;
};

// From `p` to the point `at` of the lamp: the centre, or a sample of an area light.
// False: dark there.
bool lamp_view(const struct lamp *lamp, struct vec3 at, struct vec3 p,
               struct lamp_view *out);
// Without the attenuation of 8.3.
void lamp_direction(const struct lamp *lamp, struct vec3 at, struct vec3 p,
                    struct lamp_view *out);
// The factor of 8.3; `v` from lamp_direction.
double lamp_attenuation(const struct lamp *lamp, struct vec3 at, struct vec3 p,
                        const struct lamp_view *v);

// The grid of an area light as it is turned towards a point.
struct lamp_grid {
    struct vec3 axis1, axis2;
};
struct lamp_grid lamp_grid_of(const struct lamp *lamp, struct vec3 p);
// Its point (u, v); a jittered one has fractions (spec/lighting.md 8.4).
struct vec3 lamp_grid_point(const struct lamp *lamp, const struct lamp_grid *g, double u,
                            double v);

#endif
