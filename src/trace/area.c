#include "trace/area.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "trace/packet.h"
#include "trace/projected.h"
#include "trace/ray_shaft.h"
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

// ---- the grids of many places -----------------------------------------------------------

// A part of a place's grid. Where its corners differ, it is cut into four.
struct area_cell {
    int u[2], v[2];
    uint32_t corner[4]; // values at (u0, v0), (u1, v0), (u0, v1), (u1, v1)
    uint32_t part;      // the first of its four parts, cells behind it; 0: none
    uint32_t place;
    struct rgb mean;
};

struct area_queue {
    struct area_request *at; // that wait
    uint32_t count, capacity;
    // Places of one lamp, whose grids are asked for level by level: cells of all places
    // together, so that rays to one point of the grid make packets.
    const struct lamp *lamp;
    struct area_places place;
    uint32_t slot[BATCH_SIZE];
    uint8_t photons[BATCH_SIZE];
    uint32_t *known,
        known_capacity; // by place and point: 1 + its value; 0: not asked for
    struct rgb *value;  // room as for rays
    uint32_t value_count;
    struct area_ray *ray, *sorted; // of this level
    uint32_t ray_count, ray_capacity;
    struct area_cell *cell;
    uint32_t cell_count, cell_capacity;
    uint32_t *begin, begin_capacity; // of each point's rays among the sorted
};

static uint32_t points_of(const struct light *l)
{
    return (uint32_t)(l->size1 * l->size2);
}

// The value of a point of a place's grid, which is asked for unless it has been.
static uint32_t point_ask(struct area_queue *q, uint32_t place, int u, int v)
{
    const struct light *light = q->lamp->light;
    const uint32_t point = (uint32_t)(u * light->size2 + v);
    uint32_t *known = &q->known[place * points_of(light) + point];
    if (*known)
        return *known - 1;
    q->ray[q->ray_count++] = (struct area_ray){place, point, q->value_count};
    *known = ++q->value_count;
    return *known - 1;
}

// The whole grid.
static void cell_whole(struct area_queue *q, uint32_t place)
{
    const int u = q->lamp->light->size1 - 1, v = q->lamp->light->size2 - 1;
    q->cell[q->cell_count++] = (struct area_cell){
        .u = {0, u},
        .v = {0, v},
        .corner = {point_ask(q, place, 0, 0), point_ask(q, place, u, 0),
                   point_ask(q, place, 0, v), point_ask(q, place, u, v)},
        .place = place};
}

// The values of the points (u, v[0]) and (u, v[1]).
static void pair_ask(struct area_queue *q, uint32_t place, int u, const int v[2],
                     uint32_t value[2])
{
    value[0] = point_ask(q, place, u, v[0]);
    value[1] = v[0] == v[1] ? value[0] : point_ask(q, place, u, v[1]);
}

// Four parts, which meet in the middle: only what lies between the corners is asked for.
static void cell_cut(struct area_queue *q, uint32_t i)
{
    struct area_cell *whole = &q->cell[i], *part = &q->cell[q->cell_count];
    const uint32_t place = whole->place, *corner = whole->corner;
    const int *u = whole->u, *v = whole->v;
    const int um[2] = {(u[0] + u[1]) / 2, (u[0] + u[1] + 1) / 2};
    const int vm[2] = {(v[0] + v[1]) / 2, (v[0] + v[1] + 1) / 2};
    uint32_t side[2][2], end[2][2],
        inner[2][2]; // at u[.] and vm, um[.] and v, um[.] and vm
    for (int k = 0; k < 2; k++) {
        pair_ask(q, place, u[k], vm, side[k]);
        if (k && um[0] == um[1]) {
            memcpy(end[1], end[0], sizeof end[1]);
            memcpy(inner[1], inner[0], sizeof inner[1]);
        } else {
            pair_ask(q, place, um[k], v, end[k]);
            pair_ask(q, place, um[k], vm, inner[k]);
        }
    }
    whole->part = q->cell_count;
    q->cell_count += 4;
    part[0] =
        (struct area_cell){.u = {u[0], um[0]},
                           .v = {v[0], vm[0]},
                           .corner = {corner[0], end[0][0], side[0][0], inner[0][0]},
                           .place = place};
    part[1] =
        (struct area_cell){.u = {um[1], u[1]},
                           .v = {v[0], vm[0]},
                           .corner = {end[1][0], corner[1], inner[1][0], side[1][0]},
                           .place = place};
    part[2] =
        (struct area_cell){.u = {u[0], um[0]},
                           .v = {vm[1], v[1]},
                           .corner = {side[0][1], inner[0][1], corner[2], end[0][1]},
                           .place = place};
    part[3] =
        (struct area_cell){.u = {um[1], u[1]},
                           .v = {vm[1], v[1]},
                           .corner = {inner[1][1], side[1][1], end[1][1], corner[3]},
                           .place = place};
}

