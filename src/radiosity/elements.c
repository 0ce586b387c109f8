// Elements of cells: what of a cell exists, and what it looks like.
#include "radiosity/patches.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "radiosity/polygon.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"
#include "trace/tracer.h"

// Along a side of a cell; the latter where a cell exists in part.
enum { SAMPLES_MOST = 8, SAMPLES_PART = 16 };

// What sampling found of one side of a cell.
struct found {
    double area;
    struct rgb reflectance, emission;
    uint32_t members, tried;
    struct vec3 normal, centre;
    bool rim;     // nothing but something at the rim
    bool crossed; // a wall stands on it: the anchor does not see all of it
    struct vec3 anchor;
};

// ---- cells -------------------------------------------------------------------------
static void *grow(void *at, uint32_t *capacity, uint32_t need, size_t size)
{
    if (need <= *capacity)
        return at;
    while (*capacity < need)
        *capacity = *capacity ? *capacity + *capacity / 2 : 1024;
    return must_realloc(at, *capacity, size);
}

struct cell *cells_add(struct patches *p, uint32_t count)
{
    p->cell = grow(p->cell, &p->cell_capacity, p->cell_count + count, sizeof *p->cell);
    p->cell_count += count;
    return &p->cell[p->cell_count - count];
}

void cell_split(struct patches *p, uint32_t index)
{
    const uint32_t child = p->cell_count;
    struct cell *s = cells_add(p, 4), *c = &p->cell[index];
    c->child = child;
    for (int k = 0; k < 4; k++, s++) {
        *s = *c;
        s->child = 0;
        s->du = c->du / 2;
        s->dv = c->dv / 2;
        s->u = c->u + (k & 1) * s->du;
        s->v = c->v + (k >> 1) * s->dv;
    }
}

// ---- walls on cells ------------------------------------------------------------------
// The way from an anchor to above a point of its cell. False: it sees all of that side.
static bool anchor_way(const struct patches *p, uint32_t anchor, int side, struct vec3 at,
                       struct ray *out)
{
    const struct anchor *a = &p->anchor[anchor];
    const struct vec3 n = a->n[side];
    if (vec3_dot(n, n) == 0)
        return false;
    const struct vec3 to = vec3_mad(at, vec3_dot(vec3_sub(a->o[side], at), n), n);
    *out = (struct ray){a->o[side], vec3_sub(to, a->o[side]), 0, 1};
    return true;
}

bool anchor_sees(const struct patches *p, struct trace_scratch *scratch, uint32_t anchor,
                 int side, struct vec3 at)
{
    struct ray_query q = {.hidden_by = OBJECT_NO_RADIOSITY};
    return !anchor_way(p, anchor, side, at, &q.ray) ||
           !trace_occluded_1(p->job->world, scratch, &q);
}

// Two cells in the place of one: what the anchor sees, and the rest.
static void cell_part(struct patches *p, uint32_t index, const struct found f[2])
{
    if (p->anchor_count + 1 >= p->anchor_capacity)
        p->anchor =
            grow(p->anchor, &p->anchor_capacity, p->anchor_count + 2, sizeof *p->anchor);
    const uint32_t anchor = ++p->anchor_count; // 0: none
    p->anchor[anchor] = (struct anchor){0};
    for (int side = 0; side < 2; side++) {
        if (!f[side].crossed)
            continue;
        p->anchor[anchor].o[side] = f[side].anchor;
        p->anchor[anchor].n[side] = vec3_normalize(f[side].normal);
    }
    const uint32_t part = p->cell_count;
    struct cell *s = cells_add(p, 2), *c = &p->cell[index];
    c->part = part;
    for (int k = 0; k < 2; k++, s++) {
        *s = *c;
        s->part = 0;
        s->anchor = anchor;
        s->twin = k == 1;
    }
}

// ---- elements ----------------------------------------------------------------------
static bool mixed(const struct found *f)
{
    return f->rim || (f->members && f->members < f->tried);
}

struct sampling {
    struct patches *p;
    uint32_t first; // cell
    int samples;    // along a side; more in the first round, which must find all there is
    bool part;      // the cells are parts of others
    bool last;      // cells that exist in part are measured closely, not quartered
    struct found (*found)[2];
};

// Points of a cell; many enough for those of a close look and of the rim.
enum { RIM = 8, POINTS_MOST = SAMPLES_PART * SAMPLES_PART + RIM, LOOKS = 64 };
struct points {
    struct vec3 at[POINTS_MOST];
    uint32_t count, middle; // the one next to the middle
    double off;             // by so much
};

