#include "tess/sheet.h"

#include <string.h>

#include "scene/shapes/mesh.h"
#include "scene/shapes/triangle.h"
#include "tess/map_mesh.h"

static bool is_kind(const struct object *o, const char *keyword)
{
    return strcmp(o->ops->keyword, keyword) == 0;
}

static bool is_mesh(const struct object *o)
{
    return is_kind(o, "mesh") || is_kind(o, "mesh2");
}

static bool is_triangle(const struct object *o)
{
    return is_kind(o, "triangle") || is_kind(o, "smooth_triangle");
}

// What is a sheet as the image of squares.
static bool is_mapped(const struct object *o)
{
    return o->ops == &disc_ops || o->ops == &bicubic_patch_ops;
}

bool is_sheet(const struct object *o)
{
    if (o->clip_count || o->flags & OBJECT_INVERSE)
        return false;
    if (o->kind == OBJECT_SHAPE)
        return is_mesh(o) || is_triangle(o) || is_mapped(o);
    if (o->kind != OBJECT_CSG || o->op != CSG_UNION)
        return false;
    for (uint32_t i = 0; i < o->child_count; i++)
        if (!is_sheet(o->child[i]))
            return false;
    return o->child_count > 0;
}

static void add_mesh(const struct mesh *m, const struct transform *t,
                     struct tess_mesh *out)
{
    const uint32_t base = out->vertex_count;
    const uint32_t first = out->triangle_count;
    for (uint32_t i = 0; i < m->vertex_count; i++)
        tess_mesh_add_vertex(out, transform_point(t, m->vertex[i]));
    for (uint32_t i = 0; i < m->face_count; i++) {
        const uint32_t *f = m->face[i];
        if (f[0] != f[1] && f[1] != f[2] && f[2] != f[0])
            tess_mesh_add_triangle(out, base + f[0], base + f[1], base + f[2]);
    }
    if (!m->solid || tess_mesh_report(out).volume >= 0)
        return;
    for (uint32_t i = first; i < out->triangle_count; i++) {
        const uint32_t b = out->triangle[i][1];
        out->triangle[i][1] = out->triangle[i][2];
        out->triangle[i][2] = b;
    }
}

static void add(const struct object *o, const struct transform *outer, double step,
                struct tess_mesh *out)
{
    const struct transform t = transform_then(o->transform, outer);
    if (o->kind == OBJECT_CSG) {
        for (uint32_t i = 0; i < o->child_count; i++)
            add(o->child[i], &t, step, out);
        return;
    }
    if (is_mesh(o)) {
        struct tess_mesh part = {0};
        add_mesh(o->shape, &t, &part);
        const uint32_t base = out->vertex_count;
        for (uint32_t i = 0; i < part.vertex_count; i++)
            tess_mesh_add_vertex(out, part.vertex[i]);
        for (uint32_t i = 0; i < part.triangle_count; i++)
            tess_mesh_add_triangle(out, base + part.triangle[i][0],
                                   base + part.triangle[i][1],
                                   base + part.triangle[i][2]);
        tess_mesh_free(&part);
        return;
    }
    if (is_mapped(o)) {
        tess_map_mesh(tess_map_find(o->ops), o->shape, &t, step, out);
        return;
    }
    const struct triangle *x = o->shape;
    if (x->degenerate)
        return;
    uint32_t v[3];
    for (int k = 0; k < 3; k++)
        v[k] = tess_mesh_add_vertex(out, transform_point(&t, x->p[k]));
    tess_mesh_add_triangle(out, v[0], v[1], v[2]);
}

static struct aabb sheet_bounds(const struct object *o, const struct transform *outer)
{
    const struct transform t = transform_then(o->transform, outer);
    if (o->kind == OBJECT_SHAPE)
        return aabb_transform(shape_surface_bounds(o->ops, o->shape), &t);
    struct aabb b = aabb_empty();
    for (uint32_t i = 0; i < o->child_count; i++)
        b = aabb_join(b, sheet_bounds(o->child[i], &t));
    return b;
}

void sheet_mesh(const struct object *o, int resolution, struct tess_mesh *out)
{
    const struct aabb b = sheet_bounds(o, &transform_identity);
    const double size = vec3_max_abs(vec3_sub(b.max, b.min));
    add(o, &transform_identity, size / resolution, out);
}
