#ifndef TRACE_PACKET_H
#define TRACE_PACKET_H

#include "trace/accel.h"
#include "trace/photon_search.h"
#include "trace/ray_shaft.h"
#include "trace/scratch.h"

// One ray on its way through the world. The nearest hit so far is kept; among equal
// distances it is the one of the object declared first.
struct search {
    const struct world *w;
    struct trace_scratch *s;
    const struct ray_query *q;
    enum sweep_mode mode;
    struct box_ray box;
    double dd;       // d.d
    double t;        // of the nearest; INFINITY: none
    uint32_t object; // UINT32_MAX: none
    bool known;      // b is filled; else the boundary is still to be made
    struct boundary b;
};

struct search search_of(const struct world *w, struct trace_scratch *s,
                        const struct ray_query *q, enum sweep_mode mode);
// Whether the object is hit nearer than all before; then it is the nearest.
bool search_try_object(struct search *f, uint32_t object);

static inline bool search_is_nearer(const struct search *f, double t, uint32_t object)
{
    return t < f->t || (t == f->t && object < f->object);
}

// Eight rays in the terms of a tree, as bvh8_ray; t_far < 0: the lane wants no more.
struct tree_lanes {
    _Alignas(64) double t_begin[8];
    double scale[8];
    float o[3][8], inverse[3][8], t_far[8];
};

// Eight rays of a batch. Lanes that are not `alive` hold rays as well: any.
// What lanes load and store at once stands on lines of the cache of its own.
struct packet {
    _Alignas(64) double t[8]; // as in search, when the lane has no search of its own yet
    double dt[8], part[8], u[8], v[8]; // of the boundary, and the enum crossing, where
    uint32_t object[8];                // `whole`; UINT32_MAX: none
    uint32_t leaf[8];                  // of an unknown boundary
    struct tree_lanes top;
    uint8_t crossing[8];
    const struct ray_batch *rays;
    uint32_t first;
    unsigned alive, searching, whole;
    unsigned hidden_any; // of all rays, where some object is hidden from some
    const struct world *w;
    struct trace_scratch *s;
    enum sweep_mode mode;
    struct ray_query query[8];
    struct search search[8]; // both filled where `searching`
};

// Tries the object with the rays of `lanes` one by one; says where it became the nearest.
unsigned packet_try_object(struct packet *p, unsigned lanes, uint32_t object);
// The search that continues the lane, and its end.
struct search *packet_lane_begin(struct packet *p, int lane);
void packet_lane_end(struct packet *p, int lane);
// The boundary of a leaf at just this t, which a kernel has found, by the shape itself.
struct boundary boundary_at(const struct world *w, struct trace_scratch *s,
                            const struct ray *ray, uint32_t leaf, double t);
// The same of a lane's nearest hit.
struct boundary packet_lane_hit(struct packet *p, int lane);

// Whether the lane's search holds that boundary.
static inline bool packet_lane_known(const struct packet *p, int lane)
{
    return (p->searching >> lane & 1) && p->search[lane].object == p->object[lane] &&
           p->search[lane].known;
}

// The crossing of an inverted leaf.
static inline uint8_t crossing_of_leaf(uint8_t crossing, bool inverted)
{
    return !inverted || crossing == CROSS_TOUCH ? crossing
           : crossing == CROSS_ENTER            ? CROSS_EXIT
                                                : CROSS_ENTER;
}

// The surfaces that eight rays cross between t_min and t_max, in order.
enum { CROSSINGS = 16 };
struct crossings8 {
    double t[8][CROSSINGS];
    uint32_t leaf[8][CROSSINGS];
    uint8_t count[8];
    unsigned left; // lanes whose crossings are not known
};

// Whether `crossings` may be asked for the objects of a world that are not opaque.
bool packet_lists_crossings(const struct world *w);

// What is compiled once per instruction set.
struct packet_kernels {
    const char *name;
    // trace_closest, trace_occluded and, where `some` is given, trace_occluded_by.
    void (*hits)(const struct world *w, struct trace_scratch *s,
                 const struct ray_batch *rays, const struct hit_batch *out);
    void (*occluded)(const struct world *w, struct trace_scratch *s,
                     const struct ray_batch *rays, const uint64_t *some, uint8_t *out);
    // What the lanes of eight rays from `first` on cross, in a world of packet_lists_crossings.
    // Each surface is the nearest (trace_closest) of a ray that goes on from the last.
    void (*crossings)(const struct world *w, struct trace_scratch *s,
                      const struct ray_batch *rays, uint32_t first, unsigned lanes,
                      struct crossings8 *out);
    // Continues a search among the objects below a child of the tree.
    void (*walk)(struct search *f, struct bvh8_ray *r, int32_t child);
    // As sweep_object before f->t, of a PACKET_CARVED; unsure: only the sweep can tell.
    bool (*carve)(struct search *f, uint32_t object, struct boundary *out, bool *unsure);
    ray_shaft_function *shaft;
    const struct shape_kernels *shapes;
    photon_search_fn *photons;
};

extern const struct packet_kernels packet_kernels_base, packet_kernels_avx2,
    packet_kernels_avx512;
// The best this processor has, or what the environment variable LAMBERT_ISA names if it
// is there.
const struct packet_kernels *packet_kernels_choose(void);

#endif