static void points_add(struct points *x, struct vec3 at, double u, double v)
{
    const double off = fabs(u - .5) + fabs(v - .5);
    if (x->count == 0 || off < x->off) {
        x->off = off;
        x->middle = x->count;
    }
    x->at[x->count++] = at;
}

// What a thread keeps: rays go together. Points as they were found, in order.
struct sampler {
    struct tracer *t;
    struct ray_batch *rays;
    struct hit_batch *hits;
    uint32_t of[POINTS_MOST]; // the point of each ray
    uint32_t count;           // of points
    double uv[POINTS_MOST][2];
    bool exists[POINTS_MOST];
    struct element_point at[POINTS_MOST];
    struct ray ray[POINTS_MOST];
    struct hit hit[POINTS_MOST];
};

// A ray of point `of`.
static void put_ray(struct sampler *s, const struct ray *ray, uint32_t of)
{
    const uint32_t k = s->rays->count;
    ray_put_from(s->rays, ray->o, ray->d, ray->t_max);
    s->rays->hidden_by[k] = OBJECT_NO_RADIOSITY;
    s->of[k] = of;
}

// Of the points found on a part of a cell, those on the other side of the wall are out.
static void keep_part(const struct patches *p, struct sampler *s, const struct cell *c,
                      int side)
{
    uint8_t hidden[POINTS_MOST];
    struct ray way;
    s->rays->count = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        if (s->exists[i] && anchor_way(p, c->anchor, side, s->at[i].p, &way))
            put_ray(s, &way, i);
        else
            s->exists[i] = s->exists[i] && !c->twin;
    }
    trace_occluded(p->job->world, s->t->scratch, s->rays, hidden);
    for (uint32_t k = 0; k < s->rays->count; k++)
        s->exists[s->of[k]] = hidden[k] == c->twin;
}

// Looks for the points of uv; the same as patch_point() of each.
static void probe(const struct patches *p, struct sampler *s, const struct cell *c,
                  int side)
{
    s->rays->count = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        s->exists[i] =
            patch_aim(p, c, side, s->uv[i][0], s->uv[i][1], &s->at[i], &s->ray[i]);
        if (s->exists[i])
            put_ray(s, &s->ray[i], i);
    }
    trace_closest(p->job->world, s->t->scratch, s->rays, s->hits);
    for (uint32_t k = 0; k < s->rays->count; k++) {
        const uint32_t i = s->of[k];
        s->hit[i] = hit_batch_at(s->hits, k);
        s->exists[i] = patch_met(p, c, &s->ray[i], &s->hit[i], &s->at[i]);
    }
    if (c->anchor)
        keep_part(p, s, c, side);
}

// Whether the ways from the middle to the other points, just above the cell, are not all
// free: then a wall stands on it, and light would get from one side to the other.
static void find_crossed(const struct patches *p, struct sampler *s,
                         const struct points *x, struct found *f)
{
    static const double above = 1e-3; // of the cell's size
    const struct vec3 n = vec3_normalize(f->normal), middle = x->at[x->middle];
    uint8_t hidden[LOOKS];
    double top = 0;
    for (uint32_t k = 0; k < x->count; k++)
        top = fmax(top, vec3_dot(vec3_sub(x->at[k], middle), n));
    f->anchor = vec3_mad(middle, top + above * sqrt(f->area), n);
    const uint32_t step = x->count / LOOKS + 1;
    s->rays->count = 0;
    for (uint32_t k = 0; k < x->count; k += step) {
        const struct vec3 to =
            vec3_mad(x->at[k], vec3_dot(vec3_sub(f->anchor, x->at[k]), n), n);
        const struct ray way = {f->anchor, vec3_sub(to, f->anchor), 0, 1};
        put_ray(s, &way, k);
    }
    trace_occluded(p->job->world, s->t->scratch, s->rays, hidden);
    for (uint32_t k = 0; k < s->rays->count; k++)
        f->crossed = f->crossed || hidden[k];
}

