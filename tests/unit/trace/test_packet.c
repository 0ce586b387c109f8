// Packets, single rays and the plain sweep over every object find the same boundaries, to
// the bit, with every instruction set there is.
#include "test.h"

#include <stdlib.h>

#include "packet_maker.h"

#include "base/arena.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/disc.h"
#include "scene/shapes/mesh.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/quadric.h"
#include "scene/shapes/sphere.h"
#include "scene/shapes/torus.h"
#include "trace/packet.h"

static void lone_shapes(void **state)
{
    (void)state;
    assert_true(check_random(1, 30, 0, 4, false) > 1000);
    assert_true(check_random(2, 60, 0, 4, true) > 1000);
}

// Thin, fat, and spindles.
static struct object *random_torus(struct maker *m, double r, int i)
{
    const struct torus t = {i % 3 == 1 ? .5 * r : r, i % 3 == 2 ? .001 : .75 * r};
    struct object *o = of(m, &torus_ops, &t);
    struct transform turn = transform_rotate(somewhere(m, 90));
    object_transform(m->a, o, &turn);
    turn = transform_translate(somewhere(m, 3));
    object_transform(m->a, o, &turn);
    return o;
}

// Each kernel by itself: a world of one kind of shape.
static void every_kernel(void **state)
{
    (void)state;
    int empty = 0;
    for (int kind = 0; kind < 9; kind++) {
        struct maker m = {.a = arena_new(1 << 16), .random = 40 + (uint64_t)kind};
        for (int i = 0; i < 24; i++) {
            m.grid = i % 3 == 0;
            const struct vec3 c = somewhere(&m, 3);
            const double r = .5 + between(&m, .25, 1);
            const struct cylinder z = {.frame = frame_around(c, vec3(0, i % 2, 1)),
                                       .length = 2 * r,
                                       .radius = r,
                                       .open = kind == 0};
            struct cone cone = random_cone(&m, c, r);
            cone.open = kind == 2;
            const struct quadric q = random_quadric(&m, c, r);
            const struct disc d = {c, vec3_normalize(vec3(i % 2, 1, i % 3)), 2 * r, r};
            const struct box b = {c, vec3_add(c, vec3(r, 2, r))};
            const struct sphere s = {c, r, transform_identity.linear};
            const struct plane p = {vec3_normalize(vec3(i % 2, 1, i % 3)), c};
            struct object *o = kind <= 0   ? of(&m, &cylinder_ops, &z)
                               : kind <= 2 ? of(&m, &cone_ops, &cone)
                               : kind == 3 ? of(&m, &quadric_ops, &q)
                               : kind == 4 ? of(&m, &disc_ops, &d)
                               : kind == 5 ? random_triangle(&m, c)
                               : kind == 8 ? random_torus(&m, r, i)
                               : kind == 6
                                   ? i % 2 ? of(&m, &box_ops, &b) : of(&m, &plane_ops, &p)
                                   : of(&m, &sphere_ops, &s);
            if (i % 4 == 0) {
                struct transform t = transform_scale(vec3(1, 1.5, .75));
                object_transform(m.a, o, &t);
            }
            m.object[m.count++] = o;
        }
        check_made(&m);
        empty += m.empty;
    }
    assert_true(empty > 10);
}

static void one_product(void **state)
{
    (void)state;
    for (uint64_t seed = 10; seed < 16; seed++)
        check_random(seed, 4, 1, 1, seed % 2);
}

