#include "radiosity/chart.h"

#include "math/elementary.h"
#include "math/pi.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/disc.h"
#include "scene/shapes/mesh.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/sphere.h"
#include "scene/shapes/triangle.h"
#include "tess/map.h"

enum { CROSSINGS_MOST = 8 };

// ---- points --------------------------------------------------------------------------
static double turn_of(const struct chart *c, struct vec3 r)
{
    const double t = det_atan2(vec3_dot(r, c->b), vec3_dot(r, c->a)) / (2 * PI);
    return t < 0 ? t + 1 : t;
}

static struct vec3 round_about(const struct chart *c, double u)
{
    return vec3_mad(vec3_scale(det_cos(2 * PI * u), c->a), det_sin(2 * PI * u), c->b);
}

static double cone_radius(const struct chart *c, double v)
{
    return sqrt(c->r0 * c->r0 + v * (c->r1 * c->r1 - c->r0 * c->r0));
}

static bool crossing_at(const struct chart *c, const struct leaf *l, struct vec3 o,
                        struct vec3 *p, struct vec3 *n)
{
    const struct vec3 d = vec3(c->axis == 0, c->axis == 1, c->axis == 2);
    const struct ray ray = {o, d, -INFINITY, INFINITY};
    struct boundary_list list = {0};
    l->ops->intersect(l->shape, &ray, &list);
    uint32_t k = 0;
    bool found = false;
    for (uint32_t i = 0; i < list.count && !found; i++) {
        if (!list.at[i].drawn || k++ != c->part)
            continue;
        struct surface_point s = {.p = ray_at(&ray, list.at[i].t)};
        l->ops->surface(l->shape, &list.at[i], s.p, &s);
        // The axis that sees it best has it; equal ones share in order.
        const double x[3] = {fabs(s.ng.x), fabs(s.ng.y), fabs(s.ng.z)};
        const int best = x[0] >= x[1] && x[0] >= x[2] ? 0 : x[1] >= x[2] ? 1 : 2;
        found = best == c->axis;
        *p = s.p;
        *n = s.ng;
    }
    boundary_list_free(&list);
    return found;
}

static bool point_in_shape(const struct chart *c, const struct leaf *l, double u,
                           double v, struct vec3 *p, struct vec3 *n)
{
    *n = c->n;
    switch (c->kind) {
    case CHART_FLAT: *p = vec3_mad(vec3_mad(c->o, u, c->a), v, c->b); break;
    case CHART_TRIANGLE: {
        const double s = sqrt(u);
        *p = vec3_mad(vec3_mad(c->o, s * (1 - v), c->a), s * v, c->b);
        break;
    }
    case CHART_RING: *p = vec3_mad(c->o, cone_radius(c, v), round_about(c, u)); break;
    case CHART_SPHERE: {
        const double z = 1 - 2 * v, r = sqrt(fmax(0, 1 - z * z));
        *n = vec3_mad(vec3_scale(r, round_about(c, u)), z, c->n);
        *p = vec3_mad(c->o, c->r0, *n);
        break;
    }
    case CHART_CONE: {
        const double r = cone_radius(c, v), slope = (c->r1 - c->r0) / c->length;
        const double z = slope == 0 ? v * c->length : (r - c->r0) / slope;
        const struct vec3 out = round_about(c, u);
        *p = vec3_mad(vec3_mad(c->o, z, c->n), r, out);
        *n = vec3_normalize(vec3_mad(out, -slope, c->n));
        break;
    }
    case CHART_MAPPED: {
        struct map_point at;
        c->map->at(l->shape, c->part, u, v, &at);
        *p = at.p;
        *n = at.n;
        break;
    }
    case CHART_PROJECTED:
        return crossing_at(c, l, vec3_mad(vec3_mad(c->o, u, c->a), v, c->b), p, n);
    }
    return true;
}

bool chart_point(const struct chart *c, const struct leaf *l, double u, double v,
                 struct vec3 *p, struct vec3 *n)
{
    if (!point_in_shape(c, l, u, v, p, n))
        return false;
    if (!l->transform->identity) {
        *p = transform_point(l->transform, *p);
        *n = vec3_normalize(transform_normal(l->transform, *n));
    }
    return true;
}

static double along(struct vec3 r, struct vec3 axis)
{
    return vec3_dot(r, axis) / vec3_dot(axis, axis);
}

static double radial(const struct chart *c, double r)
{
    const double ring = c->r1 * c->r1 - c->r0 * c->r0;
    return ring == 0 ? 0 : (r * r - c->r0 * c->r0) / ring;
}

