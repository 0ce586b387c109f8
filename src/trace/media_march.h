#ifndef TRACE_MEDIA_MARCH_H
#define TRACE_MEDIA_MARCH_H

#include "trace/media_lit.h"

// A sample on a stretch. `light` and `depth` are those of an interval that is like the
// sample everywhere.
struct media_sample {
    double t;
    uint32_t interval;
    uint32_t number; // among those of its way that are found together
    struct vec3 light, depth;
};

// Between two samples of method 3, with one in the middle; halves that differ too much are
// spans of their own.
struct media_span {
    uint32_t first, middle, last; // samples
    uint32_t half[2];             // spans; 0: none, since spans come after their parent
};

// The means over a span.
struct media_value {
    struct vec3 light, depth;
};

// What a thread needs to walk through media: rays to the eye and shadow rays have one each,
// because a sample of the one may ask for the other.
struct media_scratch {
    struct arena *arena;
    struct media_sample *sample;
    struct media_span *span;
    struct media_value *value; // of the spans that fill intervals
    uint32_t sample_count, sample_capacity, span_count, span_capacity, value_capacity;
    double *exp; // numbers whose exponentials are asked for together
    uint32_t exp_count, exp_capacity;
    bool air_even; // for shadow rays: what fills the scene is the same everywhere
    struct vec3 air_extinction;
};

enum { WAY_EYE, WAY_SHADOW }; // whose scratch it is
// Tells the random numbers of media that fill the scene from those of a ray's interiors.
enum { MEDIA_AIR_HASH = 11 };

// How the settings of a medium end the random samples of methods 1 and 2: [n], the variance
// of the mean at which n samples are enough (spec/lighting.md 10.5). Of each that has them.
struct media_threshold {
    const struct media *media;
    const double *enough;
    uint32_t most; // samples
};

// One way that is walked, and the lamps that light it.
struct media_walker {
    const struct media_way *way;
    const struct media_lamp *lamp;
    uint32_t lamp_count;
    uint32_t drawn; // random numbers so far
    uint32_t asked; // samples that are found together, so far
};

// Walks along stretches of the same media, whose ends belong to the same light group.
struct media_march {
    struct tracer *t;
    struct media_scratch *scratch;
    const struct media_mix *mix;
    struct media_walker *walker;
    const struct media_interval *interval;
    uint32_t walker_count, interval_count;
    bool depth_only; // light is not asked for
};

enum { MEDIA_SAMPLES = 512 }; // that are found together at most

// Of one walker.
struct media_result media_walk(struct media_march *m);
// What media_walk lets pass of a mix that is the same everywhere, when only depths are asked
// for.
struct vec3 media_even_pass(struct vec3 extinction, double s);

// Whether several ways through the mix may be walked together.
bool media_goes_together(const struct media_mix *mix, bool depth_only);
// The same as media_walk of each walker; i has the intervals from first[i] to before
// first[i + 1], at most media_stride.
void media_walk_together(struct media_march *m, const uint32_t *first,
                         struct media_result *out);
// Intervals that are walked at once, at most.
uint32_t media_stride(const struct media_mix *mix);

// A way to the eye and what lights it (media_lamps); in the arena of its scratch.
struct media_walker media_walker(struct tracer *t, const struct media_way *way,
                                 const uint8_t *missed, uint8_t lane);

// Light that reaches samples from the lamps: added to their `light` (media_light.c);
// scattering: of media there.
void media_samples_lit(struct media_march *m, struct media_sample *sample,
                       const struct vec3 *scattering, uint32_t count);

// The same of light that comes from all around, by way of surfaces.
void media_open_lit(const struct media_march *m, struct media_sample *sample,
                    const struct vec3 *scattering, uint32_t count);

#endif