// Shapes of products of about size r; plates are `off` thick.
static struct object *random_solid(struct maker *m, struct vec3 c, double r, double off,
                                   bool up)
{
    const struct box b = {vec3_sub(c, vec3(r, r, chance(m) < .1 ? off : r)),
                          vec3_add(c, vec3(r, r, off * chance(m)))};
    const struct sphere s = {c, r, transform_identity.linear};
    const struct plane p = {vec3(0, 0, up ? 1 : -1), c};
    const struct cylinder z = {.frame = frame_around(c, vec3(0, m->grid ? 0 : .5, 1)),
                               .length = 2 * r,
                               .radius = r};
    const struct cone cone = random_cone(m, c, r);
    const struct quadric q = random_quadric(m, c, r);
    const double k = chance(m);
    struct object *o = k < .3    ? of(m, &box_ops, &b)
                       : k < .5  ? of(m, &sphere_ops, &s)
                       : k < .65 ? of(m, &cylinder_ops, &z)
                       : k < .75 ? of(m, &cone_ops, &cone)
                       : k < .9  ? of(m, &quadric_ops, &q)
                                 : of(m, &plane_ops, &p);
    if (chance(m) < .3) {
        struct transform t = transform_scale(vec3(1, 2, 1));
        object_transform(m->a, o, &t);
    }
    return o;
}

// Intersections and differences whose faces coincide, almost coincide or are apart; thin
// plates; rays that start in a face.
static struct object *random_product(struct maker *m, double off)
{
    const uint32_t n = 2 + (uint32_t)(4 * chance(m));
    const struct object **child = arena_new_array(m->a, const struct object *, n);
    for (uint32_t i = 0; i < n; i++) {
        const struct vec3 c = somewhere(m, .75);
        const double r = .5 + between(m, 0, .5) + off * chance(m);
        child[i] = random_solid(m, c, r, off, i % 2);
    }
    if (chance(m) < .2) // some surfaces let light through, others do not
        ((struct object *)child[0])->texture =
            (struct attached_texture){&clear_texture, &transform_identity};
    return object_new_csg(m->a, chance(m) < .3 ? CSG_INTERSECTION : CSG_DIFFERENCE, child,
                          n, (struct span){0});
}

// Glass: all that rays cross, surface by surface.
static void clear_products(void **state)
{
    (void)state;
    struct maker m = {.a = arena_new(1 << 16), .random = 90};
    for (int i = 0; i < 30; i++) {
        struct object *o = random_product(&m, .01);
        const struct transform t = transform_translate(somewhere(&m, 3));
        o->texture = (struct attached_texture){&clear_texture, &transform_identity};
        object_transform(m.a, o, &t);
        m.object[m.count++] = o;
    }
    check_scene(&m);
    assert_true(m.crossed > 1000);
    arena_free(m.a);
}

// A block with a notch; a plane is its upper face, at -.75.
static struct object *notched(struct maker *m, double x, double depth)
{
    const struct box b = {vec3(x - 2, -2, -.75 - depth), vec3(x + 2, 2, 1)};
    const struct plane p = {vec3(0, 0, 1), vec3(0, 0, -.75)};
    const struct sphere s = {vec3(x, 2, -.75), .5, transform_identity.linear};
    const struct object **solid = arena_new_array(m->a, const struct object *, 2);
    const struct object **child = arena_new_array(m->a, const struct object *, 2);
    solid[0] = of(m, &box_ops, &b);
    solid[1] = of(m, &plane_ops, &p);
    child[0] = object_new_csg(m->a, CSG_INTERSECTION, solid, 2, (struct span){0});
    child[1] = of(m, &sphere_ops, &s);
    return object_new_csg(m->a, CSG_DIFFERENCE, child, 2, (struct span){0});
}

// Two objects have a face in one place: the one declared first is seen, whichever is tried
// first, although its box may seem to begin a rounding behind the hit of the other.
static void hits_in_one_place(void **state)
{
    (void)state;
    enum { COUNT = 400 };
    for (int swapped = 0; swapped < 2; swapped++) {
        struct maker m = {.a = arena_new(1 << 16)};
        struct vec3 o[COUNT], d[COUNT];
        m.object[m.count++] = notched(&m, swapped ? 1 : -1, 1);
        m.object[m.count++] = notched(&m, swapped ? -1 : 1, 2);
        for (int i = 0; i < COUNT; i++) {
            o[i] = vec3(.25, .25, .25 * (1 + i / 20));
            d[i] = vec3(0, 0, -.25 * (1 + i % 20));
        }
        assert_int_equal(check_rays(&m, o, d, COUNT), COUNT);
        arena_free(m.a);
    }
}

