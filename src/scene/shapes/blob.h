#ifndef SCENE_SHAPES_BLOB_H
#define SCENE_SHAPES_BLOB_H

#include "math/bvh8.h"
#include "math/transform.h"
#include "scene/shape_kernels.h"

struct arena;
struct texture;

enum blob_part { PART_BALL, PART_STRAIGHT, PART_BASE, PART_APEX };

struct blob_component {
    enum blob_part kind;
    // Centre, or base of a cylinder, from where all its parts measure their share of the
    // axis, so that none overlap and no gap is left; unit axis towards the apex.
    struct vec3 c, axis;
    double length, r, s;
    struct transform transform;    // blob from component space
    const struct texture *texture; // NULL: the blob's
};

// A component is nowhere outside of this ball.
struct blob_reach {
    struct vec3 c;
    double r2; // squared
};

struct blob {
    struct blob_component *at;
    struct blob_reach *reach; // of each
    uint32_t count, capacity;
    double threshold;
    struct bvh8 tree; // of the components' boxes; no node: they are few
};

void blob_make_tree(struct blob *b, struct arena *a);
struct aabb blob_component_box(const struct blob_component *c);

// The components that may reach a point.
struct blob_near {
    const struct blob *blob;
    uint32_t next, last;
    float p[3];
    struct bvh8_walk walk;
};

void blob_near_begin(struct blob_near *n, const struct blob *b, struct vec3 p);
bool blob_near_in_tree(struct blob_near *n, uint32_t *i);

static inline bool blob_near_next(struct blob_near *n, uint32_t *i)
{
    if (n->blob->tree.node)
        return blob_near_in_tree(n, i);
    *i = n->next++;
    return *i < n->last;
}

// A component on a line: q(t) = 1 - d^2/r^2 = top + bend (t - at)^2 for lo < t < hi. About the
// nearest point, so that a thin component keeps its digits on a line from afar.
struct blob_stretch {
    double lo, hi, s, top, at, bend;
    double peak; // the field is never above
};

void blob_intersect(const struct blob *b, const struct ray *ray,
                    struct boundary_list *out);

// A line in the blob's space, p(t) = o + t u with |u| = 1, and where the ray is on it.
struct blob_line {
    double t_min, t_max;  // of the ray
    double shift, length; // t of the line = length t of the ray - shift
    double noise;         // what the rounding of o makes of t
};

// A walk along a line over `count` stretches, which are all that reach into the ray's range,
// for the first crossing with t > t_min.
struct blob_walk {
    const struct blob *blob;
    const struct blob_stretch *at;
    const double *end;    // of all stretches, ascending
    uint32_t count, next; // stretches; the end that is next
    bool in, known;       // the state; whether it is known
    bool first_only;      // of those with t > t_min; then `first`, once `found`
    bool found;
    double start, stop; // of the ray, on the line
    struct blob_line line;
    struct boundary *first;
    struct boundary_list *out; // where all are wanted
};

// A stretch between two ends, on which the field less the threshold is one quartic about m.
struct blob_piece {
    double c[5]; // ascending
    double m, half;
    double rounding,
        lost; // of the coefficients, in units of roundoff; of the first, by a sum
};

// `end` has room for twice the count.
void blob_walk_begin(struct blob_walk *w, const struct blob *b,
                     const struct blob_line *line, const struct blob_stretch *at,
                     uint32_t count, double *end, struct boundary *first);
// The next piece that may have a crossing; false: there is none, or the first was found.
bool blob_walk_next(struct blob_walk *w, struct blob_piece *piece);
// Its crossings, and the state behind it.
void blob_walk_over(struct blob_walk *w, const struct blob_piece *piece);
// The same where its first crossing is known to be at m + t, and that it comes from inside; or
// that it has none, and which state it has.
void blob_walk_to(struct blob_walk *w, const struct blob_piece *piece, bool in, double t,
                  double dt);
void blob_walk_past(struct blob_walk *w, bool in);

// As shape_ops.closest8. Lanes that are `odd` are for the one line's crossings.
#define BLOB_CLOSEST8(isa)                                                               \
    unsigned blob_closest8_##isa(const struct blob *s, const struct shape_rays *rays,    \
                                 unsigned lanes, struct shape_hits *out, unsigned *odd);
BLOB_CLOSEST8(base)
BLOB_CLOSEST8(avx2)
BLOB_CLOSEST8(avx512)
#undef BLOB_CLOSEST8

#endif
