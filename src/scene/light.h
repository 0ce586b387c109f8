#ifndef SCENE_LIGHT_H
#define SCENE_LIGHT_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "math/vec.h"

struct object;

enum light_kind { LIGHT_POINT, LIGHT_SPOT, LIGHT_CYLINDER };

struct light {
    enum light_kind kind;
    struct vec3 location;
    struct rgb color;
    bool parallel, shadowless;
    struct vec3 point_at, axis;        // axis: unit(point_at - location)
    double radius, falloff, tightness; // degrees for spots, units for cylinders
    double fade_distance, fade_power;
    // area lights
    bool area, jitter, circular, orient, area_illumination;
    struct vec3 axis1, axis2;
    int size1, size2, adaptive;
    const struct object *looks_like;        // already moved to the light; NULL: none
    const struct object *projected_through; // NULL: none
    bool media_interaction, media_attenuation;
    signed char photon_refraction, photon_reflection; // 1 on, -1 off, 0: not written
    bool photon_area; // photons leave all of an area light
};
extern const struct light light_default;

#endif