// A block from which small solids are taken, again and again, and turned between.
static struct object *drilled(struct maker *m, uint32_t n, double off)
{
    const struct box b = {vec3(-1, -1, -1), vec3(1, 1, 1)};
    struct object *o = of(m, &box_ops, &b);
    for (uint32_t i = 1; i < n; i++) {
        const struct object **child = arena_new_array(m->a, const struct object *, 2);
        child[0] = o;
        child[1] = random_solid(m, somewhere(m, 1), .25 + off * chance(m), off, true);
        if (child[1]->ops == &plane_ops)
            continue; // takes half of it
        o = object_new_csg(m->a, CSG_DIFFERENCE, child, 2, (struct span){0});
        if (i % 6 == 0) {
            struct transform t = transform_rotate(vec3(0, 0, m->grid ? 90 : 20));
            object_transform(m->a, o, &t);
        }
    }
    return o;
}

static void clip_by_solids(struct maker *m, struct object *o, double off)
{
    const uint32_t n = 1 + (uint32_t)(2.5 * chance(m));
    const struct object **clip = arena_new_array(m->a, const struct object *, n);
    for (uint32_t i = 0; i < n; i++) {
        const double r = 1 + between(m, 0, 1) + off * chance(m);
        clip[i] = random_solid(m, somewhere(m, .75), r, off, i % 2);
    }
    o->clip = clip;
    o->clip_count = n;
}

// Merges of solids that overlap, touch and coincide.
static void merges(void **state)
{
    (void)state;
    static const double off[] = {0, 1e-15, 1e-9, .01};
    for (uint64_t k = 0; k < 12; k++) {
        struct maker m = {.a = arena_new(1 << 16), .random = 600 + k, .grid = k % 2 == 0};
        for (int i = 0; i < 16; i++) {
            const uint32_t n = 2 + (uint32_t)(4 * chance(&m));
            const struct object **child = arena_new_array(m.a, const struct object *, n);
            for (uint32_t j = 0; j < n; j++) {
                child[j] = random_solid(&m, somewhere(&m, .75), .5 + .5 * chance(&m),
                                        off[k / 3], j % 2);
                if (i % 4 == 3 && j == 0)
                    ((struct object *)child[j])->texture =
                        (struct attached_texture){&clear_texture, &transform_identity};
            }
            struct object *o = object_new_csg(m.a, CSG_MERGE, child, n, (struct span){0});
            add_within(&m, o, 3);
        }
        check_made(&m);
    }
}

// A ring cut by solids and cutting them, by drawn ones and clips.
static void rings(void **state)
{
    (void)state;
    static const double off[] = {0, 1e-15, 1e-9, .01};
    for (uint64_t k = 0; k < 16; k++) {
        struct maker m = {.a = arena_new(1 << 16), .random = 500 + k, .grid = k % 4 == 0};
        for (int i = 0; i < 20; i++) {
            const uint32_t n = 2 + (uint32_t)(3 * chance(&m));
            const struct object **child = arena_new_array(m.a, const struct object *, n);
            const uint32_t first = i % 3 == 0;
            for (uint32_t j = 0; j < n; j++)
                child[j] = random_solid(&m, somewhere(&m, .75), .6 + chance(&m),
                                        off[k / 4], j % 2);
            child[first] = m.grid ? of(&m, &torus_ops, &(struct torus){1, .25})
                                  : random_torus(&m, 1, 0);
            struct object *o =
                object_new_csg(m.a, i % 2 ? CSG_INTERSECTION : CSG_DIFFERENCE, child, n,
                               (struct span){0});
            if (i % 4 == 0)
                clip_by_solids(&m, o, off[k / 4]);
            add_within(&m, o, 2);
        }
        check_made(&m);
    }
}

