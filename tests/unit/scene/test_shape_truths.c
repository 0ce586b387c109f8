// Analytic truths and slow references of shapes that find their crossings by iteration:
// Bezier patches, sphere sweeps, height fields; and `closest` against `intersect` for all.
#include "test.h"

#include "base/arena.h"
#include "base/diag.h"
#include "fake_args.h"
#include "scene/shape_kernels.h"

static double uniform(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static struct vec3 in_cube(uint64_t *seed)
{
    const double x = uniform(seed), y = uniform(seed), z = uniform(seed);
    return vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
}

static void quiet(void *user, const struct diag *d)
{
    (void)user;
    (void)d;
}

static const struct shape_ops *make(struct arena *a, const char *word, const char *text,
                                    void **shape)
{
    struct diag_sink sink = {.emit = quiet};
    const struct shape_ops *ops = shape_find(word, strlen(word));
    if (!ops)
        fail_msg("no shape '%s'", word);
    *shape = arena_alloc(a, ops->size);
    struct args *args = fake_args_new(a, &sink, text);
    if (!ops->build(*shape, args) || fake_args_failed(args))
        fail_msg("%s { %s } does not build", word, text);
    return ops;
}

static struct ray ray_to(struct vec3 from, struct vec3 to)
{
    return (struct ray){from, vec3_sub(to, from), -INFINITY, INFINITY};
}

// The first drawn crossing by the shape's own short cut: `closest`, lanes, or a list of one.
static bool first_of(const struct shape_ops *ops, const void *shape, const struct ray *r,
                     struct boundary *first)
{
    if (shape_has_lanes(ops, shape)) {
        struct shape_rays rays;
        struct shape_hits hits = {.evaluations = 0};
        for (int i = 0; i < 8; i++) {
            for (int k = 0; k < 3; k++) {
                rays.o[k][i] = vec3_axis(r->o, k);
                rays.d[k][i] = vec3_axis(r->d, k);
            }
            rays.t_min[i] = r->t_min;
            rays.t_max[i] = r->t_max;
        }
        if (!ops->closest8(&shape_kernels_base, shape, &rays, 1, false, &hits))
            return false;
        *first =
            (struct boundary){.t = hits.t[0], .dt = hits.dt[0], .part = hits.part[0]};
        return true;
    }
    if (ops->closest)
        return ops->closest(shape, r, first);
    struct boundary_list l = {.first_only = true};
    ops->intersect(shape, r, &l);
    const bool found = l.count > 0 && l.at[0].t > r->t_min && l.at[0].t < r->t_max;
    if (found)
        *first = l.at[0];
    boundary_list_free(&l);
    return found;
}

// ---- patches --------------------------------------------------------------------------

struct control {
    struct vec3 p[16];
};

static const struct shape_ops *make_patch(struct arena *a, const struct control *c,
                                          void **shape)
{
    char *text = arena_printf(a, "type 1");
    for (int i = 0; i < 16; i++)
        text = arena_printf(a, "%s <%.17g, %.17g, %.17g>", text, c->p[i].x, c->p[i].y,
                            c->p[i].z);
    return make(a, "bicubic_patch", text, shape);
}

static struct control grid(double (*height)(int i, int j))
{
    struct control c;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            c.p[4 * i + j] = vec3(-1 + j * (2. / 3), -1 + i * (2. / 3), height(i, j));
    return c;
}

static double arch(int i, int j)
{
    (void)i;
    return j == 1 || j == 2;
}

// z(x) = 0.75 (1 - x^2), exactly; across the fold there are two crossings or none.
static void arch_is_a_parabola(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct boundary_list l = {0};
    const struct control c = grid(arch);
    void *shape;
    const struct shape_ops *ops = make_patch(a, &c, &shape);
    uint64_t seed = 3;
    for (int k = 0; k < 2000; k++) {
        const double x = 1.9 * uniform(&seed) - .95, y = 1.9 * uniform(&seed) - .95;
        const struct ray r = {vec3(x, y, -5), vec3(0, 0, 1), -INFINITY, INFINITY};
        l.count = 0;
        ops->intersect(shape, &r, &l);
        assert_int_equal(l.count, 1);
        assert_near(l.at[0].t, 5 + .75 * (1 - x * x), 1e-13);
        struct surface_point s = {0};
        ops->surface(shape, &l.at[0], ray_at(&r, l.at[0].t), &s);
        const struct vec3 n = vec3_normalize(vec3(-1.5 * x, 0, -1));
        assert_near(vec3_length(vec3_sub(s.ng, n)), 0, 1e-12);
    }
    for (int k = 3; k < 15; k++)
        for (int side = -1; side <= 1; side += 2) {
            const double z = .75 + side * pow(10, -k);
            const struct ray r = {vec3(-5, .123, z), vec3(1, 0, 0), -INFINITY, INFINITY};
            l.count = 0;
            ops->intersect(shape, &r, &l);
            assert_int_equal(l.count, side < 0 ? 2 : 0);
            for (uint32_t i = 0; i < l.count; i++) {
                const double x = sqrt(1 - z / .75) * (i ? 1 : -1);
                assert_true(fabs(l.at[i].t - (5 + x)) <= l.at[i].dt + 1e-12);
            }
        }
    boundary_list_free(&l);
    arena_free(a);
}

// A flat sector with four equal points: its normal is that of its plane everywhere.
static void collapsed_edge_has_a_normal(void **state)
{
    const double right_angle = 1.5707963267948966;
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct boundary_list l = {0};
    struct control c;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            c.p[4 * i + j] = vec3(i * cos(j * right_angle / 3) / 3, 0,
                                  i * sin(j * right_angle / 3) / 3);
    void *shape;
    const struct shape_ops *ops = make_patch(a, &c, &shape);
    const double r[] = {.3, .05, .014, 1e-4, 1e-8, 1e-12, 0};
    for (size_t k = 0; k < sizeof r / sizeof r[0]; k++) {
        const struct ray ray = {vec3(r[k] * .6, 3, r[k] * .8), vec3(0, -1, 0), -INFINITY,
                                INFINITY};
        l.count = 0;
        ops->intersect(shape, &ray, &l);
        if (l.count == 0)
            fail_msg("a ray %g from the apex slips through", r[k]);
        assert_near(l.at[0].t, 3, 1e-12);
        struct surface_point s = {0};
        ops->surface(shape, &l.at[0], ray_at(&ray, l.at[0].t), &s);
        assert_near(fabs(s.ng.y), 1, 1e-9);
    }
    boundary_list_free(&l);
    arena_free(a);
}

// Two patches bent differently over one edge: no ray to the edge slips through.
static void shared_edge_is_closed(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct boundary_list l = {0};
    struct control c[2];
    uint64_t seed = 8;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                c[k].p[4 * i + j] = vec3(j / 3., (k ? -i : i) / 3., uniform(&seed));
    memcpy(c[1].p, c[0].p, 4 * sizeof c[0].p[0]);
    void *shape[2];
    const struct shape_ops *ops = NULL;
    for (int k = 0; k < 2; k++)
        ops = make_patch(a, &c[k], &shape[k]);
    for (int k = 0; k < 10000; k++) {
        const double w = k % 16 ? uniform(&seed) : (k / 16 % 17) / 16., z = 1 - w;
        const double b[4] = {z * z * z, 3 * w * z * z, 3 * w * w * z, w * w * w};
        struct vec3 at = {0, 0, 0};
        for (int j = 0; j < 4; j++)
            at = vec3_mad(at, b[j], c[0].p[j]);
        const struct ray r =
            ray_to(vec3_add(at, vec3(uniform(&seed) - .5, uniform(&seed) - .5,
                                     -2 - 3 * uniform(&seed))),
                   at);
        bool met = false, first_met = false;
        for (int i = 0; i < 2; i++) {
            struct boundary first;
            l.count = 0;
            ops->intersect(shape[i], &r, &l);
            for (uint32_t n = 0; n < l.count; n++)
                met |= fabs(l.at[n].t - 1) < 1e-6;
            const struct ray ahead = {r.o, r.d, 0, INFINITY};
            first_met |= first_of(ops, shape[i], &ahead, &first) && first.t < 1 + 1e-6;
        }
        if (!met || !first_met)
            fail_msg("a ray slips through the edge at w = %.17g", w);
    }
    boundary_list_free(&l);
    arena_free(a);
}

// Slow reference: halving down to 2^-26 of the patch in extended precision.
struct exact {
    long double p[16][2];
    double u, v, width;
};

static void halves(const struct exact *n, bool along_u, struct exact h[2])
{
    h[0] = h[1] = *n;
    const int step = along_u ? 4 : 1, across = along_u ? 1 : 4;
    for (int j = 0; j < 4; j++)
        for (int k = 0; k < 2; k++) {
            const int o = j * across;
            const long double p0 = n->p[o][k], p1 = n->p[o + step][k],
                              p2 = n->p[o + 2 * step][k], p3 = n->p[o + 3 * step][k];
            const long double a = (p0 + p1) / 2, b = (p1 + p2) / 2, c = (p2 + p3) / 2;
            const long double d = (a + b) / 2, e = (b + c) / 2, f = (d + e) / 2;
            h[0].p[o + step][k] = a;
            h[0].p[o + 2 * step][k] = d;
            h[0].p[o + 3 * step][k] = h[1].p[o][k] = f;
            h[1].p[o + step][k] = e;
            h[1].p[o + 2 * step][k] = c;
        }
}

struct found {
    double u[64], v[64];
    int count;
};

static void search(const struct exact *n, struct found *f)
{
    for (int k = 0; k < 2; k++) {
        int above = 0, below = 0;
        for (int i = 0; i < 16; i++) {
            above += n->p[i][k] > 0;
            below += n->p[i][k] < 0;
        }
        if (above == 16 || below == 16)
            return;
    }
    if (n->width < 0x1p-26) {
        for (int i = 0; i < f->count; i++)
            if (fabs(f->u[i] - n->u) < 1e-5 && fabs(f->v[i] - n->v) < 1e-5)
                return;
        if (f->count < 64) {
            f->u[f->count] = n->u;
            f->v[f->count++] = n->v;
        }
        return;
    }
    struct exact u[2], v[2];
    halves(n, true, u);
    u[1].u = n->u + n->width / 2;
    for (int i = 0; i < 2; i++) {
        u[i].width = n->width / 2;
        halves(&u[i], false, v);
        v[1].v = n->v + n->width / 2;
        search(&v[0], f);
        search(&v[1], f);
    }
}

static void folded_patches_keep_all_crossings(void **state)
{
    (void)state;
    struct boundary_list l = {0};
    uint64_t seed = 21;
    int most = 0, met = 0;
    for (int n = 0; n < 40; n++) {
        struct arena *a = arena_new(1 << 16);
        struct control c;
        for (int i = 0; i < 16; i++)
            c.p[i] =
                vec3_add(vec3(i % 4 / 3., i / 4 / 3., 0), vec3_scale(.9, in_cube(&seed)));
        void *shape;
        const struct shape_ops *ops = make_patch(a, &c, &shape);
        for (int k = 0; k < 60; k++) {
            const struct ray r = ray_to(vec3(uniform(&seed), uniform(&seed), -4),
                                        vec3(uniform(&seed), uniform(&seed), 4));
            struct exact e = {.width = 1};
            for (int i = 0; i < 16; i++) { // across the ray, by its slopes
                const struct vec3 q = vec3_sub(c.p[i], r.o);
                e.p[i][0] = q.x - (long double)q.z * r.d.x / r.d.z;
                e.p[i][1] = q.y - (long double)q.z * r.d.y / r.d.z;
            }
            struct found f = {.count = 0};
            search(&e, &f);
            l.count = 0;
            ops->intersect(shape, &r, &l);
            if ((int)l.count != f.count)
                fail_msg("patch %d, ray %d: %u crossings, not %d", n, k, l.count,
                         f.count);
            for (int i = 0; i < f.count; i++) {
                double near = 1;
                for (uint32_t m = 0; m < l.count; m++)
                    near =
                        fmin(near, fabs(l.at[m].u - f.u[i]) + fabs(l.at[m].v - f.v[i]));
                assert_true(near < 1e-5);
            }
            most = f.count > most ? f.count : most;
            met += f.count > 0;
        }
        arena_free(a);
    }
    assert_true(most >= 4 && met > 500);
    boundary_list_free(&l);
}

static void patches_without_area_are_not_met(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct boundary_list l = {0};
    struct control c[2];
    for (int i = 0; i < 16; i++) {
        c[0].p[i] = vec3(.1, .2, .3);
        c[1].p[i] = vec3_scale(i % 5, vec3(.1, .2, .3));
    }
    for (int k = 0; k < 2; k++) {
        void *shape;
        const struct shape_ops *ops = make_patch(a, &c[k], &shape);
        const struct ray r = ray_to(vec3(0, 0, -5), vec3(.1, .2, .3));
        ops->intersect(shape, &r, &l);
        assert_int_equal(l.count, 0);
    }
    boundary_list_free(&l);
    arena_free(a);
}

// ---- sphere sweeps --------------------------------------------------------------------

static void spline_ball(const char *kind, const double (*b)[4], double u, double out[4])
{
    for (int k = 0; k < 4; k++) {
        const double p0 = b[0][k], p1 = b[1][k], p2 = b[2][k], p3 = b[3][k];
        if (kind[0] == 'l')
            out[k] = p0 + u * (p1 - p0);
        else if (kind[0] == 'c')
            out[k] =
                p1 + u * ((p2 - p0) / 2 + u * (p0 - 2.5 * p1 + 2 * p2 - p3 / 2 +
                                               u * (-p0 + 3 * p1 - 3 * p2 + p3) / 2));
        else
            out[k] = (p0 + 4 * p1 + p2) / 6 +
                     u * ((p2 - p0) / 2 + u * ((p0 - 2 * p1 + p2) / 2 +
                                               u * (-p0 + 3 * p1 - 3 * p2 + p3) / 6));
    }
}

// Every ball of the sweep lies within one of the stretches found, and every end found is
// near the end of a ball.
static void check_sweep(const char *kind, double scale, uint64_t *seed)
{
    enum { BALLS = 5, STEPS = 1500 };
    struct arena *a = arena_new(1 << 16);
    struct boundary_list l = {0};
    double b[BALLS + 3][4] = {{0}};
    char *text = arena_printf(a, "%s %d", kind, BALLS);
    for (int i = 0; i < BALLS; i++) {
        const struct vec3 p = vec3_scale(scale, in_cube(seed));
        const double r = scale * (.05 + .4 * uniform(seed));
        text = arena_printf(a, "%s <%.17g, %.17g, %.17g>, %.17g", text, p.x, p.y, p.z, r);
        b[i][0] = p.x;
        b[i][1] = p.y;
        b[i][2] = p.z;
        b[i][3] = r;
    }
    void *shape;
    const struct shape_ops *ops = make(a, "sphere_sweep", text, &shape);
    const int segments = kind[0] == 'l' ? BALLS - 1 : BALLS - 3;
    for (int k = 0; k < 40; k++) {
        const struct vec3 d = vec3_normalize(in_cube(seed));
        const struct ray r = {vec3_mad(vec3_scale(scale, in_cube(seed)), -5 * scale, d),
                              d, -INFINITY, INFINITY};
        double gap[64];
        l.count = 0;
        ops->intersect(shape, &r, &l);
        assert_true(l.count % 2 == 0 && l.count < 64);
        for (uint32_t i = 0; i < l.count; i++)
            gap[i] = INFINITY;
        for (int n = 0; n <= segments * STEPS; n++) {
            double c[4];
            const int at = n / STEPS < segments ? n / STEPS : segments - 1;
            spline_ball(kind, (const double(*)[4])b + at, n / (double)STEPS - at, c);
            const struct vec3 to = vec3_sub(vec3(c[0], c[1], c[2]), r.o);
            const double tau = vec3_dot(to, d);
            const struct vec3 off = vec3_mad(to, -tau, d);
            const double w = c[3] * c[3] - vec3_dot(off, off), h = sqrt(fmax(0, w));
            bool held = w < 1e-12 * scale * scale;
            for (uint32_t i = 0; i < l.count; i += 2) {
                const double slack = 1e-10 * scale;
                held |= tau - h >= l.at[i].t - slack && tau + h <= l.at[i + 1].t + slack;
                gap[i] = fmin(gap[i], fabs(tau - h - l.at[i].t));
                gap[i + 1] = fmin(gap[i + 1], fabs(tau + h - l.at[i + 1].t));
            }
            if (!held)
                fail_msg("%s at scale %g: a ball sticks out of what ray %d met", kind,
                         scale, k);
        }
        for (uint32_t i = 0; i < l.count; i++)
            if (gap[i] > .02 * scale)
                fail_msg("%s at scale %g: no ball ends where a crossing is", kind, scale);
    }
    boundary_list_free(&l);
    arena_free(a);
}

static void sweeps_hold_their_balls(void **state)
{
    (void)state;
    static const char *const kind[] = {"linear_spline", "cubic_spline", "b_spline"};
    static const double scale[] = {1, 1e-3, 1e5};
    uint64_t seed = 77;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            for (int n = 0; n < 6; n++)
                check_sweep(kind[i], scale[k], &seed);
}

// A straight sweep of equal balls is a cylinder with round ends, met squarely.
static void sweep_is_a_capsule(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct boundary_list l = {0};
    void *shape;
    const struct shape_ops *ops =
        make(a, "sphere_sweep", "linear_spline 2, <-1,0,0>, .5, <1,0,0>, .5", &shape);
    for (int k = 0; k < 200; k++) {
        const double x = -1.6 + 3.2 * k / 199., y = .3;
        const double over = fabs(x) > 1 ? fabs(x) - 1 : 0, h2 = .25 - y * y - over * over;
        const struct ray r = {vec3(x, y, -5), vec3(0, 0, 1), -INFINITY, INFINITY};
        l.count = 0;
        ops->intersect(shape, &r, &l);
        assert_int_equal(l.count, h2 > 0 ? 2 : 0);
        if (l.count)
            assert_near(l.at[0].t, 5 - sqrt(h2), 1e-12);
    }
    boundary_list_free(&l);
    arena_free(a);
}

// ---- height fields --------------------------------------------------------------------

// Through samples, along grid lines and along diagonals (9 by 7 samples).
static void height_field_is_watertight(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct boundary_list l = {0};
    void *shape;
    const struct shape_ops *ops = make(a, "height_field", "", &shape);
    uint64_t seed = 4;
    for (int k = 0; k < 4000; k++) {
        const double i = 1 + (int)(7 * uniform(&seed)), j = 1 + (int)(5 * uniform(&seed));
        const double along = k % 3 ? uniform(&seed) : 0;
        const double x = k % 2 ? i - along : i,
                     z = k % 2 ? j + along : j + along * (k % 4 / 2);
        struct vec3 top = vec3(fmax(0, fmin(8, x)) / 8, 2, fmax(0, fmin(6, z)) / 6);
        struct vec3 foot = vec3(top.x, -1, top.z);
        if (k % 5 == 0) // aslant over the grid lines
            foot.x = i / 8;
        const struct ray r = ray_to(top, foot);
        struct boundary first;
        l.count = 0;
        ops->intersect(shape, &r, &l);
        const bool upright = r.d.x == 0 && r.d.z == 0;
        assert_true(l.count >= 1 && (upright ? l.count == 1 : l.count % 2 == 0));
        const struct ray ahead = {r.o, r.d, 0, 1};
        assert_true(first_of(ops, shape, &ahead, &first));
        const struct vec3 p = ray_at(&r, first.t);
        assert_true(ops->inside(shape, vec3_add(p, vec3(0, -1e-9, 0))));
        assert_false(ops->inside(shape, vec3_add(p, vec3(0, 1e-9, 0))));
    }
    boundary_list_free(&l);
    arena_free(a);
}

// uv coordinates of a sor's caps: -1 to 0 from the axis to the base's rim, 1 to 2 back from
// the top's.
static void caps_of_a_sor_have_uv(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct boundary_list l = {0};
    void *shape;
    const struct shape_ops *ops =
        make(a, "sor", "5, <.5,-1>, <.5,0>, <.5,1>, <.5,2>, <.5,3>", &shape);
    const struct ray r = {vec3(0, 5, -.2), vec3(0, -1, 0), -INFINITY, INFINITY};
    ops->intersect(shape, &r, &l);
    assert_int_equal(l.count, 2);
    const double want[2] = {1.6, -.6};
    for (uint32_t i = 0; i < 2; i++) {
        struct surface_point s = {.want_uv = true};
        ops->surface(shape, &l.at[i], ray_at(&r, l.at[i].t), &s);
        assert_near(s.uv.u, .75, 1e-12);
        assert_near(s.uv.v, want[i], 1e-12);
    }
    boundary_list_free(&l);
    arena_free(a);
}

// ---- closest --------------------------------------------------------------------------

static void closest_is_the_first_crossing(void **state)
{
    (void)state;
    static const struct {
        const char *word, *text;
    } all[] = {
        {"superellipsoid", "<.5,.5>"},
        {"superellipsoid", "<1.4,3>"},
        {"height_field", ""},
        {"height_field", "water_level .6"},
        {"julia_fractal",
         "<-.083, 0, -.83, -.025> quaternion sqr max_iteration 6 precision 30"},
        {"julia_fractal",
         "<.5, .2, .3, 0> hypercomplex sin max_iteration 5 precision 20"},
        {"bicubic_patch", "type 1 <-1,-1,.2>, <-.3,-1,1>, <.3,-1,-1>, <1,-1,.1>, "
                          "<-1,-.3,0>, <-.3,-.3,2>, <.3,-.3,-2>, <1,-.3,.3>, "
                          "<-1,.3,-.5>, <-.3,.3,1>, <.3,.3,-1>, <1,.3,0>, "
                          "<-1,1,0>, <-.3,1,1>, <.3,1,.5>, <1,1,.2>"},
    };
    struct boundary_list l = {0};
    for (size_t n = 0; n < sizeof all / sizeof all[0]; n++) {
        struct arena *a = arena_new(1 << 16);
        void *shape;
        const struct shape_ops *ops = make(a, all[n].word, all[n].text, &shape);
        uint64_t seed = 31 + n;
        int met = 0;
        for (int k = 0; k < 3000; k++) {
            const struct vec3 d = in_cube(&seed);
            struct ray r = {vec3_mad(in_cube(&seed), -3, d), d, 3 * uniform(&seed),
                            3 + 3 * uniform(&seed)};
            struct boundary first = {.t = 0};
            l.count = 0;
            ops->intersect(shape, &r, &l);
            const struct boundary *want = NULL;
            for (uint32_t i = 0; !want && i < l.count; i++)
                if (l.at[i].drawn && l.at[i].t > r.t_min && l.at[i].t < r.t_max)
                    want = &l.at[i];
            const bool found = first_of(ops, shape, &r, &first);
            // Lanes come by other roundings to it.
            const double slack = want && ops->closest8 ? want->dt + first.dt : 0;
            if (found != (want != NULL) ||
                (want && (fabs(want->t - first.t) > slack || want->part != first.part)))
                fail_msg("%s { %s }: ray %d: %.17g, not %.17g", all[n].word, all[n].text,
                         k, found ? first.t : NAN, want ? want->t : NAN);
            met += found;
        }
        assert_true(met > 50);
        arena_free(a);
    }
    boundary_list_free(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arch_is_a_parabola),
        cmocka_unit_test(collapsed_edge_has_a_normal),
        cmocka_unit_test(shared_edge_is_closed),
        cmocka_unit_test(folded_patches_keep_all_crossings),
        cmocka_unit_test(patches_without_area_are_not_met),
        cmocka_unit_test(sweeps_hold_their_balls),
        cmocka_unit_test(sweep_is_a_capsule),
        cmocka_unit_test(height_field_is_watertight),
        cmocka_unit_test(caps_of_a_sor_have_uv),
        cmocka_unit_test(closest_is_the_first_crossing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
