#include "trace/carve.h"

#include <math.h>

#include "scene/shape_kernels.h"
#include "trace/accel.h"
#include "trace/packet.h"

enum {
    CUTS = 24,    // crossings of the simple solids with one ray
    STRETCHES = 8 // on which all of them are inside
};

// Crossings no farther apart than this many of their errors, or this share of their t, are
// left to the sweep, which knows what coincides. Only more than the errors is needed.
static const double NEAR_ERRORS = 4, NEAR_SHARE = 0x1p-34;

struct stretch {
    struct boundary begin, end; // at infinity: none
};

struct lane {
    struct stretch stretch[STRETCHES];
    double near[CUTS];   // t of all crossings,
    double margin[CUTS]; // and what is too near to them
    uint32_t cuts, stretches, next;
};

struct carving {
    const struct world *w;
    struct trace_scratch *s;
    const struct world_object *o;
    uint32_t solid; // the leaf
    const struct ray *ray;
    double limit[8]; // hits are to lie before it
    enum sweep_mode mode;
    struct lane lane[8];
    struct carve_hits *out;
    unsigned met;
};

static uint32_t solid_of(const struct world *w, const struct world_object *o)
{
    uint32_t i = o->first_leaf;
    while (w->accel->leaf_shape[i] != PACKET_LANES)
        i++;
    return i;
}

// ---- the simple solids -----------------------------------------------------------------

// Adds a leaf's crossings; says whether the ray comes from inside it.
static bool leaf_begins_inside(const struct carving *c, uint32_t leaf,
                               const struct ray *ray)
{
    const struct leaf *l = &c->w->leaf[leaf];
    const struct boundary_list *list = &c->s->crossings;
    const uint32_t from = list->count;
    leaf_crossings_in_csg(c->w, c->s, leaf, ray);
    if (list->count > from)
        return list->at[from].crossing == CROSS_EXIT;
    if (l->bounded)
        return l->inverted;
    return l->ops->inside(l->shape, transform_inverse_point(l->transform, ray->o)) !=
           l->inverted;
}

static void sort_by_t(struct boundary_list *l)
{
    for (uint32_t i = 1; i < l->count; i++) {
        const struct boundary b = l->at[i];
        uint32_t j = i;
        for (; j > 0 && l->at[j - 1].t > b.t; j--)
            l->at[j] = l->at[j - 1];
        l->at[j] = b;
    }
}

// Notes where the crossings are; false: two of them that matter are too near each other.
static bool note_cuts(struct lane *lane, const struct boundary_list *l, double t_min,
                      double limit)
{
    if (l->count > CUTS)
        return false;
    lane->cuts = l->count;
    for (uint32_t i = 0; i < l->count; i++) {
        const struct boundary *b = &l->at[i];
        const double margin = NEAR_ERRORS * b->dt + NEAR_SHARE * fabs(b->t);
        if (!(margin < INFINITY) || b->crossing == CROSS_TOUCH)
            return false;
        lane->near[i] = b->t;
        lane->margin[i] = margin;
        if (i && b->t + margin > t_min &&
            lane->near[i - 1] - lane->margin[i - 1] < limit &&
            b->t - lane->near[i - 1] <= margin + lane->margin[i - 1])
            return false;
    }
    return true;
}

