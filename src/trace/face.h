#ifndef TRACE_FACE_H
#define TRACE_FACE_H

// Faces of leaves in world space, described so that those which lie in one place are found
// however they were placed (face_pairs.h).
#include "trace/world.h"

// A direction that no scene's author had in mind.
static const struct vec3 face_odd = {.5413, .3178, .7791};

// What is round is taken for the square around it.
struct flat_face {
    struct vec3 corner[4]; // or a point on the plane
    uint32_t corners;      // 0: it has no end
    struct vec3 normal;    // outward, unit
};

// Where x form x + gradient.x + value = 0, x = point - origin, form of unit size; or some
// other surface of its kind, which `more` tells from others.
struct curved_face {
    const void *kind; // of what shape, or the shape itself
    struct vec3 origin, gradient;
    double form[6]; // xx, yy, zz, xy, xz, yz of the symmetric matrix
    double value;
    double more[9];
    double own; // some number of the shape's, to tell shapes apart at once
};

struct face {
    bool flat;
    union {
        struct flat_face plane;
        struct curved_face curve;
    };
    double error; // bounds how far from the true place it lies
    uint32_t leaf;
    bool sheet;      // seen from both sides
    bool inward;     // of curved ones: it looks to where the equation is negative
    bool clear;      // lets light through
    double key;      // nearly equal for faces that nearly lie in one place
    double from, to; // along `face_odd`
};

struct faces {
    struct face *at;
    uint32_t count, capacity;
};

// A new one, zeroed.
struct face *faces_add(struct faces *f);

// Adds the faces of a leaf. The caller fills leaf and clear, and finds from and to.
void flat_faces(const struct leaf *l, struct faces *out);
void curved_faces(const struct leaf *l, struct faces *out);

// What holds all of the face.
struct aabb flat_face_box(const struct flat_face *f, double error);

// Whether they lie in one place; flat ones also whether they overlap.
bool flat_faces_coincide(const struct face *f, const struct face *g);
bool curved_faces_coincide(const struct face *f, const struct face *g);

#endif
