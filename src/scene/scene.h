#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "scene/camera.h"
#include "scene/effects.h"
#include "scene/light.h"
#include "scene/object.h"
#include "scene/texture.h"

enum fog_type { FOG_CONSTANT = 1, FOG_GROUND = 2 };

struct fog {
    enum fog_type type;
    double distance, alt, offset;
    struct vec3 up; // unit
    struct rgbft color;
    bool has_turbulence;
    struct turbulence turbulence;
    double turb_depth;
};

struct rainbow {
    double angle; // degrees, of the inner edge: as written less half the width
    double width, distance, jitter, arc_angle, falloff_angle; // degrees
    struct vec3 direction, up;
    const struct color_map *colors;
};

struct sky_sphere {
    const struct pigment *const *pigment; // in written order
    uint32_t count;
    struct rgb emission;
};

// How scene numbers become linear light (spec/lighting.md 3.1-3.3).
enum gamma_mode { GAMMA_NONE, GAMMA_POWER, GAMMA_SRGB };

struct settings {
    int version; // effective, 100*f: 362 when no #version was seen
    enum gamma_mode gamma_mode;
    double assumed_gamma;
    int max_trace_level;
    float adc_bailout;
    struct rgb ambient_light, irid_wavelength;
    int noise_generator, number_of_waves;
    bool radiosity; // the scene has a radiosity{} block
    double mm_per_unit;
    struct radiosity_settings radiosity_settings;
    struct photon_settings photons;
    struct subsurface_settings subsurface;
};

// What #default named before it named something else.
struct past_default {
    uint32_t until; // of scene.object: its texture is that of the objects before
    struct attached_texture texture;
};

// Everything the language described; const while rendering.
struct scene {
    struct camera camera;
    bool has_camera;
    struct settings settings;
    struct rgbft background;
    bool has_background;
    const struct sky_sphere *sky; // NULL: none
    const struct fog *const *fog; // in written order
    uint32_t fog_count;
    const struct rainbow *const *rainbow;
    uint32_t rainbow_count;
    const struct media *const *media; // filling the whole scene
    uint32_t media_count;
    const struct object *const *object; // top level, in written order, lights too
    uint32_t object_count;
    struct attached_texture default_texture;        // of objects that have none
    const struct past_default *const *past_default; // in written order
    uint32_t past_default_count;
};

#endif
