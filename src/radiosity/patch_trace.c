// Elements as rays see them.
#include <stdlib.h>

#include "base/arena.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "radiosity/patches.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"
#include "trace/layers.h"
#include "trace/tracer.h"

// ---- colours -----------------------------------------------------------------------
struct seen_color {
    struct tracer *t;
    struct rgb reflectance, emission;
};

// The layers from the top, as the picture adds them up (trace/shade.c).
static void color_plain(void *user, const struct surface_view *v, const struct texture *x,
                        const struct texture_point *at, const struct texture_chain *chain,
                        double weight)
{
    struct seen_color *c = user;
    const struct job *job = c->t->job;
    struct rgb filter = rgb_even((float)weight);
    for (uint32_t i = x->layer_count; i-- > 0;) {
        struct layer l;
        layer_eval(c->t, v, &x->layer[i], at, chain, false, &l);
        const struct finish *f = l.finish;
        const struct rgb own =
            rgb_add(rgb_mul(f->ambient, job->ambient_light), f->emission);
        const struct rgb paint = rgb_mul(l.color, rgb_scale(l.att, filter));
        c->emission = rgb_add(c->emission, rgb_mul(paint, own));
        if (!l.found)
            continue;
        c->reflectance = rgb_add(c->reflectance, rgb_scale(f->diffuse, paint));
        filter = rgb_mul(filter, l.pass);
    }
}

static float limited(float v, float most) { return v > 0 ? (v < most ? v : most) : 0; }

void patch_color(struct tracer *t, const struct ray *ray, const struct hit *hit,
                 struct rgb *reflectance, struct rgb *emission)
{
    // A surface that gives back more than it gets has no solution.
    static const float most = 0.999f;
    struct seen_color c = {.t = t};
    struct interaction at;
    struct surface_view view;
    arena_reset(t->arena);
    trace_interaction(t->job->world, ray, hit, &at);
    surface_view_init(&view, &at, ray->d);
    texture_walk(t, &view, color_plain, &c);
    *reflectance = rgb(limited(c.reflectance.r, most), limited(c.reflectance.g, most),
                       limited(c.reflectance.b, most));
    *emission = rgb(limited(c.emission.r, INFINITY), limited(c.emission.g, INFINITY),
                    limited(c.emission.b, INFINITY));
}

// ---- lookups -----------------------------------------------------------------------
static uint32_t smallest(const struct patches *p, uint32_t i, double u, double v)
{
    while (p->cell[i].child) {
        const struct cell *x = &p->cell[i];
        i = x->child + (u >= x->u + x->du / 2 ? 1 : 0) + (v >= x->v + x->dv / 2 ? 2 : 0);
    }
    return i;
}

static uint32_t cell_at(const struct patches *p, const struct chart *c, double u,
                        double v)
{
    uint32_t iu = (uint32_t)(u * c->nu), iv = (uint32_t)(v * c->nv);
    iu = iu < c->nu ? iu : c->nu - 1;
    iv = iv < c->nv ? iv : c->nv - 1;
    return smallest(p, c->first_cell + iv * c->nu + iu, u, v);
}

struct place {
    const struct chart *chart;
    double u, v;
    int side;
    struct vec3 p;
};

static bool place_of(const struct patches *p, const struct ray *ray,
                     const struct hit *hit, const struct interaction *at,
                     struct place *out)
{
    const struct world *w = p->job->world;
    const uint32_t leaf = hit->b.leaf, first = p->leaf_first[leaf];
    const uint32_t count = p->leaf_first[leaf + 1] - first;
    const uint32_t k = leaf_chart_of(w, p->chart + first, count, &hit->b, at->p);
    if (k >= count)
        return false;
    out->chart = &p->chart[first + k];
    if (!out->chart->nu)
        return false;
    chart_locate(out->chart, &w->leaf[leaf], &hit->b, at->p, &out->u, &out->v);
    out->side = vec3_dot(at->ng, ray->d) > 0;
    out->p = at->p;
    return true;
}