// Room for `count` more cells and their corners.
static void cells_reserve(struct area_queue *q, uint32_t count)
{
    while (q->cell_count + count > q->cell_capacity) {
        q->cell_capacity = q->cell_capacity ? 2 * q->cell_capacity : BATCH_SIZE;
        q->cell = must_realloc(q->cell, q->cell_capacity, sizeof *q->cell);
    }
    while (q->value_count + 4 * count > q->ray_capacity) {
        q->ray_capacity = q->ray_capacity ? 2 * q->ray_capacity : 4 * BATCH_SIZE;
        q->value = must_realloc(q->value, q->ray_capacity, sizeof *q->value);
        q->ray = must_realloc(q->ray, q->ray_capacity, sizeof *q->ray);
        q->sorted = must_realloc(q->sorted, q->ray_capacity, sizeof *q->sorted);
    }
}

// Brings rays to the same point side by side.
static void rays_sort(struct area_queue *q)
{
    const uint32_t points = points_of(q->lamp->light);
    uint32_t *begin = q->begin, n = 0;
    memset(begin, 0, points * sizeof *begin);
    for (uint32_t i = 0; i < q->ray_count; i++)
        begin[q->ray[i].point]++;
    for (uint32_t i = 0; i < points; i++) {
        const uint32_t here = begin[i];
        begin[i] = n;
        n += here;
    }
    for (uint32_t i = 0; i < q->ray_count; i++)
        q->sorted[begin[q->ray[i].point]++] = q->ray[i];
}

// What comes along the rays that stand in `near`.
static void rays_light(struct tracer *t, uint32_t count, struct rgb *out)
{
    const struct area_queue *q = t->area;
    if (q->lamp->window)
        window_factors_near(t, q->lamp, count, out);
    else
        shadow_factors_near(t, q->lamp->index, count, out);
}

// Finds the values of the points asked for.
static void rays_trace(struct tracer *t)
{
    struct area_queue *q = t->area;
    struct rgb value[BATCH_SIZE];
    rays_sort(q);
    for (uint32_t first = 0, n; first < q->ray_count; first += n) {
        const struct area_ray *ray = q->sorted + first;
        n = q->ray_count - first < BATCH_SIZE ? q->ray_count - first : BATCH_SIZE;
        t->job->kernels->toward(q->lamp, &q->place, ray, n, t->near.rays);
        for (uint32_t i = 0; i < n; i++) {
            t->near.slot[i] = (uint16_t)q->slot[ray[i].place];
            t->near.photons[i] = q->photons[ray[i].place];
        }
        if (tracer_gives_up(t))
            memset(value, 0, n * sizeof *value);
        else
            rays_light(t, n, value);
        for (uint32_t i = 0; i < n; i++)
            q->value[ray[i].value] = value[i];
    }
    q->ray_count = 0;
}

static float difference(struct rgb a, struct rgb b, struct rgb color)
{
    return fabsf(color.r * (a.r - b.r)) + fabsf(color.g * (a.g - b.g)) +
           fabsf(color.b * (a.b - b.b));
}

