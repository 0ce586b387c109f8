#include "radiosity/patches.h"

#include <stdlib.h>
#include <string.h>

#include "radiosity/parallel.h"
#include "radiosity/polygon.h"
#include "trace/tracer.h"

const struct patch_settings patch_defaults = {.count = 2000, .samples = 3, .depth = 2};

// How far above the surface, relative to the cell, a probing ray starts.
static const double probe_height = 1e-5;

static bool in_room(const struct patches *p, struct vec3 at)
{
    enum { MOST = 64 };
    uint32_t object[MOST];
    const uint32_t n = trace_containing(p->job->world, at, object, MOST);
    for (uint32_t i = 0, k = 0; i < n; i++) {
        while (k < p->room_count && p->room[k] < object[i])
            k++;
        if (k == p->room_count || p->room[k] != object[i])
            return false;
    }
    return true;
}

bool patch_point(const struct patch_probe *probe, const struct cell *c, int side,
                 double u, double v, struct element_point *out, struct hit *hit,
                 struct ray *ray)
{
    const struct patches *p = probe->p;
    const struct chart *chart = &p->chart[c->chart];
    const struct leaf *l = &p->job->world->leaf[chart->leaf];
    struct vec3 n;
    if (!chart_point(chart, l, c->u + u * c->du, c->v + v * c->dv, &out->p, &n))
        return false;
    out->normal = l->inverted != (side == 1) ? vec3_neg(n) : n;
    const double height = probe_height * p->size + 1e-9 * vec3_max_abs(out->p);
    const struct vec3 from = vec3_mad(out->p, height, out->normal);
    const struct ray_query q = {{from, vec3_neg(out->normal), 0, 2 * height},
                                OBJECT_NO_RADIOSITY};
    *hit = trace_closest_1(p->job->world, probe->scratch, &q);
    if (hit->b.t == INFINITY || hit->b.leaf != chart->leaf || !in_room(p, from))
        return false;
    *ray = q.ray;
    struct interaction at;
    trace_interaction(p->job->world, ray, hit, &at);
    out->p = at.p;
    out->error = 2 * at.error;
    return true;
}

// ---- rooms -------------------------------------------------------------------------
static void room_add(struct patches *p, struct vec3 at, uint32_t except)
{
    enum { MOST = 64 };
    uint32_t object[MOST];
    const uint32_t n = trace_containing(p->job->world, at, object, MOST);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t k = 0;
        while (k < p->room_count && p->room[k] < object[i])
            k++;
        if (object[i] == except || (k < p->room_count && p->room[k] == object[i]))
            continue;
        memmove(p->room + k + 1, p->room + k, (p->room_count - k) * sizeof *p->room);
        p->room[k] = object[i];
        p->room_count++;
    }
}

static bool surface_glows(const struct surface *s)
{
    for (uint32_t i = 0; s->texture->kind == TEXTURE_PLAIN && i < s->texture->layer_count;
         i++) {
        const struct rgb e = s->texture->layer[i].finish->emission;
        if (e.r > 0 || e.g > 0 || e.b > 0)
            return true;
    }
    return false;
}

// Points just outside a chart; room: whether one of them lies where light can be.
enum { OUTSIDE_POINTS = 16 };
static uint32_t outside_points(const struct patches *p, const struct chart *c,
                               struct vec3 *out, bool *room)
{
    const struct leaf *l = &p->job->world->leaf[c->leaf];
    uint32_t n = 0;
    for (int k = 0; k < OUTSIDE_POINTS; k++) {
        struct vec3 at, normal;
        if (!chart_point(c, l, (k % 4 + .5) / 4, (k / 4 + .5) / 4, &at, &normal))
            continue;
        const double up = l->inverted ? -1e-6 : 1e-6;
        out[n] = vec3_mad(at, up * (vec3_max_abs(at) + p->size), normal);
        *room = *room || in_room(p, out[n]);
        n++;
    }
    return n;
}