// Steps to the neighbours, bit by bit of patches->neighbours.
static const int steps[8][2] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0},
                                {1, 0},   {-1, 1}, {0, 1},  {1, 1}};

static uint32_t element_of(const struct patches *p, struct trace_scratch *scratch,
                           uint32_t cell, const struct place *at, double u, double v)
{
    const struct cell *c = &p->cell[cell];
    if (!c->part)
        return c->element[at->side];
    const uint32_t anchor = p->cell[c->part].anchor;
    const uint32_t part = c->part + !anchor_sees(p, scratch, anchor, at->side, at->p);
    return p->cell[smallest(p, part, u, v)].element[at->side];
}

// The element at a place; where sampling missed a sliver of surface, one beside it.
static uint32_t element_near(const struct patches *p, struct trace_scratch *scratch,
                             const struct place *at)
{
    const uint32_t cell = cell_at(p, at->chart, at->u, at->v);
    const struct cell *c = &p->cell[cell];
    const uint32_t own = element_of(p, scratch, cell, at, at->u, at->v);
    if (own != ELEMENT_NONE)
        return own;
    for (int k = 0; k < 8; k++) {
        double u = at->u + steps[k][0] * c->du, v = at->v + steps[k][1] * c->dv;
        if (at->chart->wrap)
            u -= floor(u);
        if (u < 0 || u > 1 || v < 0 || v > 1)
            continue;
        const uint32_t e = element_of(p, scratch, cell_at(p, at->chart, u, v), at, u, v);
        if (e != ELEMENT_NONE)
            return e;
    }
    return ELEMENT_NONE;
}

uint32_t patch_of_hit(const struct patches *p, struct trace_scratch *scratch,
                      const struct ray *ray, const struct hit *hit)
{
    struct interaction met;
    struct place at;
    trace_interaction(p->job->world, ray, hit, &met);
    if (!place_of(p, ray, hit, &met, &at))
        return ELEMENT_NONE;
    return element_near(p, scratch, &at);
}

static int step_number(int su, int sv)
{
    const int k = (sv + 1) * 3 + su + 1;
    return k < 4 ? k : k - 1;
}

static uint32_t neighbour(const struct patches *p, uint32_t element, int su, int sv,
                          unsigned part)
{
    const struct cell *c = &p->cell[p->element_cell[element] / 2];
    const struct chart *chart = &p->chart[c->chart];
    double u = c->u + c->du * (.5 + su), v = c->v + c->dv * (.5 + sv);
    if (chart->wrap)
        u -= floor(u);
    if (u < 0 || u > 1 || v < 0 || v > 1)
        return ELEMENT_NONE;
    const uint32_t at = cell_at(p, chart, u, v);
    const uint32_t first = p->cell[at].part;
    const struct cell *to = &p->cell[first ? smallest(p, first + part, u, v) : at];
    return to->element[p->element_cell[element] & 1];
}

uint32_t patch_neighbour(const struct patches *p, uint32_t element, int k)
{
    if (!((p->neighbours[element] >> k) & 1))
        return ELEMENT_NONE;
    return neighbour(p, element, steps[k][0], steps[k][1],
                     (p->neighbours[element] >> (8 + k)) & 1);
}

