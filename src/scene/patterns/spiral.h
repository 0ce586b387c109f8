#ifndef SCENE_PATTERNS_SPIRAL_H
#define SCENE_PATTERNS_SPIRAL_H

#include "scene/pattern_math.h"

// The value of spiral1; *radius is the distance from the z axis.
static inline double spiral_value(const struct pattern *p, struct vec3 at, double *radius)
{
    const double r = sqrt(at.x * at.x + at.y * at.y);
    double angle = 0;
    if (r != 0) {
        angle = quick_atan2(at.y, fabs(at.x));
        angle = at.x < 0 ? 3 * PATTERN_PI / 2 - angle : PATTERN_PI / 2 + angle;
    }
    double v = at.z + r + p->integer[0] * angle / (2 * PATTERN_PI);
    if (p->turbulence)
        v += p->turbulence->amount.x * pattern_turbulence(p, at);
    *radius = r;
    return v;
}

#endif
