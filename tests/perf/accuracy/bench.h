#ifndef PERF_ACCURACY_BENCH_H
#define PERF_ACCURACY_BENCH_H

#include <stdint.h>

#include "math/vec.h"
#include "scene/boundary.h"

// Speed against accuracy of ways to intersect one thing. A method answers a line with
// parameters t, ascending; it is right when it names as many as the truth and each is within
// `tolerance` of it.
enum { FOUND_MAX = 20 };
struct found {
    int count;
    double t[FOUND_MAX];
};

typedef void meet_line(const void *thing, const struct ray *ray, struct found *out);

// One row of the table: what is met, on which rays, and what is true.
struct trial {
    const char *family, *set;
    const struct ray *ray;
    const struct found *truth;
    int rays;
    double tolerance;
};

// Prints family, set, method, knob, rays a second, share of wrong rays, and of the right
// ones the rms and the largest error of t.
void bench_method(const struct trial *t, const char *method, double knob, meet_line *meet,
                  const void *thing);

// Ascending.
void found_sort(struct found *f);
static inline void found_add(struct found *f, double t)
{
    if (f->count < FOUND_MAX)
        f->t[f->count++] = t;
}

// Uniform in 0..1, the same in every run.
double bench_random(uint64_t *state);
struct vec3 bench_in_cube(uint64_t *state);
// Through two points of the cube from -1 to 1, from outside.
struct ray bench_chord(uint64_t *state);

struct boundary_list *bench_list(void); // one for all, emptied
void *bench_memory(uint64_t bytes);     // never NULL

void bench_quartics(void);
void bench_quadrics(void);
void bench_patches(void);
void bench_csg(void);
void bench_isosurfaces(void);

#endif
