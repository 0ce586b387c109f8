#include "scene/mesh_camera.h"

#include <string.h>

#include "base/arena.h"
#include "math/gamma.h"
#include "math/larger.h"
#include "scene/camera.h"
#include "scene/shapes/mesh.h"
#include "scene/shapes/triangle.h"

// ---- faces by uv -------------------------------------------------------------------

// A grid over the unit square; each cell lists the faces whose uv boxes touch it, in
// order, since the first face that holds a point counts.
struct uv_faces {
    uint32_t side;
    uint32_t *begin; // side^2 + 1
    uint32_t *face;
};

static uint32_t cell_of(const struct uv_faces *f, double v)
{
    const double at = floor(v * f->side);
    return !(at > 0) ? 0 : at >= f->side ? f->side - 1 : (uint32_t)at;
}

struct cells {
    uint32_t u0, u1, v0, v1;
};

static void uv_corners(const struct mesh *m, uint32_t face, struct vec2 t[3])
{
    for (int i = 0; i < 3; i++)
        t[i] = m->uv[m->face_uv[face][i]];
}

static struct cells cells_of(const struct uv_faces *f, const struct mesh *m,
                             uint32_t face)
{
    struct vec2 t[3];
    uv_corners(m, face, t);
    return (struct cells){
        cell_of(f, fmin(t[0].u, fmin(t[1].u, t[2].u))),
        cell_of(f, fmax(t[0].u, fmax(t[1].u, t[2].u))),
        cell_of(f, fmin(t[0].v, fmin(t[1].v, t[2].v))),
        cell_of(f, fmax(t[0].v, fmax(t[1].v, t[2].v))),
    };
}

// Counts the faces of each cell, or, with `next`, puts them there.
static void cells_visit(const struct uv_faces *f, const struct mesh *m, uint32_t *count,
                        uint32_t *next)
{
    for (uint32_t i = 0; i < m->face_count; i++) {
        const struct cells c = cells_of(f, m, i);
        for (uint32_t v = c.v0; v <= c.v1; v++)
            for (uint32_t u = c.u0; u <= c.u1; u++) {
                const uint32_t k = v * f->side + u;
                if (next)
                    f->face[next[k]++] = i;
                else
                    count[k + 1]++;
            }
    }
}

static uint64_t entries(const struct uv_faces *f, const struct mesh *m)
{
    uint64_t n = 0;
    for (uint32_t i = 0; i < m->face_count; i++) {
        const struct cells c = cells_of(f, m, i);
        n += (uint64_t)(c.u1 - c.u0 + 1) * (c.v1 - c.v0 + 1);
    }
    return n;
}

// As fine as there are faces, unless they lie over each other and would fill the lists.
static void choose_side(struct uv_faces *f, const struct mesh *m)
{
    enum { MOST = 512, LISTED = 16 };
    const double side = sqrt(m->face_count);
    f->side = side < 1 ? 1 : side > MOST ? MOST : (uint32_t)side;
    while (f->side > 1 && entries(f, m) > (uint64_t)LISTED * m->face_count)
        f->side /= 2;
}

static const struct uv_faces *uv_faces_new(const struct mesh *m, struct arena *a)
{
    struct uv_faces *f = arena_new_struct(a, struct uv_faces);
    choose_side(f, m);
    const uint32_t cells = f->side * f->side;
    f->begin = arena_new_array(a, uint32_t, cells + 1);
    cells_visit(f, m, f->begin, NULL);
    for (uint32_t k = 0; k < cells; k++)
        f->begin[k + 1] += f->begin[k];
    f->face = arena_new_array(a, uint32_t, f->begin[cells] + 1);
    uint32_t *next = arena_new_array(a, uint32_t, cells);
    for (uint32_t k = 0; k < cells; k++)
        next[k] = f->begin[k];
    cells_visit(f, m, NULL, next);
    return f;
}

