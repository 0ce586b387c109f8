// Boxes of objects in a world, and rays that start on a surface.
#include "world_fixture.h"

#include "scene/shapes/box.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/quadric.h"
#include "scene/shapes/sphere.h"
#include "trace/accel.h"

// ---- secondary rays -------------------------------------------------------------------

// Planes that were turned with a shape lie along its own axes: what they leave of it has the
// box of that part, whatever the world's axes.
static void turned_planes_cut_boxes(void **state)
{
    struct fixture *f = *state;
    const struct transform turn = transform_rotate(vec3(0, 30, 0));
    struct object *o =
        csg(f, CSG_DIFFERENCE, box_of(f, vec3(-1, -1, -10), vec3(1, 1, 10)),
            half_space(f, vec3(0, 0, 1), 0)); // z < 0 goes
    o = csg(f, CSG_INTERSECTION, o, half_space(f, vec3(1, 0, 0), 0));
    add(f, moved(f, o, turn));
    struct object *turned_in_place =
        moved(f, half_space(f, vec3(0, 1, 0), 0), transform_rotate(vec3(0, 0, 45)));
    add(f, csg(f, CSG_INTERSECTION, box_of(f, vec3(0, -1, -1), vec3(4, 8, 1)),
               turned_in_place));
    finish(f);
    struct aabb part = aabb_empty();
    for (int i = 0; i < 8; i++) // x in [-1, 0], z in [0, 10]
        part = aabb_add(part, transform_point(&turn, vec3(i & 1 ? -1 : 0, i & 2 ? -1 : 1,
                                                          i & 4 ? 10 : 0)));
    const struct aabb box = f->w->object[0].bounds;
    assert_true(box.min.x <= part.min.x && box.max.x >= part.max.x);
    assert_true(box.min.z <= part.min.z && box.max.z >= part.max.z);
    // The plane x < 0 stands above the difference and cuts it in the world's axes only.
    assert_true(box.min.z >= part.min.z - 1 && box.max.z <= part.max.z + 1);
    // y < x, and x goes up to 4.
    assert_near(f->w->object[1].bounds.max.y, 4, 1e-6);
    assert_true(f->w->object[1].bounds.max.y >= 4);
}

// The ends along the axes of what is on one sphere and in the other, by many points.
static struct aabb points_on_in(const struct sphere *on, const struct sphere *in)
{
    enum { AROUND = 400, DOWN = 200 };
    static const double pi = 3.141592653589793;
    struct aabb box = aabb_empty();
    for (int i = 0; i < AROUND; i++) {
        for (int k = 0; k <= DOWN; k++) {
            const double phi = 2 * pi * i / AROUND, theta = pi * k / DOWN;
            const struct vec3 d =
                vec3(sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi));
            const struct vec3 p = vec3_mad(on->centre, on->radius, d);
            if (vec3_length(vec3_sub(p, in->centre)) <= in->radius)
                box = aabb_add(box, p);
        }
    }
    return box;
}

// What two spheres have in common has a box that holds it and hardly more, whether it is a thin
// lens or all of one sphere.
static void lenses_have_boxes(void **state)
{
    enum { LENSES = 30 };
    struct fixture *f = *state;
    const struct sphere *pair[LENSES][2];
    uint64_t random = 5;
    for (int i = 0; i < LENSES; i++) {
        const struct object *o[2];
        for (int k = 0; k < 2; k++) {
            o[k] = sphere_at(f, between(&random, -0.8, 0.8), between(&random, -0.8, 0.8),
                             between(&random, -0.8, 0.8), between(&random, 0.7, 2));
            pair[i][k] = o[k]->shape;
        }
        add(f, csg(f, CSG_INTERSECTION, o[0], o[1]));
    }
    finish(f);
    for (int i = 0; i < LENSES; i++) {
        const struct aabb box = f->w->object[i].bounds;
        const struct aabb part = aabb_join(points_on_in(pair[i][0], pair[i][1]),
                                           points_on_in(pair[i][1], pair[i][0]));
        assert_false(aabb_is_empty(part));
        for (int a = 0; a < 3; a++) {
            const double below = vec3_axis(part.min, a) - vec3_axis(box.min, a),
                         above = vec3_axis(box.max, a) - vec3_axis(part.max, a);
            assert_true(0 <= below && below < 0.05 && 0 <= above && above < 0.05);
        }
    }
}