// A leaf that glows where no other light is: inside a solid object.
static void glow_room(struct patches *p, uint32_t leaf)
{
    struct vec3 at[OUTSIDE_POINTS];
    const uint32_t object = p->job->world->leaf[leaf].object;
    bool room = false;
    for (uint32_t c = p->leaf_first[leaf]; c < p->leaf_first[leaf + 1] && !room; c++)
        outside_points(p, &p->chart[c], at, &room);
    for (uint32_t c = p->leaf_first[leaf]; c < p->leaf_first[leaf + 1] && !room; c++) {
        bool ignored = false;
        const uint32_t n = outside_points(p, &p->chart[c], at, &ignored);
        for (uint32_t k = 0; k < n; k++)
            room_add(p, at[k], object);
    }
}

// Light can be where the camera or a lamp is, and around what glows, also when that is
// inside an object.
static void find_rooms(struct patches *p)
{
    const struct job *job = p->job;
    const struct world *w = job->world;
    p->room = calloc(w->object_count + 1, sizeof *p->room);
    if (!p->room)
        abort();
    room_add(p, job->camera->location, UINT32_MAX);
    for (uint32_t i = 0; i < job->lamp_count; i++)
        room_add(p, job->lamp[i].light->location, UINT32_MAX);
    for (uint32_t l = 0; l < w->leaf_count; l++)
        if (w->leaf[l].drawn && surface_glows(&w->surface[w->leaf[l].surface]))
            glow_room(p, l);
}

// ---- cells -------------------------------------------------------------------------
static void *grow(void *at, uint32_t *capacity, uint32_t need, size_t size)
{
    if (need <= *capacity)
        return at;
    while (*capacity < need)
        *capacity = *capacity ? *capacity + *capacity / 2 : 1024;
    at = realloc(at, *capacity * size);
    if (!at)
        abort();
    return at;
}

static double chart_area(const struct patches *p, const struct chart *c, double side[2])
{
    enum { N = 8 };
    const struct leaf *l = &p->job->world->leaf[c->leaf];
    double area = 0;
    side[0] = side[1] = 0;
    for (int i = 0; i < N * N; i++) {
        const double u = (i % N + .5) / N, v = (i / N + .5) / N;
        area += chart_density(c, l, u, v, 1e-4, 1e-4) / (N * N);
        struct vec3 a, b, n;
        const double h = .5 / N;
        if (chart_point(c, l, u - h, v, &a, &n) && chart_point(c, l, u + h, v, &b, &n))
            side[0] += vec3_length(vec3_sub(b, a)) / N;
        if (chart_point(c, l, u, v - h, &a, &n) && chart_point(c, l, u, v + h, &b, &n))
            side[1] += vec3_length(vec3_sub(b, a)) / N;
    }
    return area;
}

// Cells along u and v so that none is longer than the size.
static void chart_grid(const struct patches *p, struct chart *c)
{
    double side[2];
    const double area = chart_area(p, c, side);
    if (!(area > 0)) {
        c->nu = c->nv = 0;
        return;
    }
    if (c->kind == CHART_PROJECTED) {
        const struct transform *t = p->job->world->leaf[c->leaf].transform;
        side[0] = vec3_length(transform_vector(t, c->a));
        side[1] = vec3_length(transform_vector(t, c->b));
    }
    // 1e-9: a side of exactly n sizes is n cells.
    c->nu = (uint32_t)fmax(c->wrap ? 8 : 1, ceil(side[0] / p->size - 1e-9));
    c->nv =
        (uint32_t)fmax(c->kind == CHART_SPHERE ? 4 : 1, ceil(side[1] / p->size - 1e-9));
}

static void chart_cells(struct patches *p, uint32_t index)
{
    struct chart *c = &p->chart[index];
    chart_grid(p, c);
    c->first_cell = p->cell_count;
    const uint32_t n = c->nu * c->nv;
    p->cell = grow(p->cell, &p->cell_capacity, p->cell_count + n, sizeof *p->cell);
    for (uint32_t i = 0; i < n; i++)
        p->cell[p->cell_count++] = (struct cell){.u = (double)(i % c->nu) / c->nu,
                                                 .v = (double)(i / c->nu) / c->nv,
                                                 .du = 1.0 / c->nu,
                                                 .dv = 1.0 / c->nv,
                                                 .chart = index,
                                                 .element = {ELEMENT_NONE, ELEMENT_NONE}};
}

