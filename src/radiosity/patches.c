#include "radiosity/patches.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "math/isa.h"
#include "radiosity/polygon.h"
#include "trace/accel.h"
#include "trace/packet.h"
#include "trace/tracer.h"

const struct patch_settings patch_defaults = {.count = 8000, .samples = 3, .depth = 2};

// How far above the surface, relative to the cell, a probing ray starts.
static const double probe_height = 1e-5;

// Inside of a disc is the half space below it, but what lies there is in the open; so is
// what lies inside of what patches do not see.
static bool encloses(const struct world *w, uint32_t object)
{
    const struct world_object *o = &w->object[object];
    return !(o->flags & OBJECT_NO_RADIOSITY) &&
           (o->is_csg || w->leaf[o->first_leaf].ops != &disc_ops);
}

static bool in_room(const struct patches *p, struct vec3 at)
{
    enum { MOST = 64 };
    uint32_t object[MOST];
    const uint32_t n = trace_containing(p->job->world, at, object, MOST);
    for (uint32_t i = 0, k = 0; i < n; i++) {
        while (k < p->room_count && p->room[k] < object[i])
            k++;
        if ((k == p->room_count || p->room[k] != object[i]) &&
            encloses(p->job->world, object[i]))
            return false;
    }
    return true;
}

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
    return in_room(p, from);
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
        if (object[i] == except || !encloses(p->job->world, object[i]) ||
            (k < p->room_count && p->room[k] == object[i]))
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
    p->room = must_calloc(w->object_count + 1, sizeof *p->room);
    room_add(p, job->camera->location, UINT32_MAX);
    for (uint32_t i = 0; i < job->lamp_count; i++)
        room_add(p, job->lamp[i].light->location, UINT32_MAX);
    for (uint32_t l = 0; l < w->leaf_count; l++)
        if (w->leaf[l].drawn && surface_glows(&w->surface[w->leaf[l].surface]))
            glow_room(p, l);
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

// Cells along u and v so that none is longer than the size.
static void chart_grid(const struct chart *c, double size, uint32_t grid[2])
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
    chart_grid(c, p->size, grid);
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

static struct patches *with_charts(const struct job *job, const struct patch_settings *s)
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

// Cuts the charts into cells no longer than the size, and those into elements. NULL, and p
// is freed: there is nothing to cut.
static struct patches *cut(struct patches *p, double size)
{
    p->size = size;
    if (!(p->size > 0 && p->size < INFINITY)) {
        patches_free(p);
        return NULL;
    }
    find_rooms(p);
    find_around(p);
    for (uint32_t i = 0; i < p->chart_count && !watch_cancelled(p->settings.watch); i++)
        chart_cells(p, i);
    elements_find(p);
    patches_enclosure(p);
    patches_neighbours(p);
    patches_prune(p);
    return p;
}

static struct patches *build(const struct job *job, const struct patch_settings *s)
{
    struct patches *p = with_charts(job, s);
    return cut(p, s->size > 0 ? s->size : size_for(p));
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

// ---- how many there will be --------------------------------------------------------
// What a coarse trial says about the number of elements at other sizes of cells.
struct forecast {
    const struct patches *trial;
    double *whole; // by chart: elements of a cell, both sides
    double *cut;   // and cells that exist in part
    double scale;  // of what was built to what was expected
};

static void forecast_init(struct forecast *f, const struct patches *trial)
{
    *f = (struct forecast){trial, must_calloc(trial->chart_count + 1, sizeof *f->whole),
                           must_calloc(trial->chart_count + 1, sizeof *f->cut), 1};
    for (uint32_t i = 0; i < trial->element_count; i++) {
        const uint32_t c = trial->cell[trial->element_cell[i] / 2].chart;
        f->whole[c] += trial->element[i].area / trial->chart[c].area;
        f->cut[c] += trial->element[i].partial;
    }
}

static double forecast_count(const struct forecast *f, double size)
{
    // A cut cell is quartered twice: so many elements more than one of its area.
    static const double more = 4.5;
    double count = 0;
    for (uint32_t i = 0; i < f->trial->chart_count; i++) {
        uint32_t grid[2];
        chart_grid(&f->trial->chart[i], size, grid);
        count +=
            f->whole[i] * grid[0] * grid[1] + more * f->cut[i] * f->trial->size / size;
    }
    return f->scale * count;
}

// The largest size of cells that gives as many elements.
static double forecast_size(const struct forecast *f, double count)
{
    enum { STEPS = 40 };
    double few = f->trial->size, many = few, area = 0;
    // Cells of the size of all there is are more than coarse.
    for (uint32_t i = 0; i < f->trial->element_count; i++)
        area += f->trial->element[i].area;
    few = fmax(few, sqrt(area));
    if (forecast_count(f, few) > count)
        return few;
    for (int k = 0; k < STEPS && forecast_count(f, many) < count; k++)
        many /= 2;
    for (int k = 0; k < STEPS; k++) {
        const double middle = sqrt(few * many);
        if (forecast_count(f, middle) < count)
            few = middle;
        else
            many = middle;
    }
    return many;
}

enum { TRIAL = 400 }; // elements

// One cell a chart where that makes as many elements as are wanted, or more: then there is
// nothing to try. NULL: it does not, or that would take long to find out.
static struct patches *build_coarsest(const struct job *job,
                                      const struct patch_settings *s)
{
    struct patches *p = with_charts(job, s);
    double longest = 0;
    for (uint32_t i = 0; i < p->chart_count; i++)
        longest = fmax(longest, fmax(p->chart[i].side[0], p->chart[i].side[1]));
    if (2.0 * p->chart_count < s->count) {
        patches_free(p);
        return NULL;
    }
    p = cut(p, longest);
    if (p && p->element_count < s->count && !watch_cancelled(s->watch)) {
        patches_free(p);
        return NULL;
    }
    return p;
}

// As many elements as are wanted, about; cells that are quartered and small charts make
// more than was counted on.
static struct patches *build_counted(const struct job *job,
                                     const struct patch_settings *s)
{
    enum { RETRIES = 3 };
    static const double most = 1.15; // elements, of those wanted
    struct patch_settings settings = *s;
    struct patches *const coarsest = s->count <= TRIAL ? build_coarsest(job, s) : NULL;
    if (coarsest)
        return coarsest;
    settings.count = fmin(s->count, TRIAL);
    settings.depth = 0;
    settings.trial = true;
    struct patches *p = NULL, *trial = build(job, &settings);
    if (!trial || !trial->element_count) {
        patches_free(trial);
        return NULL;
    }
    struct forecast f;
    forecast_init(&f, trial);
    settings = *s;
    settings.size = forecast_size(&f, s->count);
    for (int k = 0; k <= RETRIES && !watch_cancelled(s->watch); k++) {
        const double before = p ? p->element_count : 0;
        patches_free(p);
        p = build(job, &settings);
        if (!p || p->element_count <= most * s->count ||
            (k && p->element_count > .9 * before))
            break;
        f.scale *= p->element_count / forecast_count(&f, settings.size);
        const double size = forecast_size(&f, s->count);
        if (size <= settings.size)
            break;
        settings.size = size;
    }
    free(f.whole);
    free(f.cut);
    patches_free(trial);
    return p;
}

struct patches *patches_build(const struct job *job, const struct patch_settings *s)
{
    struct patches *p = s->size > 0 ? build(job, s) : build_counted(job, s);
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
