#include "radiosity/patches.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "math/isa.h"
#include "trace/accel.h"
#include "trace/packet.h"
#include "trace/tracer.h"

const struct patch_settings patch_defaults = {.count = 8000, .samples = 3, .depth = 2};

// How far above the surface, relative to the cell, a probing ray starts.
static const double probe_height = 1e-5;

bool patch_aim(const struct patches *p, const struct cell *c, int side, double u,
               double v, struct element_point *out, struct ray *ray)
{
    const struct chart *chart = &p->chart[c->chart];
    const struct leaf *l = &p->job->world->leaf[chart->leaf];
    struct vec3 n;
    if (!chart_point(chart, l, c->u + u * c->du, c->v + v * c->dv, &out->p, &n))
        return false;
    out->normal = l->inverted != (side == 1) ? vec3_neg(n) : n;
    const double height = probe_height * p->size + 1e-9 * vec3_max_abs(out->p);
    const struct vec3 from = vec3_mad(out->p, height, out->normal);
    *ray = (struct ray){from, vec3_neg(out->normal), 0, 2 * height};
    return patches_in_room(p, from);
}

bool patch_met(const struct patches *p, const struct cell *c, const struct ray *ray,
               const struct hit *hit, struct element_point *out)
{
    struct interaction at;
    if (hit->b.t == INFINITY || hit->b.leaf != p->chart[c->chart].leaf)
        return false;
    trace_interaction(p->job->world, ray, hit, &at);
    out->p = at.p;
    out->error = 2 * at.error;
    return true;
}

bool patch_point(const struct patch_probe *probe, const struct cell *c, int side,
                 double u, double v, struct element_point *out, struct hit *hit,
                 struct ray *ray)
{
    const struct patches *p = probe->p;
    struct ray_query q = {.hidden_by = OBJECT_NO_RADIOSITY};
    if (!patch_aim(p, c, side, u, v, out, &q.ray))
        return false;
    *hit = trace_closest_1(p->job->world, probe->scratch, &q);
    *ray = q.ray;
    return patch_met(p, c, ray, hit, out) &&
           (!c->anchor ||
            anchor_sees(p, probe->scratch, c->anchor, side, out->p) != c->twin);
}

// ---- what has nothing before it ----------------------------------------------------
// Where rays of the camera may start and what all objects lie in.
static void find_around(struct patches *p)
{
    const struct world *w = p->job->world;
    const struct camera *c = p->job->camera;
    const struct aabb *b = &w->bounds;
    const bool wide = c->kind == CAMERA_ORTHOGRAPHIC;
    if (c->aperture > 0 || c->kind == CAMERA_MESH || c->normal ||
        (c->kind >= CAMERA_CYLINDER_1 && c->kind <= CAMERA_CYLINDER_4))
        return;
    for (uint32_t o = 0; o < w->object_count; o++)
        if (!aabb_is_finite(w->object[o].bounds))
            return;
    for (int k = 0; k < 8; k++)
        p->around[p->around_count++] =
            vec3(k & 1 ? b->max.x : b->min.x, k & 2 ? b->max.y : b->min.y,
                 k & 4 ? b->max.z : b->min.z);
    for (int k = 0; k < (wide ? 4 : 1); k++) {
        const struct vec3 across = vec3_scale(wide ? (k & 1) - .5 : 0, c->right);
        const struct vec3 up = vec3_scale(wide ? (k >> 1) - .5 : 0, c->up);
        p->around[p->around_count++] = vec3_add(c->location, vec3_add(across, up));
    }
}

// Sides of flat charts that face away from all objects and the camera: no light goes
// from there to either, the bits of cell.dead.
static uint8_t sides_alone(const struct patches *p, const struct chart *c)
{
    // What stands out of a plane by less sees nothing of it.
    static const double flush = 1e-9; // of the scene's extent
    const struct leaf *l = &p->job->world->leaf[c->leaf];
    struct vec3 at, normal;
    double before = 0, behind = 0, extent = 0;
    if ((c->kind != CHART_FLAT && c->kind != CHART_TRIANGLE && c->kind != CHART_RING) ||
        !p->around_count || !chart_point(c, l, .5, .5, &at, &normal))
        return 0;
    const struct vec3 out = l->inverted ? vec3_neg(normal) : normal;
    for (uint32_t k = 0; k < p->around_count; k++) {
        const struct vec3 r = vec3_sub(p->around[k], at);
        const double height = vec3_dot(r, out);
        before = fmax(before, height);
        behind = fmax(behind, -height);
        extent = fmax(extent, vec3_length(r));
    }
    return (uint8_t)((before <= flush * extent ? 1 : 0) |
                     (behind <= flush * extent ? 2 : 0));
}

