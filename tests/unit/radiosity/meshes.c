#include "meshes.h"

#include <stdlib.h>

#include "radiosity/polygon.h"
#include "trace/intersect.h"

struct mesh *mesh_new(void)
{
    struct mesh *m = calloc(1, sizeof *m);
    m->blocker = calloc(8, sizeof *m->blocker);
    m->e.user = m;
    return m;
}

void mesh_free(struct mesh *m)
{
    free(m->element);
    free(m->blocker);
    free(m);
}

static struct element *next(struct mesh *m)
{
    if (m->e.count == m->capacity) {
        m->capacity = m->capacity ? 2 * m->capacity : 64;
        m->element = realloc(m->element, m->capacity * sizeof *m->element);
        m->e.element = m->element;
    }
    return &m->element[m->e.count++];
}

static struct element parallelogram(struct vec3 p, struct vec3 a, struct vec3 b)
{
    struct element e = {.corner_count = 4};
    e.corner[0] = p;
    e.corner[1] = vec3_add(p, a);
    e.corner[2] = vec3_add(e.corner[1], b);
    e.corner[3] = vec3_add(p, b);
    element_finish(&e);
    return e;
}

uint32_t mesh_add(struct mesh *m, struct vec3 p, struct vec3 a, struct vec3 b,
                  uint32_t nu, uint32_t nv)
{
    const uint32_t first = m->e.count;
    const struct vec3 du = vec3_scale(1.0 / nu, a), dv = vec3_scale(1.0 / nv, b);
    for (uint32_t i = 0; i < nu * nv; i++) {
        struct element *e = next(m);
        *e = parallelogram(vec3_mad(vec3_mad(p, i % nu, du), i / nu, dv), du, dv);
        e->surface = first;
    }
    return first;
}

void mesh_add_triangle(struct mesh *m, struct vec3 a, struct vec3 b, struct vec3 c)
{
    struct element *e = next(m);
    *e = (struct element){.corner = {a, b, c}, .corner_count = 3};
    element_finish(e);
}

void mesh_block(struct mesh *m, struct vec3 p, struct vec3 a, struct vec3 b)
{
    m->blocker[m->blockers++] = parallelogram(p, a, b);
}

// Where the ray meets a parallelogram, INFINITY: nowhere.
static double meet(const struct element *e, struct vec3 o, struct vec3 d)
{
    const struct vec3 a = vec3_sub(e->corner[1], e->corner[0]);
    const struct vec3 b = vec3_sub(e->corner[3], e->corner[0]);
    const double t =
        vec3_dot(vec3_sub(e->corner[0], o), e->normal) / vec3_dot(d, e->normal);
    if (!(t > 1e-9))
        return INFINITY;
    const struct vec3 r = vec3_sub(vec3_mad(o, t, d), e->corner[0]);
    const double u = vec3_dot(r, a) / vec3_dot(a, a), v = vec3_dot(r, b) / vec3_dot(b, b);
    return u >= 0 && u <= 1 && v >= 0 && v <= 1 ? t : INFINITY;
}

static void occluded(void *state, const struct ray_batch *rays, uint8_t *out)
{
    const struct mesh *m = state;
    for (uint32_t i = 0; i < rays->count; i++) {
        const struct vec3 o = vec3(rays->o[0][i], rays->o[1][i], rays->o[2][i]);
        const struct vec3 d = vec3(rays->d[0][i], rays->d[1][i], rays->d[2][i]);
        out[i] = 0;
        for (uint32_t b = 0; b < m->blockers && !out[i]; b++)
            out[i] = meet(&m->blocker[b], o, d) < 1;
    }
}

static void closest(void *state, const struct ray_batch *rays, uint32_t *out)
{
    const struct mesh *m = state;
    for (uint32_t i = 0; i < rays->count; i++) {
        const struct vec3 o = vec3(rays->o[0][i], rays->o[1][i], rays->o[2][i]);
        const struct vec3 d = vec3(rays->d[0][i], rays->d[1][i], rays->d[2][i]);
        double best = INFINITY;
        out[i] = ELEMENT_NONE;
        for (uint32_t b = 0; b < m->blockers; b++)
            best = fmin(best, meet(&m->blocker[b], o, d));
        for (uint32_t b = 0; b < m->e.count; b++) {
            const double t = meet(&m->element[b], o, d);
            if (t < best && vec3_dot(d, m->element[b].normal) < 0) {
                best = t;
                out[i] = b;
            }
        }
    }
}

void mesh_trace(struct mesh *m)
{
    m->e.occluded = occluded;
    m->e.closest = closest;
}

struct mesh *mesh_cube(uint32_t n)
{
    struct mesh *m = mesh_new();
    const struct vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1}, o = {0, 0, 0};
    mesh_add(m, o, x, y, n, n);
    mesh_add(m, z, y, x, n, n);
    mesh_add(m, o, y, z, n, n);
    mesh_add(m, x, z, y, n, n);
    mesh_add(m, o, z, x, n, n);
    mesh_add(m, y, x, z, n, n);
    return m;
}