// Planes across the axis of a quadric that has no end leave a part that has one, however both
// were turned, moved and scaled; what is the widest there touches the box.
static void planes_end_quadrics(void **state)
{
    struct fixture *f = *state;
    static const struct {
        struct quadric q; // around y, whose planes are y > -2 and y < 3
        double widest;
    } of[] = {
        {{.xx = 1, .yy = -1, .zz = 1, .constant = -1}, 3.16227766016838}, // sqrt(10)
        {{.xx = 1, .yy = -.25, .zz = 1}, 1.5},
        {{.xx = 1, .zz = 1, .constant = -4}, 2},
        {{.xx = 1, .zz = 1, .linear = {0, -1, 0}}, 1.73205080756888}, // sqrt(3)
        {{.centre = {5, 1, 0}, .xx = 1, .yy = -1, .zz = 1, .constant = -1},
         3.16227766016838},
    };
    enum { SHAPES = sizeof of / sizeof *of, MOVES = 4 };
    const struct vec3 degrees[MOVES] = {
        {0, 0, 0}, {90, 0, 0}, {0, 180, 90}, {20, 30, 40}};
    for (int i = 0; i < SHAPES * MOVES; i++) {
        struct quadric *q = arena_new_struct(f->a, struct quadric);
        *q = of[i / MOVES].q;
        const struct object **child = arena_new_array(f->a, const struct object *, 3);
        child[0] = half_space(f, vec3(0, 1, 0), 3);
        child[1] = object_new_shape(f->a, &quadric_ops, q, (struct span){0});
        child[2] = half_space(f, vec3(0, -1, 0), 2);
        struct object *o =
            object_new_csg(f->a, CSG_INTERSECTION, child, 3, (struct span){0});
        o = moved(f, o, transform_scale(vec3(2, 2, 2)));
        o = moved(f, o, transform_rotate(degrees[i % MOVES]));
        add(f, moved(f, o, transform_translate(vec3(7, -8, 9))));
    }
    finish(f);
    for (int i = 0; i < SHAPES * MOVES; i++) {
        const double r = of[i / MOVES].widest, end = i / MOVES == 4 ? -2 : 3;
        const struct vec3 c = of[i / MOVES].q.centre;
        const struct transform turn = transform_rotate(degrees[i % MOVES]);
        const struct aabb box = f->w->object[i].bounds;
        assert_true(aabb_is_finite(box));
        struct aabb rim = aabb_empty();
        for (int k = 0; k < 64; k++) {
            const double angle = k * .0981747704246810; // a 64th of the circle
            const struct vec3 p =
                vec3(2 * (c.x + r * cos(angle)), 2 * end, 2 * r * sin(angle));
            rim = aabb_add(rim, vec3_add(transform_point(&turn, p), vec3(7, -8, 9)));
        }
        assert_true(box.min.x <= rim.min.x && box.max.x >= rim.max.x);
        assert_true(box.min.y <= rim.min.y && box.max.y >= rim.max.y);
        assert_true(box.min.z <= rim.min.z && box.max.z >= rim.max.z);
        const struct vec3 size = vec3_sub(box.max, box.min);
        if (i % MOVES < 3) // by right angles: no corner of the box is lost
            assert_true(size.x + size.y + size.z <= 2 * (2 * r + 2 * r + 5) * (1 + 1e-6));
    }
}