// A block less a ring, clipped by a box whose upper face lies a rounding below the block's:
// where that begins and ends what is left, nothing of it is drawn.
static void clips_share_faces_with_ringed_solids(void **state)
{
    (void)state;
    struct maker m = {.a = arena_new(1 << 16), .random = 31};
    for (int i = 0; i < 9; i++) {
        const struct object **child = arena_new_array(m.a, const struct object *, 2);
        const struct object **clip = arena_new_array(m.a, const struct object *, 1);
        const struct box b = {vec3(-1, -1, -1), vec3(1, 1, .3 + 2e-15)};
        const struct box c = {vec3(-.9, -.9, -.9), vec3(.9, .9, .3)};
        child[0] = of(&m, &box_ops, &b);
        child[1] = of(&m, &torus_ops, &(struct torus){.5, .25});
        clip[0] = of(&m, &box_ops, &c);
        struct object *o =
            object_new_csg(m.a, CSG_DIFFERENCE, child, 2, (struct span){0});
        o->clip = clip;
        o->clip_count = 1;
        const struct transform t =
            transform_translate(vec3(3 * (i % 3 - 1), 3 * (i / 3 - 1), 0));
        object_transform(m.a, o, &t);
        m.object[m.count++] = o;
    }
    check_made(&m);
}

// Bounds that are smaller than the object cull: what packets keep is what one ray keeps.
static void bounded(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 8; k++) {
        struct maker m = {.a = arena_new(1 << 16), .random = 400 + k, .alone = true};
        for (int i = 0; i < 24; i++) {
            struct object *o = i % 2 ? random_product(&m, 0) : random_shape(&m);
            const struct object **bound = arena_new_array(m.a, const struct object *, 1);
            bound[0] = random_solid(&m, somewhere(&m, .5), .3 + chance(&m), .5, i % 2);
            o->bound = bound;
            o->bound_count = 1;
            struct transform t = transform_rotate(vec3(10 * (i % 5), 0, 25));
            if (i % 3 == 0)
                object_transform(m.a, o, &t);
            add_within(&m, o, 2);
        }
        check_made(&m);
    }
}

// Lone shapes and products that solids clip, with faces that coincide, almost coincide or
// are apart.
static void clipped(void **state)
{
    (void)state;
    static const double off[] = {0, 1e-15, 1e-9, .01};
    for (uint64_t k = 0; k < 16; k++) {
        struct maker m = {.a = arena_new(1 << 16), .random = 300 + k, .grid = k % 2 == 0};
        for (int i = 0; i < 20; i++) {
            const double apart = off[k / 2 % 4];
            struct object *o = i % 2 ? random_product(&m, apart) : random_shape(&m);
            clip_by_solids(&m, o, apart);
            struct transform t = transform_rotate(vec3(0, 0, m.grid ? 90 : 25));
            if (i % 3 == 0)
                object_transform(m.a, o, &t);
            add_within(&m, o, 2);
        }
        check_made(&m);
    }
}

static void large_products(void **state)
{
    (void)state;
    static const double off[] = {0, 1e-15, 1e-9};
    for (uint64_t k = 0; k < 6; k++) {
        struct maker m = {.a = arena_new(1 << 16), .random = 150 + k, .grid = k < 3};
        for (int i = 0; i < 8; i++) {
            struct object *o = drilled(&m, 12 + 4 * (uint32_t)i, off[k % 3]);
            add_within(&m, o, 3);
        }
        check_made(&m);
    }
}

static void products(void **state)
{
    (void)state;
    static const double off[] = {0, 1e-16, 1e-15, 1e-13, 1e-9, 1e-3};
    for (uint64_t k = 0; k < 12; k++) {
        struct maker m = {.a = arena_new(1 << 16), .random = 100 + k, .grid = k < 9};
        for (int i = 0; i < 12; i++) {
            struct object *o = random_product(&m, off[k % 6]);
            add_within(&m, o, k < 6 ? 1 : 3);
        }
        check_made(&m);
    }
}

