// A box less many parts: a test of every candidate against every part, intervals merged along
// the line, and what the renderer does.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "loaded.h"
#include "math/transform.h"
#include "quad.h"

enum { RAYS = 4000, PARTS_MAX = 1001, TEXT_MAX = 1 << 18 };

// A ball, or a box turned and moved; part 0 is what the others are taken from.
struct part {
    bool ball;
    double radius;
    struct vec3 half, centre; // before the turn
    struct vec3 middle;       // after it, rounded
};

struct solid {
    struct part part[PARTS_MAX];
    int count;
    struct mat3 turn;
    struct loaded l;
};

// To the world and back: scene vectors are rows.
static struct vec3 turned_back(const struct mat3 *m, struct vec3 v)
{
    return vec3(m->m[0][0] * v.x + m->m[0][1] * v.y + m->m[0][2] * v.z,
                m->m[1][0] * v.x + m->m[1][1] * v.y + m->m[1][2] * v.z,
                m->m[2][0] * v.x + m->m[2][1] * v.y + m->m[2][2] * v.z);
}

static struct vec3 turned_by(const struct mat3 *m, struct vec3 v)
{
    return vec3(m->m[0][0] * v.x + m->m[1][0] * v.y + m->m[2][0] * v.z,
                m->m[0][1] * v.x + m->m[1][1] * v.y + m->m[2][1] * v.z,
                m->m[0][2] * v.x + m->m[1][2] * v.y + m->m[2][2] * v.z);
}

// Where the line is in a part; false: nowhere.
static bool span_of(const struct solid *s, const struct part *p, const struct ray *ray,
                    double t[2])
{
    struct vec3 o = vec3_sub(ray->o, p->middle), d = ray->d;
    if (p->ball) {
        const double b = vec3_dot(o, d);
        const struct vec3 h = vec3_mad(o, -b, d);
        const double disc = p->radius * p->radius - vec3_dot(h, h);
        if (!(disc > 0))
            return false;
        t[0] = -b - sqrt(disc);
        t[1] = -b + sqrt(disc);
        return true;
    }
    o = turned_back(&s->turn, o);
    d = turned_back(&s->turn, d);
    t[0] = -INFINITY;
    t[1] = INFINITY;
    for (int i = 0; i < 3; i++) {
        const double h = vec3_axis(p->half, i), inv = 1 / vec3_axis(d, i);
        const double a = (-h - vec3_axis(o, i)) * inv, b = (h - vec3_axis(o, i)) * inv;
        t[0] = fmax(t[0], fmin(a, b));
        t[1] = fmin(t[1], fmax(a, b));
    }
    return t[0] < t[1];
}

static bool holds(const struct solid *s, const struct part *p, struct vec3 at)
{
    struct vec3 q = vec3_sub(at, p->middle);
    if (p->ball)
        return vec3_dot(q, q) < p->radius * p->radius;
    q = turned_back(&s->turn, q);
    return fabs(q.x) <= p->half.x && fabs(q.y) <= p->half.y && fabs(q.z) <= p->half.z;
}

static bool survives(const struct solid *s, int from, struct vec3 at)
{
    for (int i = 0; i < s->count; i++)
        if (i != from && holds(s, &s->part[i], at) != (i == 0))
            return false;
    return true;
}

static void meet_tested(const void *thing, const struct ray *ray, struct found *out)
{
    const struct solid *s = thing;
    double best = INFINITY, t[2];
    for (int i = 0; i < s->count; i++) {
        if (!span_of(s, &s->part[i], ray, t))
            continue;
        for (int k = 0; k < 2; k++)
            if (t[k] > 0 && t[k] < best && survives(s, i, ray_at(ray, t[k])))
                best = t[k];
    }
    if (best < INFINITY)
        found_add(out, best);
}

struct event {
    double t;
    int part, step;
};

static int by_t(const void *a, const void *b)
{
    const struct event *x = a, *y = b;
    return (x->t > y->t) - (x->t < y->t);
}

// The first t > 0 at which the state of the whole changes; events at one t count as one.
static double first_change(struct event *e, int n)
{
    qsort(e, (size_t)n, sizeof *e, by_t);
    int whole = 0, taken = 0;
    for (int i = 0; i < n;) {
        const bool before = whole > 0 && taken == 0;
        const double t = e[i].t;
        for (; i < n && e[i].t == t; i++)
            *(e[i].part ? &taken : &whole) += e[i].step;
        if (t > 0 && (whole > 0 && taken == 0) != before)
            return t;
    }
    return INFINITY;
}

static void meet_merged(const void *thing, const struct ray *ray, struct found *out)
{
    const struct solid *s = thing;
    static struct event e[2 * PARTS_MAX];
    int n = 0;
    double t[2];
    for (int i = 0; i < s->count; i++) {
        if (!span_of(s, &s->part[i], ray, t))
            continue;
        e[n++] = (struct event){t[0], i, 1};
        e[n++] = (struct event){t[1], i, -1};
    }
    const double first = first_change(e, n);
    if (first < INFINITY)
        found_add(out, first);
}

static void meet_renderer(const void *thing, const struct ray *ray, struct found *out)
{
    const struct solid *s = thing;
    const struct ray_query q = {.ray = *ray};
    const struct hit h = trace_closest_1(s->l.world, s->l.scratch, &q);
    if (h.b.t < INFINITY)
        found_add(out, h.b.t);
}

// ---- reference: one frame for all parts, in which equal faces are equal --------------------

