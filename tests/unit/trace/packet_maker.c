#include "packet_maker.h"

#include "test.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/disc.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/quadric.h"
#include "scene/shapes/sphere.h"
#include "scene/shapes/torus.h"
#include "scene/shapes/triangle.h"
#include "trace/packet.h"

enum { RAYS = 1000 };

double between(struct maker *m, double lo, double hi)
{
    m->random = m->random * 6364136223846793005u + 1442695040888963407u;
    const double v = lo + (hi - lo) * (double)(m->random >> 11) * 0x1p-53;
    return m->grid ? .25 * round(4 * v) : v;
}

double chance(struct maker *m)
{
    m->random = m->random * 6364136223846793005u + 1442695040888963407u;
    return (double)(m->random >> 11) * 0x1p-53;
}

struct vec3 somewhere(struct maker *m, double size)
{
    const double x = between(m, -size, size), y = between(m, -size, size);
    return vec3(x, y, between(m, -size, size));
}

struct object *of(struct maker *m, const struct shape_ops *ops, const void *shape)
{
    void *copy = arena_alloc(m->a, ops->size);
    memcpy(copy, shape, ops->size);
    return object_new_shape(m->a, ops, copy, (struct span){0});
}

struct cone random_cone(struct maker *m, struct vec3 c, double r)
{
    struct cone k = {.frame = frame_around(c, m->grid ? vec3(0, 0, 1) : somewhere(m, 1)),
                     .length = 2 * r,
                     .r0 = chance(m) < .2 ? 0 : r,
                     .r1 = between(m, 0, 2) * r};
    k.slope = (k.r1 - k.r0) / k.length;
    return k;
}

// Ellipsoids, hyperboloids of both kinds, paraboloids, cylinders, saddles, cones.
struct quadric random_quadric(struct maker *m, struct vec3 c, double r)
{
    struct quadric q = {.centre = c, .xx = 1, .yy = 1.5, .zz = 1, .constant = -r * r};
    const int kind = (int)(7 * chance(m));
    if (kind == 1 || kind == 2)
        q.zz = -1;
    if (kind == 2)
        q.constant = r * r;
    if (kind == 3)
        q.yy = 0, q.linear.y = -1;
    if (kind == 4)
        q.yy = 0;
    if (kind == 5)
        q.yy = 0, q.zz = -1, q.linear.y = 1;
    if (kind == 6)
        q.zz = -1, q.constant = 0;
    if (!m->grid && chance(m) < .3)
        q.xy = q.yz = .25;
    return q;
}

struct object *random_triangle(struct maker *m, struct vec3 c)
{
    struct triangle t = {.smooth = chance(m) < .5};
    for (int i = 0; i < 3; i++) {
        t.p[i] = vec3_add(c, somewhere(m, 1));
        t.n[i] = vec3(0, 0, 1);
    }
    t.face = triangle_normal(t.p);
    t.degenerate = vec3_dot(t.face, t.face) == 0;
    return of(m, t.smooth ? &smooth_triangle_ops : &triangle_ops, &t);
}

struct object *random_shape(struct maker *m)
{
    const struct vec3 c = somewhere(m, 1);
    const double r = .25 + between(m, .25, 1);
    const int kind = (int)(9 * chance(m));
    if (kind == 8) {
        const struct torus t = {r, .1 + .75 * chance(m) * r};
        return of(m, &torus_ops, &t);
    }
    if (kind == 5) {
        struct cone k = random_cone(m, c, r);
        k.open = chance(m) < .3;
        return of(m, &cone_ops, &k);
    }
    if (kind == 6) {
        const struct quadric q = random_quadric(m, c, r);
        return of(m, &quadric_ops, &q);
    }
    if (kind == 7)
        return random_triangle(m, c);
    if (kind == 0) {
        const struct box b = {vec3_sub(c, vec3(r, r, r)), vec3_add(c, vec3(r, r, r))};
        return of(m, &box_ops, &b);
    }
    if (kind == 1) {
        struct vec3 n = m->grid ? vec3(0, chance(m) < .5 ? 1 : -1, 0) : somewhere(m, 1);
        const struct plane p = {vec3_normalize(n), c};
        return of(m, &plane_ops, &p);
    }
    if (kind == 2) {
        const struct cylinder z = {
            .frame = frame_around(c, m->grid ? vec3(0, 0, 1) : somewhere(m, 1)),
            .length = 2 * r,
            .radius = r,
            .open = chance(m) < .3};
        return of(m, &cylinder_ops, &z);
    }
    if (kind == 3 && chance(m) < .5) {
        const struct disc d = {c, vec3(0, 1, 0), r, .5 * r};
        return of(m, &disc_ops, &d);
    }
    const struct sphere s = {c, r, transform_identity.linear};
    return of(m, &sphere_ops, &s);
}

