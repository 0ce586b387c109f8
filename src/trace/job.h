#ifndef TRACE_JOB_H
#define TRACE_JOB_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/scene.h"
#include "trace/lamp.h"
#include "trace/render.h"
#include "trace/world.h"

// The lamps that light a surface: by light group, 0 for none.
struct lamp_list {
    const struct lamp *const *lamp;
    uint32_t count;
};

// What a surface lets through of light, where that is the same everywhere.
struct even_pass {
    bool known;
    struct rgb pass;
};

struct bow;
struct media_threshold;
struct photons;
struct surface_kernels;
struct simple_surface;
struct simple_class;
struct paint_surface;
struct shade_kernels;

// Number of wavelengths at which the spectrum of dispersion is tabulated.
enum { SPECTRUM_NODES = 74 };

// Everything a render needs beyond the world, worked out once; const while tracing.
struct job {
    const struct world *world;
    const struct scene *scene;
    const struct camera *camera;
    struct render_settings settings;
    struct lamp *lamp;
    uint32_t lamp_count;
    const struct lamp_list *lamps; // [0] global, [g] of light group g
    int max_level;
    float adc_bailout;
    bool old_opacity; // the rules before 3.7
    bool old_layers;  // and before 3.5
    bool see_through; // the background may show as alpha
    struct rgb ambient_light, irid_wavelength;
    // switched by the quality level (spec/lighting.md 14)
    bool lights, shadows, area_lights, pigments, refraction, mirrors, normals, atmosphere;
    bool air;                          // fogs, rainbows and media act
    float spectrum[SPECTRUM_NODES][3]; // summed from the violet end
    // What a miss sees where that does not depend on the direction: [1] where the
    // background never shows as alpha.
    unsigned hidden_by[2]; // of rays: [1] once they were mirrored
    bool has_air;          // fog, rainbows or media: rays change on their way
    const struct bow *bow; // its rainbows (trace/sky.h)
    bool even_sky;
    struct rgb sky[2];
    float sky_clear[2];
    const struct even_pass
        *pass;                // per surface of the world; NULL: none lets light through
    const struct aabb *clear; // around everything that lets light through
    uint32_t clear_count;
    bool lists_crossings; // shadow rays among them take trace/shadow_list.h
    // Photons (trace/photons.h).
    bool shoots;                              // lamps shoot at targets
    const struct subsurface_plan *subsurface; // trace/subsurface.h; NULL: no light goes
                                              // on below surfaces
    const struct photons *photons;            // NULL: not shot, or nothing to shoot at
    // Media (trace/media.h).
    bool has_media, has_air_media; // somewhere; filling the scene
    const struct media_threshold *media_threshold;
    uint32_t media_threshold_count;
    const struct media_tapes *media_tapes; // of all media, by their addresses
    uint32_t media_tapes_count;
    const struct surface_kernels *surface_kernels;
    // Of the sky's pigments (trace/sky.h); NULL: its colours are found one by one.
    const struct pigment_tape *const *sky_tape;
    // Shading eight hits at a time (trace/simple.h).
    const struct shade_kernels *kernels;
    double reach;      // of rays with PATH_SHORT; 0: none has a limit
    bool general;      // for tests: no hit is shaded in lanes
    bool quick_camera; // its rays are made eight at a time
    bool collects;     // irradiance, whose samples depend on the order of the rays
    const bool *quiet; // per surface (trace/scout.h); NULL: none is
    const struct simple_surface *simple; // per surface of the world
    const struct simple_class *simple_class;
    uint32_t simple_class_count;
    const struct paint_surface *paint; // per surface (trace/paint.h); NULL: none
    uint32_t paint_count;
    bool simple_uv; // some of these surfaces may ask for uv coordinates
};

void job_init(struct job *job, struct arena *a, const struct world *w,
              const struct render_settings *settings);

#endif