// Solids less many spheres: apart, overlapping, equal, touching the faces.
static void sponges(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 6; k++) {
        struct maker m = {.a = arena_new(1 << 16), .random = 200 + k, .grid = k % 2};
        const uint32_t n = k < 4 ? 40 : 400;
        const struct object **child = arena_new_array(m.a, const struct object *, n);
        for (uint32_t i = 0; i < n; i++) {
            const struct sphere s = {somewhere(&m, 2.25),
                                     k < 2   ? .75
                                     : k < 4 ? .5
                                             : .25,
                                     transform_identity.linear};
            child[i] = of(&m, &sphere_ops, &s);
        }
        const struct box b = {vec3(-2, -2, -2), vec3(2, 2, k == 3 ? -2 : 2)};
        struct object *solid = of(&m, &box_ops, &b);
        if (k == 2) {
            struct transform t = transform_rotate(vec3(10, 20, 30));
            object_transform(m.a, solid, &t);
        }
        child[0] = solid;
        m.object[m.count++] =
            object_new_csg(m.a, CSG_DIFFERENCE, child, n, (struct span){0});
        m.object[m.count++] = random_shape(&m);
        check_made(&m);
    }
}

// A bumpy sheet of 2 n^2 triangles that share their corners; on a grid it is flat here and
// there, so that rays meet edges and corners.
static struct object *random_mesh(struct maker *m, uint32_t n)
{
    struct mesh mesh = {.vertex_count = (n + 1) * (n + 1), .face_count = 2 * n * n};
    mesh.vertex = arena_new_array(m->a, struct vec3, mesh.vertex_count);
    mesh.face = arena_alloc(m->a, mesh.face_count * sizeof *mesh.face);
    for (uint32_t i = 0; i <= n; i++)
        for (uint32_t k = 0; k <= n; k++)
            mesh.vertex[i * (n + 1) + k] =
                vec3(4. * i / n - 2, 4. * k / n - 2, between(m, -.5, .5));
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < n; k++) {
            const uint32_t a = i * (n + 1) + k, b = a + n + 1, f = 2 * (i * n + k);
            memcpy(mesh.face[f], (uint32_t[]){a, a + 1, b}, sizeof *mesh.face);
            memcpy(mesh.face[f + 1], (uint32_t[]){a + 1, b + 1, b}, sizeof *mesh.face);
        }
    mesh_finish(&mesh, m->a);
    return of(m, &mesh2_ops, &mesh);
}

static void meshes(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 4; k++) {
        struct maker m = {.a = arena_new(1 << 16), .random = 300 + k, .alone = true};
        m.grid = k % 2;
        for (int i = 0; i < 8; i++) {
            struct object *o = random_mesh(&m, k < 2 ? 4 : 16);
            if (i % 2) {
                struct transform t = transform_rotate(somewhere(&m, 90));
                object_transform(m.a, o, &t);
            }
            add_within(&m, o, 3);
        }
        check_made(&m);
    }
}

static void nested_csg(void **state)
{
    (void)state;
    check_random(20, 60, 2, 5, false);
    check_random(21, 40, 2, 4, true);
    check_random(22, 20, 3, 4, true);
}

// Expressions of solids of which some faces coincide, almost coincide or are apart: unions
// and merges in intersections, and the other way round.
static struct object *random_nest(struct maker *m, int depth, double off)
{
    struct object *o;
    if (depth == 0 || chance(m) < .2) {
        const double kind = chance(m);
        o = kind < .7 ? random_solid(m, somewhere(m, .75), .5 + chance(m), off, kind < .3)
            : kind < .8 ? random_torus(m, 1, m->grid ? 1 : (int)(3 * chance(m)))
                        : random_shape(m);
    } else {
        const uint32_t n = 2 + (uint32_t)(2.5 * chance(m));
        const struct object **child = arena_new_array(m->a, const struct object *, n);
        for (uint32_t i = 0; i < n; i++)
            child[i] = random_nest(m, depth - 1, off);
        const double k = chance(m);
        const enum csg_op op = k < .25  ? CSG_MERGE
                               : k < .5 ? CSG_UNION
                               : k < .8 ? CSG_INTERSECTION
                                        : CSG_DIFFERENCE;
        o = object_new_csg(m->a, op, child, n, (struct span){0});
    }
    if (chance(m) < .1)
        o->texture = (struct attached_texture){&clear_texture, &transform_identity};
    if (chance(m) < .05)
        o->flags |= OBJECT_INVERSE;
    return o;
}