// What cuts a cell mostly cuts a corner or an edge.
static void sample_rim(const struct patches *p, struct sampler *s, const struct cell *c,
                       int side, struct found *f, struct points *x)
{
    static const double in = 1e-3, out = 1 - 1e-3;
    static const double rim[RIM][2] = {{in, in}, {out, in}, {out, out}, {in, out},
                                       {.5, in}, {out, .5}, {.5, out},  {in, .5}};
    s->count = RIM;
    memcpy(s->uv, rim, sizeof rim);
    probe(p, s, c, side);
    for (int k = 0; k < RIM; k++) {
        if (s->exists[k])
            points_add(x, s->at[k].p, rim[k][0], rim[k][1]);
        else
            f->tried++;
    }
}

// n x n points of a cell's square.
static void put_points(struct sampler *s, uint32_t index, int n)
{
    s->count = (uint32_t)(n * n);
    for (int i = 0; i < n * n; i++) {
        s->uv[i][0] = (i % n + .5) / n;
        s->uv[i][1] = (i / n + .5) / n;
        if (n == SAMPLES_PART) {
            // A grid sees an edge along it no better than by a whole row.
            double x4[4];
            sobol_point((uint32_t)i, index, x4);
            s->uv[i][0] = x4[0];
            s->uv[i][1] = x4[1];
        }
    }
}

static void sample_cell(const struct patches *p, struct sampler *s, uint32_t index,
                        int side, int n, struct found *f)
{
    const struct cell *c = &p->cell[index];
    const struct chart *chart = &p->chart[c->chart];
    const struct leaf *l = &p->job->world->leaf[chart->leaf];
    struct points x;
    x.count = 0;
    *f = (struct found){.tried = (uint32_t)(n * n)};
    put_points(s, index, n);
    probe(p, s, c, side);
    for (uint32_t i = 0; i < s->count; i++) {
        const double u = s->uv[i][0], v = s->uv[i][1];
        struct rgb reflectance, emission;
        if (!s->exists[i])
            continue;
        const double area = chart_density(chart, l, c->u + u * c->du, c->v + v * c->dv,
                                          1e-3 * c->du, 1e-3 * c->dv) *
                            c->du * c->dv / (n * n);
        patch_color(s->t, &s->ray[i], &s->hit[i], &reflectance, &emission);
        f->area += area;
        f->reflectance = rgb_add(f->reflectance, rgb_scale((float)area, reflectance));
        f->emission = rgb_add(f->emission, rgb_scale((float)area, emission));
        f->normal = vec3_mad(f->normal, area, s->at[i].normal);
        f->centre = vec3_mad(f->centre, area, s->at[i].p);
        f->members++;
        points_add(&x, s->at[i].p, u, v);
    }
    if (f->members == f->tried || f->members == 0)
        sample_rim(p, s, c, side, f, &x);
    f->rim = f->members == 0 && x.count;
    if (f->members == 0)
        return;
    if (!c->anchor && x.count > 1)
        find_crossed(p, s, &x, f);
}

static void *sampling_begin(void *user)
{
    const struct sampling *of = user;
    struct sampler *s = must_malloc(1, sizeof *s);
    s->t = tracer_new(of->p->job);
    s->rays = ray_batch_new(POINTS_MOST);
    s->hits = hit_batch_new(POINTS_MOST);
    return s;
}

static void sampling_end(void *user, void *state)
{
    struct sampler *s = state;
    (void)user;
    tracer_free(s->t);
    ray_batch_free(s->rays);
    hit_batch_free(s->hits);
    free(s);
}

static void sampling_work(void *user, void *state, uint32_t begin, uint32_t end)
{
    const struct sampling *s = user;
    for (uint32_t i = begin; i < end; i++) {
        for (int side = 0; side < 2; side++) {
            struct found *f = &s->found[i][side];
            if ((s->p->cell[s->first + i].dead >> side) & 1)
                continue;
            sample_cell(s->p, state, s->first + i, side, s->samples, f);
            // A quarter of a cell that exists in part: what little may be there counts.
            if (s->last && s->part && !f->members)
                sample_cell(s->p, state, s->first + i, side, SAMPLES_MOST, f);
            if ((s->last || s->p->cell[s->first + i].anchor) && mixed(f))
                sample_cell(s->p, state, s->first + i, side, SAMPLES_PART, f);
        }
    }
}