static void cell_split(struct patches *p, uint32_t index)
{
    p->cell = grow(p->cell, &p->cell_capacity, p->cell_count + 4, sizeof *p->cell);
    struct cell *c = &p->cell[index];
    c->child = p->cell_count;
    for (int k = 0; k < 4; k++) {
        struct cell *s = &p->cell[p->cell_count++];
        *s = *c;
        s->child = 0;
        s->du = c->du / 2;
        s->dv = c->dv / 2;
        s->u = c->u + (k & 1) * s->du;
        s->v = c->v + (k >> 1) * s->dv;
    }
}

// ---- elements ----------------------------------------------------------------------
enum { SAMPLES_MOST = 8, SAMPLES_PART = 16 };

// What sampling found of one side of a cell.
struct found {
    double area;
    struct rgb reflectance, emission;
    uint32_t members, tried;
    struct vec3 normal, centre;
    bool crossed; // a wall stands on it
};

static bool mixed(const struct found *f) { return f->members && f->members < f->tried; }

struct sampling {
    struct patches *p;
    uint32_t first; // cell
    int samples;    // along a side; more in the first round, which must find all there is
    bool last;      // cells that exist in part are measured closely, not quartered
    struct found (*found)[2];
};

// Whether the ways from the middle to the rim, just above the cell, are not all free: then
// a wall stands on it, and light would get from one side to the other.
enum { RIM = 8 };
static bool is_crossed(const struct patches *p, struct tracer *t, const struct found *f,
                       struct vec3 middle, const struct vec3 rim[RIM])
{
    static const double above = 1e-3; // of the cell's size
    const struct vec3 n = vec3_normalize(f->normal);
    double top = 0;
    for (int k = 0; k < RIM; k++)
        top = fmax(top, vec3_dot(vec3_sub(rim[k], middle), n));
    top += above * sqrt(f->area);
    const struct vec3 o = vec3_mad(middle, top, n);
    for (int k = 0; k < RIM; k++) {
        const double height = vec3_dot(vec3_sub(rim[k], middle), n);
        const struct vec3 to = vec3_mad(rim[k], top - height, n);
        const struct ray_query q = {{o, vec3_sub(to, o), 0, 1}, OBJECT_NO_RADIOSITY};
        if (trace_occluded_1(p->job->world, t->scratch, &q))
            return true;
    }
    return false;
}

static void sample_rim(const struct patches *p, struct tracer *t, const struct cell *c,
                       int side, struct found *f)
{
    // What cuts a cell mostly cuts a corner or an edge.
    static const double in = 1e-3, out = 1 - 1e-3;
    static const double rim[RIM][2] = {{in, in}, {out, in}, {out, out}, {in, out},
                                       {.5, in}, {out, .5}, {.5, out},  {in, .5}};
    const struct patch_probe probe = {t->scratch, p};
    struct vec3 at[RIM];
    struct element_point x;
    struct hit hit;
    struct ray ray;
    for (int k = 0; k < RIM; k++) {
        if (!patch_point(&probe, c, side, rim[k][0], rim[k][1], &x, &hit, &ray)) {
            f->tried++;
            return;
        }
        at[k] = x.p;
    }
    if (patch_point(&probe, c, side, .5, .5, &x, &hit, &ray))
        f->crossed = is_crossed(p, t, f, x.p, at);
}

