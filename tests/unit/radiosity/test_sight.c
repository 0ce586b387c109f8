// What is seen between points, in lanes: the bits of the scalar forms on every instruction
// set, and no ray meets what is said not to come between.
#include "test.h"

#include <stdlib.h>
#include <string.h>

#include "math/isa.h"
#include "radiosity/polygon.h"
#include "radiosity/sequence.h"
#include "scenes.h"
#include "trace/intersect.h"
#include "trace/packet.h"

enum { ROUNDS = 3000, EDGES = 24 };

static uint32_t drawn;

static double any(double low, double high)
{
    double x[4];
    random_point(drawn++, 5, x);
    return low + (high - low) * x[0];
}

static struct vec3 some_point(double size)
{
    const double x = any(-size, size), y = any(-size, size);
    return vec3(x, y, any(-size, size));
}

static uint32_t present(const struct sight_kernels *out[3])
{
    static const char *const isas[] = {"base", "avx2", "avx512"};
    uint32_t n = 0;
    for (int k = 0; k < 3; k++) {
        setenv("LAMBERT_ISA", isas[k], 1);
        if (!strcmp(packet_kernels_choose()->name, isas[k]))
            out[n++] = ISA_NAMED(isas[k], sight_kernels);
    }
    unsetenv("LAMBERT_ISA");
    assert_true(n > 0);
    return n;
}

// Polygons of three and four corners, above the horizon, below it and across.
static void edges_are_lambert_polygon(void **state)
{
    (void)state;
    const struct sight_kernels *kernels[3];
    const uint32_t isas = present(kernels);
    double number[6][EDGES], term[EDGES], height[EDGES], most = 0;
    const struct polygon_edges e = {
        {number[0], number[1], number[2]}, {number[3], number[4], number[5]}, EDGES};
    for (int round = 0; round < ROUNDS; round++) {
        struct vec3 corner[EDGES / 4][4];
        uint32_t count[EDGES / 4], at = 0;
        const struct vec3 o = some_point(1), n = vec3_normalize(some_point(1));
        memset(number, 0, sizeof number);
        for (int i = 0; i < EDGES / 4; i++) {
            count[i] = 3 + (uint32_t)(i % 2);
            for (uint32_t c = 0; c < count[i]; c++)
                corner[i][c] = c && any(0, 1) < .05 ? o : some_point(i < 3 ? .2 : 3);
            for (uint32_t c = 0; c < count[i]; c++, at++) {
                const struct vec3 b = corner[i][c + 1 == count[i] ? 0 : c + 1];
                for (int k = 0; k < 3; k++) {
                    number[k][at] = vec3_axis(corner[i][c], k);
                    number[3 + k][at] = vec3_axis(b, k);
                }
            }
        }
        for (uint32_t k = 0; k < isas; k++) {
            kernels[k]->edges(&e, o, n, term, height);
            at = 0;
            for (int i = 0; i < EDGES / 4; at += count[i++]) {
                const double f = lambert_polygon(o, n, corner[i], count[i]);
                assert_true(lambert_of_edges(o, n, corner[i], count[i], term + at,
                                             height + at) == f);
                most = f > most ? f : most;
            }
        }
    }
    assert_true(most > .5);
}

