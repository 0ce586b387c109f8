#ifndef TRACE_LAYERS_H
#define TRACE_LAYERS_H

#include "scene/texture.h"
#include "trace/tracer.h"

struct painted;

// Where a texture is looked up while maps are walked downwards: the way back to the
// world, for normals.
struct texture_chain {
    const struct texture_chain *outer;
    const struct transform *transform; // the texture's place in the world, or
    const struct texture *map;         // the map around it
};

// One evaluated layer of one plain texture.
struct layer {
    const struct finish *finish;
    struct vec3 n; // unit, of this layer
    struct rgb color;
    struct rgb filter; // of the layers above, times the texture's weight
    float att;         // opacity
    float trans;       // what the layers above let through
    bool found;
    struct rgb pass; // of the pigment
};

// A surface met by a ray, as the layers see it.
struct surface_view {
    const struct interaction *at;
    struct vec3 d; // of the ray
    struct vec3 n; // the surface's normal, towards the ray
    const struct texture *texture;
    const struct transform *transform;
    // Set by texture_walk: the normal of the layer that was evaluated last. Maps by slope
    // see it in the textures after it, as the language's first program has it.
    struct vec3 *seen;
    // Of the layers of the plain texture at hand (trace/paint.h); NULL: none.
    const struct painted *painted;
};

// Finds the texture of the side that was met and turns the normal to the ray.
void surface_view_init(struct surface_view *v, const struct interaction *at,
                       struct vec3 d);

// Calls `plain` for every plain texture that counts at the point, with its weight.
typedef void plain_function(void *user, const struct surface_view *v,
                            const struct texture *texture, const struct texture_point *at,
                            const struct texture_chain *chain, double weight);
void texture_walk(struct tracer *t, const struct surface_view *v, plain_function *plain,
                  void *user);

// Normal and pigment of one layer; filter and trans are the caller's.
void layer_eval(const struct tracer *t, const struct surface_view *v,
                const struct texture_layer *layer, const struct texture_point *at,
                const struct texture_chain *chain, bool want_normal, struct layer *out);
// The same of one that is evaluated already.
void layer_painted(const struct tracer *t, const struct texture_layer *layer,
                   const struct painted *painted, struct layer *out);

#endif
