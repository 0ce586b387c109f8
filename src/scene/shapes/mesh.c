// What mesh and mesh2 share: the box tree, crossings, normals.
#include "scene/shapes/mesh.h"

#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "base/memory.h"
#include "scene/shape.h"
#include "scene/shapes/extrude.h"
#include "scene/shapes/triangle.h"

struct faces {
    const struct mesh *m;
    const uint32_t *face;
};

// The boxes of the tree are grown by far more than the triangle test rounds, unless the
// origin is 2^28 times as far away as the mesh is large.
static struct aabb face_box(const struct vec3 p[3])
{
    return aabb_pad(aabb_add(aabb_add(aabb_add(aabb_empty(), p[0]), p[1]), p[2]));
}

static struct aabb box_of(const void *user, uint32_t i)
{
    const struct faces *f = user;
    struct vec3 p[3];
    mesh_corners(f->m, f->face[i], p);
    return face_box(p);
}

void mesh_finish(struct mesh *m, struct arena *a)
{
    uint32_t *face = must_malloc(m->face_count + 1, sizeof *face);
    uint32_t count = 0;
    m->bounds = aabb_empty();
    for (uint32_t f = 0; f < m->face_count; f++) {
        struct vec3 p[3];
        mesh_corners(m, f, p);
        const struct vec3 n = triangle_normal(p);
        if (vec3_dot(n, n) == 0)
            continue;
        m->bounds = aabb_join(m->bounds, face_box(p));
        face[count++] = f;
    }
    m->tree = bvh8_build_of(a, box_of, &(struct faces){m, face}, m->bounds, face, count,
                            BVH8_CHEAP_ITEMS);
    free(face);
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
    const struct triangle_ray r = triangle_ray_of(ray);
    const uint32_t from = out->count;
    struct bvh8_ray way;
    struct bvh8_walk walk;
    if (!bvh8_ray_begin(&m->tree, ray, -INFINITY, INFINITY, &way))
        return;
    bvh8_walk_begin(&walk, &m->tree);
    for (uint32_t first, n; bvh8_walk_next(&walk, &m->tree, &way, &first, &n);)
        for (uint32_t k = first; k < first + n; k++) {
            const uint32_t f = m->tree.item[k];
            struct vec3 p[3];
            struct triangle_hit h;
            mesh_corners(m, f, p);
            // Of the triangles around a common edge one counts, so that a closed mesh is
            // left as often as it is entered.
            if (triangle_meet(&r, p, &h) && (!m->solid || triangle_owns(&r, p)))
                fill(boundary_list_add(out, h.t, h.dt, CROSS_TOUCH, 0), &h, f);
        }
    boundary_list_sort(out, from);
    if (m->solid)
        alternate(out, from);
}

// A face that is met before *t_max, which then is where.
static bool closer_face(const struct mesh *m, const struct triangle_ray *r, double t_min,
                        uint32_t face, bool found, double *t_max, struct boundary *out)
{
    struct vec3 p[3];
    struct triangle_hit h;
    mesh_corners(m, face, p);
    if (!triangle_meet(r, p, &h) || !(h.t > t_min) ||
        !(h.t < *t_max || (found && h.t == *t_max && face < out->part)))
        return false; // of equal hits the first face, whatever the tree
    fill(out, &h, face);
    out->crossing = CROSS_TOUCH;
    *t_max = h.t;
    return true;
}

bool mesh_closest(const void *shape, const struct ray *ray, struct boundary *out)
{
    enum { SMALL = 2 }; // faces that are tried without a walk, as in trace/packet_mesh.h
    const struct mesh *m = shape;
    double t_max = ray->t_max;
    bool found = false;
    struct bvh8_ray way;
    struct bvh8_walk walk;
    if (!bvh8_ray_begin(&m->tree, ray, ray->t_min, t_max, &way))
        return false;
    const struct triangle_ray r = triangle_ray_of(ray);
    if (m->face_count <= SMALL) {
        for (uint32_t f = 0; f < m->face_count; f++)
            found |= closer_face(m, &r, ray->t_min, f, found, &t_max, out);
        return found;
    }
    bvh8_walk_begin(&walk, &m->tree);
    for (uint32_t first, n; bvh8_walk_next(&walk, &m->tree, &way, &first, &n);)
        for (uint32_t k = first; k < first + n; k++)
            if (closer_face(m, &r, ray->t_min, m->tree.item[k], found, &t_max, out)) {
                found = true;
                bvh8_ray_limit(&way, t_max);
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
    mesh_corners(m, f, q);
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

const struct texture *mesh_whole_texture(const struct shape_ops *ops, const void *shape)
{
    return ops->textures_at == mesh_textures_at ? ((const struct mesh *)shape)->whole
                                                : NULL;
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
