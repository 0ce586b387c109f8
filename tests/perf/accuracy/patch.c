// A bicubic patch: leaves of two triangles or of one bilinear patch at k levels of halving,
// Newton's method, and the reference by halving in extended precision.
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"
#include "loaded.h"
#include "scene/shape.h"
#include "scene/shapes/slabs.h"

enum { RAYS = 4000, LEVELS = 7 };

struct control {
    struct vec3 p[4][4];
};

// 2^k x 2^k cells of the surface's points; boxes of all coarser levels.
struct grid {
    int level;
    struct vec3 *point;           // (n + 1) x (n + 1)
    struct aabb *box[LEVELS + 1]; // [j]: 2^j x 2^j
};

static struct vec3 corner(const struct grid *g, int i, int k)
{
    return g->point[i * ((1 << g->level) + 1) + k];
}

static struct aabb box_of(struct grid *g, int level, int i, int k)
{
    const int n = 1 << level;
    struct aabb b = aabb_empty();
    if (level == g->level) {
        for (int c = 0; c < 4; c++)
            b = aabb_add(b, corner(g, i + c / 2, k + c % 2));
        b = aabb_pad(b);
    } else {
        for (int c = 0; c < 4; c++)
            b = aabb_join(b, box_of(g, level + 1, 2 * i + c / 2, 2 * k + c % 2));
    }
    return g->box[level][i * n + k] = b;
}

// By de Casteljau's rule.
static struct vec3 on_curve(const struct vec3 p[4], double w)
{
    struct vec3 q[4] = {p[0], p[1], p[2], p[3]};
    for (int n = 3; n > 0; n--)
        for (int i = 0; i < n; i++)
            q[i] = vec3_mad(q[i], w, vec3_sub(q[i + 1], q[i]));
    return q[0];
}

static struct vec3 point_at(const struct control *c, double u, double v)
{
    struct vec3 p[4];
    for (int i = 0; i < 4; i++)
        p[i] = on_curve(c->p[i], v);
    return on_curve(p, u);
}

static void grid_build(struct grid *g, const struct control *p, int level)
{
    const int n = 1 << level;
    g->level = level;
    g->point = bench_memory((uint64_t)(n + 1) * (uint64_t)(n + 1) * sizeof *g->point);
    for (int i = 0; i <= n; i++)
        for (int k = 0; k <= n; k++)
            g->point[i * (n + 1) + k] = point_at(p, (double)i / n, (double)k / n);
    for (int j = 0; j <= level; j++)
        g->box[j] = bench_memory(sizeof *g->box[j] << (2 * j));
    box_of(g, 0, 0, 0);
}

static void grid_free(struct grid *g)
{
    free(g->point);
    for (int j = 0; j <= g->level; j++)
        free(g->box[j]);
}

typedef void cell(const struct vec3 p[4], const struct ray *ray, struct found *out);

// p[0], p[1] along v, p[2], p[3] the same one further along u.
static void walk(const struct grid *g, const struct slabs *slabs, const struct ray *ray,
                 cell *meet_cell, int level, int i, int k, struct found *out)
{
    double t;
    if (!slabs_meet(&g->box[level][i * (1 << level) + k], slabs, -INFINITY, INFINITY, &t))
        return;
    if (level == g->level) {
        const struct vec3 p[4] = {corner(g, i, k), corner(g, i, k + 1),
                                  corner(g, i + 1, k), corner(g, i + 1, k + 1)};
        meet_cell(p, ray, out);
        return;
    }
    for (int c = 0; c < 4; c++)
        walk(g, slabs, ray, meet_cell, level + 1, 2 * i + c / 2, 2 * k + c % 2, out);
}

static void meet_grid(const struct grid *g, const struct ray *ray, cell *meet_cell,
                      struct found *out)
{
    const struct aabb *whole = &g->box[0][0];
    const struct slabs slabs = slabs_of(whole, ray);
    walk(g, &slabs, ray, meet_cell, 0, 0, 0, out);
    found_sort(out);
}