// Barycentric coordinates in the uv plane and a bound on how far they are off where p and
// the corners are rounded; false: a face without area.
static bool uv_weights(const struct vec2 t[3], struct vec2 p, double w[3], double *off)
{
    const double a = t[1].u - t[0].u, b = t[2].u - t[0].u;
    const double c = t[1].v - t[0].v, d = t[2].v - t[0].v;
    const double e = p.u - t[0].u, f = p.v - t[0].v;
    const double area = a * d - b * c;
    if (area == 0)
        return false;
    double most = larger(fabs(p.u), fabs(p.v));
    for (int i = 0; i < 3; i++)
        most = larger(larger(fabs(t[i].u), fabs(t[i].v)), most);
    *off = GAMMA(8) * most * (fabs(a) + fabs(b) + fabs(c) + fabs(d)) / fabs(area);
    w[1] = (e * d - b * f) / area;
    w[2] = (a * f - e * c) / area;
    w[0] = 1 - w[1] - w[2];
    return true;
}

// The first face that holds p; where p lies on an edge and rounding puts it out of the faces
// on both sides, the one that it is least outside of. UINT32_MAX: none.
static uint32_t uv_face_at(const struct uv_faces *f, const struct mesh *m, struct vec2 p,
                           double w[3])
{
    const uint32_t k = cell_of(f, p.v) * f->side + cell_of(f, p.u);
    uint32_t nearest = UINT32_MAX;
    double best = -INFINITY;
    for (uint32_t i = f->begin[k]; i < f->begin[k + 1]; i++) {
        struct vec2 t[3];
        double at[3], off;
        uv_corners(m, f->face[i], t);
        if (!uv_weights(t, p, at, &off))
            continue;
        const double least = smaller(at[0], smaller(at[1], at[2]));
        if (least <= best || least < -off)
            continue;
        best = least;
        nearest = f->face[i];
        memcpy(w, at, sizeof at);
        if (least >= 0)
            break;
    }
    return nearest;
}

// ---- rays --------------------------------------------------------------------------

// Where a ray leaves a mesh, in the mesh's space.
struct start {
    const struct camera_mesh *mesh;
    struct vec3 p, n;
};

static bool start_at_center(const struct camera_mesh *c, double face,
                            struct mesh_camera_memo *memo, struct start *out)
{
    struct vec3 p[3];
    if (!(face >= 0 && face < c->mesh->face_count))
        return false;
    if (memo->mesh != c->mesh || memo->face != (uint32_t)face) {
        mesh_corners(c->mesh, (uint32_t)face, p);
        *memo = (struct mesh_camera_memo){
            .mesh = c->mesh,
            .face = (uint32_t)face,
            .centre = vec3_scale(1.0 / 3, vec3_add(vec3_add(p[0], p[1]), p[2])),
            .normal = triangle_normal(p)};
    }
    *out = (struct start){c, memo->centre, memo->normal};
    return true;
}

static bool start_in_list(const struct mesh_camera *m, double face,
                          struct mesh_camera_memo *memo, struct start *out)
{
    for (uint32_t i = 0; i < m->mesh_count; i++) {
        if (start_at_center(&m->mesh[i], face, memo, out))
            return true;
        face -= m->mesh[i].mesh->face_count;
    }
    return false;
}

static void start_in_face(const struct mesh_camera *m, uint32_t face, const double w[3],
                          struct start *out)
{
    const struct mesh *mesh = m->mesh->mesh;
    struct vec3 p[3];
    mesh_corners(mesh, face, p);
    *out = (struct start){m->mesh, {0, 0, 0}, triangle_normal(p)};
    for (int i = 0; i < 3; i++)
        out->p = vec3_mad(out->p, w[i], p[i]);
    if (m->smooth && mesh->face_normal && mesh->face_normal[face][0] != UINT32_MAX) {
        struct vec3 n = {0, 0, 0};
        for (int i = 0; i < 3; i++)
            n = vec3_mad(n, w[i], mesh->normal[mesh->face_normal[face][i]]);
        if (vec3_dot(n, n) > 0)
            out->n = vec3_normalize(n);
    }
}

static bool start_in_uv(const struct mesh_camera *m, struct vec2 at, struct start *out)
{
    double w[3];
    const uint32_t face = m->uv ? uv_face_at(m->uv, m->mesh->mesh, at, w) : UINT32_MAX;
    if (face == UINT32_MAX)
        return false;
    start_in_face(m, face, w, out);
    return true;
}

