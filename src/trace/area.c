#include "trace/area.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "trace/projected.h"
#include "trace/shade_kernel.h"

struct vec3 area_point(const struct lamp *lamp, const struct lamp_grid *grid,
                       uint32_t hash, int u, int v)
{
    double fu = u, fv = v;
    if (lamp->light->jitter) {
        const uint32_t h =
            hash_mix(hash_mix(hash, lamp->index), (uint32_t)(u * lamp->light->size2 + v));
        fu += hash_unit(hash_mix(h, 1)) - 0.5;
        fv += hash_unit(hash_mix(h, 2)) - 0.5;
    }
    return lamp_grid_point(lamp, grid, fu, fv);
}

// ---- rays ----------------------------------------------------------------------------

// The corners of grids come first, those of many places at once.
enum { CORNERS = 4, PLACES = BATCH_SIZE / CORNERS };

struct area_queue {
    struct area_request *at;
    uint32_t count, capacity;
    // Rays to one lamp, either as requests or, where it shines from points through clear
    // air, as places.
    uint32_t ray_count;
    struct shadow_request ray[BATCH_SIZE];
    struct area_rays place;
    struct rgb value[BATCH_SIZE];
};

static bool is_plain(const struct job *job, const struct light *l)
{
    return !job->has_air && !l->projected_through && !l->parallel &&
           l->kind != LIGHT_CYLINDER;
}

// Puts the shadow ray to a point of the grid behind the others.
static void ray_put(struct tracer *t, const struct area_request *r,
                    const struct lamp_grid *grid, int u, int v)
{
    struct area_queue *q = t->area;
    const uint32_t i = q->ray_count++;
    const struct vec3 at = area_point(r->lamp, grid, r->hash, u, v);
    if (is_plain(t->job, r->lamp->light)) {
        const struct vec3 from[3] = {at, r->at.p, r->at.ng};
        double(*const to[3])[BATCH_SIZE] = {q->place.to, q->place.p, q->place.ng};
        for (int k = 0; k < 3; k++) {
            to[k][0][i] = from[k].x;
            to[k][1][i] = from[k].y;
            to[k][2][i] = from[k].z;
        }
        q->place.error[i] = r->at.error;
        t->near.slot[i] = (uint16_t)r->shadow.slot;
        t->near.photons[i] = r->shadow.photons;
        return;
    }
    struct lamp_view view;
    lamp_direction(r->lamp, at, r->at.p, &view);
    q->ray[i] = r->shadow;
    q->ray[i].d = view.l;
    q->ray[i].t_max = view.distance;
    q->ray[i].o = trace_offset(&r->at, view.l);
}

// What of the light comes along the rays, into `value`.
static void rays_trace(struct tracer *t, const struct lamp *lamp)
{
    struct area_queue *q = t->area;
    const uint32_t n = q->ray_count;
    q->ray_count = 0;
    if (!n)
        return;
    if (is_plain(t->job, lamp->light)) {
        t->job->kernels->toward(&q->place, n, t->near.rays);
        shadow_factors_near(t, n, q->value);
    } else if (lamp->light->projected_through) {
        for (uint32_t i = 0; i < n; i++)
            q->value[i] = projected_shadow(t, lamp, &q->ray[i]);
    } else {
        shadow_factors(t, q->ray, n, q->value);
    }
}

// ---- one grid ------------------------------------------------------------------------

// The grid as seen from one point; each of its points is traced when first asked for.
struct grid {
    struct tracer *t;
    const struct area_request *to;
    struct lamp_grid place;
    struct rgb *value;
    bool *known;
};

// Finds the values of the corners of `count` cells that are not known, together: rays from
// one point to one lamp make good packets.
static void grid_ask(struct grid *g, const int (*cell)[4], int count)
{
    int at[16];
    uint32_t n = 0;
    for (int i = 0; i < 4 * count; i++) {
        const int u = cell[i / 4][i & 1 ? 2 : 0], v = cell[i / 4][i & 2 ? 3 : 1];
        const int k = u * g->to->lamp->light->size2 + v;
        if (g->known[k])
            continue;
        g->known[k] = true;
        at[n++] = k;
        ray_put(g->t, g->to, &g->place, u, v);
    }
    rays_trace(g->t, g->to->lamp);
    for (uint32_t i = 0; i < n; i++)
        g->value[at[i]] = g->t->area->value[i];
}

static struct rgb grid_value(const struct grid *g, int u, int v)
{
    return g->value[u * g->to->lamp->light->size2 + v];
}

static float difference(struct rgb a, struct rgb b, struct rgb color)
{
    return fabsf(color.r * (a.r - b.r)) + fabsf(color.g * (a.g - b.g)) +
           fabsf(color.b * (a.b - b.b));
}

// The mean over a cell {u1, v1, u2, v2} whose corners are known.
static struct rgb grid_mean(struct grid *g, const int cell[4], int level)
{
    static const float notable = 0.1f; // difference of corners that calls for more
    const int u1 = cell[0], v1 = cell[1], u2 = cell[2], v2 = cell[3];
    struct rgb a = grid_value(g, u1, v1), b = grid_value(g, u2, v1),
               c = grid_value(g, u1, v2), d = grid_value(g, u2, v2);
    const struct rgb k = g->to->lamp->light->color;
    if ((u2 - u1 > 1 || v2 - v1 > 1) &&
        (level < g->to->lamp->light->adaptive || difference(a, b, k) > notable ||
         difference(c, d, k) > notable || difference(a, c, k) > notable ||
         difference(b, d, k) > notable)) {
        const int ul = (u1 + u2) / 2, uh = (u1 + u2 + 1) / 2;
        const int vl = (v1 + v2) / 2, vh = (v1 + v2 + 1) / 2;
        const int part[4][4] = {
            {u1, v1, ul, vl}, {uh, v1, u2, vl}, {u1, vh, ul, v2}, {uh, vh, u2, v2}};
        grid_ask(g, part, 4);
        a = grid_mean(g, part[0], level + 1);
        b = grid_mean(g, part[1], level + 1);
        c = grid_mean(g, part[2], level + 1);
        d = grid_mean(g, part[3], level + 1);
    }
    return rgb_scale(0.25f, rgb_add(rgb_add(a, b), rgb_add(c, d)));
}

