#ifndef TRACE_SCRATCH_H
#define TRACE_SCRATCH_H

#include "math/gamma.h"
#include "scene/boundary.h"
#include "trace/accel.h"
#include "trace/intersect.h"

// Crossings that eight lines had made in leaves of an object (leaf_crossings_in_csg), for the
// sweep of one of them.
struct made_crossings {
    uint32_t first_leaf;
    uint8_t lanes[CSG_LEAVES];                       // by leaf: lanes that had them made
    uint32_t from[CSG_LEAVES][8], to[CSG_LEAVES][8]; // their place
    int lane;                                        // the one that is swept
};

// What one thread needs while it traces: nothing is allocated per ray once the lists
// have grown to their working size.
struct trace_scratch {
    struct boundary_list crossings;
    double *own_dt; // of the crossings whose dt was widened
    uint32_t own_count, own_capacity;
    const struct made_crossings *made; // NULL: none
    struct boundary *made_at;          // what `crossings` and `own_dt` were then
    double *made_own_dt;
    uint32_t made_capacity, made_own_capacity;
    uint32_t *inside; // children inside, per node of the object at hand
    uint32_t *before; // the same before the batch, where stamped
    uint64_t *stamp;  // batch that last touched the node
    uint64_t batch;
    uint32_t *leaves; // the leaves whose boxes the ray meets
    struct trace_stats stats;
};

// A ray prepared for box tests. inv: 1 / d; infinite where shapes take it to run along a plane
// (RUNS_ALONG), so that no box leaves out what a shape takes for a crossing.
struct box_ray {
    struct vec3 o, inv;
    double t_min, t_max;
};

struct box_ray box_ray_of(const struct ray *r);
// By as much of a t rounding moves a slab, so that a box may seem to begin behind a hit in its face:
// t_max of a search for what is nearer, or as near, than another hit grows by it, too.
#define BOX_SLACK (2 * GAMMA(3))
// Whether the box is met within [t_min, t_max]; *t is where it begins. Conservative: the
// bounds are grown by the rounding of the slab test (Ize 2013).
bool box_meets(const struct aabb *b, const struct box_ray *r, double *t);

// Which of an object's surfaces end the search: all drawn ones or opaque ones only.
enum sweep_mode { SWEEP_CLOSEST, SWEEP_OPAQUE };

// The first drawn surface of a CSG object on t_min < t < t_max by the sweep over batches
// (doc/architecture.md); false: none, or none that begins before `limit`.
bool sweep_object(const struct world *w, struct trace_scratch *s, uint32_t object,
                  const struct ray *ray, double limit, enum sweep_mode mode,
                  struct boundary *out);

// What the sweep finds, for objects of accel->object_shape PACKET_SPONGE; UNSURE: only the
// sweep can tell.
enum stab_result { STAB_NOTHING, STAB_FOUND, STAB_UNSURE };
enum { STAB_SOLIDS = 4 }; // leaves that are not subtracted, at most
enum stab_result stab_object(const struct world *w, struct trace_scratch *s,
                             uint32_t object, const struct ray *ray, double limit,
                             struct boundary *out);

// All crossings of one leaf with the line, in world terms: inverted leaves turned.
void leaf_crossings(const struct world *w, uint32_t leaf, const struct ray *ray,
                    struct boundary_list *out);
// The same for CSG, into s->crossings: where the leaf has a transform, dt covers its rounding
// as well, and the shape's own dt goes to s->own_dt.
void leaf_crossings_in_csg(const struct world *w, struct trace_scratch *s, uint32_t leaf,
                           const struct ray *ray);
// The same where the shape's own crossings of that ray stand there from `from` on; slope: |normal
// . direction| at each, in the shape's space; NULL: not known.
void leaf_crossings_made(const struct world *w, struct trace_scratch *s, uint32_t leaf,
                         const struct ray *ray, uint32_t from, const double *slope);
// Puts the crossings made so far aside, where sweeps find them until s->made is NULL again.
void scratch_keep_crossings(struct trace_scratch *s, const struct made_crossings *made);
// The boundary found, with its shape's own dt.
struct boundary boundary_as_shape_has_it(const struct trace_scratch *s,
                                         const struct boundary *b);

#endif
