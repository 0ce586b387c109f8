#ifndef TESS_SOLID_H
#define TESS_SOLID_H

#include "math/aabb.h"
#include "scene/boundary.h"
#include "scene/object.h"

struct arena;
struct world;
struct trace_scratch;

// One object of a scene, asked for its inside and its exact surface.
struct tess_solid {
    const struct object *object;
    struct aabb bounds;
    struct world *world; // of this object alone
    struct trace_scratch *scratch;
    struct boundary_list crossings; // of one line
};

// Lives in the arena until tess_solid_close.
void tess_solid_open(struct tess_solid *s, struct arena *a, const struct object *object);
void tess_solid_close(struct tess_solid *s);

bool tess_solid_inside(const struct tess_solid *s, struct vec3 p);

// A place of the surface, and its outward unit normal; zero where there is none (the cut
// of a clip). `leaf` and `part` name the face it lies on.
struct tess_crossing {
    struct vec3 p, n;
    uint32_t leaf, part;
};

// Between a point outside and one inside.
struct tess_crossing tess_solid_crossing(const struct tess_solid *s, struct vec3 outside,
                                         struct vec3 inside);
// The first surface that the segment meets from without; false: none.
bool tess_solid_first(const struct tess_solid *s, struct vec3 from, struct vec3 to,
                      struct tess_crossing *out);
// Where the face of `on` crosses the line through p along the normal of `on`, nearest to
// p, whether the solid's surface is there or not; false: it does not.
bool tess_solid_project(struct tess_solid *s, const struct tess_crossing *on,
                        struct vec3 p, struct tess_crossing *out);

#endif