enum { FEW = 400 };

// Room for the values of a grid: `few` and `known`, or more of them.
static struct grid grid_of(struct tracer *t, const struct area_request *r,
                           struct rgb *few, bool *known)
{
    const struct light *light = r->lamp->light;
    const size_t count = (size_t)light->size1 * (size_t)light->size2;
    struct grid g = {t, r, lamp_grid_of(r->lamp, r->at.p), few, known};
    if (count > FEW) {
        g.value = arena_new_array(t->arena, struct rgb, count);
        g.known = arena_new_array(t->arena, bool, count);
    }
    for (size_t i = 0; i < count; i++)
        g.known[i] = false;
    return g;
}

struct rgb area_shadow(struct tracer *t, const struct area_request *r)
{
    struct rgb few[FEW];
    bool known[FEW];
    struct grid g = grid_of(t, r, few, known);
    const int whole[1][4] = {
        {0, 0, r->lamp->light->size1 - 1, r->lamp->light->size2 - 1}};
    grid_ask(&g, whole, 1);
    return grid_mean(&g, whole[0], 0);
}

// ---- together ------------------------------------------------------------------------

// The corners of grids come first, those of many places at once.
void area_init(struct tracer *t)
{
    const struct job *job = t->job;
    for (uint32_t i = 0; i < job->lamp_count && !t->area; i++)
        if (job->lamp[i].light->area && job->area_lights && job->shadows)
            t->area = must_calloc(1, sizeof *t->area);
}

void area_end(struct tracer *t)
{
    if (t->area)
        free(t->area->at);
    free(t->area);
}

void area_add(struct tracer *t, const struct area_request *r)
{
    struct area_queue *q = t->area;
    if (q->count == q->capacity) {
        q->capacity = q->capacity ? 2 * q->capacity : PLACES;
        q->at = realloc(q->at, q->capacity * sizeof *q->at);
        if (!q->at)
            abort();
    }
    q->at[q->count++] = *r;
}

// The corners of a lamp's grid that are not the same.
struct corners {
    int u[CORNERS], v[CORNERS];
    uint32_t count;
};

static struct corners corners_of(const struct light *l)
{
    struct corners c = {.count = 0};
    for (int k = 0; k < CORNERS; k++) {
        if ((k & 1 && l->size1 == 1) || (k & 2 && l->size2 == 1))
            continue;
        c.u[c.count] = k & 1 ? l->size1 - 1 : 0;
        c.v[c.count++] = k & 2 ? l->size2 - 1 : 0;
    }
    return c;
}

// The mean over a grid whose corners are known.
static struct rgb cornered(struct tracer *t, const struct area_request *r,
                           const struct corners *c, const struct rgb *value)
{
    struct rgb few[FEW];
    bool known[FEW];
    const int u = r->lamp->light->size1, v = r->lamp->light->size2;
    struct grid g = grid_of(t, r, few, known);
    for (uint32_t i = 0; i < c->count; i++) {
        g.value[c->u[i] * v + c->v[i]] = value[i];
        g.known[c->u[i] * v + c->v[i]] = true;
    }
    return grid_mean(&g, (const int[4]){0, 0, u - 1, v - 1}, 0);
}

// At most PLACES of one lamp.
static void places_light(struct tracer *t, const struct area_request *const *r,
                         uint32_t count)
{
    const struct lamp *lamp = r[0]->lamp;
    const struct corners c = corners_of(lamp->light);
    struct rgb value[BATCH_SIZE]; // the queue's is needed on the way
    for (uint32_t i = 0; i < count; i++) {
        const struct lamp_grid place = lamp_grid_of(lamp, r[i]->at.p);
        for (uint32_t k = 0; k < c.count; k++)
            ray_put(t, r[i], &place, c.u[k], c.v[k]);
    }
    rays_trace(t, lamp);
    memcpy(value, t->area->value, c.count * count * sizeof *value);
    for (uint32_t i = 0; i < count; i++)
        tracer_lit(
            t, r[i]->shadow.slot,
            rgb_mul(r[i]->shadow.value, cornered(t, r[i], &c, &value[c.count * i])));
}

void area_flush(struct tracer *t)
{
    struct area_queue *q = t->area;
    const struct area_request *of_lamp[PLACES];
    if (!q)
        return;
    for (uint32_t l = 0; l < t->job->lamp_count && q->count; l++) {
        uint32_t n = 0;
        for (uint32_t i = 0; i < q->count; i++) {
            if (q->at[i].lamp->index == l)
                of_lamp[n++] = &q->at[i];
            if (n == PLACES || (n && i + 1 == q->count)) {
                places_light(t, of_lamp, n);
                n = 0;
            }
        }
    }
    q->count = 0;
}

struct rgb projected_shadow(struct tracer *t, const struct lamp *lamp,
                            const struct shadow_request *r)
{
    const double h = object_first_hit(lamp->light->projected_through, r->o, r->d);
    if (!(h < r->t_max))
        return rgb(0, 0, 0);
    if (lamp->light->shadowless)
        return rgb(1, 1, 1);
    struct shadow_request near = *r;
    near.t_max = h;
    return shadow_factor(t, &near);
}
