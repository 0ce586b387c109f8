// What mesh and mesh2 share: the box tree, crossings, normals.
#include "scene/shapes/mesh.h"

#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "math/gamma.h"
#include "scene/shape.h"
#include "scene/shapes/extrude.h"
#include "scene/shapes/slabs.h"
#include "scene/shapes/triangle.h"

enum { LEAF_MAX = 4, BINS = 16, DEPTH_MAX = 60 };

static void corners(const struct mesh *m, uint32_t f, struct vec3 p[3])
{
    for (int i = 0; i < 3; i++)
        p[i] = m->vertex[m->face[f][i]];
}

// ---- the tree -------------------------------------------------------------------------

struct tree {
    struct mesh *m;
    struct aabb *box;
    uint32_t nodes;
};

static double middle(const struct aabb *b, int axis)
{
    return 0.5 * (vec3_axis(b->min, axis) + vec3_axis(b->max, axis));
}

struct bin {
    struct aabb box;
    uint32_t count;
};

static int bin_of(double v, double lo, double size)
{
    const int i = (int)((v - lo) / size * BINS);
    return i < 0 ? 0 : i >= BINS ? BINS - 1 : i;
}

static double split_cost(const struct tree *t, uint32_t first, uint32_t count, int axis,
                         double lo, double size, int *best)
{
    struct bin bin[BINS];
    double right[BINS], least = INFINITY;
    for (int i = 0; i < BINS; i++)
        bin[i] = (struct bin){aabb_empty(), 0};
    for (uint32_t i = first; i < first + count; i++) {
        const struct aabb *b = &t->box[t->m->order[i]];
        struct bin *k = &bin[bin_of(middle(b, axis), lo, size)];
        k->box = aabb_join(k->box, *b);
        k->count++;
    }
    struct bin side = {aabb_empty(), 0};
    for (int i = BINS - 1; i > 0; i--) {
        side.box = aabb_join(side.box, bin[i].box);
        side.count += bin[i].count;
        right[i] = side.count ? side.count * aabb_half_area(side.box) : INFINITY;
    }
    side = (struct bin){aabb_empty(), 0};
    for (int i = 0; i < BINS - 1; i++) {
        side.box = aabb_join(side.box, bin[i].box);
        side.count += bin[i].count;
        const double cost =
            side.count ? side.count * aabb_half_area(side.box) + right[i + 1] : INFINITY;
        if (cost < least) {
            least = cost;
            *best = i;
        }
    }
    return least;
}

static uint32_t partition(struct tree *t, uint32_t first, uint32_t count, int depth)
{
    struct aabb centers = aabb_empty();
    uint32_t *order = t->m->order;
    for (uint32_t i = first; i < first + count; i++) {
        const struct aabb *b = &t->box[order[i]];
        centers = aabb_add(centers, vec3(middle(b, 0), middle(b, 1), middle(b, 2)));
    }
    int axis = -1, bin = 0;
    double least = INFINITY;
    for (int a = 0; a < 3 && depth < DEPTH_MAX / 2; a++) {
        const double lo = vec3_axis(centers.min, a),
                     size = vec3_axis(centers.max, a) - lo;
        int k = 0;
        const double cost =
            size > 0 ? split_cost(t, first, count, a, lo, size, &k) : INFINITY;
        if (cost < least) {
            least = cost;
            axis = a;
            bin = k;
        }
    }
    if (axis < 0)
        return count / 2;
    const double lo = vec3_axis(centers.min, axis),
                 size = vec3_axis(centers.max, axis) - lo;
    uint32_t i = first, j = first + count;
    while (i < j) {
        if (bin_of(middle(&t->box[order[i]], axis), lo, size) <= bin) {
            i++;
        } else {
            const uint32_t swap = order[i];
            order[i] = order[--j];
            order[j] = swap;
        }
    }
    const uint32_t left = i - first;
    return left == 0 || left == count ? count / 2 : left;
}

static void build(struct tree *t, uint32_t first, uint32_t count, int depth)
{
    struct mesh_node *n = &t->m->node[t->nodes++];
    n->bounds = aabb_empty();
    for (uint32_t i = first; i < first + count; i++)
        n->bounds = aabb_join(n->bounds, t->box[t->m->order[i]]);
    if (count <= LEAF_MAX) {
        n->first = first;
        n->count = count;
        return;
    }
    const uint32_t left = partition(t, first, count, depth);
    build(t, first, left, depth + 1);
    n->first = t->nodes;
    build(t, first + left, count - left, depth + 1);
}