// ---- cells -------------------------------------------------------------------------
static void chart_measure(const struct patches *p, struct chart *c)
{
    enum { N = 8 };
    const struct leaf *l = &p->job->world->leaf[c->leaf];
    for (int i = 0; i < N * N; i++) {
        const double u = (i % N + .5) / N, v = (i / N + .5) / N;
        c->area += chart_density(c, l, u, v, 1e-4, 1e-4) / (N * N);
        struct vec3 a, b, n;
        const double h = .5 / N;
        if (chart_point(c, l, u - h, v, &a, &n) && chart_point(c, l, u + h, v, &b, &n))
            c->side[0] += vec3_length(vec3_sub(b, a)) / N;
        if (chart_point(c, l, u, v - h, &a, &n) && chart_point(c, l, u, v + h, &b, &n))
            c->side[1] += vec3_length(vec3_sub(b, a)) / N;
    }
    if (c->kind == CHART_PROJECTED) {
        const struct transform *t = p->job->world->leaf[c->leaf].transform;
        c->side[0] = vec3_length(transform_vector(t, c->a));
        c->side[1] = vec3_length(transform_vector(t, c->b));
    }
}

void patches_grid(const struct chart *c, double size, uint32_t grid[2])
{
    grid[0] = grid[1] = 0;
    if (!(c->area > 0))
        return;
    // 1e-9: a side of exactly n sizes is n cells.
    grid[0] = (uint32_t)fmax(c->wrap ? 8 : 1, ceil(c->side[0] / size - 1e-9));
    const bool ends = c->kind == CHART_SPHERE || c->kind == CHART_MAPPED;
    grid[1] = (uint32_t)fmax(ends ? 4 : 1, ceil(c->side[1] / size - 1e-9));
}

