// Finding surfaces: CSG with coincident faces, infinite and clipped solids, trees against
// brute force.
#include "world_fixture.h"

#include <stdlib.h>

// ---- coincidence ------------------------------------------------------------------

// T01: a pocket whose mouth lies in a face has no film over it, however it is turned.
static void a_pocket_is_open(void **state)
{
    struct fixture *f = *state;
    struct object *o = csg(f, CSG_DIFFERENCE, unit_box(f),
                           box_of(f, vec3(-.5, -.5, -1), vec3(.5, .5, 0)));
    add(f, o);
    finish(f);
    assert_near(first_t(f, vec3(.1, .2, -5), Z), 5, 1e-13);
    struct vec3 n = first_normal(f, vec3(.1, .2, -5), Z);
    assert_near(n.z, -1, 1e-15);
    assert_near(first_t(f, vec3(.7, .2, -5), Z), 4, 1e-13);
}

static void a_turned_pocket_is_open(void **state)
{
    struct fixture *f = *state;
    struct transform t = transform_rotate(vec3(10, 20, 30));
    struct object *o = csg(f, CSG_DIFFERENCE, unit_box(f),
                           box_of(f, vec3(-.5, -.5, -1), vec3(.5, .5, 0)));
    add(f, moved(f, o, t));
    finish(f);
    for (int i = 0; i < 100; i++) {
        double x = -.45 + .009 * i, y = .4 - .008 * i;
        assert_near(
            first_t(f, transform_point(&t, vec3(x, y, -5)), transform_vector(&t, Z)), 5,
            1e-12);
    }
}

// T03, T04, T05
static void equal_solids_combine_exactly(void **state)
{
    struct fixture *f = *state;
    for (int i = 0; i < 3; i++) {
        static const enum csg_op op[] = {CSG_DIFFERENCE, CSG_MERGE, CSG_INTERSECTION};
        struct transform t = transform_translate(vec3(10 * i, 0, 0));
        add(f, moved(f, csg(f, op[i], unit_box(f), unit_box(f)), t));
        t = transform_translate(vec3(10 * i, 10, 0));
        add(f, moved(f, csg(f, op[i], sphere_at(f, 0, 0, 0, 1), sphere_at(f, 0, 0, 0, 1)),
                     t));
    }
    finish(f);
    assert_true(isinf(first_t(f, vec3(.1, .2, -5), Z)));
    assert_true(isinf(first_t(f, vec3(.1, 10.2, -5), Z)));
    for (int i = 1; i < 3; i++) {
        assert_near(first_t(f, vec3(10 * i + .1, .2, -5), Z), 4, 1e-13);
        assert_near(first_t(f, vec3(10 * i + .1, 10.2, -5), Z), 4.025320565519, 1e-11);
    }
}

// T06: the face two merged boxes share is gone; a union keeps it.
static void a_merge_loses_the_shared_face(void **state)
{
    struct fixture *f = *state;
    for (int i = 0; i < 2; i++) {
        struct object *o =
            csg(f, i ? CSG_UNION : CSG_MERGE, box_of(f, vec3(-1, -1, -1), vec3(1, 1, 0)),
                box_of(f, vec3(-1, -1, 0), vec3(1, 1, 1)));
        o->flags |= OBJECT_NO_SPLIT;
        add(f, moved(f, o, transform_translate(vec3(10 * i, 0, 0))));
    }
    finish(f);
    assert_near(first_t(f, vec3(.1, .2, -.5), Z), 1.5, 1e-13);
    assert_near(first_t(f, vec3(10.1, .2, -.5), Z), .5, 1e-13);
}

// ---- structure --------------------------------------------------------------------

// T37
static void inversions_cancel(void **state)
{
    struct fixture *f = *state;
    struct object *inverse = sphere_at(f, 10, 0, 0, 1);
    inverse->flags |= OBJECT_INVERSE;
    add(f, inverse);
    struct object *inner = csg(f, CSG_DIFFERENCE, unit_box(f), sphere_at(f, 0, 0, 0, 1));
    add(f, csg(f, CSG_DIFFERENCE, box_of(f, vec3(-1, -1, 0), vec3(1, 1, 2)), inner));
    finish(f);
    assert_near(first_t(f, vec3(10, 0, 0), Z), 1, 1e-15);
    assert_near(first_normal(f, vec3(10, 0, 0), Z).z, -1, 1e-15);
    // The upper half ball and the slab over it are left.
    assert_near(first_t(f, vec3(.1, .2, 5), BACK), 3, 1e-13);
    assert_near(first_t(f, vec3(.9, .9, -5), Z), 6, 1e-13);
    assert_near(first_t(f, vec3(.1, .2, -5), Z), 5, 1e-13);
}

// T38
static void infinite_solids(void **state)
{
    struct fixture *f = *state;
    add(f, csg(f, CSG_INTERSECTION, half_space(f, Z, 1), half_space(f, BACK, 1)));
    finish(f);
    assert_near(first_t(f, vec3(.1, .2, -5), Z), 4, 1e-13);
    assert_near(first_t(f, vec3(.1, .2, 0), Z), 1, 1e-13);
}