void mesh_finish(struct mesh *m, struct arena *a)
{
    struct tree t = {.m = m, .box = malloc((m->face_count + 1) * sizeof *t.box)};
    if (!t.box)
        abort();
    m->order = arena_new_array(a, uint32_t, m->face_count + 1);
    uint32_t count = 0;
    for (uint32_t f = 0; f < m->face_count; f++) {
        struct vec3 p[3];
        corners(m, f, p);
        const struct vec3 n = triangle_normal(p);
        if (vec3_dot(n, n) == 0)
            continue;
        t.box[f] = aabb_pad(aabb_add(aabb_add(aabb_add(aabb_empty(), p[0]), p[1]), p[2]));
        m->order[count++] = f;
    }
    m->node = arena_new_array(a, struct mesh_node, 2 * (count + 1));
    build(&t, 0, count, 0);
    m->bounds = m->node[0].bounds;
    free(t.box);
}

// ---- rays -------------------------------------------------------------------------------

static void fill(struct boundary *b, const struct triangle_hit *h, uint32_t face)
{
    b->t = h->t;
    b->dt = h->dt;
    b->u = h->u;
    b->v = h->v;
    b->part = face;
    b->drawn = 1;
}

// Entering when the ray runs against the outward side; which side is outward follows
// from the count of crossings, as faces may be turned either way.
static void alternate(struct boundary_list *out, uint32_t from)
{
    for (uint32_t i = from; i < out->count; i++)
        out->at[i].crossing = (i - from) % 2 ? CROSS_EXIT : CROSS_ENTER;
    if ((out->count - from) % 2) // the mesh is not closed along this line
        out->count--;
}

void mesh_intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct mesh *m = shape;
    const struct slabs s = slabs_of(&m->bounds, ray);
    const struct triangle_ray r = triangle_ray_of(ray);
    const uint32_t from = out->count;
    uint32_t stack[DEPTH_MAX + 4], depth = 0;
    stack[depth++] = 0;
    while (depth) {
        const uint32_t i = stack[--depth];
        const struct mesh_node *n = &m->node[i];
        double t;
        if (!slabs_meet(&n->bounds, &s, -INFINITY, INFINITY, &t))
            continue;
        if (n->count == 0 && n->first) {
            stack[depth++] = n->first;
            stack[depth++] = i + 1;
            continue;
        }
        for (uint32_t k = n->first; k < n->first + n->count; k++) {
            struct vec3 p[3];
            struct triangle_hit h;
            corners(m, m->order[k], p);
            // Of the triangles around a common edge one counts, so that a closed mesh is
            // left as often as it is entered.
            if (triangle_meet(&r, p, &h) && (!m->solid || triangle_owns(&r, p)))
                fill(boundary_list_add(out, h.t, h.dt, CROSS_TOUCH, 0), &h, m->order[k]);
        }
    }
    boundary_list_sort(out, from);
    if (m->solid)
        alternate(out, from);
}

bool mesh_closest(const void *shape, const struct ray *ray, struct boundary *out)
{
    const struct mesh *m = shape;
    const struct slabs s = slabs_of(&m->bounds, ray);
    const struct triangle_ray r = triangle_ray_of(ray);
    uint32_t stack[DEPTH_MAX + 4], depth = 0;
    double t_max = ray->t_max;
    bool found = false;
    stack[depth++] = 0;
    while (depth) {
        const uint32_t i = stack[--depth];
        const struct mesh_node *n = &m->node[i];
        double t, t0, t1;
        if (!slabs_meet(&n->bounds, &s, ray->t_min, t_max, &t))
            continue;
        if (n->count == 0 && n->first) {
            const bool b0 = slabs_meet(&m->node[i + 1].bounds, &s, ray->t_min, t_max, &t0);
            const bool b1 = slabs_meet(&m->node[n->first].bounds, &s, ray->t_min, t_max, &t1);
            const bool second_first = b0 && b1 && t1 < t0;
            if (b0 && second_first)
                stack[depth++] = i + 1;
            if (b1)
                stack[depth++] = n->first;
            if (b0 && !second_first)
                stack[depth++] = i + 1;
            continue;
        }
        for (uint32_t k = n->first; k < n->first + n->count; k++) {
            struct vec3 p[3];
            struct triangle_hit h;
            const uint32_t f = m->order[k];
            corners(m, f, p);
            if (!triangle_meet(&r, p, &h) || !(h.t > ray->t_min) ||
                !(h.t < t_max || (found && h.t == t_max && f < out->part)))
                continue; // of equal hits the first face, whatever the tree
            fill(out, &h, f);
            out->crossing = CROSS_TOUCH;
            t_max = h.t;
            found = true;
        }
    }
    return found;
}