// Moeller and Trumbore 1997.
static void meet_triangle(struct vec3 a, struct vec3 b, struct vec3 c,
                          const struct ray *ray, struct found *out)
{
    const struct vec3 e1 = vec3_sub(b, a), e2 = vec3_sub(c, a);
    const struct vec3 h = vec3_cross(ray->d, e2);
    const double det = vec3_dot(e1, h);
    const struct vec3 s = vec3_sub(ray->o, a), q = vec3_cross(s, e1);
    const double u = vec3_dot(s, h) / det, v = vec3_dot(ray->d, q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1)
        found_add(out, vec3_dot(e2, q) / det);
}

static void two_triangles(const struct vec3 p[4], const struct ray *ray,
                          struct found *out)
{
    meet_triangle(p[0], p[1], p[3], ray, out);
    meet_triangle(p[0], p[3], p[2], ray, out);
}

// u of the two rulings that the line meets solve a quadratic (Reshetov 2019).
static void bilinear(const struct vec3 p[4], const struct ray *ray, struct found *out)
{
    const struct vec3 e10 = vec3_sub(p[2], p[0]), e11 = vec3_sub(p[3], p[2]),
                      e00 = vec3_sub(p[1], p[0]);
    const struct vec3 qn = vec3_cross(e10, vec3_sub(p[1], p[3]));
    const struct vec3 q00 = vec3_sub(p[0], ray->o), q10 = vec3_sub(p[2], ray->o);
    const double a = vec3_dot(vec3_cross(q00, ray->d), e00);
    const double c = vec3_dot(qn, ray->d);
    const double b = vec3_dot(vec3_cross(q10, ray->d), e11) - a - c;
    const double disc = b * b - 4 * a * c;
    if (!(disc >= 0))
        return;
    const double q = (-b - copysign(sqrt(disc), b)) / 2;
    const double u[2] = {c != 0 ? q / c : -1, q != 0 ? a / q : -1};
    for (int i = 0; i < 2; i++) {
        if (!(u[i] >= 0 && u[i] <= 1))
            continue;
        const struct vec3 pa = vec3_mad(q00, u[i], e10),
                          pb = vec3_mad(e00, u[i], vec3_sub(e11, e00));
        const struct vec3 n = vec3_cross(ray->d, pb);
        const double det = vec3_dot(n, n), v = vec3_dot(vec3_cross(n, ray->d), pa);
        const double t = vec3_dot(vec3_cross(n, pb), pa);
        if (det != 0 && -v >= 0 && -v <= det)
            found_add(out, -t / det);
    }
}

static void meet_triangles(const void *thing, const struct ray *ray, struct found *out)
{
    meet_grid(thing, ray, two_triangles, out);
}

static void meet_bilinear(const void *thing, const struct ray *ray, struct found *out)
{
    meet_grid(thing, ray, bilinear, out);
}

static void meet_newton(const void *thing, const struct ray *ray, struct found *out)
{
    struct boundary_list *l = bench_list();
    bicubic_patch_ops.intersect(thing, ray, l);
    for (uint32_t i = 0; i < l->count; i++)
        found_add(out, l->at[i].t);
}

// ---- reference --------------------------------------------------------------------------

// Control points across the ray (x, y) and along it (z).
struct net {
    long double p[4][4][3];
};

static void halve(long double p[4][3], long double left[4][3], long double right[4][3])
{
    for (int x = 0; x < 3; x++) {
        const long double a = (p[0][x] + p[1][x]) / 2, b = (p[1][x] + p[2][x]) / 2,
                          c = (p[2][x] + p[3][x]) / 2, d = (a + b) / 2, e = (b + c) / 2;
        const long double whole[7] = {p[0][x], a, d, (d + e) / 2, e, c, p[3][x]};
        for (int i = 0; i < 4; i++) {
            left[i][x] = whole[i];
            right[i][x] = whole[3 + i];
        }
    }
}

static void turn(struct net *n)
{
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < i; k++)
            for (int x = 0; x < 3; x++) {
                const long double v = n->p[i][k][x];
                n->p[i][k][x] = n->p[k][i][x];
                n->p[k][i][x] = v;
            }
}

