#ifndef SCENE_TAPE_H
#define SCENE_TAPE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "math/interval.h"
#include "math/vec.h"

// A function of the scene as straight-line code over numbered registers. Built by
// tape_build.h; constant afterwards and shared by all threads.
//
// Four ways to run it, of which the first two give the same bits:
//   tape_run        one point
//   tape_run_packet eight points
//   tape_bounds     boxes of arguments: bounds that hold the value at every point, with
//                   bounds of the partial derivatives if wanted
//   tape_gradient   one point with the derivatives (forward mode)
// (Griewank and Walther, Evaluating Derivatives, 2008, chapter 3; Duff, Interval
// Arithmetic and Recursive Subdivision for Implicit Functions, 1992.)

struct tape;

enum { TAPE_LANES = 8, TAPE_ARGUMENTS_MAX = 56, TAPE_WIDTH_MAX = 5, TAPE_PARTIALS = 3 };

int tape_arguments(const struct tape *t);
int tape_width(const struct tape *t); // results: 1, or those of a vector function
// Something in it has no bounds that shrink with the box (an image, a fractal): those of
// its values may be wide, and those of its slopes the whole line, however small the box.
bool tape_is_opaque(const struct tape *t);
uint32_t tape_length(const struct tape *t); // steps
// Whether both do the same steps with the same numbers and the same data.
bool tape_equal(const struct tape *t, const struct tape *u);

// False: sum and prod, all loops inside of one together, would take more turns than this;
// what hangs on them is no number then.
bool tape_run(const struct tape *t, const double *argument, double *out);
enum { TAPE_TURNS_MAX = 1000000 };
double tape_turns(double from, double to); // of one loop; infinite: no counter can do it
void tape_run_packet(const struct tape *t, const double (*argument)[TAPE_LANES],
                     double (*out)[TAPE_LANES]);
// d out[0] / d argument[i] for the first `partials` (up to 3) arguments; returns out[0].
// Where a slope jumps it is that of one side; inside an opaque part it is a difference.
double tape_gradient(const struct tape *t, const double *argument, int partials,
                     double *gradient);

// A value and, of its derivative by each of up to three directions, the bounds.
struct tape_slope {
    struct interval v, d[TAPE_PARTIALS];
};
// Bounds of out[0] alone. Where the function jumps in the box the bounds of the
// derivatives below are the whole line.
struct interval tape_bounds(const struct tape *t, const struct interval *argument);
// argument[i].d[k] says how argument i changes with direction k < directions.
struct tape_slope tape_bounds_slope(const struct tape *t,
                                    const struct tape_slope *argument, int directions);
// Of all results, as many as tape_width says.
void tape_bounds_all(const struct tape *t, const struct tape_slope *argument,
                     int directions, struct tape_slope *out);
// Of all results over eight boxes of x, y, z at once, with the slopes by these if wanted: the bounds
// hold, as those of tape_bounds_slope, of which they are the same up to a few roundings.
struct tape_boxes {
    double lo[3][TAPE_LANES], hi[3][TAPE_LANES];
};
struct tape_slopes {
    double lo[TAPE_LANES], hi[TAPE_LANES];
    double slope_lo[3][TAPE_LANES], slope_hi[3][TAPE_LANES];
};
void tape_bounds_packet(const struct tape *t, const struct tape_boxes *in, bool slopes,
                        struct tape_slopes *out);
double tape_at(const void *tape, struct vec3 p); // of x, y, z; as pattern.function wants

// As an expression of the scene language.
void tape_print(const struct tape *t, FILE *out);

struct noise_kernels; // scene/noise_kernel.h
struct tape_range8 {
    double lo[TAPE_LANES], hi[TAPE_LANES];
};

// A function in C that a tape calls. `bounds` fills out and, if partial is not NULL,
// partial[i * arguments + k] = d out[i] / d in[k]; NULL: nothing is known. `opaque` says that
// they do not shrink with the box; NULL: they do. `anywhere`: they
// hold for arguments of the whole line too, and for what is no number. `expand`
// writes it in steps instead, for arguments of which enough are constant (tape_build.h).
struct tape_builder;
struct tape_extern {
    const char *name;
    int arguments, width;
    void (*value)(const void *data, const double *in, double *out);
    // The same bits at eight points, and the same bounds but for roundings over eight
    // boxes, with the kernels of an instruction set; NULL, or false for these: one by one.
    void (*values)(const struct noise_kernels *k, const void *data,
                   const double (*in)[TAPE_LANES], double (*out)[TAPE_LANES]);
    bool (*bounds8)(const struct noise_kernels *k, const void *data,
                    const struct tape_range8 *in, struct tape_range8 *out,
                    struct tape_range8 *partial);
    void (*bounds)(const void *data, const struct interval *in, struct interval *out,
                   struct interval *partial);
    bool (*opaque)(const void *data);
    bool anywhere;
    bool (*expand)(struct tape_builder *b, const void *data, const uint32_t *in,
                   uint32_t *out);
};
enum { TAPE_EXTERN_ARGUMENTS = 16 };

#endif