void chart_locate(const struct chart *c, const struct leaf *l, const struct boundary *b,
                  struct vec3 p, double *u, double *v)
{
    if (!l->transform->identity)
        p = transform_inverse_point(l->transform, p);
    const struct vec3 r = vec3_sub(p, c->o);
    switch (c->kind) {
    case CHART_MAPPED: c->map->locate(l->shape, b, p, u, v); break;
    case CHART_FLAT:
    case CHART_PROJECTED:
        *u = along(r, c->a);
        *v = along(r, c->b);
        break;
    case CHART_TRIANGLE: {
        // r = x a + y b; s = x + y, v = y / s.
        const double aa = vec3_dot(c->a, c->a), bb = vec3_dot(c->b, c->b);
        const double ab = vec3_dot(c->a, c->b), ra = vec3_dot(r, c->a);
        const double rb = vec3_dot(r, c->b), det = aa * bb - ab * ab;
        const double x = (ra * bb - rb * ab) / det, y = (rb * aa - ra * ab) / det;
        const double s = x + y;
        *u = s * s;
        *v = s > 0 ? y / s : 0;
        break;
    }
    case CHART_RING:
        *u = turn_of(c, r);
        *v = radial(c, vec3_length(vec3_mad(r, -vec3_dot(r, c->n), c->n)));
        break;
    case CHART_SPHERE:
        *u = turn_of(c, r);
        *v = (1 - vec3_dot(r, c->n) / c->r0) / 2;
        break;
    case CHART_CONE: {
        const double z = vec3_dot(r, c->n);
        *u = turn_of(c, r);
        *v = c->r0 == c->r1 ? z / c->length
                            : radial(c, c->r0 + z * (c->r1 - c->r0) / c->length);
        break;
    }
    }
    *u = fmin(fmax(*u, 0), 1);
    *v = fmin(fmax(*v, 0), 1);
}

double chart_density(const struct chart *c, const struct leaf *l, double u, double v,
                     double hu, double hv)
{
    struct vec3 p, n;
    if (c->kind == CHART_PROJECTED) {
        // Along the axis the cell keeps its outline: dA = dx dy / |n.axis|.
        if (!chart_point(c, l, u, v, &p, &n))
            return 0;
        const struct vec3 a = transform_vector(l->transform, c->a);
        const struct vec3 b = transform_vector(l->transform, c->b);
        const struct vec3 outline = vec3_cross(a, b);
        const struct vec3 axis = vec3_normalize(transform_vector(
            l->transform, vec3(c->axis == 0, c->axis == 1, c->axis == 2)));
        const double slant = fabs(vec3_dot(n, axis));
        return slant > 0 ? fabs(vec3_dot(outline, axis)) / slant : 0;
    }
    struct vec3 at[4];
    const double du[4] = {hu, -hu, 0, 0}, dv[4] = {0, 0, hv, -hv};
    for (int i = 0; i < 4; i++)
        chart_point(c, l, u + du[i], v + dv[i], &at[i], &n);
    const struct vec3 x = vec3_sub(at[0], at[1]), y = vec3_sub(at[2], at[3]);
    return vec3_length(vec3_cross(x, y)) / (4 * hu * hv);
}

// ---- charts of shapes ------------------------------------------------------------------
struct charts {
    const struct leaf *leaf;
    uint32_t index, count;
    struct chart *out;
};

static struct chart *add(struct charts *list, enum chart_kind kind, uint32_t part)
{
    struct chart *c = list->out ? &list->out[list->count] : NULL;
    list->count++;
    if (c)
        *c = (struct chart){.kind = kind, .leaf = list->index, .part = part};
    return c;
}

static void add_flat(struct charts *list, uint32_t part, struct vec3 o, struct vec3 a,
                     struct vec3 b, struct vec3 n)
{
    struct chart *c = add(list, CHART_FLAT, part);
    if (!c)
        return;
    c->o = o;
    c->a = a;
    c->b = b;
    c->n = n;
}

static void add_round(struct charts *list, enum chart_kind kind, uint32_t part,
                      const struct frame *f, double z, double r0, double r1,
                      double length, bool up)
{
    struct chart *c = add(list, kind, part);
    if (!c)
        return;
    c->o = vec3_mad(f->origin, z, f->e3);
    c->a = f->e1;
    c->b = up ? f->e2 : vec3_neg(f->e2);
    c->n = up ? f->e3 : vec3_neg(f->e3);
    c->r0 = r0;
    c->r1 = r1;
    c->length = length;
    c->wrap = true;
    c->curved = true;
}

