#ifndef SCENE_BOUNDARY_H
#define SCENE_BOUNDARY_H

#include <stdbool.h>
#include <stdint.h>

// What a ray meets at one t of one leaf. A solid's crossings toggle inside and
// outside and alternate ENTER, EXIT; a sheet (triangle, open mesh, patch) has no
// inside and is only touched.
enum crossing { CROSS_ENTER, CROSS_EXIT, CROSS_TOUCH };

struct boundary {
    double t;
    double dt;        // bound on the error of t; two boundaries whose [t-dt, t+dt]
                      // overlap are coincident
    double u, v;      // the shape's own parameters of the point, for normal and uv
    uint32_t part;    // the shape's own number of the face: box side, cap, triangle
    uint32_t leaf;    // filled by the caller of intersect: index into world leaves
    uint32_t own;     // within CSG, where dt may be wider: 1 + the place of the shape's
                      // own dt (trace/scratch.h); else 0
    uint8_t crossing; // enum crossing
    uint8_t drawn;    // 0: changes the inside state but is not a surface (the
                      // missing cap of an open cylinder, a clip's own face)
};

// All crossings of one shape with the WHOLE line of the ray, -inf < t < inf,
// ascending in t. A line that starts inside (half space, inverse) has its first
// boundary an EXIT. Grows in place; reset count to reuse.
struct boundary_list {
    struct boundary *at;
    uint32_t count, capacity;
    bool first_only;      // by the caller: what lies beyond the first drawn crossing with
                          // t_min < t < t_max of the ray need not be found
    uint64_t evaluations; // of functions, added up by shapes that are made of them
    const volatile bool
        *cancel; // once set, shapes whose search may take long give it up;
                 // NULL: they never do
    bool cut;    // one did: what it found is worth nothing
};

// Asked by searches that may take long, now and then.
static inline bool boundary_list_gives_up(struct boundary_list *l)
{
    if (!l->cancel || !*l->cancel)
        return false;
    return l->cut = true;
}

// The new entry, zeroed but for drawn = 1.
struct boundary *boundary_list_add(struct boundary_list *l, double t, double dt,
                                   enum crossing c, uint32_t part);
void boundary_list_free(struct boundary_list *l);

#endif