static void sample_cell(const struct patches *p, struct tracer *t, uint32_t index,
                        int side, int n, struct found *f)
{
    const struct cell *c = &p->cell[index];
    const struct chart *chart = &p->chart[c->chart];
    const struct leaf *l = &p->job->world->leaf[chart->leaf];
    const struct patch_probe probe = {t->scratch, p};
    *f = (struct found){.tried = (uint32_t)(n * n)};
    for (int i = 0; i < n * n; i++) {
        const double u = (i % n + .5) / n, v = (i / n + .5) / n;
        struct element_point at;
        struct hit hit;
        struct ray ray;
        struct rgb reflectance, emission;
        if (!patch_point(&probe, c, side, u, v, &at, &hit, &ray))
            continue;
        const double area = chart_density(chart, l, c->u + u * c->du, c->v + v * c->dv,
                                          1e-3 * c->du, 1e-3 * c->dv) *
                            c->du * c->dv / (n * n);
        patch_colour(t, &ray, &hit, &reflectance, &emission);
        f->area += area;
        f->reflectance = rgb_add(f->reflectance, rgb_scale((float)area, reflectance));
        f->emission = rgb_add(f->emission, rgb_scale((float)area, emission));
        f->normal = vec3_mad(f->normal, area, at.normal);
        f->centre = vec3_mad(f->centre, area, at.p);
        f->members++;
    }
    if (f->members == f->tried)
        sample_rim(p, t, c, side, f);
}

static void *sampling_begin(void *user)
{
    const struct sampling *s = user;
    return tracer_new(s->p->job);
}

static void sampling_end(void *user, void *state)
{
    (void)user;
    tracer_free(state);
}

static void sampling_work(void *user, void *state, uint32_t begin, uint32_t end)
{
    const struct sampling *s = user;
    for (uint32_t i = begin; i < end; i++) {
        for (int side = 0; side < 2; side++) {
            struct found *f = &s->found[i][side];
            sample_cell(s->p, state, s->first + i, side, s->samples, f);
            if (s->last && mixed(f))
                sample_cell(s->p, state, s->first + i, side, SAMPLES_PART, f);
        }
    }
}

static void element_corners(const struct patches *p, const struct cell *c, int side,
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
    (void)side;
    // Counter-clockwise about the normal of this side.
    const struct vec3 turn = vec3_cross(vec3_sub(e->corner[2], e->corner[0]),
                                        vec3_sub(e->corner[3], e->corner[1]));
    if (vec3_dot(turn, e->normal) < 0) {
        const struct vec3 swap = e->corner[1];
        e->corner[1] = e->corner[3];
        e->corner[3] = swap;
    }
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
    element_corners(p, c, side, e);
    const double outline = polygon_area(e);
    e->coverage = outline > 0 ? (float)(e->area / outline) : 1;
    c->element[side] = i;
    p->element_cell[i] = 2 * index + (uint32_t)side;
}

// Samples cells [first, end of list) and makes elements of them; those that exist in part
// or have a wall on them are quartered instead, to a depth.
static void cells_sample(struct patches *p, uint32_t first, int depth)
{
    const uint32_t end = p->cell_count;
    const int few = p->settings.samples;
    const int samples = first ? few : 2 * few < SAMPLES_MOST ? 2 * few : SAMPLES_MOST;
    struct sampling s = {p, first, samples, depth == 0,
                         calloc(end - first + 1, sizeof *s.found)};
    if (!s.found)
        abort();
    const struct parallel run = {.threads = p->settings.threads,
                                 .piece = 64,
                                 .watch = p->settings.watch,
                                 .tells = true,
                                 .user = &s,
                                 .begin = sampling_begin,
                                 .end = sampling_end,
                                 .work = sampling_work};
    parallel_run(&run, end - first);
    for (uint32_t i = first; i < end; i++) {
        const struct found *f = s.found[i - first];
        if (depth > 0 && (mixed(&f[0]) || mixed(&f[1]) || f[0].crossed || f[1].crossed)) {
            cell_split(p, i);
            continue;
        }
        for (int side = 0; side < 2; side++)
            if (f[side].area > 0)
                element_add(p, i, side, &f[side]);
    }
    free(s.found);
    if (p->cell_count > end)
        cells_sample(p, end, depth - 1);
}

// ---- the whole ---------------------------------------------------------------------
static struct aabb scene_limit(const struct job *job)
{
    struct aabb b = job->world->bounds;
    if (aabb_is_empty(b) || !aabb_is_finite(b))
        b = aabb_empty();
    b = aabb_add(b, job->camera->location);
    for (uint32_t i = 0; i < job->lamp_count; i++)
        b = aabb_add(b, job->lamp[i].light->location);
    return b;
}