static void box_charts(struct charts *list, const struct box *b)
{
    const struct vec3 d = vec3_sub(b->max, b->min);
    const struct vec3 x = {d.x, 0, 0}, y = {0, d.y, 0}, z = {0, 0, d.z};
    add_flat(list, 0, b->min, z, y, vec3(-1, 0, 0));
    add_flat(list, 1, vec3_add(b->min, x), y, z, vec3(1, 0, 0));
    add_flat(list, 2, b->min, x, z, vec3(0, -1, 0));
    add_flat(list, 3, vec3_add(b->min, y), z, x, vec3(0, 1, 0));
    add_flat(list, 4, b->min, y, x, vec3(0, 0, -1));
    add_flat(list, 5, vec3_add(b->min, z), x, y, vec3(0, 0, 1));
}

static void cylinder_charts(struct charts *list, const struct cylinder *c)
{
    add_round(list, CHART_CONE, CYLINDER_SIDE, &c->frame, 0, c->radius, c->radius,
              c->length, true);
    if (c->open)
        return;
    add_round(list, CHART_RING, CYLINDER_BASE, &c->frame, 0, 0, c->radius, 0, false);
    add_round(list, CHART_RING, CYLINDER_TOP, &c->frame, c->length, 0, c->radius, 0,
              true);
}

static void cone_charts(struct charts *list, const struct cone *c)
{
    add_round(list, CHART_CONE, CONE_SIDE, &c->frame, 0, c->r0, c->r1, c->length, true);
    if (c->open)
        return;
    if (c->r0 > 0)
        add_round(list, CHART_RING, CONE_BASE, &c->frame, 0, 0, c->r0, 0, false);
    if (c->r1 > 0)
        add_round(list, CHART_RING, CONE_TOP, &c->frame, c->length, 0, c->r1, 0, true);
}

static void sphere_charts(struct charts *list, const struct sphere *s)
{
    const struct frame f = {s->centre, vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)};
    add_round(list, CHART_SPHERE, 0, &f, 0, s->radius, s->radius, 0, true);
}

static void disc_charts(struct charts *list, const struct disc *d)
{
    const struct frame f = frame_around(d->centre, d->normal);
    add_round(list, CHART_RING, 0, &f, 0, d->hole, d->radius, 0, true);
}

// The part of the plane within the limit, along axes that suit both.
static void plane_charts(struct charts *list, const struct plane *p,
                         const struct aabb *limit)
{
    const struct vec3 n = p->normal;
    const double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    const struct vec3 least = x <= y && x <= z ? vec3(1, 0, 0)
                              : y <= z         ? vec3(0, 1, 0)
                                               : vec3(0, 0, 1);
    const struct vec3 a = vec3_normalize(vec3_cross(least, n)), b = vec3_cross(n, a);
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < 8; i++) {
        const struct vec3 corner = transform_inverse_point(
            list->leaf->transform,
            vec3(i & 1 ? limit->max.x : limit->min.x, i & 2 ? limit->max.y : limit->min.y,
                 i & 4 ? limit->max.z : limit->min.z));
        const struct vec3 r = vec3_sub(corner, p->point);
        const double at[2] = {vec3_dot(r, a), vec3_dot(r, b)};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
        }
    }
    add_flat(list, 0, vec3_mad(vec3_mad(p->point, low[0], a), low[1], b),
             vec3_scale(high[0] - low[0], a), vec3_scale(high[1] - low[1], b), n);
}

static void add_triangle(struct charts *list, uint32_t part, const struct vec3 p[3])
{
    struct chart *c = add(list, CHART_TRIANGLE, part);
    if (!c)
        return;
    c->o = p[0];
    c->a = vec3_sub(p[1], p[0]);
    c->b = vec3_sub(p[2], p[0]);
    c->n = triangle_normal(p);
}

static void mesh_charts(struct charts *list, const struct mesh *m)
{
    for (uint32_t f = 0; f < m->face_count; f++) {
        const struct vec3 p[3] = {m->vertex[m->face[f][0]], m->vertex[m->face[f][1]],
                                  m->vertex[m->face[f][2]]};
        add_triangle(list, f, p);
    }
}

// One chart a piece of the shape's map. False: it has none.
static bool mapped_charts(struct charts *list)
{
    const struct leaf *l = list->leaf;
    const struct tess_map *map = tess_map_find(l->ops);
    const uint32_t count = map ? map->count(l->shape) : 0;
    for (uint32_t k = 0; k < count; k++) {
        struct chart *c = add(list, CHART_MAPPED, k);
        if (!c)
            continue;
        c->map = map;
        c->wrap = (map->wraps & MAP_WRAPS_U) != 0;
        c->curved = true;
    }
    return count > 0;
}

static struct aabb in_shape_space(const struct leaf *l, const struct aabb *world)
{
    struct aabb b = aabb_empty();
    for (int i = 0; i < 8; i++)
        b = aabb_add(b, transform_inverse_point(
                            l->transform, vec3(i & 1 ? world->max.x : world->min.x,
                                               i & 2 ? world->max.y : world->min.y,
                                               i & 4 ? world->max.z : world->min.z)));
    return b;
}

