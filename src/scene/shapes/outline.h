#ifndef SCENE_SHAPES_OUTLINE_H
#define SCENE_SHAPES_OUTLINE_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "math/gamma.h"
#include "math/vec.h"

struct arena;

// Closed plane curves of lines, parabolas and cubics, filled by the even-odd rule:
// the cross-section of prisms and letters.
//
// Parity is exact: whether a line crosses a piece of curve is decided by the signs of
// its two ends, computed from the stored end points, which neighbours share bit for bit.
// So a line meets a closed loop an even number of times, also through a vertex.
struct outline_segment {
    struct vec2 a, b;       // end points, shared exactly with the neighbours
    struct vec2 c3, c2, c1; // curve(w) = ((c3 w + c2) w + c1) w + a, 0 <= w <= 1
    int degree;             // 1, 2, 3
    struct vec2 middle;     // all of it is within `radius` of this point
    double radius;
};

struct outline {
    struct outline_segment *segment;
    uint32_t count, capacity;
    struct arena *arena;
    struct vec2 min, max; // of the control points
};

void outline_init(struct outline *o, struct arena *arena);
void outline_line(struct outline *o, struct vec2 a, struct vec2 b);
// Bezier control points.
void outline_parabola(struct outline *o, struct vec2 a, struct vec2 control,
                      struct vec2 b);
void outline_cubic(struct outline *o, struct vec2 a, struct vec2 c1, struct vec2 c2,
                   struct vec2 b);

struct vec2 outline_point(const struct outline_segment *s, double w);
struct vec2 outline_tangent(const struct outline_segment *s, double w);

// The parameters w at which the segment crosses the line k.(u, v, 1) = 0, ascending.
// Returns their number.
enum { OUTLINE_ROOTS = 3 };
int outline_roots(const struct outline_segment *s, const double k[3],
                  double w[OUTLINE_ROOTS]);

// Whether the line k, norm = |(k0, k1)|, passes by the segment, clear of the rounding of
// k.(u, v, 1) for points of this size.
static inline bool outline_passes_by(const struct outline_segment *s, const double k[3],
                                     double norm, double size)
{
    const double off = k[0] * s->middle.u + k[1] * s->middle.v + k[2];
    return fabs(off) > s->radius * norm + GAMMA(32) * (norm * size + fabs(k[2]));
}

// The largest of all coordinates.
static inline double outline_size(const struct outline *o)
{
    return fmax(fmax(fabs(o->min.u), fabs(o->max.u)),
                fmax(fabs(o->min.v), fabs(o->max.v)));
}

bool outline_inside(const struct outline *o, struct vec2 p);

#endif