static void a_bowl_in_a_half_space(void **state)
{
    struct fixture *f = *state;
    add(f, csg(f, CSG_DIFFERENCE, half_space(f, Z, 0), sphere_at(f, 0, 0, 0, 1)));
    finish(f);
    assert_near(first_t(f, vec3(.1, .2, 5), BACK), 5.974679434480896, 1e-13);
    struct vec3 n = first_normal(f, vec3(.1, .2, 5), BACK);
    assert_near(n.x, -.1, 1e-13);
    assert_near(n.y, -.2, 1e-13);
    assert_near(n.z, .974679434480896, 1e-13);
}

// T42: a clip makes a hole, not a cap; it never becomes visible itself.
static void a_clip_leaves_a_hole(void **state)
{
    struct fixture *f = *state;
    struct object *o = sphere_at(f, 0, 0, 0, 1);
    const struct object *clip = half_space(f, BACK, 0); // z >= 0
    o->clip = &clip;
    o->clip_count = 1;
    add(f, o);
    finish(f);
    assert_near(first_t(f, vec3(.1, .2, -5), Z), 5.974679434480896, 1e-13);
    assert_near(first_normal(f, vec3(.1, .2, -5), Z).z, .974679434480896, 1e-13);
}

// T41: 2,000 levels written one in another.
static void deep_trees_work(void **state)
{
    struct fixture *f = *state;
    struct object *o = box_of(f, vec3(0, -1, -1), vec3(2000, 1, 1));
    for (int i = 0; i < 2000; i++)
        o = csg(f, i % 2 ? CSG_DIFFERENCE : CSG_MERGE, o,
                sphere_at(f, i + .5, 0, -1, .25));
    add(f, o);
    finish(f);
    assert_near(first_t(f, vec3(1000.5, 0, -5), Z), 3.75, 1e-12); // added
    assert_near(first_t(f, vec3(1001.5, 0, -5), Z), 4.25, 1e-12); // removed
    assert_near(first_t(f, vec3(1001.9, 0, -5), Z), 4, 1e-12);
    assert_true(world_object_inside(f->w, 0, vec3(1000.5, 0, -1.1)));
    assert_false(world_object_inside(f->w, 0, vec3(1001.5, 0, -.9)));
}

static void equal_distances_go_to_the_first(void **state)
{
    struct fixture *f = *state;
    for (int i = 0; i < 40; i++)
        add(f, unit_box(f));
    finish(f);
    struct ray_query q = query(vec3(.1, .2, -5), Z);
    assert_int_equal(f->w->leaf[trace_closest_1(f->w, f->s, &q).b.leaf].object, 0);
}

// ---- against brute force ---------------------------------------------------------------

static struct object *random_object(struct fixture *f, uint64_t *s, int depth)
{
    if (depth == 0 || random_unit(s) < .2) {
        double x = between(s, -3, 3), y = between(s, -3, 3), z = between(s, -3, 3);
        double r = between(s, .3, 1.2);
        struct object *o = random_unit(s) < .5
                               ? sphere_at(f, x, y, z, r)
                               : box_of(f, vec3(x - r, y - r, z - r), vec3(x + r, y, z));
        if (random_unit(s) < .4)
            moved(f, o, transform_scale(vec3(1, between(s, .5, 2), 1)));
        return moved(f, o, transform_rotate(vec3(between(s, 0, 90), 40, 0)));
    }
    static const enum csg_op op[] = {CSG_MERGE, CSG_INTERSECTION, CSG_DIFFERENCE};
    struct object *x = random_object(f, s, depth - 1);
    return csg(f, op[(int)(3 * random_unit(s))], x, random_object(f, s, depth - 1));
}

// One number after the other: the order of arguments is the compiler's.
static struct vec3 point_within(uint64_t *s, double most)
{
    struct vec3 p;
    p.x = between(s, -most, most);
    p.y = between(s, -most, most);
    p.z = between(s, -most, most);
    return p;
}

static struct ray_query random_ray(uint64_t *s)
{
    struct vec3 o = point_within(s, 8);
    return query(o, vec3_sub(point_within(s, 3), o));
}

static struct boundary brute(struct fixture *f, const struct ray_query *q)
{
    struct boundary best = {.t = INFINITY}, b;
    for (uint32_t i = 0; i < f->w->object_count; i++) {
        const struct world_object *o = &f->w->object[i];
        if (o->is_csg) {
            if (sweep_object(f->w, f->s, i, &q->ray, INFINITY, SWEEP_CLOSEST, &b) &&
                b.t < best.t)
                best = b;
            continue;
        }
        f->s->crossings.count = 0;
        leaf_crossings(f->w, o->first_leaf, &q->ray, &f->s->crossings);
        for (uint32_t k = 0; k < f->s->crossings.count; k++) {
            b = f->s->crossings.at[k];
            if (b.t > q->ray.t_min && b.t < best.t)
                best = b;
        }
    }
    return best;
}