static void chart_cells(struct patches *p, uint32_t index)
{
    struct chart *c = &p->chart[index];
    uint32_t grid[2];
    patches_grid(c, p->size, grid);
    c->nu = grid[0];
    c->nv = grid[1];
    c->first_cell = p->cell_count;
    const uint32_t n = c->nu * c->nv;
    const uint8_t dead = sides_alone(p, c);
    struct cell *cell = cells_add(p, n);
    for (uint32_t i = 0; i < n; i++)
        cell[i] = (struct cell){.u = (double)(i % c->nu) / c->nu,
                                .v = (double)(i / c->nu) / c->nv,
                                .du = 1.0 / c->nu,
                                .dv = 1.0 / c->nv,
                                .chart = index,
                                .dead = dead,
                                .element = {ELEMENT_NONE, ELEMENT_NONE}};
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

// Where a point can be inside of a node, or outside.
static struct aabb node_box(const struct world *w, uint32_t node, bool inside)
{
    const struct csg_node *n = &w->node[node];
    if (n->op == NODE_LEAF) {
        const struct leaf *l = &w->leaf[n->leaf];
        return l->inverted == inside ? aabb_infinite()
               : l->solid            ? l->bounds
                                     : aabb_empty();
    }
    const bool all = (n->op == NODE_INTERSECTION) == inside;
    struct aabb box = all ? aabb_infinite() : aabb_empty();
    for (uint32_t k = 0; k < n->child_count; k++) {
        const struct aabb c = node_box(w, n->first_child + k, inside);
        box = all ? aabb_meet(box, c) : aabb_join(box, c);
    }
    return box;
}

// What the others leave of the surfaces of the leaves below a node: of an intersection
// what is inside of them, of a merge what is outside.
static void node_limits(const struct world *w, uint32_t node, struct aabb limit,
                        struct aabb *out)
{
    const struct csg_node *n = &w->node[node];
    if (n->op == NODE_LEAF) {
        out[n->leaf] = aabb_meet(limit, n->bounds);
        return;
    }
    for (uint32_t k = 0; k < n->child_count; k++) {
        struct aabb own = limit;
        for (uint32_t i = 0; i < n->child_count && n->op != NODE_UNION; i++)
            if (i != k)
                own = aabb_meet(
                    own, node_box(w, n->first_child + i, n->op == NODE_INTERSECTION));
        node_limits(w, n->first_child + k, own, out);
    }
}

// Where the surface of each leaf can be drawn: what cuts it ends what has no end.
static struct aabb *leaf_limits(const struct job *job)
{
    const struct world *w = job->world;
    const struct aabb limit = scene_limit(job);
    struct aabb *out = must_malloc(w->leaf_count + 1, sizeof *out);
    for (uint32_t l = 0; l < w->leaf_count; l++)
        out[l] = w->object[w->leaf[l].object].bounds;
    for (uint32_t o = 0; o < w->object_count; o++)
        if (w->object[o].is_csg)
            node_limits(w, w->object[o].root, w->object[o].bounds, out);
    for (uint32_t l = 0; l < w->leaf_count; l++)
        if (!aabb_is_finite(out[l]))
            out[l] = aabb_meet(out[l], limit);
    return out;
}

static void charts_build(struct patches *p)
{
    const struct world *w = p->job->world;
    struct aabb *limit = leaf_limits(p->job);
    p->leaf_first = must_calloc(w->leaf_count + 1, sizeof *p->leaf_first);
    for (int pass = 0; pass < 2; pass++) {
        uint32_t count = 0;
        for (uint32_t l = 0; l < w->leaf_count; l++) {
            const struct world_object *o = &w->object[w->leaf[l].object];
            p->leaf_first[l] = count;
            if (w->leaf[l].drawn && !(o->flags & OBJECT_NO_RADIOSITY))
                count += leaf_charts(w, l, &limit[l], p->chart ? p->chart + count : NULL);
        }
        p->leaf_first[w->leaf_count] = count;
        p->chart_count = count;
        if (!p->chart)
            p->chart = must_calloc(count + 1, sizeof *p->chart);
    }
    free(limit);
}

static double size_for(const struct patches *p)
{
    double area = 0;
    for (uint32_t i = 0; i < p->chart_count; i++)
        area += p->chart[i].area;
    return sqrt(area / fmax(p->settings.count, 1));
}

struct patches *patches_charts(const struct job *job, const struct patch_settings *s)
{
    struct patches *p = must_calloc(1, sizeof *p);
    p->job = job;
    p->settings = *s;
    p->sight = ISA_NAMED(job->world->accel->kernels->name, sight_kernels);
    if (p->settings.samples < 1)
        p->settings.samples = 1;
    charts_build(p);
    for (uint32_t i = 0; i < p->chart_count && !watch_cancelled(s->watch); i++)
        chart_measure(p, &p->chart[i]);
    return p;
}

struct patches *patches_cut(struct patches *p, double size)
{
    p->size = size;
    if (!(p->size > 0 && p->size < INFINITY)) {
        patches_free(p);
        return NULL;
    }
    patches_find_rooms(p);
    find_around(p);
    for (uint32_t i = 0; i < p->chart_count && !watch_cancelled(p->settings.watch); i++)
        chart_cells(p, i);
    elements_find(p);
    patches_enclosure(p);
    patches_neighbours(p);
    patches_prune(p);
    return p;
}

struct patches *patches_cut_by(const struct job *job, const struct patch_settings *s)
{
    struct patches *p = patches_charts(job, s);
    return patches_cut(p, s->size > 0 ? s->size : size_for(p));
}

void patches_connect(struct patches *p)
{
    free(p->neighbours);
    free(p->shaft);
    free(p->hulls);
    p->shaft = NULL;
    p->hulls = NULL;
    patches_neighbours(p);
    patches_shafts(p);
}

struct patches *patches_build(const struct job *job, const struct patch_settings *s)
{
    struct patches *p = s->size > 0 ? patches_cut_by(job, s) : patches_counted(job, s);
    if (p)
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
    free(p->anchor);
    free(p->shaft);
    free(p->hulls);
    free(p->room);
    free(p);
}