bool mesh_inside(const void *shape, struct vec3 p)
{
    const struct mesh *m = shape;
    if (!m->solid)
        return false;
    struct boundary_list l = {0};
    const struct ray ray = {p, m->inside_vector, -INFINITY, INFINITY};
    mesh_intersect(m, &ray, &l);
    uint32_t ahead = 0;
    for (uint32_t i = 0; i < l.count; i++)
        ahead += l.at[i].t > 0;
    boundary_list_free(&l);
    return ahead % 2 == 1;
}

struct aabb mesh_bounds(const void *shape)
{
    const struct mesh *m = shape;
    return m->bounds;
}

bool mesh_is_solid(const void *shape)
{
    const struct mesh *m = shape;
    return m->solid;
}

void mesh_surface(const void *shape, const struct boundary *b, struct vec3 p,
                  struct surface_point *out)
{
    const struct mesh *m = shape;
    const uint32_t f = b->part;
    const double w[3] = {1 - b->u - b->v, b->u, b->v};
    struct vec3 q[3];
    corners(m, f, q);
    out->p = p;
    out->ng = out->ns = triangle_normal(q);
    if (m->face_normal && m->face_normal[f][0] != UINT32_MAX) {
        struct vec3 n = {0, 0, 0};
        for (int i = 0; i < 3; i++)
            n = vec3_mad(n, w[i], m->normal[m->face_normal[f][i]]);
        if (vec3_dot(n, n) > 0)
            out->ns = vec3_normalize(n);
    }
    for (int i = 0; m->face_uv && i < 3; i++) {
        const struct vec2 t = m->uv[m->face_uv[f][i]];
        out->uv.u += w[i] * t.u;
        out->uv.v += w[i] * t.v;
    }
}

const struct texture *mesh_texture(const void *shape, uint32_t i)
{
    const struct mesh *m = shape;
    return m->face_texture && i < m->texture_count ? m->texture[i] : NULL;
}

void mesh_textures_at(const void *shape, const struct boundary *b, struct vec3 p,
                      shape_texture_visit *visit, void *user)
{
    (void)p;
    const struct mesh *m = shape;
    const uint32_t *t = m->face_texture[b->part];
    if (t[0] == UINT32_MAX) {
        visit(user, NULL, 1);
    } else if (t[0] == t[1] && t[0] == t[2]) {
        visit(user, m->texture[t[0]], 1);
    } else {
        const double w[3] = {1 - b->u - b->v, b->u, b->v};
        for (int i = 0; i < 3; i++)
            if (w[i] > 0)
                visit(user, m->texture[t[i]], w[i]);
    }
}

void mesh_print(const void *shape, FILE *out)
{
    const struct mesh *m = shape;
    fprintf(out, "mesh2 { vertex_vectors { %u", (unsigned)m->vertex_count);
    for (uint32_t i = 0; i < m->vertex_count; i++) {
        fputs(", ", out);
        shape_print_vec3(out, m->vertex[i]);
    }
    fprintf(out, " } face_indices { %u", (unsigned)m->face_count);
    for (uint32_t i = 0; i < m->face_count; i++)
        fprintf(out, ", <%u, %u, %u>", (unsigned)m->face[i][0], (unsigned)m->face[i][1],
                (unsigned)m->face[i][2]);
    fputs(" }", out);
    if (m->solid) {
        fputs(" inside_vector ", out);
        shape_print_vec3(out, m->inside_vector);
    }
}