// The stretches of one ray; false: it is for the sweep.
static bool lane_begin(struct carving *c, int i)
{
    static const struct boundary before = {.t = -INFINITY}, after = {.t = INFINITY};
    struct lane *lane = &c->lane[i];
    struct boundary_list *list = &c->s->crossings;
    uint32_t in = 0;
    list->count = 0;
    c->s->own_count = 0;
    for (uint32_t k = 0; k < c->o->leaf_count; k++)
        if (c->o->first_leaf + k != c->solid)
            in += leaf_begins_inside(c, c->o->first_leaf + k, &c->ray[i]);
    sort_by_t(list);
    if (!note_cuts(lane, list, c->ray[i].t_min, c->limit[i]))
        return false;
    const uint32_t all = c->o->leaf_count - 1;
    const struct boundary *begin = in == all ? &before : NULL;
    lane->stretches = lane->next = 0;
    for (uint32_t k = 0; k <= list->count; k++) {
        const struct boundary *b = k < list->count ? &list->at[k] : &after;
        if (begin && lane->stretches == STRETCHES)
            return false;
        if (begin)
            lane->stretch[lane->stretches++] = (struct stretch){
                boundary_as_shape_has_it(c->s, begin), boundary_as_shape_has_it(c->s, b)};
        in += b->crossing == CROSS_ENTER ? 1u : -1u;
        begin = in == all ? b : NULL;
    }
    return true;
}

// ---- the solid -------------------------------------------------------------------------

// Whether the solid is inside on the whole of a stretch, where it has no crossing.
static bool inside_between(const struct carving *c, int i, double lo, double hi)
{
    const struct leaf *l = &c->w->leaf[c->solid];
    const double t = hi < INFINITY ? lo + 0.5 * (hi - lo) : lo + fmax(1, fabs(lo));
    const struct vec3 p = ray_at(&c->ray[i], t);
    return l->solid &&
           l->ops->inside(l->shape, transform_inverse_point(l->transform, p)) !=
               l->inverted;
}

static void found(struct carving *c, int i, const struct boundary *b)
{
    c->out->b[i] = *b;
    c->met |= 1u << i;
}

static bool is_too_near(const struct lane *lane, double t, double dt)
{
    for (uint32_t k = 0; k < lane->cuts; k++)
        if (fabs(t - lane->near[k]) <=
            lane->margin[k] + NEAR_ERRORS * dt + NEAR_SHARE * fabs(t))
            return true;
    return false;
}

// What the lane meets on its stretch; own: the solid's first crossing there, or NULL. False:
// nothing.
static bool settle(struct carving *c, int i, const struct boundary *own)
{
    const struct lane *lane = &c->lane[i];
    const struct stretch *at = &lane->stretch[lane->next];
    const struct ray *ray = &c->ray[i];
    const bool begins = at->begin.t > ray->t_min && at->begin.drawn;
    const bool ends = at->end.t < c->limit[i] && at->end.drawn;
    if (own && is_too_near(lane, own->t, own->dt)) {
        c->out->unsure |= 1u << i;
        return true;
    }
    if (own && (c->mode == SWEEP_OPAQUE || !begins || own->crossing != CROSS_EXIT)) {
        found(c, i, own);
        return true;
    }
    if (own) {
        found(c, i, &at->begin);
        return true;
    }
    if ((begins || ends) && inside_between(c, i, fmax(at->begin.t, ray->t_min),
                                           fmin(at->end.t, c->limit[i]))) {
        found(c, i, begins ? &at->begin : &at->end);
        return true;
    }
    return false;
}

// The next stretch that the ray comes by; false: there is none.
static bool lane_advance(const struct carving *c, int i)
{
    const struct lane *lane = &c->lane[i];
    return lane->next < lane->stretches &&
           lane->stretch[lane->next].begin.t < c->limit[i];
}

static void skip_behind(struct carving *c, int i)
{
    struct lane *lane = &c->lane[i];
    while (lane->next < lane->stretches &&
           lane->stretch[lane->next].end.t <= c->ray[i].t_min)
        lane->next++;
}

