#ifndef TRACE_SIMPLE_H
#define TRACE_SIMPLE_H

#include "trace/tracer.h"

// Simple surfaces have one layer, and their light follows from finish, lamps, and the
// colour and normal at the point; what lets light through has one colour everywhere.
// Their hits are shaded eight at a time (trace/shade_kernel.h), with the arithmetic, and
// hence the bits, of trace/shade.c.

#define SIMPLE_NONE UINT32_MAX

// All surfaces whose light has the same rule.
struct simple_class {
    const struct finish *finish;
    uint32_t light_group;
    const struct lamp_list *lamps;
    struct rgb own; // light given off, before it is multiplied by the colour
    bool side_test; // light from behind counts apart
    bool takes_light, mirror;
    bool clear;    // lets light through
    bool collects; // gathers photons
};

enum simple_pigment {
    SIMPLE_SOLID,
    SIMPLE_CHECKER, // two colours, moved by transforms alone
    SIMPLE_TAPE,    // any other pigment that lets no light through
};

struct simple_surface {
    uint32_t class; // SIMPLE_NONE: not simple
    enum simple_pigment kind;
    struct rgb color[2];
    float att;       // opacity
    struct rgb pass; // of the pigment
    const struct pigment *pigment;
    const struct pigment_tape *tape; // SIMPLE_CHECKER, SIMPLE_TAPE
    const struct normal *normal;     // NULL: none
};

// Eight hits of one class. Lanes that are not live repeat one that is.
struct simple_group {
    _Alignas(64) double d[3][8];
    double p[3][8], error[8]; // of the ray; the point, as struct interaction
    double n[3][8], ng[3][8]; // n: towards the ray
    double uv[2][8];          // where a surface may ask for them
    float color[3][8], att[8], through[3][8];
    uint16_t slot[8];
    uint32_t ray[8];
    unsigned live;
    unsigned bare;   // lanes whose pigment has no colour there: they are not live
    unsigned turned; // lanes that see the side that the surface's normal points away from
    bool in_row;     // eight slots in a row
};

// Where the light of a group goes on: mirrored, and through the surface.
struct simple_bounce {
    // Asked for:
    double eta[8], index[8];     // ratio of ior, index of Fresnel's formula
    float from_weight[8], least; // weights of the rays that came; adc_bailout
    float pass[3][8];            // of the pigment, where the class is clear
    float fade[3][8];            // of the way here: what exp of `exponent` is multiplied
    double exponent[3][8];       // by in the lanes `fading`, all of it in others
    unsigned fading, straight;   // straight: light goes on as it came
    // Answered:
    double mirror_d[3][8], mirror_o[3][8], bent_d[3][8], bent_o[3][8];
    float mirror[3][8], weight[8]; // finish_reflectivity
    // `through` and weight of rays that are mirrored, reflected totally, bent or straight on.
    float mirrored[3][8], mirror_weight[8];
    float back[3][8], bent[3][8], bent_weight[8], clarity[8]; // clarity: times through_t
    unsigned total;                                           // lanes of total reflection
    unsigned mirrors;        // lanes whose mirrored rays count
    unsigned passes, counts; // lanes where anything passes; where it counts
};

// Whether each point of the light's grid lights for itself (area_illumination).
static inline bool lamp_has_lightlets(const struct job *job, const struct light *l)
{
    return l->area && l->area_illumination && job->area_lights && job->shadows;
}
// Whether eight points can be lit by them at a time.
bool lamps_are_simple(const struct job *job, const struct lamp_list *list);
void simple_compile(struct job *job, struct arena *a);
void simple_init(struct tracer *t);
void simple_end(struct tracer *t);
// Keeps the hits of `count` rays of the batch from k on, all of one leaf, if its surface is
// simple.
bool simple_take(struct tracer *t, uint32_t k, uint32_t count);
// Where the order of hits counts for light by way of others (job.collects): asks for that of
// rays from k to end, which were kept.
void simple_ask(struct tracer *t, uint32_t k, uint32_t end);
// Shades the hits that were kept.
void simple_shade(struct tracer *t);
// The light of photons on a group (trace/shade_photons.c).
void simple_photons(struct tracer *t, const struct simple_class *c,
                    const struct simple_group *g);
// The rays that go on from a group (trace/simple_bounce.c).
void simple_bounce(struct tracer *t, const struct simple_class *c,
                   const struct simple_group *g);
// The rays that came to the lanes of a group; those from the camera are made, in `made`.
void bounce_from(const struct tracer *t, const struct simple_group *g, unsigned lanes,
                 struct path made[8], const struct path *from[8]);
// Sends on what b->mirrors says; way: of the lane's random numbers.
void bounce_mirrors(struct tracer *t, const struct simple_group *g,
                    const struct path *const from[8], const struct simple_bounce *b,
                    const uint32_t way[8]);

#endif
