#ifndef SCENE_SHAPES_SUPERELLIPSOID_WALK_H
#define SCENE_SHAPES_SUPERELLIPSOID_WALK_H

#include "scene/shapes/superellipsoid.h"

// What superellipsoid.c and superellipsoid_walk.c share: F along a line, and the walk along the
// lines of one that is not convex.

struct superellipsoid_sample {
    double f, slope; // F and its derivative along the line
};

// The gradient of F at a point, and F itself.
struct vec3 superellipsoid_gradient(const struct superellipsoid *s, struct vec3 p,
                                    double *f);

struct superellipsoid_line {
    const struct superellipsoid *s;
    struct vec3 o, u; // unit direction, o nearest to the centre
    double shift, length;
    double noise; // bound on the error of F: its numbers are near one, and see quick_pow
};

struct superellipsoid_line superellipsoid_line(const struct superellipsoid *s,
                                               const struct ray *ray);
struct superellipsoid_sample superellipsoid_at(const struct superellipsoid_line *l,
                                               double t);
// The stretch of the line within the cube that holds the surface; false: there is none.
bool superellipsoid_in_cube(const struct superellipsoid_line *l, double *a, double *b);

// A place where F was looked at.
struct superellipsoid_place {
    double t, f;
};

// Between which F crosses zero.
struct superellipsoid_bracket {
    struct superellipsoid_place a, b;
    bool enters;
};

// Where in a bracket to begin to look for the root.
double superellipsoid_first_guess(const struct superellipsoid_bracket *x);

// Where a line may be cut: its ends and nine planes, and the pieces between them.
enum { STOPS = 11, PIECES = 4 };

// Where a line is sampled, and what F is there; eight places at a time, if there are kernels.
enum { PLACES = (STOPS - 1) * PIECES + 1, ROOM = (PLACES + 7) / 8 * 8 };

struct superellipsoid_stops {
    struct superellipsoid_line line;
    const struct shape_kernels *kernels; // NULL: one place at a time
    int count;
    double t[ROOM], f[ROOM], slope[ROOM];
};

// On the way along a line from bracket to bracket.
struct superellipsoid_walk {
    struct superellipsoid_stops s;
    int i; // of the last sample
    bool in, again;
    struct superellipsoid_sample before;
    struct superellipsoid_place last;
    struct superellipsoid_bracket second; // if `again`
};

// The part of a line where the ray may meet the surface; false: there is none. k: NULL, one
// place at a time.
bool superellipsoid_walk_begin(struct superellipsoid_walk *w,
                               const struct shape_kernels *k,
                               const struct superellipsoid *s, const struct ray *ray);
// The next bracket; false: there is none.
bool superellipsoid_walk_next(struct superellipsoid_walk *w,
                              struct superellipsoid_bracket *out);

#endif
