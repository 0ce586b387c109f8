// A bicubic patch as POV-Ray draws it, to compare pictures (--pov-patches): halved until a
// piece is flat or the steps are used up, each piece two triangles with blended normals.
// Not watertight where flatness stops neighbours at different depths.
#include <math.h>

#include "base/arena.h"
#include "scene/shapes/mesh.h"
#include "scene/shapes/patch.h"

enum { STEPS_MAX = 10 };

struct piece {
    struct vec3 p[4][4];
    double u[2], v[2];
};

struct maker {
    const struct patch *whole;
    double flatness;
    int steps[2];
    struct mesh *mesh; // NULL while pieces are counted
    uint32_t pieces;
};

static void halve_curve(const struct vec3 p[4], struct vec3 left[4], struct vec3 right[4])
{
    struct vec3 q[4] = {p[0], p[1], p[2], p[3]};
    left[0] = p[0];
    right[3] = p[3];
    for (int n = 3; n > 0; n--) {
        for (int i = 0; i < n; i++)
            q[i] = vec3_scale(0.5, vec3_add(q[i], q[i + 1]));
        left[4 - n] = q[0];
        right[n - 1] = q[n - 1];
    }
}

static void halve_v(const struct piece *s, struct piece half[2])
{
    const double middle = 0.5 * (s->v[0] + s->v[1]);
    half[0] = half[1] = *s;
    half[0].v[1] = half[1].v[0] = middle;
    for (int i = 0; i < 4; i++)
        halve_curve(s->p[i], half[0].p[i], half[1].p[i]);
}

static void halve_u(const struct piece *s, struct piece half[2])
{
    const double middle = 0.5 * (s->u[0] + s->u[1]);
    half[0] = half[1] = *s;
    half[0].u[1] = half[1].u[0] = middle;
    for (int k = 0; k < 4; k++) {
        struct vec3 column[4], left[4], right[4];
        for (int i = 0; i < 4; i++)
            column[i] = s->p[i][k];
        halve_curve(column, left, right);
        for (int i = 0; i < 4; i++) {
            half[0].p[i][k] = left[i];
            half[1].p[i][k] = right[i];
        }
    }
}

// All control points are nearer than `flatness` to the plane of three corners.
static bool is_flat(const struct piece *s, double flatness)
{
    if (!(flatness > 0))
        return false;
    const struct vec3 o = s->p[0][0];
    struct vec3 a = vec3_sub(s->p[0][3], o), b = vec3_sub(s->p[3][0], o);
    const struct vec3 c = vec3_sub(s->p[3][3], o);
    if (vec3_dot(a, a) == 0)
        a = c;
    else if (vec3_dot(b, b) == 0)
        b = c;
    const struct vec3 n = vec3_normalize(vec3_cross(a, b));
    double far = 0;
    for (int i = 0; i < 16; i++)
        far = fmax(far, fabs(vec3_dot(n, vec3_sub(s->p[i / 4][i % 4], o))));
    return far < flatness;
}

// Unit; <1, 0, 0> where an edge collapses.
static struct vec3 corner_normal(const struct patch *whole, double u, double v)
{
    struct vec3 at, du, dv;
    patch_derivatives(whole, u, v, &at, &du, &dv);
    const struct vec3 n = vec3_normalize(vec3_cross(du, dv));
    return vec3_dot(n, n) > 0 ? n : vec3(1, 0, 0);
}

// POV-Ray leaves out triangles that are slimmer than this.
static bool is_slim(const struct vec3 p[4], const uint32_t corner[3])
{
    const struct vec3 a = vec3_sub(p[corner[1]], p[corner[0]]);
    const struct vec3 b = vec3_sub(p[corner[2]], p[corner[0]]);
    const struct vec3 n = vec3_cross(a, b);
    return vec3_dot(n, n) <= 1e-10 * vec3_dot(a, a) * vec3_dot(b, b);
}

static void add_triangles(struct maker *m, const struct piece *s)
{
    static const uint32_t corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
    const uint32_t first = 4 * m->pieces++;
    if (!m->mesh)
        return;
    struct mesh *mesh = m->mesh;
    const struct vec3 p[4] = {s->p[0][0], s->p[0][3], s->p[3][3], s->p[3][0]};
    const struct vec2 uv[4] = {
        {s->u[0], s->v[0]}, {s->u[0], s->v[1]}, {s->u[1], s->v[1]}, {s->u[1], s->v[0]}};
    for (int i = 0; i < 4; i++) {
        mesh->vertex[first + i] = p[i];
        mesh->uv[first + i] = uv[i];
        mesh->normal[first + i] = corner_normal(m->whole, uv[i].u, uv[i].v);
    }
    for (int k = 0; k < 2; k++) {
        if (is_slim(p, corners[k]))
            continue;
        for (int i = 0; i < 3; i++)
            mesh->face[mesh->face_count][i] = first + corners[k][i];
        mesh->face_count++;
    }
}

static void descend(struct maker *m, const struct piece *s, int depth)
{
    const bool in_u = depth < m->steps[0], in_v = depth < m->steps[1];
    struct piece half[2], quarter[2];
    if ((!in_u && !in_v) || is_flat(s, m->flatness)) {
        add_triangles(m, s);
        return;
    }
    if (in_u)
        halve_u(s, half);
    else
        halve_v(s, half);
    for (int i = 0; i < 2; i++) {
        if (!in_u || !in_v) {
            descend(m, &half[i], depth + 1);
            continue;
        }
        halve_v(&half[i], quarter);
        descend(m, &quarter[0], depth + 1);
        descend(m, &quarter[1], depth + 1);
    }
}

static int steps_of(double wanted)
{
    return wanted > 0 ? (int)fmin(wanted, STEPS_MAX) : 0;
}

struct mesh *patch_triangles(const struct patch *p, double flatness, double u_steps,
                             double v_steps, struct arena *arena)
{
    struct maker m = {.whole = p,
                      .flatness = flatness,
                      .steps = {steps_of(u_steps), steps_of(v_steps)}};
    struct piece whole = {.u = {0, 1}, .v = {0, 1}};
    for (int i = 0; i < 16; i++)
        whole.p[i / 4][i % 4] = p->p[i / 4][i % 4];
    descend(&m, &whole, 0);
    struct mesh *mesh = arena_new_struct(arena, struct mesh);
    const size_t n = 4 * (size_t)m.pieces;
    *mesh = (struct mesh){.vertex = arena_new_array(arena, struct vec3, n),
                          .normal = arena_new_array(arena, struct vec3, n),
                          .uv = arena_new_array(arena, struct vec2, n),
                          .vertex_count = (uint32_t)n,
                          .normal_count = (uint32_t)n,
                          .uv_count = (uint32_t)n};
    mesh->face = arena_alloc(arena, n / 2 * sizeof *mesh->face);
    mesh->face_normal = mesh->face_uv = mesh->face; // by the same numbers
    m.mesh = mesh;
    m.pieces = 0;
    descend(&m, &whole, 0);
    mesh_finish(mesh, arena);
    return mesh;
}