static void aims_are_points(void **state)
{
    (void)state;
    const struct sight_kernels *kernels[3];
    const uint32_t isas = present(kernels);
    struct flat_emitter of[3];
    for (int round = 0; round < ROUNDS; round++) {
        struct emitter_aims x = {.o = some_point(1), .n = vec3_normalize(some_point(1))};
        for (int i = 0; i < 3; i++)
            of[i] = (struct flat_emitter){.o = some_point(1),
                                          .a = some_point(1),
                                          .b = some_point(1),
                                          .n = vec3_normalize(some_point(1)),
                                          .u = any(0, .5),
                                          .du = any(0, .5),
                                          .v = any(0, .5),
                                          .dv = any(0, .5),
                                          .triangle = i == 1};
        for (int k = 0; k < EMITTER_RAYS; k++) {
            x.of[k] = &of[(int)any(0, 3)];
            x.u[k] = any(0, 1);
            x.v[k] = any(0, 1);
        }
        for (uint32_t i = 0; i < isas; i++) {
            kernels[i]->aim(&x);
            for (int k = 0; k < EMITTER_RAYS; k++) {
                const struct flat_emitter *e = x.of[k];
                const double u = e->u + x.u[k] * e->du, v = e->v + x.v[k] * e->dv;
                const double s = sqrt(u);
                const struct vec3 p =
                    vec3_mad(vec3_mad(e->o, e->triangle ? s * (1 - v) : u, e->a),
                             e->triangle ? s * v : v, e->b);
                const struct vec3 d = vec3_sub(p, x.o);
                const struct element_point here = {x.o, x.n, 0}, there = {p, e->n, 0};
                assert_true(x.d[0][k] == d.x && x.d[1][k] == d.y && x.d[2][k] == d.z);
                assert_true(x.kernel[k] == point_kernel(&here, &there));
            }
        }
    }
}

// How much of a segment from a to b lies in the box, as a share of it.
static double share_in(struct vec3 a, struct vec3 b, const struct shaft_boxes *boxes,
                       int object)
{
    double t0 = 0, t1 = 1;
    for (int k = 0; k < 3; k++) {
        const double o = vec3_axis(a, k), d = vec3_axis(b, k) - o;
        const double s = (boxes->low[k][object] - o) / d,
                     t = (boxes->high[k][object] - o) / d;
        t0 = fmax(t0, fmin(s, t));
        t1 = fmin(t1, fmax(s, t));
    }
    return t1 - t0;
}

static struct vec3 point_in(const struct shaft *s)
{
    return vec3_add(s->centre, vec3(any(-1, 1) * s->half.x, any(-1, 1) * s->half.y,
                                    any(-1, 1) * s->half.z));
}

static void nothing_comes_between(void **state)
{
    (void)state;
    enum { OBJECTS = 13, WAYS = 20 };
    const struct sight_kernels *kernels[3];
    const uint32_t isas = present(kernels);
    int hidden = 0, clear = 0;
    for (int round = 0; round < ROUNDS; round++) {
        struct shaft_boxes boxes = {.solid = (1u << OBJECTS) - 1};
        for (int i = 0; i < OBJECTS; i++) {
            const struct vec3 a = some_point(1), b = vec3_add(a, some_point(2));
            for (int k = 0; k < 3; k++) {
                const double x = vec3_axis(a, k), y = i % 4 == k ? x : vec3_axis(b, k);
                boxes.low[k][i] = fmin(x, y);
                boxes.high[k][i] = fmax(x, y);
            }
        }
        const struct shaft a = {.centre = some_point(1), .half = vec3(any(0, .3), 0, .1)},
                           b = {.centre = some_point(1)};
        const uint64_t some = (uint64_t)any(0, 1 << 16);
        const uint64_t found = kernels[0]->between(&boxes, &a, &b, some);
        for (uint32_t k = 1; k < isas; k++)
            assert_true(kernels[k]->between(&boxes, &a, &b, some) == found);
        assert_true(!(found & ~(some & boxes.solid)));
        for (int i = 0; i < OBJECTS; i++) {
            hidden += found >> i & 1;
            clear += (some & ~found) >> i & 1;
            for (int k = 0; k < WAYS && (some & ~found) >> i & 1; k++)
                assert_true(share_in(point_in(&a), point_in(&b), &boxes, i) <= 1e-8);
        }
    }
    assert_true(hidden > ROUNDS / 4 && clear > ROUNDS);
}

