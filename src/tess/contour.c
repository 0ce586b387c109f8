// Contouring a solid on a grid. Each cell's crossed edges are joined into loops, face by
// face; a face with two opposite inside corners always parts them, so that both cells of
// a face see the same segments and the surface is a closed 2-manifold in every case
// (marching cubes by tracing, without tables). A loop becomes a fan around a vertex of its
// own, which reconstructs edges and corners (Kobbelt, Botsch, Schwanecke & Seidel 2001,
// Feature sensitive surface extraction from volume data).
#include "tess/contour.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { NONE = -1 };

// ---- the grid ---------------------------------------------------------------------------

static size_t corner_at(const struct contour *c, int i, int j, int k)
{
    const size_t nx = (size_t)c->cells[0] + 1, ny = (size_t)c->cells[1] + 1;
    return (size_t)i + nx * ((size_t)j + ny * (size_t)k);
}

static struct vec3 corner_point(const struct contour *c, int i, int j, int k)
{
    return vec3_add(c->origin, vec3_scale(c->step, vec3(i, j, k)));
}

static void lay_grid(struct contour *c, int resolution)
{
    // A face of the solid in a plane of the grid would make slivers: the grid is moved
    // by part of a cell that no scene is likely to be built on.
    const double off = 0.3819660112501051;
    const struct aabb b = c->solid->bounds;
    const struct vec3 size = vec3_sub(b.max, b.min);
    c->step = fmax(size.x, fmax(size.y, size.z)) / resolution;
    for (int axis = 0; axis < 3; axis++)
        c->cells[axis] = (int)ceil(vec3_axis(size, axis) / c->step) + 2;
    c->origin = vec3_mad(b.min, -(1 + off) * c->step, vec3(1, 1, 1));
}

static void mark_corners(struct contour *c)
{
    c->inside = must_calloc(corner_at(c, 0, 0, c->cells[2] + 1), 1);
    // The outermost corners lie outside the bounds.
    for (int k = 1; k < c->cells[2]; k++)
        for (int j = 1; j < c->cells[1]; j++)
            for (int i = 1; i < c->cells[0]; i++)
                c->inside[corner_at(c, i, j, k)] =
                    tess_solid_inside(c->solid, corner_point(c, i, j, k));
}

// ---- vertices on grid edges -----------------------------------------------------------

// The vertices on the edges that leave the corners of two layers, by axis.
struct layer {
    uint32_t *vertex[3];
};

static uint32_t add_crossing(struct contour *c, const int at[3], int axis, bool inside)
{
    int next[3] = {at[0], at[1], at[2]};
    next[axis]++;
    const struct vec3 a = corner_point(c, at[0], at[1], at[2]);
    const struct vec3 b = corner_point(c, next[0], next[1], next[2]);
    const struct tess_crossing x =
        tess_solid_crossing(c->solid, inside ? b : a, inside ? a : b);
    const uint32_t v = tess_mesh_add_vertex(c->mesh, x.p);
    if (v >= c->crossing_capacity) {
        c->crossing_capacity = 2 * v + 1024;
        c->crossing =
            must_realloc(c->crossing, c->crossing_capacity, sizeof *c->crossing);
    }
    c->crossing[v] = x;
    return v;
}

static void cross_layer(struct contour *c, int k, struct layer *layer)
{
    const int limit[3] = {c->cells[0], c->cells[1], c->cells[2]};
    for (int j = 0; j <= limit[1]; j++) {
        for (int i = 0; i <= limit[0]; i++) {
            const int at[3] = {i, j, k};
            const uint8_t here = c->inside[corner_at(c, i, j, k)];
            const size_t slot = corner_at(c, i, j, 0);
            for (int axis = 0; axis < 3; axis++) {
                if (at[axis] == limit[axis])
                    continue;
                int to[3] = {i, j, k};
                to[axis]++;
                if (c->inside[corner_at(c, to[0], to[1], to[2])] != here)
                    layer->vertex[axis][slot] = add_crossing(c, at, axis, here);
            }
        }
    }
}

// ---- loops of a cell --------------------------------------------------------------------