static void trees_find_what_brute_force_finds(void **state)
{
    struct fixture *f = *state;
    uint64_t s = 1;
    for (int i = 0; i < 300; i++) {
        struct object *o = random_object(f, &s, i % 4);
        const struct vec3 by = point_within(&s, 9);
        add(f, moved(f, o, transform_translate(by)));
    }
    finish(f);
    int hits = 0;
    for (int i = 0; i < 4000; i++) {
        struct ray_query q = random_ray(&s);
        struct hit h = trace_closest_1(f->w, f->s, &q);
        struct boundary b = brute(f, &q);
        assert_true(h.b.t == b.t);
        assert_true(isinf(b.t) || (h.b.leaf == b.leaf && h.b.part == b.part));
        assert_true(trace_occluded_1(f->w, f->s, &q) == !isinf(b.t));
        hits += !isinf(b.t);
    }
    assert_true(hits > 2000);
}

// Far cameras and long rays must not lose anything to single precision.
static void far_rays_hit(void **state)
{
    struct fixture *f = *state;
    for (int i = 0; i < 100; i++)
        add(f, sphere_at(f, 3 * (i % 10), 3 * (i / 10), 0, 1e-3));
    finish(f);
    for (int i = 0; i < 100; i++) {
        struct vec3 to = vec3(3 * (i % 10), 3 * (i / 10), 0);
        struct vec3 from = vec3(1e6, -2e6, 3e6 + i);
        assert_near(first_t(f, from, vec3_sub(to, from)), 1, 1e-8);
    }
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

// The sweep against membership tests of points between all crossings.
static void the_sweep_agrees_with_points(void **state)
{
    struct fixture *f = *state;
    uint64_t s = 7;
    for (int i = 0; i < 60; i++)
        add(f, random_object(f, &s, 4));
    finish(f);
    for (int i = 0; i < 6000; i++) {
        struct ray_query q = random_ray(&s);
        uint32_t object = (uint32_t)i % f->w->object_count;
        const struct world_object *o = &f->w->object[object];
        if (!o->is_csg)
            continue;
        double t[256] = {0};
        int n = 1;
        f->s->crossings.count = 0;
        for (uint32_t k = 0; k < o->leaf_count; k++)
            leaf_crossings(f->w, o->first_leaf + k, &q.ray, &f->s->crossings);
        for (uint32_t k = 0; k < f->s->crossings.count && n < 255; k++)
            if (f->s->crossings.at[k].t > 0)
                t[n++] = f->s->crossings.at[k].t;
        qsort(t, (size_t)n, sizeof *t, ascending);
        t[n] = t[n - 1] + 1;
        double want = INFINITY;
        bool in = world_object_inside(f->w, object, ray_at(&q.ray, .5 * t[1]));
        for (int k = 1; k < n && isinf(want); k++)
            if (world_object_inside(f->w, object,
                                    ray_at(&q.ray, .5 * (t[k] + t[k + 1]))) != in)
                want = t[k];
        struct boundary b;
        bool found =
            sweep_object(f->w, f->s, object, &q.ray, INFINITY, SWEEP_CLOSEST, &b);
        assert_true(found == !isinf(want));
        if (found)
            assert_near(b.t, want, 1e-12);
    }
}

// T40: a large difference is what the same leaves give one by one.
static void many_holes(void **state)
{
    struct fixture *f = *state;
    const struct object **child = arena_new_array(f->a, const struct object *, 2001);
    uint64_t s = 3;
    child[0] = unit_box(f);
    for (int i = 1; i <= 2000; i++) {
        const struct vec3 at = point_within(&s, 1);
        child[i] = sphere_at(f, at.x, at.y, at.z, between(&s, .02, .1));
    }
    add(f, object_new_csg(f->a, CSG_DIFFERENCE, child, 2001, (struct span){0}));
    finish(f);
    for (int i = 0; i < 500; i++) {
        struct ray_query q = random_ray(&s);
        q.ray.d = vec3_normalize(vec3_sub(vec3(0, 0, 0), q.ray.o));
        struct hit h = trace_closest_1(f->w, f->s, &q);
        if (isinf(h.b.t) || world_object_inside(f->w, 0, q.ray.o))
            continue;
        assert_true(world_object_inside(f->w, 0, ray_at(&q.ray, h.b.t + 1e-9)));
        assert_false(world_object_inside(f->w, 0, ray_at(&q.ray, h.b.t - 1e-9)));
    }
    const struct trace_stats *st = trace_scratch_stats(f->s);
    assert_true(st->leaf_tests < 100 * st->rays);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_pocket_is_open),
        TEST(a_turned_pocket_is_open),
        TEST(equal_solids_combine_exactly),
        TEST(a_merge_loses_the_shared_face),
        TEST(inversions_cancel),
        TEST(infinite_solids),
        TEST(a_bowl_in_a_half_space),
        TEST(a_clip_leaves_a_hole),
        TEST(deep_trees_work),
        TEST(equal_distances_go_to_the_first),
        TEST(trees_find_what_brute_force_finds),
        TEST(far_rays_hit),
        TEST(the_sweep_agrees_with_points),
        TEST(many_holes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