static struct object *random_object(struct maker *m, int depth)
{
    struct object *o;
    if (depth == 0 || chance(m) < .1) {
        o = random_shape(m);
        if (chance(m) < .3) {
            struct transform t = transform_scale(vec3(1, m->grid ? 2 : 1.3, 1));
            object_transform(m->a, o, &t);
        }
    } else {
        const uint32_t n = 2 + (uint32_t)(3 * chance(m));
        const struct object **child = arena_new_array(m->a, const struct object *, n);
        for (uint32_t i = 0; i < n; i++)
            child[i] = random_object(m, depth - 1);
        const double k = chance(m);
        const enum csg_op op = k < .2   ? CSG_MERGE
                               : k < .3 ? CSG_UNION
                               : k < .6 ? CSG_INTERSECTION
                                        : CSG_DIFFERENCE;
        o = object_new_csg(m->a, op, child, n, (struct span){0});
    }
    if (!m->grid && chance(m) < .5) {
        struct transform t = transform_rotate(somewhere(m, 90));
        object_transform(m->a, o, &t);
    }
    if (chance(m) < .1)
        o->texture = (struct attached_texture){&clear_texture, &transform_identity};
    if (chance(m) < .05)
        o->flags |= OBJECT_INVERSE;
    if (chance(m) < .1)
        o->flags |= OBJECT_NO_SHADOW;
    return o;
}

// ---- rays ---------------------------------------------------------------------------

static void put(struct ray_batch *b, struct vec3 o, struct vec3 d, double t_min,
                double t_max, unsigned hidden_by)
{
    const uint32_t i = b->count++;
    b->o[0][i] = o.x, b->o[1][i] = o.y, b->o[2][i] = o.z;
    b->d[0][i] = d.x, b->d[1][i] = d.y, b->d[2][i] = d.z;
    b->t_min[i] = t_min;
    b->t_max[i] = t_max;
    b->hidden_by[i] = hidden_by;
}

// Along an axis, but for no more than a few roundings.
static struct vec3 almost_along(struct maker *m, int axis)
{
    static const double size[] = {0, 1e-17, 1e-16, 1e-15, 3e-15, 1e-14, 1e-13, 1e-12};
    double off[2];
    for (int i = 0; i < 2; i++)
        off[i] = size[(int)(8 * chance(m))] * (2 * chance(m) - 1);
    return axis == 0   ? vec3(1, off[0], off[1])
           : axis == 1 ? vec3(off[1], -2, off[0])
                       : vec3(off[1], off[0], 1);
}

// From one eye through a raster, or from anywhere to anywhere; along an axis or almost so,
// from inside, ending early.
static void fill(struct maker *m, struct ray_batch *b, int kind)
{
    const double far = m->middle ? (kind == 3 ? 1e-9 : 0) : kind == 3 ? 1e5 : 3;
    const struct vec3 eye = vec3_scale(far, somewhere(m, 4));
    b->count = 0;
    for (int i = 0; i < RAYS; i++) {
        const struct vec3 to = kind == 0 || kind == 3 ? vec3(8. * (i % 32) / 32 - 4,
                                                             8. * (i / 32) / 32 - 4, 0)
                                                      : somewhere(m, 6);
        struct vec3 o = kind == 0 || kind == 3 ? eye : somewhere(m, 9);
        struct vec3 d = vec3_sub(to, o);
        if (kind == 2)
            d = i % 3 == 0 ? vec3(1, 0, 0) : i % 3 == 1 ? vec3(0, -2, 0) : vec3(0, 0, 1);
        if (kind == 4)
            d = almost_along(m, i % 3);
        if (vec3_dot(d, d) == 0)
            d = vec3(0, 0, 1);
        // Where such a ray has left a plane that it runs along is of no interest.
        const double t_max = kind == 4 ? 1e9 : INFINITY;
        put(b, o, d, i % 7 == 0 ? .125 : 0, i % 5 == 0 ? .75 : t_max,
            i % 4 == 0 ? OBJECT_NO_SHADOW : 0);
    }
}

enum { BUNDLE = 64 };

// Bundles from places close to each other to ends close to each other.
static void fill_bundles(struct maker *m, struct ray_batch *b)
{
    struct vec3 from = {0, 0, 0}, to = {0, 0, 0};
    b->count = 0;
    for (int i = 0; i < RAYS; i++) {
        if (i % BUNDLE == 0) {
            from = somewhere(m, 9);
            to = somewhere(m, 9);
        }
        const struct vec3 o = vec3_add(from, somewhere(m, .2));
        const struct vec3 end = vec3_add(to, somewhere(m, i / BUNDLE % 2 ? .1 : 0));
        const struct vec3 d = vec3_sub(end, o);
        put(b, o, vec3_dot(d, d) == 0 ? vec3(0, 0, 1) : d, 0, 1, OBJECT_NO_SHADOW);
    }
}

