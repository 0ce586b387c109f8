// Corners and faces of what holds an object: often much less than its box.

#include "base/memory.h"
#include "radiosity/patches.h"
#include "radiosity/polygon.h"
#include "scene/shapes/mesh.h"

enum { CORNERS = HULL_CORNERS, MESH_FACES = 12 };

// Corner k of a box.
static struct vec3 box_corner(struct aabb b, int k)
{
    return vec3(k & 1 ? b.max.x : b.min.x, k & 2 ? b.max.y : b.min.y,
                k & 4 ? b.max.z : b.min.z);
}

static bool is_mesh(const struct world *w, const struct world_object *o)
{
    const struct shape_ops *ops = w->leaf[o->first_leaf].ops;
    return !o->is_csg && (ops == &mesh_ops || ops == &mesh2_ops);
}

// The corners of a small mesh; 0: there are more.
static uint32_t mesh_points(const struct leaf *l, struct vec3 out[CORNERS])
{
    const struct mesh *m = l->shape;
    uint32_t count = 0;
    if (m->face_count > MESH_FACES)
        return 0;
    for (uint32_t i = 0; i < 3 * m->face_count; i++) {
        const struct vec3 p =
            transform_point(l->transform, m->vertex[m->face[i / 3][i % 3]]);
        uint32_t k = 0;
        while (k < count && vec3_max_abs(vec3_sub(out[k], p)) > 0)
            k++;
        if (k == CORNERS)
            return 0;
        if (k == count)
            out[count++] = p;
    }
    return count;
}

// A bounded leaf that holds all of an object; NULL: there is none.
static const struct leaf *holder_of(const struct world *w, const struct world_object *o)
{
    for (uint32_t i = 0; i < o->leaf_count; i++) {
        const struct leaf *l = &w->leaf[o->first_leaf + i];
        if (l->required || (!o->is_csg && aabb_is_finite(l->ops->bounds(l->shape))))
            return l;
    }
    return NULL;
}

// Points in whose hull an object lies. 0: it has no end.
static uint32_t hull_points(const struct world *w, const struct world_object *o,
                            struct vec3 out[CORNERS])
{
    const struct leaf *l = holder_of(w, o);
    uint32_t count;
    if (!aabb_is_finite(o->bounds))
        return 0;
    if (l && is_mesh(w, o) && (count = mesh_points(l, out)) > 0)
        return count;
    for (int k = 0; k < CORNERS; k++)
        out[k] =
            l ? transform_point(l->transform, box_corner(l->ops->bounds(l->shape), k))
              : box_corner(o->bounds, k);
    return CORNERS;
}

// A face, unless it is there already; faces that are not there repeat the last one.
static void face_add(struct shaft_hull *h, uint32_t *faces, struct vec3 n, double top)
{
    static const double same = 1e-9; // of a unit
    for (uint32_t f = 0; f < *faces; f++)
        if (fabs(h->n[0][f] - n.x) + fabs(h->n[1][f] - n.y) + fabs(h->n[2][f] - n.z) <
            same)
            return;
    if (*faces == HULL_CORNERS)
        return;
    for (uint32_t f = (*faces)++; f < HULL_CORNERS; f++) {
        h->n[0][f] = n.x;
        h->n[1][f] = n.y;
        h->n[2][f] = n.z;
        h->top[f] = top;
    }
}

// Takes the plane for a face of the hull when none of its points lies above.
static void face_try(struct shaft_hull *h, uint32_t *faces, const struct vec3 *p,
                     uint32_t count, struct vec3 through, struct vec3 n, double size)
{
    static const double flush = 1e-9; // of the size
    double high = -INFINITY;
    for (uint32_t m = 0; m < count; m++)
        high = fmax(high, vec3_dot(vec3_sub(p[m], through), n));
    if (high <= flush * size)
        face_add(h, faces, n, vec3_dot(through, n) + high);
}