static void element_corners(const struct patches *p, const struct cell *c,
                            struct element *e)
{
    const struct chart *chart = &p->chart[c->chart];
    const struct leaf *l = &p->job->world->leaf[chart->leaf];
    static const double at[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    e->corner_count = 4;
    for (int k = 0; k < 4; k++) {
        struct vec3 n;
        if (!chart_point(chart, l, c->u + at[k][0] * c->du, c->v + at[k][1] * c->dv,
                         &e->corner[k], &n)) {
            // Off the surface: on the tangent plane, along the axis.
            const struct vec3 o = transform_point(
                l->transform,
                vec3_mad(vec3_mad(chart->o, c->u + at[k][0] * c->du, chart->a),
                         c->v + at[k][1] * c->dv, chart->b));
            const struct vec3 axis = transform_vector(
                l->transform, vec3(chart->axis == 0, chart->axis == 1, chart->axis == 2));
            const double slope = vec3_dot(axis, e->normal);
            const double t =
                slope != 0 ? vec3_dot(vec3_sub(e->centre, o), e->normal) / slope : 0;
            e->corner[k] = vec3_mad(o, t, axis);
        }
    }
    polygon_turn(e);
}

static void element_add(struct patches *p, uint32_t index, int side,
                        const struct found *f)
{
    if (p->element_count == p->element_capacity) {
        uint32_t capacity = p->element_capacity;
        p->element_cell = grow(p->element_cell, &capacity, p->element_count + 1,
                               sizeof *p->element_cell);
        p->element = grow(p->element, &p->element_capacity, p->element_count + 1,
                          sizeof *p->element);
    }
    struct cell *c = &p->cell[index];
    const uint32_t i = p->element_count++;
    const float share = (float)(1 / f->area);
    struct element *e = &p->element[i];
    *e = (struct element){.centre = vec3_scale(1 / f->area, f->centre),
                          .normal = vec3_normalize(f->normal),
                          .area = f->area,
                          .reflectance = rgb_scale(share, f->reflectance),
                          .emission = rgb_scale(share, f->emission),
                          .surface = 2 * c->chart + (uint32_t)side,
                          .curved = p->chart[c->chart].curved,
                          .partial = f->members < f->tried};
    element_corners(p, c, e);
    const double outline = polygon_area(e);
    e->coverage = outline > 0 ? (float)(e->area / outline) : 1;
    c->element[side] = i;
    p->element_cell[i] = 2 * index + (uint32_t)side;
}

// What became of one cell: quarters, parts or elements.
static void cell_settle(struct patches *p, uint32_t index, int depth,
                        const struct found f[2])
{
    const bool part = mixed(&f[0]) || mixed(&f[1]);
    const bool crossed = f[0].crossed || f[1].crossed;
    if (!p->cell[index].anchor && ((depth > 0 && part) || (depth > 1 && crossed))) {
        cell_split(p, index);
        return;
    }
    if (crossed) {
        cell_part(p, index, f);
        return;
    }
    for (int side = 0; side < 2; side++)
        if (f[side].area > 0)
            element_add(p, index, side, &f[side]);
}

// Samples cells [first, end of list) and makes elements of them; those that exist in part
// or have a wall on them are quartered instead, to a depth.
static void cells_sample(struct patches *p, uint32_t first, int depth)
{
    enum { CHUNK = 1 << 16 }; // what was found of cells takes more room than they do
    const uint32_t end = p->cell_count;
    const int wanted = p->settings.samples;
    const int few = wanted < 1 ? 1 : wanted < SAMPLES_MOST ? wanted : SAMPLES_MOST;
    const int samples = first ? few : 2 * few < SAMPLES_MOST ? 2 * few : SAMPLES_MOST;
    struct sampling s = {p, first, samples, first > 0, depth <= 0, NULL};
    s.found = must_malloc(CHUNK, sizeof *s.found);
    const struct parallel run = {.threads = p->settings.threads,
                                 .piece = 64,
                                 .watch = p->settings.watch,
                                 .tells = end - first <= CHUNK,
                                 .user = &s,
                                 .begin = sampling_begin,
                                 .end = sampling_end,
                                 .work = sampling_work};
    for (; s.first < end && !watch_cancelled(p->settings.watch); s.first += CHUNK) {
        const uint32_t count = end - s.first < CHUNK ? end - s.first : CHUNK;
        memset(s.found, 0, count * sizeof *s.found);
        parallel_run(&run, count);
        for (uint32_t i = 0; i < count; i++)
            cell_settle(p, s.first + i, depth, s.found[i]);
    }
    free(s.found);
    if (p->cell_count > end)
        cells_sample(p, end, depth - 1);
}

void elements_find(struct patches *p) { cells_sample(p, 0, p->settings.depth); }

void elements_add(struct patches *p, uint32_t first) { cells_sample(p, first, 0); }
