#ifndef TRACE_INDIRECT_H
#define TRACE_INDIRECT_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "trace/intersect.h"

struct tracer;
struct inside;

// A hit whose light by way of others is asked for.
struct indirect_query {
    const struct ray *ray;
    const struct hit *hit;
    const struct interaction *at;
    struct vec3 n;    // unit, of the side that is asked for; a layer's where those count
    struct vec3 side; // unit, of the bare surface, on the same side
    float weight;     // of the ray, for adc_bailout
    const struct inside *inside; // the interiors of that side
    uint32_t hash, sample;       // of the ray
    uint16_t level;              // of the ray, this hit counted
};

// Eight hits of which not more need be known; p, n and weight are those of a query.
struct indirect_eight {
    double p[3][8], n[3][8];
    float weight[8];
    unsigned lanes; // which of them ask
};

// Light that comes from one direction, as a lamp's does.
struct open_beam {
    double light[3];
    struct vec3 to; // unit, towards what it comes from
};

// Light that comes to a point in the open from all around, by channel: the integral of its
// radiance over the sphere, over pi, and the same of radiance times the direction it is
// seen in. A lamp of colour 1 is 1, and its direction. What comes from something small is not
// among it, but a beam.
enum { OPEN_BEAMS = 32 };
struct open_light {
    double all[3];
    struct vec3 from[3];
    struct open_beam beam[OPEN_BEAMS];
    uint32_t beam_count;
};

// Light that reaches surfaces by way of others, worked out before the picture.
struct indirect {
    const void *data; // NULL: there is none
    // What a tracer keeps for it; both may be NULL.
    void *(*begin)(const void *data);
    void (*end)(void *state);
    // Irradiance, in units in which a matt white surface shows it as its colour. May trace
    // with the tracer's scratch.
    struct rgb (*irradiance)(const void *data, void *state, struct tracer *t,
                             const struct indirect_query *q);
    // The same for eight hits, where it is known without a ray; returns the lanes that it has
    // answered. May be NULL.
    unsigned (*known)(const void *data, void *state, const struct indirect_eight *q,
                      struct rgb out[8]);
    // Of hits whose light nobody looks at: those that would be answered without a ray. NULL: the
    // light is wanted.
    unsigned (*settled)(const void *data, void *state, const struct indirect_eight *q);
    // What lights media besides lamps. NULL: nothing.
    void (*open)(const void *data, struct vec3 p, struct open_light *out);
    float least;        // of a layer's matt share that is worth asking
    bool layer_normals; // ask with the normal of the first layer, not the surface's
    bool both_sides;    // ask for light from behind as well, where finishes use it
    bool no_ambient;    // and `ambient` of finishes counts nothing
};

#endif
