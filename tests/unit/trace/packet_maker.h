#ifndef TESTS_PACKET_MAKER_H
#define TESTS_PACKET_MAKER_H

// Random worlds, and the check that packets, single rays and the plain sweep over every object
// find the same boundaries in them.
#include <stdbool.h>
#include <stdint.h>

#include "plain_textures.h"
#include "scene/object.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/quadric.h"

enum { OBJECTS = 400 };

struct maker {
    struct arena *a;
    const struct object *object[OBJECTS];
    uint32_t count;
    uint64_t random;
    int crossed; // surfaces in lists of all that a ray crosses
    int empty;   // shafts with nothing in them
    bool alone;  // the one-ray form is the reference, not all crossings
    bool grid;   // coordinates are multiples of 1/4, nothing is turned: faces coincide
    bool middle; // the camera is at the origin, or close to it
};

// Rounded where coordinates are to be.
double between(struct maker *m, double lo, double hi);
double chance(struct maker *m); // from 0 to 1
struct vec3 somewhere(struct maker *m, double size);
struct object *of(struct maker *m, const struct shape_ops *ops, const void *shape);
struct cone random_cone(struct maker *m, struct vec3 c, double r);
struct quadric random_quadric(struct maker *m, struct vec3 c, double r);
struct object *random_triangle(struct maker *m, struct vec3 c);
struct object *random_shape(struct maker *m);
// Adds an object somewhere within that distance of the middle.
void add_within(struct maker *m, struct object *o, double far);
// The scene as it was made, with every instruction set there is.
void check_scene(struct maker *m);
// The same; the scene is not needed any more.
void check_made(struct maker *m);
// These rays, at most 1000, in the scene as it was made; returns how many meet something.
int check_rays(struct maker *m, const struct vec3 *o, const struct vec3 *d,
               uint32_t count);
// A scene of `count` objects. Returns the surfaces in lists of all that rays cross.
int check_random(uint64_t seed, int count, int depth, double apart, bool grid);

#endif
