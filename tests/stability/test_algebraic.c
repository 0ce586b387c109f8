// Polynomials and blobs against their own formulas.
#include "test.h"

#include "lanes.h"
#include "trace/packet.h"

enum { PACKETS = 400 };

// What intervals know of a bounded polynomial when it is read.
static void boxes_hold_bounded_polynomials(void **state)
{
    (void)state;
    static const char *const bounded[] = {
        "polynomial { 2, xyz(2,0,0): 1, xyz(0,2,0): 4, xyz(0,0,2): 1, xyz(1,0,0): -.8, "
        "xyz(0,0,0): -.2 }",
        "quartic { <1,0,0,0,2,0,0,2,0,-1.3, 0,0,0,0,0,0,0,0,0,0, 1,0,0,2,0,.82,0,0,0,0, "
        "1,0,-1.3,0,.1681> }",
        "polynomial { 4, xyz(4,0,0): 1, xyz(2,2,0): -1, xyz(0,4,0): 1, xyz(0,0,4): 1, "
        "xyz(1,1,1): .3, xyz(0,0,1): -.2, xyz(0,0,0): -.01 }",
        "polynomial { 34, xyz(34,0,0): 1, xyz(0,34,0): 1, xyz(0,0,34): 1, xyz(1,0,0): "
        "-.2, xyz(0,0,0): -.1 }",
    };
    uint64_t s = 11;
    for (size_t n = 0; n < sizeof bounded / sizeof *bounded; n++) {
        struct loaded l;
        load(&l, "%s", bounded[n]);
        const struct leaf *leaf = &l.world->leaf[0];
        const struct aabb box = leaf->ops->bounds(leaf->shape);
        int in = 0;
        assert_true(aabb_is_finite(box));
        assert_true(box.max.x - box.min.x < 4);
        for (int i = 0; i < 20000; i++) {
            const struct vec3 p = vec3(4 * lanes_unit(&s) - 2, 4 * lanes_unit(&s) - 2,
                                       4 * lanes_unit(&s) - 2);
            if (!leaf->ops->inside(leaf->shape, p))
                continue;
            in++;
            assert_true(p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z &&
                        p.x <= box.max.x && p.y <= box.max.y && p.z <= box.max.z);
        }
        assert_true(in > 20);
        unload(&l);
    }
}

// A blob of many components, which it finds by a tree, against the sum of all of them.
static void many_components_are_all_found(void **state)
{
    (void)state;
    enum { MANY = 400 };
    static char text[64 * MANY];
    static double ball[MANY][5];
    uint64_t s = 23;
    size_t n = (size_t)snprintf(text, sizeof text, "blob { threshold .4");
    for (int i = 0; i < MANY; i++) {
        for (int k = 0; k < 3; k++)
            ball[i][k] = round(2e4 * lanes_unit(&s) - 1e4) / 1e4;
        ball[i][3] = round(1e3 * (.05 + .15 * lanes_unit(&s))) / 1e3;
        ball[i][4] = lanes_unit(&s) < .2 ? -.5 : 1;
        n += (size_t)snprintf(text + n, sizeof text - n,
                              " sphere { <%.4f, %.4f, %.4f>, %.3f, %.1f }", ball[i][0],
                              ball[i][1], ball[i][2], ball[i][3], ball[i][4]);
    }
    struct loaded l;
    load(&l, "%s }", text);
    const struct leaf *leaf = &l.world->leaf[0];
    int in = 0;
    for (int i = 0; i < 20000; i++) {
        const struct vec3 p = vec3(2.4 * lanes_unit(&s) - 1.2, 2.4 * lanes_unit(&s) - 1.2,
                                   2.4 * lanes_unit(&s) - 1.2);
        double sum = 0;
        for (int k = 0; k < MANY; k++) {
            const struct vec3 v = vec3_sub(p, vec3(ball[k][0], ball[k][1], ball[k][2]));
            const double q = 1 - vec3_dot(v, v) / (ball[k][3] * ball[k][3]);
            sum += q > 0 ? ball[k][4] * q * q : 0;
        }
        if (fabs(sum - .4) < 1e-12)
            continue;
        in += sum > .4;
        assert_int_equal(leaf->ops->inside(leaf->shape, p), sum > .4);
    }
    assert_true(in > 1000);
    lanes_compare(&l, "a blob of 400 components", false, PACKETS, false, false);
    lanes_compare(&l, "a blob of 400 components", true, PACKETS, false, false);
    unload(&l);
}

// x^34 + y^34 + z^34 = .2 x + 1: expanded along a ray, terms of 1e9 cancel.
static double value_34(const struct ray *r, double t)
{
    const struct vec3 p = vec3_mad(r->o, t, r->d);
    return pow(p.x, 34) + pow(p.y, 34) + pow(p.z, 34) - .2 * p.x - 1;
}

static void high_orders_are_met_where_they_are(void **state)
{
    (void)state;
    struct loaded l;
    load(&l, "polynomial { 35, xyz(34,0,0): 1, xyz(0,34,0): 1, xyz(0,0,34): 1, "
             "xyz(1,0,0): -.2, xyz(0,0,0): -1 }");
    const struct leaf *leaf = &l.world->leaf[0];
    const struct shape_kernels *k = packet_kernels_choose()->shapes;
    uint64_t s = 5;
    int hits = 0;
    for (int n = 0; n < 200; n++) {
        struct shape_rays rays;
        struct shape_hits out = {.cancel = NULL};
        for (int i = 0; i < 8; i++) {
            for (int a = 0; a < 3; a++) {
                rays.o[a][i] = 8 * lanes_unit(&s) - 4;
                rays.d[a][i] = 1.6 * lanes_unit(&s) - .8 - rays.o[a][i];
            }
            rays.t_min[i] = 0;
            rays.t_max[i] = 1; // in the set
        }
        unsigned outside = 0;
        for (int i = 0; i < 8; i++) {
            const struct ray r = lanes_ray(&rays, i);
            outside |= (unsigned)(value_34(&r, 0) > 0) << i;
        }
        const unsigned met =
            leaf->ops->closest8(k, leaf->shape, &rays, outside, false, &out);
        assert_int_equal(met, outside);
        for (int i = 0; i < 8; i++) {
            if (!(met >> i & 1))
                continue;
            const struct ray r = lanes_ray(&rays, i);
            double lo = 0, hi = 1; // convex: one crossing
            for (int b = 0; b < 60; b++) {
                const double t = .5 * (lo + hi);
                *(value_34(&r, t) > 0 ? &lo : &hi) = t;
            }
            assert_true(fabs(out.t[i] - lo) <= out.dt[i] + 1e-15);
            assert_true(out.dt[i] < 1e-4);
            hits++;
        }
    }
    assert_true(hits > 1000);
    unload(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_hold_bounded_polynomials),
        cmocka_unit_test(many_components_are_all_found),
        cmocka_unit_test(high_orders_are_met_where_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
