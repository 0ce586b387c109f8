#ifndef TRACE_SHADE_H
#define TRACE_SHADE_H

#include "trace/layers.h"

enum { HIT_LAYERS = 32 };

struct plain_result;

// A hit being shaded: the layers of all its textures.
struct shading {
    struct tracer *t;
    const struct path *path; // as it arrives at the surface
    double s;                // length of the ray
    struct interaction at;
    struct surface_view view;
    struct layer *layer;
    uint32_t layer_count, layer_capacity;
    bool dark; // for photons: what layers give off by themselves is left out
    const struct contact *contact; // with other clear bodies (contact.h); NULL: none
    // What becomes of the rays that go on from one plain texture.
    void (*go_on)(struct shading *s, const struct plain_result *r);
    void *user; // of go_on
    struct layer few[HIT_LAYERS];
};

// The layers of one plain texture, for texture_walk; the user is the shading.
plain_function shade_plain;

struct paint_part;
// shade_hit of a hit whose interaction is known, and whose textures are evaluated
// (trace/paint.h). No parts: they are not. known: the light by way of others in front of it;
// NULL: it is asked for.
void shade_painted(struct tracer *t, const struct path *path, const struct hit *hit,
                   const struct interaction *at, const struct paint_part *part,
                   uint32_t part_count, const struct rgb *known);

// Direct light of all lamps on all layers (shade_light.c).
void shade_lights(struct shading *s);
// A hit as light by way of other surfaces is asked for: n is the layer's, towards the ray,
// path as it arrives at the surface.
struct indirect_hit {
    const struct ray *ray;
    const struct hit *hit;
    const struct interaction *at;
    struct vec3 n;
    const struct path *path;
};
// The matt part of all layers that is worth asking for, and the first such layer.
struct rgb matt_part(const struct shading *s, bool back, const struct layer **first);
struct rgb indirect_light(struct tracer *t, const struct indirect_hit *h, bool back);
// What all layers send to the eye of light of colour 1 from `to`; lamp: NULL for photons.
struct rgb layers_lit(const struct shading *s, const struct lamp *lamp, struct vec3 to,
                      bool side_test);
// Iridescence for light from l (spec/lighting.md 5.3).
struct rgb irid_factor(const struct shading *s, const struct finish *f, struct vec3 n,
                       struct vec3 l);
// How metals tint what they mirror (spec/lighting.md 5.4).
struct rgb metal_tint(struct rgb c, struct rgb tint, float metallic, double cosine);

// Rays that go on from layers [begin, end) of one plain texture (shade_transmit.c).
// trans and filter: what its layers let through together; any: some layer had a colour.
struct plain_result {
    uint32_t begin, end;
    float weight;
    float trans;
    struct rgb filter; // with the weight
    bool any;
};
void shade_transmit(struct shading *s, const struct plain_result *r);
// Its two halves. False: the light was reflected totally, along the top layer's normal.
bool shade_refract(struct shading *s, const struct plain_result *r);
// except: a normal along which there is no mirror; NULL: none.
void shade_mirrors(struct shading *s, const struct plain_result *r,
                   const struct vec3 *except);
// The index of Fresnel's formula seen from the ray (spec/lighting.md 5.5).
double fresnel_index(const struct inside *list, const struct interior *interior);
// Fresnel's reflectance of unpolarised light.
float fresnel_reflectance(double cosine, double index);
// Its factor on what a mirror shows, at this cosine between normal and eye; *weight is
// what it counts for adc_bailout (spec/lighting.md 5.4). index: of Fresnel's formula, where the
// finish has it.
struct rgb finish_reflectivity(const struct finish *f, double cosine, struct rgb color,
                               double index, float *weight);
// How a crossing changes the interiors and what the two sides are (spec/lighting.md
// 6.2). NULL stands for the open air.
struct crossing_sides {
    const struct interior *from, *to;
    const struct inside *inside;
    bool straight;
};
struct crossing_sides interior_cross(struct tracer *t, const struct inside *list,
                                     const struct interior *x);
// The ratio of the indices of refraction.
double crossing_eta(const struct crossing_sides *c);
// A of spec/lighting.md 6.4 for a way of length s that ends at a surface of x.
struct rgb way_fade(const struct interior *x, const struct inside *inside, double s);
bool finish_has_mirror(const struct finish *f);
bool finish_takes_light(const struct finish *f);
struct rgb layer_reflectivity(const struct shading *s, const struct layer *l,
                              float *weight);
struct vec3 mirrored(struct vec3 d, struct vec3 n, struct vec3 surface);

#endif