// Corner b of a cell is at (b & 1, b >> 1 & 1, b >> 2). Faces seen from without, counter
// clockwise where x, y, z are right-handed.
static const int face_corner[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

// Edge of two corners of a cell: 4 axis + the two other bits of the lower corner.
static int edge_of(int a, int b)
{
    const int axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2;
    const int low = a & b;
    static const int rest[3][8] = {
        {0, 0, 1, 1, 2, 2, 3, 3}, {0, 1, 0, 1, 2, 3, 2, 3}, {0, 1, 2, 3, 0, 1, 2, 3}};
    return 4 * axis + rest[axis][low];
}

// next[e]: the crossed edge that follows e around the inside.
static void link_face(unsigned inside, const int corner[4], int next[12])
{
    for (int i = 0; i < 4; i++) {
        const int a = corner[i], b = corner[(i + 1) % 4];
        if ((inside >> a & 1) || !(inside >> b & 1))
            continue; // not the beginning of a run of inside corners
        int end = i + 1;
        while (inside >> corner[(end + 1) % 4] & 1)
            end++;
        next[edge_of(a, b)] = edge_of(corner[end % 4], corner[(end + 1) % 4]);
    }
}

static void add_fan(struct contour *c, struct vec3 low, const uint32_t *vertex, int count)
{
    bool feature;
    const struct vec3 p = contour_centre(c, low, vertex, count, &feature);
    const uint32_t centre = tess_mesh_add_vertex(c->mesh, p);
    if (centre >= c->feature_capacity) {
        const uint32_t old = c->feature_capacity;
        c->feature_capacity = 2 * centre + 1024;
        c->feature = must_realloc(c->feature, c->feature_capacity, sizeof *c->feature);
        memset(c->feature + old, 0, c->feature_capacity - old);
    }
    c->feature[centre] = feature;
    for (int i = 0; i < count; i++)
        tess_mesh_add_triangle(c->mesh, vertex[i], vertex[(i + 1) % count], centre);
}

static void fill_cell(struct contour *c, int i, int j, int k, const struct layer layer[2])
{
    unsigned inside = 0;
    for (int b = 0; b < 8; b++)
        inside |=
            (unsigned)c->inside[corner_at(c, i + (b & 1), j + (b >> 1 & 1), k + (b >> 2))]
            << b;
    if (inside == 0 || inside == 255)
        return;
    int next[12];
    for (int e = 0; e < 12; e++)
        next[e] = NONE;
    for (int f = 0; f < 6; f++)
        link_face(inside, face_corner[f], next);
    for (int e = 0; e < 12; e++) {
        uint32_t loop[12];
        int count = 0;
        for (int at = e; next[at] != NONE;) {
            const int axis = at / 4, rest = at % 4;
            const int dx = axis == 0 ? 0 : rest & 1;
            const int dy = axis == 1 ? 0 : axis == 0 ? rest & 1 : rest >> 1;
            const int dz = axis == 2 ? 0 : rest >> 1;
            loop[count++] = layer[dz].vertex[axis][corner_at(c, i + dx, j + dy, 0)];
            const int to = next[at];
            next[at] = NONE;
            at = to;
        }
        if (count)
            add_fan(c, corner_point(c, i, j, k), loop, count);
    }
}

static void fill_slab(struct contour *c, int k, const struct layer layer[2])
{
    for (int j = 0; j < c->cells[1]; j++)
        for (int i = 0; i < c->cells[0]; i++)
            fill_cell(c, i, j, k, layer);
}

void contour_solid(struct tess_solid *s, const struct contour_settings *settings,
                   struct tess_mesh *out)
{
    struct contour c = {.solid = s, .mesh = out, .sharp = settings->sharp};
    lay_grid(&c, settings->resolution);
    mark_corners(&c);
    struct layer layer[2];
    const size_t slots = corner_at(&c, 0, 0, 1);
    for (int l = 0; l < 2; l++)
        for (int axis = 0; axis < 3; axis++)
            layer[l].vertex[axis] = must_calloc(slots, sizeof **layer[l].vertex);
    cross_layer(&c, 0, &layer[0]);
    for (int k = 0; k < c.cells[2]; k++) {
        cross_layer(&c, k + 1, &layer[1]);
        fill_slab(&c, k, layer);
        const struct layer low = layer[0];
        layer[0] = layer[1];
        layer[1] = low;
    }
    if (c.sharp)
        contour_turn_edges(&c);
    for (int l = 0; l < 2; l++)
        for (int axis = 0; axis < 3; axis++)
            free(layer[l].vertex[axis]);
    free(c.inside);
    free(c.crossing);
    free(c.feature);
}
