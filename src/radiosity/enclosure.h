#ifndef RADIOSITY_ENCLOSURE_H
#define RADIOSITY_ENCLOSURE_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "math/vec.h"

struct ray_batch;

#define ELEMENT_NONE UINT32_MAX

// One side of a piece of a surface, over which radiosity is constant. The corners go
// counter-clockwise about the normal; on a curved surface they lie on the surface and
// the polygon is its chord.
struct element {
    struct vec3 corner[4];
    struct vec3 centre, normal; // unit, into the space that the element lights
    double area;                // of the part that exists
    struct rgb reflectance, emission;
    uint32_t surface; // elements of one smooth surface share a number
    uint8_t corner_count;
    bool curved;
    float coverage; // area over that of the polygon
    bool partial;   // some points of the square do not exist
};

// A point of an element from which rays start.
struct element_point {
    struct vec3 p, normal; // unit
    double error;          // bound on the distance between p and the true surface
};

// A set of elements and how they see each other. The functions may be NULL: then points
// lie on the polygons and nothing hides anything. They are called from several threads,
// each with a state of its own.
struct enclosure {
    const struct element *element;
    uint32_t count;
    void *user;
    void *(*thread_begin)(void *user);
    void (*thread_end)(void *state);
    // The point at (u, v) of the unit square, uniform in area on planar elements. False:
    // this part of the element does not exist.
    bool (*point)(void *state, uint32_t element, double u, double v,
                  struct element_point *out);
    // The same without regard to what exists; NULL: the polygon has it.
    bool (*surface)(void *state, uint32_t element, double u, double v, struct vec3 *p);
    // The element beside another in one of 8 directions, 7 - k on the other side of k;
    // ELEMENT_NONE: there is none, or something stands between. NULL: not known.
    uint32_t (*neighbour)(const void *user, uint32_t element, int k);
    // Whether anything can come between points of two elements; NULL: it may.
    bool (*may_hide)(void *state, uint32_t a, uint32_t b);
    // Whether something opaque lies on each ray.
    void (*occluded)(void *state, const struct ray_batch *rays, uint8_t *out);
    // The element each ray meets first, ELEMENT_NONE: it leaves, or meets what takes no
    // part.
    void (*closest)(void *state, const struct ray_batch *rays, uint32_t *out);
};

#endif