// Planes alone that enclose a polyhedron give it its box, whatever way they stand; others none.
static void planes_enclose_polyhedra(void **state)
{
    struct fixture *f = *state;
    enum { TURNS = 4, FACES = 8 };
    const struct vec3 degrees[TURNS] = {{0, 0, 0}, {90, 0, 0}, {45, 0, 45}, {20, 30, 40}};
    const struct vec3 to = vec3(70, -8, 9);
    for (int i = 0; i < 2 * TURNS; i++) { // octahedra of radius 2, and without a face
        const uint32_t faces = i < TURNS ? FACES : FACES / 2;
        const struct object **child = arena_new_array(f->a, const struct object *, FACES);
        for (uint32_t k = 0; k < faces; k++)
            child[k] = half_space(
                f, vec3_normalize(vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)),
                2 / sqrt(3));
        struct object *o =
            object_new_csg(f->a, CSG_INTERSECTION, child, faces, (struct span){0});
        o = moved(f, o, transform_rotate(degrees[i % TURNS]));
        add(f, moved(f, o, transform_translate(to)));
    }
    finish(f);
    for (int i = 0; i < TURNS; i++) {
        const struct transform turn = transform_rotate(degrees[i]);
        const struct aabb box = f->w->object[i].bounds;
        struct aabb corners = aabb_empty();
        for (int k = 0; k < 6; k++) {
            const double r = k & 1 ? -2 : 2;
            const struct vec3 p =
                vec3(k / 2 == 0 ? r : 0, k / 2 == 1 ? r : 0, k / 2 == 2 ? r : 0);
            corners = aabb_add(corners, vec3_add(transform_point(&turn, p), to));
        }
        for (int a = 0; a < 3; a++) {
            const double above = vec3_axis(box.max, a) - vec3_axis(corners.max, a);
            const double below = vec3_axis(corners.min, a) - vec3_axis(box.min, a);
            assert_true(above >= -1e-14 && above < 1e-6 && below >= -1e-14 &&
                        below < 1e-6);
        }
        assert_false(aabb_is_finite(f->w->object[TURNS + i].bounds));
    }
}

// Shadow rays that nothing opaque stops go on among the objects that let light through.
static void the_clear_world_has_no_opaque_object(void **state)
{
    struct fixture *f = *state;
    add(f, sphere_at(f, 0, 0, 5, 1));
    struct object *glass = sphere_at(f, 0, 0, 9, 1);
    glass->texture = (struct attached_texture){&clear_texture, &transform_identity};
    add(f, glass);
    add(f, half_space(f, vec3(0, 0, -1), -20));
    finish(f);
    const struct ray_query q = query(vec3(0, 0, 0), Z);
    assert_near(trace_closest_1(f->w, f->s, &q).b.t, 4, 1e-13);
    assert_non_null(f->w->clear);
    const struct hit hit = trace_closest_1(f->w->clear, f->s, &q);
    assert_near(hit.b.t, 8, 1e-13);
    assert_int_equal(hit.b.leaf, 1);
    const struct ray_query past = query(vec3(0, 5, 0), Z);
    assert_true(trace_closest_1(f->w->clear, f->s, &past).b.t == INFINITY);
}

// T35 at several magnitudes: a ray leaving a convex surface never meets it again, and one
// that enters meets the far side.
static void a_ray_leaves_its_surface(void **state)
{
    struct fixture *f = *state;
    static const double scale[] = {1e-5, 1, 1e5, 1, 1}, far[] = {0, 0, 0, 1e6, -1e4};
    for (int i = 0; i < 5; i++) {
        struct object *o = i == 4 ? unit_box(f) : sphere_at(f, 0, 0, 0, 1);
        moved(f, o, transform_rotate(vec3(10 * i, 20, 30)));
        moved(f, o,
              transform_scale(vec3(scale[i], scale[i] * (i == 4 ? 2 : 1), scale[i])));
        add(f, moved(f, o, transform_translate(vec3(far[i], far[i], far[i]))));
        f->scene.object_count = 1;
        f->object[0] = o;
        trace_scratch_free(f->s);
        finish(f);
        uint64_t s = 5;
        for (int k = 0; k < 2000; k++) {
            struct vec3 c = vec3(far[i], far[i], far[i]);
            struct vec3 d =
                vec3(between(&s, -1, 1), between(&s, -1, 1), between(&s, -1, 1));
            struct ray_query q = query(vec3_mad(c, 10 * scale[i], d), vec3_neg(d));
            q.ray.d = vec3_add(q.ray.d, vec3(between(&s, -.05, .05), 0, 0));
            struct hit h = trace_closest_1(f->w, f->s, &q);
            if (isinf(h.b.t))
                continue;
            struct interaction at;
            trace_interaction(f->w, &q.ray, &h, &at);
            struct vec3 out =
                vec3(between(&s, -1, 1), between(&s, -1, 1), between(&s, -1, 1));
            if (vec3_dot(out, at.ng) < 0)
                out = vec3_neg(out);
            assert_true(isinf(first_t(f, trace_offset(&at, out), out)));
            struct vec3 in = vec3_neg(at.ng);
            assert_true(first_t(f, trace_offset(&at, in), in) > 1e-6 * scale[i]);
        }
    }
}