static struct ray_query query_at(const struct ray_batch *b, uint32_t i)
{
    return (struct ray_query){.ray = {vec3(b->o[0][i], b->o[1][i], b->o[2][i]),
                                      vec3(b->d[0][i], b->d[1][i], b->d[2][i]),
                                      b->t_min[i], b->t_max[i]},
                              .hidden_by = b->hidden_by[i]};
}

static struct boundary brute(const struct world *w, struct trace_scratch *s,
                             const struct ray_query *q, enum sweep_mode mode)
{
    struct boundary best = {.t = INFINITY}, b;
    for (uint32_t i = 0; i < w->object_count; i++) {
        const struct world_object *o = &w->object[i];
        if (o->flags & q->hidden_by)
            continue;
        if (o->is_csg) {
            if (sweep_object(w, s, i, &q->ray, INFINITY, mode, &b) && b.t < best.t)
                best = b;
            continue;
        }
        if (mode == SWEEP_OPAQUE && !o->opaque)
            continue;
        s->crossings.count = 0;
        leaf_crossings(w, o->first_leaf, &q->ray, &s->crossings);
        for (uint32_t k = 0; k < s->crossings.count; k++) {
            b = s->crossings.at[k];
            if (b.drawn && b.t > q->ray.t_min && b.t < q->ray.t_max && b.t < best.t)
                best = b;
        }
    }
    return best;
}

static void assert_same(const struct boundary *a, const struct boundary *b)
{
    assert_memory_equal(&a->t, &b->t, sizeof a->t);
    if (isinf(a->t))
        return;
    assert_memory_equal(&a->dt, &b->dt, sizeof a->dt);
    assert_int_equal(a->leaf, b->leaf);
    assert_int_equal(a->part, b->part);
    assert_int_equal(a->crossing, b->crossing);
    assert_memory_equal(&a->u, &b->u, sizeof a->u);
    assert_memory_equal(&a->v, &b->v, sizeof a->v);
}

// Rays that met something go on from there.
static void go_on(struct ray_batch *b, const struct hit_batch *hit)
{
    for (uint32_t i = 0; i < b->count; i++)
        if (hit->t[i] < INFINITY)
            b->t_min[i] = hit->t[i];
}

// All that rays cross among what is not opaque is what they meet going on from one surface
// to the next. Returns how many surfaces that were.
static int check_crossings(const struct world *w, struct trace_scratch *s,
                           const struct ray_batch *b)
{
    int total = 0;
    if (!w->clear || !packet_lists_crossings(w))
        return 0;
    for (uint32_t first = 0; first + 8 <= b->count; first += 8) {
        struct crossings8 c;
        const unsigned lanes = first % 3 ? 255 : 5 << first % 5;
        w->clear->accel->kernels->crossings(w->clear, s, b, first, lanes, &c);
        for (unsigned m = lanes & ~c.left; m; m &= m - 1) {
            const int lane = __builtin_ctz(m);
            struct ray_query q = query_at(b, first + (uint32_t)lane);
            for (uint32_t i = 0; i < c.count[lane]; i++) {
                if (c.t[lane][i] == q.ray.t_min) // touches the last
                    continue;
                const struct hit next = trace_closest_1(w->clear, s, &q);
                assert_memory_equal(&next.b.t, &c.t[lane][i], sizeof next.b.t);
                assert_int_equal(next.b.leaf, c.leaf[lane][i]);
                q.ray.t_min = next.b.t;
                total++;
            }
            assert_true(isinf(trace_closest_1(w->clear, s, &q).b.t));
        }
    }
    return total;
}

// Of bundles, all that is in the way of some ray is in the bundle's shaft. Returns the number of
// empty shafts.
static int check_shafts(const struct world *w, struct trace_scratch *s,
                        const struct ray_batch *b)
{
    int empty = 0;
    for (uint32_t first = 0; first + BUNDLE <= b->count; first += BUNDLE) {
        struct ray_shaft shaft = {{b->o[0] + first, b->o[1] + first, b->o[2] + first},
                                  BUNDLE,
                                  OBJECT_NO_SHADOW,
                                  aabb_empty(),
                                  aabb_empty()};
        uint32_t object[RAY_SHAFT_OBJECTS];
        for (uint32_t i = first; i < first + BUNDLE; i++) {
            const struct ray r = query_at(b, i).ray;
            shaft.from = aabb_add(shaft.from, r.o);
            shaft.to = aabb_add(shaft.to, ray_at(&r, r.t_max));
        }
        const uint32_t n = w->accel->kernels->shaft(w, &shaft, object);
        empty += n == 0;
        for (uint32_t i = first; i < first + BUNDLE && n != RAY_SHAFT_MANY; i++) {
            const struct ray_query q = query_at(b, i);
            const struct boundary met = brute(w, s, &q, SWEEP_OPAQUE);
            bool listed = isinf(met.t);
            for (uint32_t k = 0; k < n && !listed; k++)
                listed = object[k] == w->leaf[met.leaf].object;
            assert_true(listed);
        }
    }
    return empty;
}