static bool same(struct rgb a, struct rgb b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

// Whether a cell whose corners are known is cut.
static bool wants_parts(const struct area_queue *q, const struct area_cell *c, int level)
{
    static const float notable = 0.1f; // difference of corners that calls for more
    const struct light *l = q->lamp->light;
    if (c->u[1] - c->u[0] <= 1 && c->v[1] - c->v[0] <= 1)
        return false;
    if (level < l->adaptive)
        return true;
    const struct rgb v[4] = {q->value[c->corner[0]], q->value[c->corner[1]],
                             q->value[c->corner[2]], q->value[c->corner[3]]};
    if (same(v[0], v[1]) && same(v[0], v[2]) &&
        same(v[0], v[3])) // mostly: all or nothing
        return false;
    return difference(v[0], v[1], l->color) > notable ||
           difference(v[2], v[3], l->color) > notable ||
           difference(v[0], v[2], l->color) > notable ||
           difference(v[1], v[3], l->color) > notable;
}

// Cuts the cells from `first` to `end` that want it.
static void cells_cut(struct area_queue *q, uint32_t first, uint32_t end, int level)
{
    for (uint32_t i = first; i < end; i++) {
        if (!wants_parts(q, &q->cell[i], level))
            continue;
        cells_reserve(q, 4);
        cell_cut(q, i);
    }
}

// The means of all cells; parts stand behind what they are parts of.
static void cells_mean(struct area_queue *q)
{
    for (uint32_t i = q->cell_count; i-- > 0;) {
        struct area_cell *c = &q->cell[i];
        struct rgb v[4];
        for (uint32_t k = 0; k < 4; k++)
            v[k] = c->part ? q->cell[c->part + k].mean : q->value[c->corner[k]];
        c->mean = rgb_scale(0.25f, rgb_add(rgb_add(v[0], v[1]), rgb_add(v[2], v[3])));
    }
}

static void place_put(struct area_queue *q, uint32_t i, const struct area_request *r)
{
    struct area_places *to = &q->place;
    const struct lamp_grid grid = lamp_grid_of(r->lamp, r->p);
    const struct vec3 from[4] = {r->p, r->ng, grid.axis1, grid.axis2};
    double(*const at[4])[BATCH_SIZE] = {to->p, to->ng, to->axis1, to->axis2};
    for (int k = 0; k < 4; k++) {
        at[k][0][i] = from[k].x;
        at[k][1][i] = from[k].y;
        at[k][2][i] = from[k].z;
    }
    to->error[i] = r->error;
    to->hash[i] = hash_mix(r->hash, r->lamp->index);
    q->slot[i] = r->slot;
    q->photons[i] = r->photons;
}

// At most places_most of them.
static void places_light(struct tracer *t, const struct area_request *const *r,
                         uint32_t count, struct rgb *out)
{
    struct area_queue *q = t->area;
    const struct light *light = r[0]->lamp->light;
    const uint32_t points = points_of(light);
    q->lamp = r[0]->lamp;
    q->value_count = q->cell_count = 0;
    if (count * points > q->known_capacity) {
        q->known_capacity = count * points;
        q->known = must_realloc(q->known, q->known_capacity, sizeof *q->known);
    }
    if (points > q->begin_capacity) {
        q->begin_capacity = points;
        q->begin = must_realloc(q->begin, points, sizeof *q->begin);
    }
    memset(q->known, 0, count * points * sizeof *q->known);
    cells_reserve(q, count);
    for (uint32_t i = 0; i < count; i++) {
        place_put(q, i, r[i]);
        cell_whole(q, i);
    }
    for (uint32_t first = 0, end, level = 0; first < q->cell_count;
         first = end, level++) {
        rays_trace(t);
        end = q->cell_count;
        cells_cut(q, first, end, (int)level);
    }
    cells_mean(q);
    for (uint32_t i = 0; i < count; i++)
        out[i] = q->cell[i].mean;
}

// How many places are lit together: what is known of their grids should stay near.
static uint32_t places_most(const struct light *light)
{
    enum { NEAR = 16384, LEAST = 8 };
    const uint32_t most = NEAR / points_of(light);
    return most < LEAST ? LEAST : most > BATCH_SIZE ? BATCH_SIZE : most;
}

// ---- what is in the way -----------------------------------------------------------------

enum { AREA_PLACES = 8 }; // neighbours that are asked for together

// What holds all points of an area light's grid, however it is turned and jittered.
struct area_around {
    bool known; // rays end there
    struct aabb box;
    double radius;
};

static double half_of(const struct light *l, int size)
{
    static const double shift = 0.001; // of a circular grid
    return size > 1 ? 0.5 + l->circular * shift + l->jitter * 0.5 / (size - 1)
                    : l->circular * shift;
}

static struct area_around area_around(const struct tracer *t, const struct lamp *lamp)
{
    const struct light *l = lamp->light;
    const double h1 = half_of(l, l->size1), h2 = half_of(l, l->size2);
    const double r1 = h1 * vec3_length(l->axis1);
    const double r2 = h2 * vec3_length(l->orient ? l->axis1 : l->axis2);
    struct vec3 reach = vec3(r1 + r2, r1 + r2, r1 + r2);
    if (!l->orient)
        reach = vec3(h1 * fabs(l->axis1.x) + h2 * fabs(l->axis2.x),
                     h1 * fabs(l->axis1.y) + h2 * fabs(l->axis2.y),
                     h1 * fabs(l->axis1.z) + h2 * fabs(l->axis2.z));
    return (struct area_around){
        !l->parallel && l->kind != LIGHT_CYLINDER && !lamp->window &&
            !air_counts(t->job, lamp->index),
        {vec3_sub(l->location, reach), vec3_add(l->location, reach)},
        r1 + r2};
}

// The origins of the rays from places to the lamp's grid, and a box around them; false: some
// begin on either side of their surface.
static bool origins_of(const struct area_around *around,
                       const struct area_request *const *r, uint32_t count,
                       double origin[3][AREA_PLACES], struct aabb *box)
{
    *box = aabb_empty();
    for (uint32_t i = 0; i < AREA_PLACES; i++) {
        const struct area_request *a = r[i < count ? i : 0];
        const double up = vec3_dot(vec3_sub(a->lamp->light->location, a->p), a->ng);
        if (a->error > 0 && !(fabs(up) > 1.001 * around->radius))
            return false;
        const struct vec3 o = vec3_mad(a->p, (up < 0 ? -2 : 2) * a->error, a->ng);
        origin[0][i] = o.x, origin[1][i] = o.y, origin[2][i] = o.z;
        *box = aabb_add(*box, o);
    }
    return true;
}

// Whether nothing can lie between neighbouring places and any point of the lamp.
static bool nothing_between(const struct tracer *t, const struct area_around *around,
                            const struct area_request *const *r, uint32_t count)
{
    const struct world *w = t->job->world;
    double origin[3][AREA_PLACES];
    uint32_t object[RAY_SHAFT_OBJECTS];
    struct ray_shaft s = {{origin[0], origin[1], origin[2]},
                          AREA_PLACES,
                          OBJECT_NO_SHADOW,
                          around->box,
                          around->box};
    return around->known && origins_of(around, r, count, origin, &s.from) &&
           ray_shaft_reaches(&s.from) && ray_shaft_reaches(&s.to) &&
           !w->accel->kernels->shaft(w->dark, &s, object) &&
           (!w->clear || !w->accel->kernels->shaft(w->clear, &s, object));
}

// Places on whose ways something may be, together.
struct area_rest {
    const struct area_request *at[BATCH_SIZE];
    struct rgb *out[BATCH_SIZE];
    uint32_t count;
};

static void rest_light(struct tracer *t, struct area_rest *rest)
{
    struct rgb out[BATCH_SIZE];
    if (rest->count)
        places_light(t, rest->at, rest->count, out);
    for (uint32_t i = 0; i < rest->count; i++)
        *rest->out[i] = out[i];
    rest->count = 0;
}

void area_shadows(struct tracer *t, const struct area_request *const *r, uint32_t count,
                  struct rgb *out)
{
    if (!count)
        return;
    const uint32_t most = places_most(r[0]->lamp->light);
    const struct area_around around = area_around(t, r[0]->lamp);
    struct area_rest rest;
    rest.count = 0;
    for (uint32_t i = 0, n; i < count; i += n) {
        n = count - i < AREA_PLACES ? count - i : AREA_PLACES;
        const bool lit = nothing_between(t, &around, r + i, n);
        if (rest.count + n > most)
            rest_light(t, &rest);
        for (uint32_t k = i; k < i + n; k++) {
            out[k] = rgb(1, 1, 1);
            rest.at[rest.count] = r[k];
            rest.out[rest.count] = &out[k];
            rest.count += !lit;
        }
    }
    rest_light(t, &rest);
}

// ---- places that wait -------------------------------------------------------------------

void area_init(struct tracer *t)
{
    const struct job *job = t->job;
    for (uint32_t i = 0; i < job->lamp_count && !t->area; i++)
        if (job->lamp[i].light->area && job->area_lights && job->shadows)
            t->area = must_calloc(1, sizeof *t->area);
}

void area_end(struct tracer *t)
{
    struct area_queue *q = t->area;
    if (!q)
        return;
    free(q->at);
    free(q->known);
    free(q->value);
    free(q->ray);
    free(q->sorted);
    free(q->cell);
    free(q->begin);
    free(q);
}

void area_add(struct tracer *t, const struct area_request *r)
{
    struct area_queue *q = t->area;
    if (q->count == q->capacity) {
        q->capacity = q->capacity ? 2 * q->capacity : BATCH_SIZE;
        q->at = must_realloc(q->at, q->capacity, sizeof *q->at);
    }
    q->at[q->count++] = *r;
}

static void lit_add(struct tracer *t, const struct area_request *const *r, uint32_t count)
{
    struct rgb factor[BATCH_SIZE];
    area_shadows(t, r, count, factor);
    for (uint32_t i = 0; i < count; i++)
        tracer_lit(t, r[i]->slot, rgb_mul(r[i]->value, factor[i]));
}

void area_flush(struct tracer *t)
{
    struct area_queue *q = t->area;
    const struct area_request *of_lamp[BATCH_SIZE];
    if (!q)
        return;
    for (uint32_t l = 0; l < t->job->lamp_count && q->count; l++) {
        uint32_t n = 0;
        for (uint32_t i = 0; i < q->count; i++) {
            if (q->at[i].lamp->index != l)
                continue;
            of_lamp[n++] = &q->at[i];
            if (n == BATCH_SIZE) {
                lit_add(t, of_lamp, n);
                n = 0;
            }
        }
        lit_add(t, of_lamp, n);
    }
    q->count = 0;
}