// A mean of corners with weights at random.
static struct vec3 point_of(const struct vec3 *corner, uint32_t count)
{
    struct vec3 d = {0, 0, 0};
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double weight = any(0, 1);
        d = vec3_mad(d, weight, corner[i]);
        sum += weight;
    }
    return vec3_scale(1 / sum, d);
}

// Whether the way from o along d, up to its end, passes a triangle of the hull's points
// well inside.
static bool meets(const struct shaft_hull *h, struct vec3 o, struct vec3 d)
{
    static const double inside = 1e-6;
    struct vec3 c[3];
    for (int i = 0; i < 3; i++) {
        const int k = (int)any(0, HULL_CORNERS);
        c[i] = vec3_sub(vec3(h->p[0][k], h->p[1][k], h->p[2][k]), o);
    }
    // d = x c0 + y c1 + z c2 by Cramer's rule; met at 1 / (x + y + z) of the way.
    const double det = vec3_dot(c[0], vec3_cross(c[1], c[2]));
    const double x = vec3_dot(d, vec3_cross(c[1], c[2])) / det,
                 y = vec3_dot(c[0], vec3_cross(d, c[2])) / det,
                 z = vec3_dot(c[0], vec3_cross(c[1], d)) / det;
    return fabs(det) > inside && x > inside && y > inside && z > inside &&
           x + y + z > 1 + inside;
}

// Four corners in a plane, counter-clockwise about the normal.
static void some_polygon(struct vec3 corner[4], struct vec3 *n)
{
    const struct vec3 at = some_point(2), a = some_point(.5), b = some_point(.5);
    for (int k = 0; k < 4; k++)
        corner[k] = vec3_mad(vec3_mad(at, k == 1 || k == 2, a), k > 1, b);
    *n = vec3_normalize(vec3_cross(a, b));
}

// Ways between two polygons that face each other.
static void check_beside(const struct sight_kernels *const *kernels, uint32_t isas,
                         const struct shaft_hull *h, int *parted)
{
    enum { WAYS = 20 };
    struct facing_polygons x = {.count = {4, 4}};
    some_polygon(x.corner[0], &x.n[0]);
    some_polygon(x.corner[1], &x.n[1]);
    const bool beside = kernels[0]->beside(h, &x);
    for (uint32_t isa = 1; isa < isas; isa++)
        assert_true(kernels[isa]->beside(h, &x) == beside);
    *parted += beside;
    for (int w = 0; w < WAYS && beside; w++) {
        const struct vec3 o = point_of(x.corner[0], 4);
        const struct vec3 d = vec3_sub(point_of(x.corner[1], 4), o);
        if (vec3_dot(d, x.n[0]) > 0 && vec3_dot(d, x.n[1]) < 0)
            assert_false(meets(h, o, d));
    }
}