uint32_t patch_around(const struct patches *p, struct trace_scratch *scratch,
                      const struct ray *ray, const struct hit *hit,
                      const struct interaction *met, uint32_t element[4],
                      double weight[4])
{
    struct place at;
    if (!place_of(p, ray, hit, met, &at))
        return 0;
    const uint32_t own = element_near(p, scratch, &at);
    if (own == ELEMENT_NONE)
        return 0;
    const struct cell *c = &p->cell[p->element_cell[own] / 2];
    const double x = (at.u - c->u) / c->du - .5, y = (at.v - c->v) / c->dv - .5;
    const int su = x < 0 ? -1 : 1, sv = y < 0 ? -1 : 1;
    const double fx = fabs(x), fy = fabs(y);
    const int step[4][2] = {{0, 0}, {su, 0}, {0, sv}, {su, sv}};
    const double share[4] = {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
    uint32_t n = 0;
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        uint32_t e = own;
        if (k) {
            e = patch_neighbour(p, own, step_number(step[k][0], step[k][1]));
        }
        if (e == ELEMENT_NONE)
            continue;
        element[n] = e;
        // Small elements are less sure of their light.
        weight[n] = share[k] * p->element[e].area;
        sum += weight[n++];
    }
    for (uint32_t k = 0; k < n; k++)
        weight[k] = sum > 0 ? weight[k] / sum : 1.0 / n;
    return n;
}

// ---- the enclosure -----------------------------------------------------------------
struct of_thread {
    const struct patches *p;
    struct trace_scratch *scratch;
    struct hit_batch *hit;
};

enum { ENCLOSURE_BATCH = 1024 };

static void *thread_begin(void *user)
{
    struct of_thread *t = must_calloc(1, sizeof *t);
    t->p = user;
    t->scratch = trace_scratch_new(t->p->job->world);
    t->hit = hit_batch_new(ENCLOSURE_BATCH);
    return t;
}

static void thread_end(void *state)
{
    struct of_thread *t = state;
    trace_scratch_free(t->scratch);
    hit_batch_free(t->hit);
    free(t);
}

bool patch_cell_point(const struct patches *p, struct trace_scratch *scratch,
                      const struct cell *c, int side, bool partial, double u, double v,
                      struct element_point *out)
{
    const struct chart *chart = &p->chart[c->chart];
    if (partial) {
        const struct patch_probe probe = {scratch, p};
        struct hit hit;
        struct ray ray;
        return patch_point(&probe, c, side, u, v, out, &hit, &ray);
    }
    // Whole: no ray is needed to know the point.
    static const double rounding = 0x1p-42; // above that of any hit
    const struct leaf *l = &p->job->world->leaf[chart->leaf];
    if (!chart_point(chart, l, c->u + u * c->du, c->v + v * c->dv, &out->p, &out->normal))
        return false;
    if (l->inverted != (side == 1))
        out->normal = vec3_neg(out->normal);
    out->error = rounding * (vec3_max_abs(out->p) + vec3_max_abs(l->transform->offset) +
                             vec3_max_abs(chart->o) + chart->r1 + chart->length +
                             vec3_max_abs(chart->a) + vec3_max_abs(chart->b));
    return true;
}

// The point at (u, v) of an element's square, uniform in area on planar ones. False: this
// part of the element does not exist.
static bool patch_element_point(const struct patches *p, struct trace_scratch *scratch,
                                uint32_t element, double u, double v,
                                struct element_point *out)
{
    return patch_cell_point(p, scratch, &p->cell[p->element_cell[element] / 2],
                            p->element_cell[element] & 1, p->element[element].partial, u,
                            v, out);
}

static bool point(void *state, uint32_t element, double u, double v,
                  struct element_point *out)
{
    const struct of_thread *t = state;
    return patch_element_point(t->p, t->scratch, element, u, v, out);
}

static bool bare_surface(void *state, uint32_t element, double u, double v,
                         struct vec3 *p)
{
    const struct of_thread *t = state;
    const struct cell *c = &t->p->cell[t->p->element_cell[element] / 2];
    const struct chart *chart = &t->p->chart[c->chart];
    struct vec3 n;
    return chart_point(chart, &t->p->job->world->leaf[chart->leaf], c->u + u * c->du,
                       c->v + v * c->dv, p, &n);
}

static uint32_t neighbour_of(const void *user, uint32_t element, int k)
{
    return patch_neighbour(user, element, k);
}