// T31: a sheet this close still throws a shadow.
static void small_gaps_are_seen(void **state)
{
    struct fixture *f = *state;
    add(f, half_space(f, Z, 0));
    add(f, box_of(f, vec3(-1, -1, 5e-5), vec3(1, 1, 6e-5)));
    struct object *pane = box_of(f, vec3(4, -1, 1), vec3(6, 1, 2));
    pane->texture = (struct attached_texture){&clear_texture, &transform_identity};
    add(f, pane);
    finish(f);
    struct ray_query q = query(vec3(0, 0, -1e-12), Z);
    assert_false(trace_occluded_1(
        f->w, f->s, &(struct ray_query){.ray = {vec3(9, 9, 5), Z, 0, INFINITY}}));
    q = query(vec3(.3, 5, 3), vec3(0, -5, -3));
    struct hit h = trace_closest_1(f->w, f->s, &q); // meets the sheet's upper face
    assert_int_equal(f->w->leaf[h.b.leaf].object, 1);
    q = query(vec3(5, 0, 9), vec3(0, 0, -1));
    h = trace_closest_1(f->w, f->s, &q);
    assert_int_equal(f->w->leaf[h.b.leaf].object, 2);
    q.ray.t_max = 8.5; // the pane lets light through
    assert_false(trace_occluded_1(f->w, f->s, &q));
    assert_true(f->w->has_transparent);
    // From the floor under the sheet, up.
    struct ray floor_ray = {vec3(.1, .1, -1), Z, 0, INFINITY};
    struct hit under = {.b = {.t = 1, .leaf = f->w->object[0].first_leaf}};
    struct interaction at;
    trace_interaction(f->w, &floor_ray, &under, &at);
    q = query(trace_offset(&at, Z), Z);
    assert_near(trace_closest_1(f->w, f->s, &q).b.t, 5e-5, 1e-12);
    assert_true(trace_occluded_1(f->w, f->s, &q));
}

static void visibility_and_points(void **state)
{
    struct fixture *f = *state;
    struct object *o = sphere_at(f, 0, 0, 0, 1);
    o->flags |= OBJECT_NO_SHADOW;
    add(f, o);
    add(f, sphere_at(f, 0, 0, .5, 1));
    add(f, half_space(f, Z, 0));
    finish(f);
    struct ray_query q = query(vec3(0, 0, -5), Z);
    q.ray.t_max = 4.2;
    q.hidden_by = OBJECT_NO_SHADOW;
    assert_false(trace_occluded_1(f->w, f->s, &q));
    q.hidden_by = 0;
    assert_true(trace_occluded_1(f->w, f->s, &q));
    uint32_t in[4];
    assert_int_equal(trace_containing(f->w, vec3(0, 0, -.2), in, 4), 3);
    assert_int_equal(in[0], 0);
    assert_int_equal(in[1], 1);
    assert_int_equal(in[2], 2);
    assert_int_equal(trace_containing(f->w, vec3(0, 0, 9), in, 4), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(turned_planes_cut_boxes),
        TEST(lenses_have_boxes),
        TEST(planes_end_quadrics),
        TEST(planes_enclose_polyhedra),
        TEST(the_clear_world_has_no_opaque_object),
        TEST(a_ray_leaves_its_surface),
        TEST(small_gaps_are_seen),
        TEST(visibility_and_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