static void charts_build(struct patches *p)
{
    const struct world *w = p->job->world;
    const struct aabb limit = scene_limit(p->job);
    p->leaf_first = calloc(w->leaf_count + 1, sizeof *p->leaf_first);
    if (!p->leaf_first)
        abort();
    for (int pass = 0; pass < 2; pass++) {
        uint32_t count = 0;
        for (uint32_t l = 0; l < w->leaf_count; l++) {
            const struct world_object *o = &w->object[w->leaf[l].object];
            const struct aabb bounds =
                aabb_is_finite(o->bounds) ? o->bounds : aabb_meet(o->bounds, limit);
            p->leaf_first[l] = count;
            if (w->leaf[l].drawn && !(o->flags & OBJECT_NO_RADIOSITY))
                count += leaf_charts(w, l, &bounds, p->chart ? p->chart + count : NULL);
        }
        p->leaf_first[w->leaf_count] = count;
        p->chart_count = count;
        if (!p->chart && !(p->chart = calloc(count + 1, sizeof *p->chart)))
            abort();
    }
}

static double size_for(const struct patches *p)
{
    double area = 0, side[2];
    for (uint32_t i = 0; i < p->chart_count && !watch_cancelled(p->settings.watch); i++)
        area += chart_area(p, &p->chart[i], side);
    return sqrt(area / fmax(p->settings.count, 1));
}

static struct patches *build(const struct job *job, const struct patch_settings *s)
{
    struct patches *p = calloc(1, sizeof *p);
    if (!p)
        abort();
    p->job = job;
    p->settings = *s;
    if (p->settings.samples < 1)
        p->settings.samples = 1;
    if (p->settings.samples > SAMPLES_MOST)
        p->settings.samples = SAMPLES_MOST;
    charts_build(p);
    p->size = s->size > 0 ? s->size : size_for(p);
    if (!(p->size > 0 && p->size < INFINITY)) {
        patches_free(p);
        return NULL;
    }
    find_rooms(p);
    for (uint32_t i = 0; i < p->chart_count && !watch_cancelled(s->watch); i++)
        chart_cells(p, i);
    cells_sample(p, 0, p->settings.depth);
    patches_enclosure(p);
    patches_prune(p);
    return p;
}

struct patches *patches_build(const struct job *job, const struct patch_settings *s)
{
    enum { TRIAL = 400, RETRIES = 3 };
    static const double most = 1.15; // elements, of those wanted
    struct patch_settings settings = *s;
    if (s->size <= 0) {
        // How much of the surfaces takes part is known from a coarse trial.
        double area = 0;
        settings.count = fmin(s->count, TRIAL);
        settings.depth = 0;
        struct patches *trial = build(job, &settings);
        for (uint32_t i = 0; trial && i < trial->element_count; i++)
            area += trial->element[i].area;
        patches_free(trial);
        settings = *s;
        settings.size = sqrt(area / fmax(s->count, 1));
    }
    struct patches *p = settings.size > 0 ? build(job, &settings) : NULL;
    // Cells that are quartered and small charts may be more than was counted on.
    for (int k = 0; k < RETRIES && p && s->size <= 0 &&
                    p->element_count > most * s->count && !watch_cancelled(s->watch);
         k++) {
        const uint32_t before = p->element_count;
        settings.size *= sqrt(before / s->count);
        patches_free(p);
        p = build(job, &settings);
        if (p && p->element_count > .9 * before)
            break;
    }
    if (!p)
        return NULL;
    patches_neighbours(p);
    patches_shafts(p);
    return p;
}

void patches_free(struct patches *p)
{
    if (!p)
        return;
    free(p->chart);
    free(p->leaf_first);
    free(p->cell);
    free(p->element);
    free(p->element_cell);
    free(p->neighbours);
    free(p->shaft);
    free(p->room);
    free(p);
}
