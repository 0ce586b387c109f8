#ifndef SCENE_WARP_H
#define SCENE_WARP_H

#include "scene/pattern.h"

// Coordinates past this are of no use to any pattern.
#define WARP_FAR 1e17

// One step of pattern_warp.
struct vec3 warp_point(const struct warp *w, struct vec3 p);
// Whether the classic turbulence moves the point.
bool turbulence_is_warp(const struct pattern *p);

#endif
