#ifndef SCENE_EFFECTS_H
#define SCENE_EFFECTS_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"

struct pigment;

// Media (spec/lighting.md 10.1). Densities multiply; each is a pigment whose colour
// is the density, without the default pigment below it.
struct media {
    int method, intervals, samples_min, samples_max;
    float confidence, variance, ratio;
    struct rgb absorption, emission, scattering;
    int scattering_type; // 0: none
    float eccentricity, extinction;
    const struct pigment *const *density;
    uint32_t density_count;
    int aa_level;
    float aa_threshold, jitter;
    bool collect;
};

// global_settings { photons {} } (spec/lighting.md 11.1).
struct photon_settings {
    bool on;
    double spacing, jitter, autostop;
    int count, gather_min, gather_max, media_steps;
    double media_factor;
    double radius[4]; // < 0: chosen automatically
    double expand_increase;
    int expand_min;
    int max_trace_level; // 0: the scene's
    double adc_bailout;  // < 0: the scene's
    const char *load_file, *save_file;
};

// global_settings { radiosity {} } (spec/lighting.md 12.1).
struct radiosity_settings {
    bool on;
    double pretrace_start, pretrace_end, error_bound, low_error_factor, gray_threshold;
    double minimum_reuse, maximum_reuse, adc_bailout, brightness, max_sample;
    double importance; // of objects that do not say
    int count, count_directions, nearest_count, nearest_adaptive, recursion_limit;
    bool normal, media, always_sample, subsurface;
};

struct subsurface_settings {
    bool on, radiosity;
    int samples_diffuse, samples_single;
};

// photons {} of an object (spec/lighting.md 11.1).
struct photon_target {
    bool target, pass_through, collect;
    signed char refraction, reflection; // 1 on, -1 off, 0: not written
    double spacing;                     // factor of `target`
};

#endif