// The hull of points; its faces are planes through three of `all`, of which it is part.
static struct shaft_hull hull_of(const struct vec3 *p, uint32_t count,
                                 const struct vec3 *all, uint32_t all_count)
{
    struct shaft_hull h = {.p = {{0}}};
    uint32_t faces = 0;
    for (uint32_t k = 0; k < CORNERS; k++) {
        h.p[0][k] = p[k < count ? k : 0].x;
        h.p[1][k] = p[k < count ? k : 0].y;
        h.p[2][k] = p[k < count ? k : 0].z;
    }
    for (uint32_t i = 0; i < all_count; i++)
        for (uint32_t j = i + 1; j < all_count; j++)
            for (uint32_t k = j + 1; k < all_count; k++) {
                const struct vec3 c =
                    vec3_cross(vec3_sub(all[j], all[i]), vec3_sub(all[k], all[i]));
                const double area = vec3_length(c);
                if (!(area > 0))
                    continue;
                const struct vec3 n = vec3_scale(1 / area, c);
                face_try(&h, &faces, p, count, all[i], n, sqrt(area));
                face_try(&h, &faces, p, count, all[i], vec3_neg(n), sqrt(area));
            }
    // Of points on a line: a plane that nothing lies above.
    if (!faces)
        face_add(&h, &faces, vec3(0, 0, 0), INFINITY);
    return h;
}

// The faces of a small mesh, or a hull around all of the object. Returns how many.
static uint32_t object_hulls(const struct world *w, const struct world_object *o,
                             struct shaft_hull out[HULLS_MOST])
{
    struct vec3 all[CORNERS], p[3];
    const uint32_t count = hull_points(w, o, all);
    if (!count)
        return 0;
    const struct leaf *l = &w->leaf[o->first_leaf];
    const struct mesh *m = is_mesh(w, o) ? l->shape : NULL;
    if (!m || m->face_count > HULLS_MOST) {
        out[0] = hull_of(all, count, all, count);
        return 1;
    }
    for (uint32_t i = 0; i < m->face_count; i++) {
        mesh_corners(m, i, p);
        for (int k = 0; k < 3; k++)
            p[k] = transform_point(l->transform, p[k]);
        out[i] = hull_of(p, 3, all, count);
    }
    return m->face_count;
}

struct shaft_hulls *hulls_of(const struct world *w)
{
    struct shaft_hulls *hulls = must_calloc(w->object_count + 1, sizeof *hulls);
    for (uint32_t i = 0; i < w->object_count; i++)
        hulls[i].count = object_hulls(w, &w->object[i], hulls[i].hull);
    return hulls;
}

static bool beside(const struct patches *p, const struct shaft_hulls *h,
                   const struct facing_polygons *x)
{
    for (uint32_t i = 0; i < h->count; i++)
        if (!p->sight->beside(&h->hull[i], x))
            return false;
    return h->count > 0;
}

uint64_t hulls_hide_all(const struct patches *p, const struct element *a,
                        const struct element *b, uint64_t some)
{
    const struct element *const of[2] = {a, b};
    struct facing_polygons x;
    uint64_t found = some;
    for (int s = 0; s < 2; s++) {
        x.n[s] = of[s]->normal;
        x.count[s] = of[s]->corner_count;
        for (uint32_t i = 0; i < x.count[s]; i++)
            x.corner[s][i] = of[s]->corner[i];
    }
    for (uint64_t left = some; left; left &= left - 1)
        if (beside(p, &p->hulls[__builtin_ctzll(left)], &x))
            found &= ~(left & -left);
    return found;
}

static bool apart(const struct patches *p, const struct shaft_hulls *h,
                  const struct horizon_polygon *to)
{
    for (uint32_t i = 0; i < h->count; i++)
        if (!p->sight->apart(&h->hull[i], to))
            return false;
    return h->count > 0;
}

uint64_t hulls_hide(const struct patches *p, struct vec3 o, struct vec3 n,
                    const struct element *polygon, uint64_t some)
{
    struct horizon_polygon to = {.o = o, .n = n};
    uint64_t found = some;
    to.count = polygon_risen(o, n, polygon->corner, polygon->corner_count, to.corner);
    for (uint64_t left = some; left; left &= left - 1)
        if (apart(p, &p->hulls[__builtin_ctzll(left)], &to))
            found &= ~(left & -left);
    return found;
}