// The hulls of meshes of one triangle and two, of turned boxes, and of products, by the
// scene; polygons above the horizon and across it.
static void hulls_hold_objects(void **state)
{
    (void)state;
    enum { WAYS = 20 };
    struct scene_run s = scene_load(
        HEAD "camera { location <0, 1, -5> look_at 0 }\n"
             "mesh { triangle { <-.5, -1, 0>, <.7, -.3, .4>, <0, .8, .1> } M(.5, 0) }\n"
             "mesh { triangle { <0, 0, 0>, <1, 0, 0>, <1, .1, 1> }\n"
             " triangle { <0, 0, 0>, <1, .1, 1>, <0, 0, 1> } M(.5, 0) }\n"
             "box { -.3, .3 rotate <30, 40, 50> translate .2 M(.5, 0) }\n"
             "intersection { box { -.4, .4 rotate 20*x } sphere { 0, 5 } M(.5, 0) }\n"
             "sphere { <.1, .2, .3>, .4 M(.5, 0) } plane { y, -3 M(.5, 0) }\n");
    const struct sight_kernels *kernels[3];
    const uint32_t isas = present(kernels), count = s.job->world->object_count;
    struct shaft_hulls *hulls = hulls_of(s.job->world);
    int parted[8] = {0}, beside[8] = {0}, met = 0;
    assert_int_equal(count, 6);
    for (uint32_t i = 0; i < count; i++)
        assert_int_equal(hulls[i].count, i == 1 ? 2 : i < 5);
    for (int round = 0; round < ROUNDS; round++) {
        struct horizon_polygon to = {.o = some_point(2)};
        struct vec3 corner[4];
        some_polygon(corner, &to.n);
        to.n = vec3_normalize(some_point(1));
        to.count = polygon_risen(to.o, to.n, corner, 4, to.corner);
        if (to.count < 3)
            continue;
        for (uint32_t i = 0; i < count; i++)
            for (uint32_t k = 0; k < hulls[i].count; k++) {
                const struct shaft_hull *h = &hulls[i].hull[k];
                const bool apart = kernels[0]->apart(h, &to);
                for (uint32_t isa = 1; isa < isas; isa++)
                    assert_true(kernels[isa]->apart(h, &to) == apart);
                parted[i] += apart;
                check_beside(kernels, isas, h, &beside[i]);
                for (int w = 0; w < WAYS; w++) {
                    const bool meet = meets(h, to.o, point_of(to.corner, to.count));
                    assert_false(apart && meet);
                    met += meet;
                }
            }
    }
    assert_true(met > ROUNDS / 10);
    for (uint32_t i = 0; i + 1 < count; i++)
        assert_true(parted[i] > ROUNDS / 4 && beside[i] > ROUNDS / 4);
    free(hulls);
    scene_free(&s);
}

// By all objects: what trace_occluded finds; by one of them: what it finds of it alone.
static void occluded_by_some(void **state)
{
    (void)state;
    struct scene_run s = scene_load(
        HEAD
        "camera { location <0, 1, -5> look_at 0 }\n"
        "sphere { <1, 0, 0>, .7 M(.5, 0) } box { <-2, -1, -1>, <-.6, .4, 1> M(.5, 0) }\n"
        "plane { y, -1 M(.5, 0) } sphere { <0, 2, 0>, .5 pigment { rgbt 1 } }\n");
    enum { RAYS = 1003 };
    const struct world *w = s.job->world;
    struct trace_scratch *scratch = trace_scratch_new(w);
    struct ray_batch *rays = ray_batch_new(RAYS);
    uint8_t all[RAYS], any_of[RAYS] = {0}, by[RAYS];
    for (rays->count = 0; rays->count < RAYS; rays->count++) {
        const uint32_t i = rays->count;
        const struct vec3 o = some_point(3), d = vec3_sub(some_point(3), o);
        for (int k = 0; k < 3; k++) {
            rays->o[k][i] = vec3_axis(o, k);
            rays->d[k][i] = vec3_axis(d, k);
        }
        rays->t_min[i] = 0;
        rays->t_max[i] = 1;
        rays->hidden_by[i] = 0;
    }
    trace_occluded(w, scratch, rays, all);
    trace_occluded_by(w, scratch, rays, (1u << w->object_count) - 1, by);
    assert_memory_equal(by, all, RAYS);
    for (uint32_t o = 0; o < w->object_count; o++) {
        uint32_t found = 0;
        trace_occluded_by(w, scratch, rays, 1u << o, by);
        for (uint32_t i = 0; i < RAYS; i++) {
            any_of[i] |= by[i];
            found += by[i];
        }
        assert_true(w->object[o].opaque ? found > 0 : !found);
    }
    assert_memory_equal(any_of, all, RAYS);
    ray_batch_free(rays);
    trace_scratch_free(scratch);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_are_lambert_polygon), cmocka_unit_test(aims_are_points),
        cmocka_unit_test(nothing_comes_between),     cmocka_unit_test(hulls_hold_objects),
        cmocka_unit_test(occluded_by_some),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
