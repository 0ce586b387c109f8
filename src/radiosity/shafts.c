// Which objects can come between two elements: most pairs of a scene need no ray.
#include <stdlib.h>

#include "base/parallel.h"
#include "radiosity/patches.h"
#include "scene/shape.h"

// A convex leaf that is cut out of its object: between two points inside of it the object
// is never met.
static const struct leaf *hollow_of(const struct world *w, const struct world_object *o)
{
    if (!o->is_csg || w->node[o->root].op != NODE_INTERSECTION)
        return NULL;
    const struct csg_node *root = &w->node[o->root];
    for (uint32_t i = 0; i < root->child_count; i++) {
        const struct csg_node *n = &w->node[root->first_child + i];
        if (n->op != NODE_LEAF)
            continue;
        const struct leaf *l = &w->leaf[n->leaf];
        if (l->inverted && l->solid && (l->ops->flags & SHAPE_CONVEX))
            return l;
    }
    return NULL;
}

// Inside the closed shape, up to rounding: towards the middle of its bounds.
static bool inside_closed(const struct leaf *l, struct vec3 p)
{
    static const double inwards = 1e-7;
    const struct vec3 middle = vec3_scale(.5, vec3_add(l->bounds.min, l->bounds.max));
    if (aabb_is_finite(l->bounds))
        p = vec3_mad(p, inwards, vec3_sub(middle, p));
    return l->ops->inside(l->shape, transform_inverse_point(l->transform, p));
}

struct shaft patches_shaft(const struct patches *p, const struct element *e,
                           const struct cell *c)
{
    const struct world *w = p->job->world;
    const struct chart *chart = &p->chart[c->chart];
    const struct leaf *own = &w->leaf[chart->leaf];
    struct shaft s = {.hollow = 0};
    struct aabb box = aabb_empty();
    for (uint32_t k = 0; k < e->corner_count; k++)
        box = aabb_add(box, e->corner[k]);
    if (e->curved) {
        // Room for what bulges over the corners: measured at the middle, doubled.
        struct vec3 middle, n;
        double bulge = 0;
        if (chart_point(chart, own, c->u + c->du / 2, c->v + c->dv / 2, &middle, &n)) {
            struct vec3 sum = {0, 0, 0};
            for (uint32_t k = 0; k < 4; k++)
                sum = vec3_mad(sum, .25, e->corner[k]);
            bulge = 2 * vec3_length(vec3_sub(middle, sum));
        }
        box.min = vec3_sub(box.min, vec3(bulge, bulge, bulge));
        box.max = vec3_add(box.max, vec3(bulge, bulge, bulge));
    }
    s.centre = vec3_scale(.5, vec3_add(box.min, box.max));
    s.half = vec3_scale(.5, vec3_sub(box.max, box.min));
    for (uint32_t o = 0; o < w->object_count; o++) {
        const struct leaf *l = hollow_of(w, &w->object[o]);
        if (!l)
            continue;
        bool within = true;
        for (uint32_t k = 0; l != own && within && k < e->corner_count; k++)
            within = inside_closed(l, e->corner[k]);
        if (within && (l == own || inside_closed(l, e->centre)))
            s.hollow |= (uint64_t)1 << o;
    }
    return s;
}

static void shafts(void *user, void *state, uint32_t begin, uint32_t end)
{
    struct patches *p = user;
    (void)state;
    for (uint32_t i = begin; i < end; i++)
        p->shaft[i] = patches_shaft(p, &p->element[i], &p->cell[p->element_cell[i] / 2]);
}

void patches_shafts(struct patches *p)
{
    if (p->job->world->object_count > SHAFT_OBJECTS)
        return;
    p->shaft = calloc(p->element_count + 1, sizeof *p->shaft);
    if (!p->shaft)
        abort();
    const struct parallel run = {.threads = p->settings.threads,
                                 .piece = 256,
                                 .watch = p->settings.watch,
                                 .user = p,
                                 .work = shafts};
    parallel_run(&run, p->element_count);
}

// Of numbers that are none but numbers: fmin and fmax are calls.
static double smaller(double a, double b) { return a < b ? a : b; }
static double greater(double a, double b) { return a > b ? a : b; }

// Cuts [t0, t1] down to where a + t (b - a) < 0, to nothing or less where another cut
// left none of it; false: that is nowhere in 0 to 1.
static bool clip(double a, double b, double *t0, double *t1)
{
    if (a >= 0 && b >= 0)
        return false;
    if (a >= 0)
        *t0 = greater(*t0, a / (a - b));
    else if (b >= 0)
        *t1 = smaller(*t1, a / (a - b));
    return true;
}

// Whether the box between the boxes of both elements, moved from one to the other, runs
// into the object's: it holds every way from one to the other.
static bool sweeps_into(const struct shaft *a, const struct shaft *b,
                        const struct aabb *o)
{
    double t0 = 0, t1 = 1;
    for (int k = 0; k < 3; k++) {
        const double ca = vec3_axis(a->centre, k), cb = vec3_axis(b->centre, k);
        const double ha = vec3_axis(a->half, k), hb = vec3_axis(b->half, k);
        const double low = vec3_axis(o->min, k), high = vec3_axis(o->max, k);
        // Bounds are padded; what only touches, all the way, does not hide.
        const double pad = 1e-9 * (fabs(low) + fabs(high) + fabs(ca) + fabs(cb));
        double k0 = 0, k1 = 1;
        if (!clip(ca - ha - high + pad, cb - hb - high + pad, &k0, &k1) ||
            !clip(low + pad - ca - ha, low + pad - cb - hb, &k0, &k1))
            return false;
        // Nothing flat goes through something flat but at one time.
        t0 = greater(t0, smaller(k0, k1));
        t1 = smaller(t1, greater(k0, k1));
        if (t0 > t1)
            return false;
    }
    return true;
}

static bool may_hide(const struct world *w, uint32_t object, const struct shaft *a,
                     const struct shaft *b)
{
    const struct world_object *o = &w->object[object];
    return !((a->hollow & b->hollow) >> object & 1) &&
           !(o->flags & OBJECT_NO_RADIOSITY) && sweeps_into(a, b, &o->bounds);
}

bool shafts_may_hide(const struct patches *p, const struct shaft *a,
                     const struct shaft *b, uint64_t some)
{
    for (; some; some &= some - 1)
        if (may_hide(p->job->world, (uint32_t)__builtin_ctzll(some), a, b))
            return true;
    return false;
}

uint64_t shafts_hide(const struct patches *p, const struct shaft *a,
                     const struct shaft *b)
{
    uint64_t found = 0;
    for (uint32_t o = 0; o < p->job->world->object_count; o++)
        found |= (uint64_t)may_hide(p->job->world, o, a, b) << o;
    return found;
}

uint64_t shafts_all(const struct patches *p)
{
    return UINT64_MAX >> (SHAFT_OBJECTS - p->job->world->object_count);
}

bool patches_may_hide(const struct patches *p, uint32_t a, uint32_t b)
{
    return !p->shaft || shafts_may_hide(p, &p->shaft[a], &p->shaft[b], shafts_all(p));
}

bool shaft_holds(const struct shaft *s, struct vec3 at)
{
    static const double rounding = 1e-9; // of the coordinates, as above
    const struct vec3 off = vec3_sub(at, s->centre);
    for (int k = 0; k < 3; k++) {
        const double pad =
            rounding * (fabs(vec3_axis(at, k)) + fabs(vec3_axis(s->centre, k)));
        if (fabs(vec3_axis(off, k)) > vec3_axis(s->half, k) + pad)
            return false;
    }
    return true;
}
