// Which objects can come between two elements: most pairs of a scene need no ray.

#include "base/memory.h"
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

static void find_boxes(struct patches *p)
{
    const struct world *w = p->job->world;
    p->boxes = (struct shaft_boxes){.solid = 0};
    for (uint32_t i = 0; i < w->object_count; i++) {
        for (int k = 0; k < 3; k++) {
            p->boxes.low[k][i] = vec3_axis(w->object[i].bounds.min, k);
            p->boxes.high[k][i] = vec3_axis(w->object[i].bounds.max, k);
        }
        if (!(w->object[i].flags & OBJECT_NO_RADIOSITY))
            p->boxes.solid |= (uint64_t)1 << i;
    }
}

void patches_shafts(struct patches *p)
{
    if (p->job->world->object_count > SHAFT_OBJECTS)
        return;
    find_boxes(p);
    p->hulls = hulls_of(p->job->world);
    p->shaft = must_calloc(p->element_count + 1, sizeof *p->shaft);
    const struct parallel run = {.threads = p->settings.threads,
                                 .piece = 256,
                                 .watch = p->settings.watch,
                                 .user = p,
                                 .work = shafts};
    parallel_run(&run, p->element_count);
}

uint64_t shafts_hide(const struct patches *p, const struct shaft *a,
                     const struct shaft *b, uint64_t some)
{
    return p->sight->between(&p->boxes, a, b, some & ~(a->hollow & b->hollow));
}

bool patch_is_flat(const struct patches *p, const struct element *e)
{
    const enum chart_kind kind = p->chart[e->surface / 2].kind;
    return kind == CHART_FLAT || kind == CHART_TRIANGLE;
}

bool patches_may_hide(const struct patches *p, uint32_t a, uint32_t b)
{
    if (!p->shaft)
        return true;
    const uint64_t some = shafts_hide(p, &p->shaft[a], &p->shaft[b], UINT64_MAX);
    const struct element *const x = &p->element[a], *const y = &p->element[b];
    return some && (!patch_is_flat(p, x) || !patch_is_flat(p, y) ||
                    hulls_hide_all(p, x, y, some));
}

static bool same(struct vec3 a, struct vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool shaft_equals(const struct shaft *a, const struct shaft *b)
{
    return same(a->centre, b->centre) && same(a->half, b->half) && a->hollow == b->hollow;
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