static void ask(const struct carving *c, int i, struct shape_rays *rays)
{
    const struct leaf *l = &c->w->leaf[c->solid];
    const struct lane *lane = &c->lane[i];
    const struct stretch *at = &lane->stretch[lane->next];
    struct ray local = c->ray[i];
    if (!l->transform->identity)
        local = transform_inverse_ray(l->transform, &c->ray[i]);
    for (int k = 0; k < 3; k++) {
        rays->o[k][i] = vec3_axis(local.o, k);
        rays->d[k][i] = vec3_axis(local.d, k);
    }
    rays->t_min[i] = c->ray[i].t_min;
    rays->t_max[i] = c->limit[i];
    for (uint32_t k = 0; k < lane->cuts;
         k++) { // so that what is too near is found as well
        const double t = lane->near[k], margin = lane->margin[k];
        if (t == at->begin.t)
            rays->t_min[i] = fmax(rays->t_min[i], t - margin);
        if (t == at->end.t)
            rays->t_max[i] = fmin(rays->t_max[i], t + margin);
    }
}

static unsigned solid_meets(struct carving *c, const struct shape_rays *rays,
                            unsigned lanes, struct shape_hits *hits)
{
    const struct leaf *l = &c->w->leaf[c->solid];
    hits->evaluations = 0;
    hits->cancel = c->s->crossings.cancel;
    hits->cut = false;
    const unsigned met = l->ops->closest8(c->w->accel->kernels->shapes, l->shape, rays,
                                          lanes, c->mode == SWEEP_OPAQUE, hits);
    c->s->stats.leaf_tests += (unsigned)__builtin_popcount(lanes);
    c->s->crossings.evaluations += hits->evaluations;
    c->s->crossings.cut |= hits->cut;
    return met;
}

// One stretch of each of the lanes; returns those that go on to another.
static unsigned stretches_search(struct carving *c, unsigned lanes)
{
    const struct leaf *l = &c->w->leaf[c->solid];
    struct shape_rays rays;
    struct shape_hits hits;
    for (int i = 0; i < 8; i++) // lanes that are not asked hold rays as well
        for (int k = 0; k < 3; k++)
            rays.o[k][i] = rays.d[k][i] = rays.t_min[i] = rays.t_max[i] = 1;
    for (unsigned m = lanes; m; m &= m - 1)
        ask(c, __builtin_ctz(m), &rays);
    const unsigned met = solid_meets(c, &rays, lanes, &hits);
    unsigned on = 0;
    for (unsigned m = lanes; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        const bool own = (met >> i & 1) && hits.t[i] < rays.t_max[i];
        struct boundary b = {0};
        if (own)
            b = (struct boundary){.t = hits.t[i],
                                  .dt = hits.dt[i],
                                  .u = hits.u[i],
                                  .v = hits.v[i],
                                  .part = hits.part[i],
                                  .leaf = c->solid,
                                  .crossing =
                                      crossing_of_leaf(hits.crossing[i], l->inverted),
                                  .drawn = 1};
        if (settle(c, i, own ? &b : NULL))
            continue;
        c->lane[i].next++;
        if (lane_advance(c, i))
            on |= 1u << i;
    }
    return on;
}

unsigned carve(const struct world *w, struct trace_scratch *s, uint32_t object,
               const struct ray *ray, const double *limit, unsigned lanes,
               enum sweep_mode mode, struct carve_hits *out)
{
    struct carving c; // not set to zero as a whole: it is large
    c.w = w;
    c.s = s;
    c.o = &w->object[object];
    c.solid = solid_of(w, c.o);
    c.ray = ray;
    c.mode = mode;
    c.out = out;
    c.met = 0;
    out->unsure = 0;
    s->stats.csg_tests += (unsigned)__builtin_popcount(lanes);
    unsigned on = 0;
    for (unsigned m = lanes; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        // An equal distance must still be seen: the object may have been declared earlier.
        c.limit[i] = fmin(ray[i].t_max, nextafter(limit[i], INFINITY));
        if (!lane_begin(&c, i)) {
            out->unsure |= 1u << i;
            continue;
        }
        skip_behind(&c, i);
        if (lane_advance(&c, i))
            on |= 1u << i;
    }
    while (on)
        on = stretches_search(&c, on);
    return c.met;
}
