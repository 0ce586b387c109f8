#ifndef SCENE_SHAPE_H
#define SCENE_SHAPE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "math/aabb.h"
#include "math/transform.h"
#include "math/vec.h"
#include "scene/boundary.h"

struct args;
struct arena;
struct shape_hits; // scene/shape_kernels.h
struct shape_kernels;
struct shape_lines;
struct shape_rays;
struct texture;

enum shape_flags {
    SHAPE_SOLID = 1,   // has an inside; otherwise a sheet (CROSS_TOUCH only)
    SHAPE_BOUNDED = 2, // bounds are finite for every parameter
    SHAPE_STURM = 4,   // accepts the modifier `sturm`
    SHAPE_HIERARCHY = 8,
    SHAPE_CONVEX = 16, // at most one ENTER and one EXIT on any line
    SHAPE_UV = 32,     // surface fills uv; otherwise uv is the world x and y of the hit
    // Which rays a bounded_by { } culls, as in POV-Ray: those that miss its box, or its
    // shape. With neither, none.
    SHAPE_BOUND_BOX = 64,
    SHAPE_BOUND_SHAPE = 128,
    SHAPE_FLAT = 256, // may have flat faces
};

// A point on a surface, as shading wants it. In the shape's own space.
struct surface_point {
    struct vec3 p;
    struct vec3 ng; // outward unit normal of the true surface
    struct vec3 ns; // unit shading normal (smooth triangles); else ng
    struct vec2 uv; // as uv_mapping sees it; filled only when want_uv is set
    bool want_uv;   // by the caller: mapping a sphere costs more than meeting it
};

typedef void shape_texture_visit(void *user, const struct texture *texture,
                                 double weight);

// What a kind of shape can do. Each src/scene/shapes/NAME.c defines one table,
// NAME_ops; shapes.def lists it. Shapes are in their own coordinates: the
// object holding the shape has the transform. Designated initialisers only.
struct shape_ops {
    const char *keyword; // as written in a scene: "sphere"
    size_t size;         // of the struct that build fills
    unsigned flags;      // enum shape_flags; for a shape whose solidity depends on
                         // its data (mesh) see is_solid

    // Reads the arguments between '{' and the first object modifier. Large data
    // (meshes) goes to args_arena().
    bool (*build)(void *shape, struct args *args);

    // Folds t into the parameters exactly (sphere: translate, rotate, uniform
    // scale) so that no transform is left; false: keep the transform outside.
    bool (*absorb)(void *shape, const struct transform *t);

    // Of everything inside (and of the surface).
    struct aabb (*bounds)(const void *shape);
    // The same of the shape moved by t, where that is smaller than the box around the
    // moved box; padded. NULL: that box.
    struct aabb (*placed_bounds)(const void *shape, const struct transform *t);
    // Of what is drawn, where that is smaller: a disc is a half space in CSG but a
    // disc to the eye. NULL: as bounds.
    struct aabb (*surface_bounds)(const void *shape);
    bool (*is_solid)(const void *shape); // NULL: as flags say
    // Whether there is nothing of the shape beyond finite bounds; NULL: as SHAPE_BOUNDED says.
    bool (*is_bounded)(const void *shape);
    bool (*inside)(const void *shape, struct vec3 p);

    // Appends every crossing of the whole line (t_min, t_max of the ray are
    // hints that later crossings are not wanted, except that the alternation
    // and the state at t_min must stay right; most shapes ignore them). A line that
    // no boundary meets is wholly inside or wholly outside: only `inside` tells
    // which, and only for a shape that is not bounded can it be inside.
    void (*intersect)(const void *shape, const struct ray *ray,
                      struct boundary_list *out);

    // The first drawn crossing with t_min < t < t_max, for shapes that find it much
    // faster than all crossings (a mesh that stands alone). NULL: use intersect.
    bool (*closest)(const void *shape, const struct ray *ray, struct boundary *out);

    // The same of eight rays at once, for those of `lanes`: the lanes that meet the shape
    // with t_min < t <= t_max. `any`: the t of any crossing in that range will do. A lane's
    // result depends on its own ray alone. `has_lanes` (NULL: all) says for which shapes
    // it may be called; these are always asked this way when they stand alone.
    unsigned (*closest8)(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out);
    bool (*has_lanes)(const void *shape);

    // All crossings of eight lines, for those of `lanes`: returns the lanes where it tells, the
    // others are for `intersect`. A lane's result depends on its own line alone. NULL: none.
    // In CSG these are the shape's crossings, of single rays as well.
    unsigned (*lines8)(const struct shape_kernels *k, const void *shape,
                       const struct shape_rays *rays, unsigned lanes,
                       struct shape_lines *out);

    // Geometry at a crossing that intersect reported; p is the point in shape space.
    void (*surface)(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out);
    // Textures of parts, for shapes whose parts may have their own (faces of a mesh,
    // components of a blob): the i-th of all, NULL behind the last. NULL: no parts.
    const struct texture *(*texture)(const void *shape, uint32_t i);
    // Calls visit for every texture that counts at a crossing, with its weight; NULL
    // stands for the object's own. The weights add up to 1.
    void (*textures_at)(const void *shape, const struct boundary *b, struct vec3 p,
                        shape_texture_visit *visit, void *user);
    // The keyword, the open brace and the arguments as scene text, no newline and no
    // closing brace: object_print adds modifiers and closes.
    void (*print)(const void *shape, FILE *out);
};

// Whether closest8 may be called for the shape.
static inline bool shape_has_lanes(const struct shape_ops *ops, const void *shape)
{
    return ops->closest8 && (!ops->has_lanes || ops->has_lanes(shape));
}

#define SHAPE(name) extern const struct shape_ops name##_ops;
#include "scene/shapes.def"
#undef SHAPE

extern const struct shape_ops *const shape_table[];
extern const size_t shape_count;
const struct shape_ops *shape_find(const char *keyword, size_t len); // NULL: none
bool shape_is_solid(const struct shape_ops *ops, const void *shape);
bool shape_is_bounded(const struct shape_ops *ops, const void *shape);
struct aabb shape_placed_bounds(const struct shape_ops *ops, const void *shape,
                                const struct transform *t); // padded
struct aabb shape_surface_bounds(const struct shape_ops *ops, const void *shape);
// A number or vector as scene text that reads back as the same bits.
void shape_print_number(FILE *out, double v);
void shape_print_vec2(FILE *out, struct vec2 v);
void shape_print_vec3(FILE *out, struct vec3 v);

#endif