static bool true_span(const struct part *p, const quad o[3], const quad d[3], double t[2])
{
    const double h[3] = {p->half.x, p->half.y, p->half.z},
                 c[3] = {p->centre.x, p->centre.y, p->centre.z};
    if (p->ball) {
        quad dd = 0, od = 0, oo = 0;
        for (int i = 0; i < 3; i++) {
            dd += d[i] * d[i];
            od += (o[i] - c[i]) * d[i];
            oo += (o[i] - c[i]) * (o[i] - c[i]);
        }
        const quad disc = od * od - dd * (oo - (quad)p->radius * p->radius);
        t[0] = (double)((-od - quad_sqrt(disc)) / dd);
        t[1] = (double)((-od + quad_sqrt(disc)) / dd);
        return disc > 0;
    }
    quad lo = -1e9, hi = 1e9;
    for (int i = 0; i < 3; i++) {
        quad a = (c[i] - h[i] - o[i]) / d[i], b = (c[i] + h[i] - o[i]) / d[i];
        if (a > b) {
            const quad swap = a;
            a = b;
            b = swap;
        }
        lo = a > lo ? a : lo;
        hi = b < hi ? b : hi;
    }
    t[0] = (double)lo;
    t[1] = (double)hi;
    return lo < hi;
}

static void find_truth(const struct solid *s, const struct ray *ray, struct found *out)
{
    static struct event e[2 * PARTS_MAX];
    const double o[3] = {ray->o.x, ray->o.y, ray->o.z},
                 d[3] = {ray->d.x, ray->d.y, ray->d.z};
    quad local_o[3] = {0}, local_d[3] = {0};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            local_o[i] += (quad)s->turn.m[i][k] * o[k];
            local_d[i] += (quad)s->turn.m[i][k] * d[k];
        }
    int n = 0;
    double t[2];
    for (int i = 0; i < s->count; i++) {
        if (!true_span(&s->part[i], local_o, local_d, t))
            continue;
        e[n++] = (struct event){t[0], i, 1};
        e[n++] = (struct event){t[1], i, -1};
    }
    const double first = first_change(e, n);
    if (first < INFINITY)
        found_add(out, first);
}

// ---- scenes -------------------------------------------------------------------------------

static const char turned[] = "rotate x*10 rotate y*20 rotate z*30";

static void load_solid(struct solid *s)
{
    char *text = bench_memory(TEXT_MAX);
    int n = 0;
    for (int i = 0; i < s->count; i++) {
        const struct part *p = &s->part[i];
        if (p->ball)
            n += snprintf(text + n, (size_t)(TEXT_MAX - n), "sphere { 0, %.17g",
                          p->radius);
        else
            n +=
                snprintf(text + n, (size_t)(TEXT_MAX - n),
                         "box { <%.17g, %.17g, %.17g>, <%.17g, %.17g, %.17g>", -p->half.x,
                         -p->half.y, -p->half.z, p->half.x, p->half.y, p->half.z);
        n += snprintf(text + n, (size_t)(TEXT_MAX - n),
                      " translate <%.17g, %.17g, %.17g> %s }\n", p->centre.x, p->centre.y,
                      p->centre.z, turned);
    }
    load(&s->l, "difference { %s }\n", text);
    free(text);
}

static void run(struct solid *s, const char *set)
{
    struct transform t = transform_rotate(vec3(10, 20, 30));
    s->turn = t.linear;
    for (int i = 0; i < s->count; i++)
        s->part[i].middle = turned_by(&s->turn, s->part[i].centre);
    load_solid(s);
    struct ray *ray = bench_memory(RAYS * sizeof *ray);
    struct found *truth = bench_memory(RAYS * sizeof *truth);
    uint64_t state = 31;
    for (int i = 0; i < RAYS; i++) {
        ray[i] = bench_chord(&state);
        find_truth(s, &ray[i], &truth[i]);
    }
    const struct trial trial = {"csg", set, ray, truth, RAYS, 1e-6};
    bench_method(&trial, "inside tests", s->count - 1, meet_tested, s);
    bench_method(&trial, "intervals", s->count - 1, meet_merged, s);
    bench_method(&trial, "lambert", s->count - 1, meet_renderer, s);
    unload(&s->l);
    free(ray);
    free(truth);
}

static void drilled(struct solid *s, int n)
{
    uint64_t state = 3;
    for (int i = 1; i <= n; i++)
        s->part[i] = (struct part){
            .ball = true, .radius = 1.2 / cbrt(n + 1), .centre = bench_in_cube(&state)};
    s->count = n + 1;
}

// Pockets side by side in the front face, which they share, as they share their walls.
static void pocketed(struct solid *s, int side)
{
    const double h = .875 / side;
    s->count = 1;
    for (int i = 0; i < side; i++)
        for (int k = 0; k < side; k++)
            s->part[s->count++] = (struct part){
                .half = vec3(h, h, .25),
                .centre = vec3((2 * i + 1 - side) * h, (2 * k + 1 - side) * h, -.75)};
}

void bench_csg(void)
{
    struct solid *s = bench_memory(sizeof *s);
    s->part[0] = (struct part){.half = vec3(1, 1, 1)};
    static const int holes[] = {1, 10, 100, 1000};
    for (int i = 0; i < 4; i++) {
        drilled(s, holes[i]);
        run(s, "drilled");
    }
    for (int side = 1; side <= 16; side *= 2) {
        pocketed(s, side);
        run(s, "pockets");
    }
    free(s);
}