// Traces the batch, and each ray against every object by itself; returns the hits.
static int check_batch(struct world *w, struct trace_scratch *s, struct maker *m,
                       const struct ray_batch *b, struct hit_batch *hit)
{
    uint8_t dark[RAYS];
    int hits = 0;
    trace_closest(w, s, b, hit);
    trace_occluded(w, s, b, dark);
    m->crossed += check_crossings(w, s, b);
    for (uint32_t i = 0; i < b->count; i++) {
        const struct ray_query q = query_at(b, i);
        const struct hit one = trace_closest_1(w, s, &q);
        const struct boundary want = m->alone ? one.b : brute(w, s, &q, SWEEP_CLOSEST);
        assert_same(&want, &one.b);
        const struct hit in_batch = hit_batch_at(hit, i);
        assert_same(&want, &in_batch.b);
        const bool shadowed = m->alone ? trace_occluded_1(w, s, &q)
                                       : !isinf(brute(w, s, &q, SWEEP_OPAQUE).t);
        assert_int_equal(shadowed, trace_occluded_1(w, s, &q));
        assert_int_equal(shadowed, dark[i]);
        hits += !isinf(want.t);
    }
    return hits;
}

static int check_world(struct world *w, struct maker *m)
{
    struct trace_scratch *s = trace_scratch_new(w);
    struct ray_batch *b = ray_batch_new(RAYS);
    struct hit_batch *hit = hit_batch_new(RAYS);
    int hits = 0;
    for (int kind = 0; kind < 11; kind++) {
        if (kind == 10)
            fill_bundles(m, b);
        else if (kind % 2 == 0)
            fill(m, b, kind / 2);
        else
            go_on(b, hit);
        if (kind == 10 && !m->alone)
            m->empty += check_shafts(w, s, b);
        hits += check_batch(w, s, m, b, hit);
    }
    hit_batch_free(hit);
    ray_batch_free(b);
    trace_scratch_free(s);
    return hits;
}

static struct world *made_world(struct maker *m)
{
    struct scene scene = {.object = m->object, .object_count = m->count};
    scene.default_texture = (struct attached_texture){&grey_texture, &transform_identity};
    return world_build(m->a, &scene);
}

void check_scene(struct maker *m)
{
    static const char *const isa[] = {"base", "avx2", "avx512"};
    for (int i = 0; i < 3; i++) {
        setenv("LAMBERT_ISA", isa[i], 1);
        struct maker rays = *m;
        assert_true(check_world(made_world(m), &rays) > 100);
        m->crossed = rays.crossed;
        m->empty = rays.empty;
    }
    unsetenv("LAMBERT_ISA");
}

int check_rays(struct maker *m, const struct vec3 *o, const struct vec3 *d,
               uint32_t count)
{
    struct world *w = made_world(m);
    struct trace_scratch *s = trace_scratch_new(w);
    struct ray_batch *b = ray_batch_new(RAYS);
    struct hit_batch *hit = hit_batch_new(RAYS);
    assert_true(count <= RAYS);
    b->count = 0;
    for (uint32_t i = 0; i < count; i++)
        put(b, o[i], d[i], 0, INFINITY, 0);
    const int hits = check_batch(w, s, m, b, hit);
    hit_batch_free(hit);
    ray_batch_free(b);
    trace_scratch_free(s);
    return hits;
}

void add_within(struct maker *m, struct object *o, double far)
{
    struct transform t = transform_translate(somewhere(m, far));
    object_transform(m->a, o, &t);
    m->object[m->count++] = o;
}

void check_made(struct maker *m)
{
    check_scene(m);
    arena_free(m->a);
}

int check_random(uint64_t seed, int count, int depth, double apart, bool grid)
{
    struct maker m = {.a = arena_new(1 << 16), .random = seed, .grid = grid};
    for (int i = 0; i < count; i++) {
        struct object *o = random_object(&m, depth);
        add_within(&m, o, apart);
    }
    check_made(&m);
    return m.crossed;
}