static bool may_hide(void *state, uint32_t a, uint32_t b)
{
    const struct of_thread *t = state;
    return patches_may_hide(t->p, a, b);
}

static void occluded(void *state, const struct ray_batch *rays, uint8_t *out)
{
    struct of_thread *t = state;
    for (uint32_t i = 0; i < rays->count; i++)
        rays->hidden_by[i] = OBJECT_NO_RADIOSITY;
    trace_occluded(t->p->job->world, t->scratch, rays, out);
}

static void closest(void *state, const struct ray_batch *rays, uint32_t *out)
{
    struct of_thread *t = state;
    for (uint32_t i = 0; i < rays->count; i++)
        rays->hidden_by[i] = OBJECT_NO_RADIOSITY;
    trace_closest(t->p->job->world, t->scratch, rays, t->hit);
    for (uint32_t i = 0; i < rays->count; i++) {
        const struct ray ray = ray_batch_line(rays, i);
        const struct hit hit = hit_batch_at(t->hit, i);
        out[i] = hit.b.t < INFINITY ? patch_of_hit(t->p, t->scratch, &ray, &hit)
                                    : ELEMENT_NONE;
    }
}

// An existing point of an element near its middle.
static bool middle(struct of_thread *t, uint32_t element, struct element_point *out)
{
    enum { TRIES = 32 };
    if (point(t, element, .5, .5, out))
        return true;
    for (uint32_t k = 0; k < TRIES; k++) {
        double x[4];
        sobol_point(k, element, x);
        if (point(t, element, x[0], x[1], out))
            return true;
    }
    return false;
}

static void find_neighbours(void *user, void *state, uint32_t begin, uint32_t end)
{
    struct patches *p = user;
    struct of_thread *t = state;
    for (uint32_t i = begin; i < end; i++) {
        struct element_point from, to;
        if (!middle(t, i, &from))
            continue;
        // Lifted, so that the way between two points of a hollow surface is free.
        const double lift = .05 * sqrt(p->element[i].area);
        from.p = vec3_mad(from.p, lift, from.normal);
        for (unsigned k = 0; k < 16; k++) {
            const unsigned step = k % 8, part = k / 8;
            const uint32_t j = neighbour(p, i, steps[step][0], steps[step][1], part);
            if (j == ELEMENT_NONE || (p->neighbours[i] >> step) & 1 || !middle(t, j, &to))
                continue;
            to.p = vec3_mad(to.p, lift, to.normal);
            const struct vec3 o = point_lifted(&from);
            const struct ray_query q = {{o, vec3_sub(point_lifted(&to), o), 0, 1},
                                        OBJECT_NO_RADIOSITY};
            if (!trace_occluded_1(p->job->world, t->scratch, &q))
                p->neighbours[i] |= (uint16_t)((1u | part << 8) << step);
        }
    }
}

static void *neighbours_begin(void *user) { return thread_begin(user); }

static void neighbours_end(void *user, void *state)
{
    (void)user;
    thread_end(state);
}

void patches_enclosure(struct patches *p)
{
    p->enclosure = (struct enclosure){.element = p->element,
                                      .count = p->element_count,
                                      .user = p,
                                      .thread_begin = thread_begin,
                                      .thread_end = thread_end,
                                      .point = point,
                                      .surface = bare_surface,
                                      .neighbour = neighbour_of,
                                      .may_hide = may_hide,
                                      .occluded = occluded,
                                      .closest = closest};
}

void patches_neighbours(struct patches *p)
{
    p->neighbours = must_calloc(p->element_count + 1, sizeof *p->neighbours);
    const struct parallel run = {.threads = p->settings.threads,
                                 .piece = 64,
                                 .watch = p->settings.watch,
                                 .user = p,
                                 .begin = neighbours_begin,
                                 .end = neighbours_end,
                                 .work = find_neighbours};
    parallel_run(&run, p->element_count);
}