// Lines along each axis through the box of the shape, of what is not cut off.
static void projected_charts(struct charts *list, const struct aabb *limit)
{
    const struct leaf *l = list->leaf;
    struct aabb b = shape_surface_bounds(l->ops, l->shape);
    if (aabb_is_finite(*limit))
        b = aabb_meet(b, in_shape_space(l, limit));
    const struct vec3 d = vec3_sub(b.max, b.min);
    if (aabb_is_empty(b) || !(vec3_max_abs(d) < INFINITY))
        return;
    const struct vec3 side[3] = {{d.x, 0, 0}, {0, d.y, 0}, {0, 0, d.z}};
    for (int axis = 0; axis < 3; axis++) {
        const struct vec3 x = side[(axis + 1) % 3], y = side[(axis + 2) % 3];
        for (uint32_t k = 0; k < CROSSINGS_MOST; k++) {
            struct chart *c = add(list, CHART_PROJECTED, k);
            if (!c)
                continue;
            c->o = b.min;
            c->a = x;
            c->b = y;
            c->axis = axis;
            c->curved = true;
        }
    }
}

uint32_t leaf_charts(const struct world *w, uint32_t leaf, const struct aabb *limit,
                     struct chart *out)
{
    const struct leaf *l = &w->leaf[leaf];
    struct charts list = {.leaf = l, .index = leaf, .out = out};
    if (l->ops == &box_ops)
        box_charts(&list, l->shape);
    else if (l->ops == &sphere_ops)
        sphere_charts(&list, l->shape);
    else if (l->ops == &cylinder_ops)
        cylinder_charts(&list, l->shape);
    else if (l->ops == &cone_ops)
        cone_charts(&list, l->shape);
    else if (l->ops == &disc_ops)
        disc_charts(&list, l->shape);
    else if (l->ops == &plane_ops)
        plane_charts(&list, l->shape, limit);
    else if (l->ops == &triangle_ops || l->ops == &smooth_triangle_ops)
        add_triangle(&list, 0, ((const struct triangle *)l->shape)->p);
    else if (l->ops == &mesh_ops || l->ops == &mesh2_ops)
        mesh_charts(&list, l->shape);
    else if (!mapped_charts(&list))
        projected_charts(&list, limit);
    return list.count;
}

// Which crossing of the axis line through p is p itself.
static uint32_t crossing_number(const struct leaf *l, int axis, struct vec3 p)
{
    const struct vec3 d = vec3(axis == 0, axis == 1, axis == 2);
    const struct ray ray = {p, d, -INFINITY, INFINITY};
    struct boundary_list list = {0};
    l->ops->intersect(l->shape, &ray, &list);
    uint32_t best = CROSSINGS_MOST, k = 0;
    double nearest = INFINITY;
    for (uint32_t i = 0; i < list.count; i++) {
        if (!list.at[i].drawn)
            continue;
        if (fabs(list.at[i].t) < nearest) {
            nearest = fabs(list.at[i].t);
            best = k;
        }
        k++;
    }
    boundary_list_free(&list);
    return best;
}

uint32_t leaf_chart_of(const struct world *w, const struct chart *chart, uint32_t count,
                       const struct boundary *b, struct vec3 p)
{
    if (count == 0)
        return count;
    const struct leaf *l = &w->leaf[b->leaf];
    if (chart[0].kind == CHART_MAPPED) {
        double u, v;
        if (!l->transform->identity)
            p = transform_inverse_point(l->transform, p);
        return chart[0].map->locate(l->shape, b, p, &u, &v);
    }
    if (chart[0].kind != CHART_PROJECTED) {
        // Parts are numbered as charts are, but for caps that are missing.
        if (b->part < count && chart[b->part].part == b->part)
            return b->part;
        for (uint32_t i = 0; i < count; i++)
            if (chart[i].part == b->part)
                return i;
        return count == 1 ? 0 : count;
    }
    if (!l->transform->identity)
        p = transform_inverse_point(l->transform, p);
    struct surface_point s = {.p = p};
    l->ops->surface(l->shape, b, p, &s);
    const double x[3] = {fabs(s.ng.x), fabs(s.ng.y), fabs(s.ng.z)};
    const int axis = x[0] >= x[1] && x[0] >= x[2] ? 0 : x[1] >= x[2] ? 1 : 2;
    const uint32_t k = crossing_number(l, axis, p);
    return k < CROSSINGS_MOST ? (uint32_t)axis * CROSSINGS_MOST + k : count;
}