static bool may_meet(const struct net *n)
{
    for (int x = 0; x < 2; x++) {
        long double lo = INFINITY, hi = -INFINITY;
        for (int i = 0; i < 16; i++) {
            lo = fminl(lo, n->p[i / 4][i % 4][x]);
            hi = fmaxl(hi, n->p[i / 4][i % 4][x]);
        }
        if (lo > 0 || hi < 0)
            return false;
    }
    return true;
}

static void descend(const struct net *n, int depth, struct found *out)
{
    if (!may_meet(n))
        return;
    if (depth == 80) { // 40 halvings each way: 1e-12 of the patch
        const double t = (double)n->p[0][0][2];
        for (int i = 0; i < out->count; i++)
            if (fabs(out->t[i] - t) < 1e-9) // a neighbour that shares the point
                return;
        found_add(out, t);
        return;
    }
    struct net half[2];
    struct net whole = *n;
    for (int i = 0; i < 4; i++)
        halve(whole.p[i], half[0].p[i], half[1].p[i]);
    for (int i = 0; i < 2; i++) {
        turn(&half[i]); // the other direction next
        descend(&half[i], depth + 1, out);
    }
}

static void find_truth(const struct control *p, const struct ray *ray, struct found *out)
{
    const struct vec3 d = ray->d;
    const struct vec3 other = fabs(d.x) < .5 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const struct vec3 e1 = vec3_normalize(vec3_cross(d, other)), e2 = vec3_cross(d, e1);
    const struct vec3 axis[3] = {e1, e2, d};
    struct net n;
    for (int i = 0; i < 16; i++)
        for (int x = 0; x < 3; x++) {
            const struct vec3 q = p->p[i / 4][i % 4];
            n.p[i / 4][i % 4][x] = ((long double)q.x - ray->o.x) * axis[x].x +
                                   ((long double)q.y - ray->o.y) * axis[x].y +
                                   ((long double)q.z - ray->o.z) * axis[x].z;
        }
    descend(&n, 0, out);
    found_sort(out);
}

static void load_patch(struct loaded *l, const struct control *c)
{
    char text[2048];
    int n = 0;
    for (int i = 0; i < 16; i++) {
        const struct vec3 p = c->p[i / 4][i % 4];
        n += snprintf(text + n, sizeof text - (size_t)n, ", <%.17g, %.17g, %.17g>", p.x,
                      p.y, p.z);
    }
    load(l, "bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3%s }\n", text);
}

static void run(const char *set, double height)
{
    static const double bump[4][4] = {
        {.1, .5, -.5, .1}, {0, 1, -1, .2}, {-.3, .6, -.6, 0}, {0, .5, .3, .1}};
    struct control c;
    for (int i = 0; i < 16; i++)
        c.p[i / 4][i % 4] =
            vec3(i / 4 * 2. / 3 - 1, i % 4 * 2. / 3 - 1, height * bump[i / 4][i % 4]);
    struct ray *ray = bench_memory(RAYS * sizeof *ray);
    struct found *truth = bench_memory(RAYS * sizeof *truth);
    uint64_t state = 29;
    for (int i = 0; i < RAYS; i++) {
        ray[i] = bench_chord(&state);
        find_truth(&c, &ray[i], &truth[i]);
    }
    const struct trial t = {"patch", set, ray, truth, RAYS, 1e-2};
    for (int k = 1; k <= LEVELS; k++) {
        struct grid g;
        grid_build(&g, &c, k);
        bench_method(&t, "two triangles", k, meet_triangles, &g);
        bench_method(&t, "bilinear leaves", k, meet_bilinear, &g);
        grid_free(&g);
    }
    struct loaded l;
    load_patch(&l, &c);
    bench_method(&t, "lambert", 0, meet_newton, l.world->leaf[0].shape);
    unload(&l);
    free(ray);
    free(truth);
}

void bench_patches(void)
{
    run("gentle", .3);
    run("folded", 2);
}