static void nests(void **state)
{
    (void)state;
    static const double off[] = {0, 1e-15, 1e-9, .01};
    for (uint64_t k = 0; k < 24; k++) {
        struct maker m = {.a = arena_new(1 << 16), .random = 700 + k, .grid = k % 2 == 0};
        for (int i = 0; i < 12; i++) {
            struct object *part[2] = {
                random_nest(&m, 2, off[k / 6]),
                random_solid(&m, somewhere(&m, .5), 1.5, .5, i % 2)};
            const struct object **child = arena_new_array(m.a, const struct object *, 2);
            child[0] = part[0];
            child[1] = part[1];
            struct object *o = object_new_csg(m.a, i % 3 ? CSG_INTERSECTION : CSG_MERGE,
                                              child, 2, (struct span){0});
            if (i % 4 == 0)
                clip_by_solids(&m, o, off[k / 6]);
            add_within(&m, o, 2);
        }
        check_made(&m);
    }
}

// Turned solids less others, all around the origin, where the camera is.
static void seen_from_within(void **state)
{
    (void)state;
    static const double off[] = {0, 1e-15, 1e-9, .01};
    for (uint64_t k = 0; k < 16; k++) {
        struct maker m = {.a = arena_new(1 << 16),
                          .random = 800 + k,
                          .grid = k % 4 == 0,
                          .middle = true};
        for (int i = 0; i < 8; i++) {
            const uint32_t n = 3 + (uint32_t)(4 * chance(&m));
            const struct object **child = arena_new_array(m.a, const struct object *, n);
            for (uint32_t j = 0; j < n; j++) {
                struct object *o = random_solid(&m, somewhere(&m, j > 2 ? .5 : 0),
                                                j ? .3 + .5 * chance(&m) : 1 + .5 * i,
                                                off[k / 4], j % 2);
                struct transform t = transform_scale(vec3(.8, 1.3, j % 2 ? 1 : .4));
                object_transform(m.a, o, &t);
                t = transform_rotate(vec3(0, 30. * i, m.grid ? 0 : 25. * j));
                object_transform(m.a, o, &t);
                child[j] = o;
            }
            m.object[m.count++] = object_new_csg(
                m.a, i % 4 == 3 ? CSG_MERGE : CSG_DIFFERENCE, child, n, (struct span){0});
        }
        check_made(&m);
    }
}

// Spheres by the hundred: the tree is deep, leaves hold blocks of spheres.
static void many_spheres(void **state)
{
    (void)state;
    struct maker m = {.a = arena_new(1 << 16), .random = 5};
    for (int i = 0; i < OBJECTS; i++) {
        m.grid = i % 2;
        const struct sphere s = {somewhere(&m, 5), m.grid ? .5 : .4,
                                 transform_identity.linear};
        m.object[m.count++] = of(&m, &sphere_ops, &s);
    }
    check_made(&m);
}

static void the_environment_names_the_kernels(void **state)
{
    (void)state;
    setenv("LAMBERT_ISA", "base", 1);
    assert_string_equal(packet_kernels_choose()->name, "base");
    setenv("LAMBERT_ISA", "no such thing", 1);
    assert_non_null(packet_kernels_choose());
    unsetenv("LAMBERT_ISA");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lone_shapes),
        cmocka_unit_test(every_kernel),
        cmocka_unit_test(one_product),
        cmocka_unit_test(products),
        cmocka_unit_test(hits_in_one_place),
        cmocka_unit_test(clear_products),
        cmocka_unit_test(merges),
        cmocka_unit_test(rings),
        cmocka_unit_test(clips_share_faces_with_ringed_solids),
        cmocka_unit_test(bounded),
        cmocka_unit_test(clipped),
        cmocka_unit_test(large_products),
        cmocka_unit_test(sponges),
        cmocka_unit_test(meshes),
        cmocka_unit_test(nested_csg),
        cmocka_unit_test(nests),
        cmocka_unit_test(seen_from_within),
        cmocka_unit_test(many_spheres),
        cmocka_unit_test(the_environment_names_the_kernels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
