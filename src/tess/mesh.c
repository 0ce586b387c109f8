#include "tess/mesh.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

void tess_mesh_free(struct tess_mesh *m)
{
    free(m->vertex);
    free(m->triangle);
    *m = (struct tess_mesh){0};
}

uint32_t tess_mesh_add_vertex(struct tess_mesh *m, struct vec3 p)
{
    m->vertex =
        must_grow(m->vertex, m->vertex_count, &m->vertex_capacity, sizeof *m->vertex);
    m->vertex[m->vertex_count] = p;
    return m->vertex_count++;
}

void tess_mesh_add_triangle(struct tess_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    m->triangle = must_grow(m->triangle, m->triangle_count, &m->triangle_capacity,
                            sizeof *m->triangle);
    uint32_t *t = m->triangle[m->triangle_count++];
    t[0] = a;
    t[1] = b;
    t[2] = c;
}

// ---- the report ------------------------------------------------------------------------

// A side of a triangle, from a corner to the next, filed under its smaller end.
struct side {
    uint32_t low, high;
    uint32_t triangle;
    bool forward; // runs from low to high
};

static int side_order(const void *a, const void *b)
{
    const struct side *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return x->forward - y->forward;
}

static struct side *sides_of(const struct tess_mesh *m)
{
    struct side *side = must_malloc(3 * (size_t)m->triangle_count + 1, sizeof *side);
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        for (int k = 0; k < 3; k++) {
            const uint32_t a = m->triangle[t][k], b = m->triangle[t][(k + 1) % 3];
            side[3 * t + (uint32_t)k] =
                (struct side){a < b ? a : b, a < b ? b : a, t, a < b};
        }
    }
    qsort(side, 3 * (size_t)m->triangle_count, sizeof *side, side_order);
    return side;
}

static uint32_t root(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

// Joins the corners at both ends of an edge that two triangles share; afterwards the
// corners at a vertex are one set exactly where its triangles are one fan.
static void join_corners(const struct tess_mesh *m, uint32_t *parent,
                         const struct side *a, const struct side *b)
{
    const uint32_t end[2] = {a->low, a->high};
    for (int e = 0; e < 2; e++) {
        uint32_t corner[2] = {0, 0};
        for (uint32_t k = 0; k < 3; k++) {
            if (m->triangle[a->triangle][k] == end[e])
                corner[0] = 3 * a->triangle + k;
            if (m->triangle[b->triangle][k] == end[e])
                corner[1] = 3 * b->triangle + k;
        }
        parent[root(parent, corner[0])] = root(parent, corner[1]);
    }
}

static bool one_fan_each(const struct tess_mesh *m, uint32_t *parent)
{
    uint32_t *fan = must_malloc(m->vertex_count + 1, sizeof *fan);
    memset(fan, 0xff, m->vertex_count * sizeof *fan);
    bool one = true;
    for (uint32_t c = 0; c < 3 * m->triangle_count && one; c++) {
        uint32_t *of = &fan[m->triangle[c / 3][c % 3]];
        if (*of == UINT32_MAX)
            *of = root(parent, c);
        one = *of == root(parent, c);
    }
    free(fan);
    return one;
}

static long vertices_in_use(const struct tess_mesh *m)
{
    uint8_t *used = must_calloc(m->vertex_count + 1, 1);
    for (uint32_t t = 0; t < m->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            used[m->triangle[t][k]] = 1;
    long n = 0;
    for (uint32_t i = 0; i < m->vertex_count; i++)
        n += used[i];
    free(used);
    return n;
}

static void measure(const struct tess_mesh *m, struct tess_report *r)
{
    if (!m->triangle_count)
        return;
    // From a point of the mesh: volumes of far meshes keep their digits.
    const struct vec3 o = m->vertex[m->triangle[0][0]];
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const struct vec3 a = vec3_sub(m->vertex[m->triangle[t][0]], o);
        const struct vec3 b = vec3_sub(m->vertex[m->triangle[t][1]], o);
        const struct vec3 c = vec3_sub(m->vertex[m->triangle[t][2]], o);
        const struct vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
        r->area += vec3_length(n) / 2;
        r->volume += vec3_dot(a, vec3_cross(b, c)) / 6;
    }
}

struct tess_report tess_mesh_report(const struct tess_mesh *m)
{
    struct tess_report r = {.closed = true, .oriented = true};
    const size_t n = 3 * (size_t)m->triangle_count;
    struct side *side = sides_of(m);
    uint32_t *parent = must_malloc(n + 1, sizeof *parent);
    for (size_t i = 0; i < n; i++)
        parent[i] = (uint32_t)i;
    long edges = 0;
    for (size_t i = 0, end; i < n; i = end) {
        for (end = i + 1;
             end < n && side[end].low == side[i].low && side[end].high == side[i].high;
             end++)
            ;
        edges++;
        if (end - i != 2) {
            r.closed = false;
            continue;
        }
        if (side[i].forward == side[i + 1].forward)
            r.oriented = false;
        join_corners(m, parent, &side[i], &side[i + 1]);
    }
    r.manifold = r.closed && r.oriented && one_fan_each(m, parent);
    r.euler = vertices_in_use(m) - edges + (long)m->triangle_count;
    measure(m, &r);
    free(side);
    free(parent);
    return r;
}