// Rows begin half a pixel late, as the language has it: rows 0 and 1 share their faces.
static double face_row(double y) { return floor(fmax(0, y - 1)); }
static double face_col(double x) { return floor(fmax(0, x)); }

// Corners of pixels, not their centres, are looked up; the last column and the first row
// are moved into the picture.
static struct vec2 uv_place(double x, double y, int w, int h)
{
    return (struct vec2){fmin(x - 0.5, w - 1.5) / w, 1 - fmax(0.5, y - 0.5) / h};
}

static bool start_of(const struct mesh_camera *m, double x, double y, int w, int h,
                     uint32_t k, struct mesh_camera_memo *memo, struct start *out)
{
    const double row = face_row(y), col = face_col(x);
    switch (m->way) {
    case MESH_CAMERA_RAYS:
        return k < m->mesh_count &&
               start_at_center(&m->mesh[k], row * w + col, memo, out);
    case MESH_CAMERA_LIST:
        return start_in_list(m, row * w + col + (double)k * m->face_count, memo, out);
    case MESH_CAMERA_WIDTH: {
        // Columns count from the left of the picture in every mesh.
        const double part = floor(w / (double)m->mesh_count);
        const double mesh = part > 0 ? floor(col / part) : 0;
        const uint32_t last = m->mesh_count - 1;
        return start_at_center(&m->mesh[mesh < last ? (uint32_t)mesh : last],
                               row * part + col, memo, out);
    }
    case MESH_CAMERA_UV: return start_in_uv(m, uv_place(x, y, w, h), out);
    }
    return false;
}

static bool turns_alike(const struct transform *s, const struct transform *t)
{
    return s->identity == t->identity &&
           memcmp(&s->inverse, &t->inverse, sizeof s->inverse) == 0;
}

static void find_turns(struct mesh_camera *m, struct arena *a)
{
    m->turn = arena_new_array(a, const struct transform *, m->mesh_count);
    for (uint32_t i = 0; i < m->mesh_count; i++) {
        const struct transform *own = m->mesh[i].transform;
        m->turn[i] = i && turns_alike(m->turn[i - 1], own) ? m->turn[i - 1] : own;
    }
}

void mesh_camera_finish(struct mesh_camera *m, struct arena *a)
{
    find_turns(m, a);
    m->face_count = 0;
    for (uint32_t i = 0; i < m->mesh_count; i++)
        m->face_count += m->mesh[i].mesh->face_count;
    // Behind the last mesh or face no ray is left.
    if (m->way == MESH_CAMERA_RAYS && m->rays > m->mesh_count)
        m->rays = m->mesh_count;
    else if (m->way != MESH_CAMERA_RAYS)
        m->rays = 1;
    if (m->way == MESH_CAMERA_UV && m->mesh->mesh->face_uv)
        m->uv = uv_faces_new(m->mesh->mesh, a);
}

// The direction of a ray along a normal, or against it.
static struct vec3 direction_of(const struct camera *c, const struct start *s)
{
    static const double backwards = -1e-10; // "is negative", as the language has it
    const struct vec3 d = c->direction.z < backwards ? vec3_neg(s->n) : s->n;
    return vec3_normalize(transform_normal(s->mesh->transform, d));
}

bool mesh_camera_ray(const struct camera *c, double x, double y, int w, int h, uint32_t k,
                     struct mesh_camera_memo *memo, struct vec3 *origin,
                     struct vec3 *direction)
{
    const struct mesh_camera *m = c->mesh;
    struct mesh_camera_memo own = {.mesh = NULL};
    struct start s;
    if (!memo)
        memo = &own;
    if (!start_of(m, x, y, w, h, k, memo, &s))
        return false;
    *origin = transform_point(s.mesh->transform, vec3_mad(s.p, c->location.z, s.n));
    if (m->way == MESH_CAMERA_UV) { // which keeps no face
        *direction = direction_of(c, &s);
        return true;
    }
    const struct transform *turn = m->turn[s.mesh - m->mesh];
    if (memo->turn != turn) {
        memo->turn = turn;
        memo->direction = direction_of(c, &s);
    }
    *direction = memo->direction;
    return true;
}
