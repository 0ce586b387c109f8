// Tables of what cells of pavements have around them (scene/patterns/paving.h)
#include "scene/patterns/paving.h"

#include "base/arena.h"

static const struct paving pavings[] = {
#define PAVING(s, t, k, a, b, c, n, ...) {s, t, k, a, b, c, n, __VA_ARGS__},
#include "scene/patterns/pavement.def"
#undef PAVING
};
enum { PAVINGS = sizeof pavings / sizeof pavings[0] };

// ---- pieces ------------------------------------------------------------------
// Which piece a cell belongs to: one of the list, moved by a vector of the period.
struct piece {
    int64_t number, m, n;
};

static struct piece piece_of(const struct paving *g, int64_t i, int64_t j)
{
    for (int k = 0; k < g->count; k++) {
        const int64_t di = i - g->cell[k][0], dj = j - g->cell[k][1];
        if (dj % g->c)
            continue;
        const int64_t n = dj / g->c, rest = di - n * g->b;
        if (rest % g->a == 0)
            return (struct piece){g->cell[k][2], rest / g->a, n};
    }
    return (struct piece){-1, i, j};
}

static bool same(struct piece a, struct piece b)
{
    return a.number == b.number && a.m == b.m && a.n == b.n;
}

// ---- squares -----------------------------------------------------------------
static unsigned round_square(const struct paving *g, int64_t i, int64_t j)
{
    const struct piece own = piece_of(g, i, j);
    bool alike[3][3]; // the neighbour at dx + 1, dz + 1 is of the same piece
    for (int dx = -1; dx <= 1; dx++)
        for (int dz = -1; dz <= 1; dz++)
            alike[1 + dx][1 + dz] = same(own, piece_of(g, i + dx, j + dz));
    unsigned out = 0;
    const bool inside[4] = {alike[0][1], alike[2][1], alike[1][0], alike[1][2]};
    for (int side = 0; side < 4; side++)
        if (!inside[side])
            out |= (unsigned)SQUARE_WALL << side;
    // A bend of the piece: the first in this order is the cell's.
    static const int8_t order[4] = {1, 3, 2, 0};
    for (int n = 0; n < 4; n++) {
        const int k = order[n], sx = paving_corners[k][0], sz = paving_corners[k][1];
        if (!alike[1 + sx][1] || !alike[1][1 + sz] || alike[1 + sx][1 + sz])
            continue;
        out |= (unsigned)SQUARE_POST << k;
        if (!(out & SQUARE_TURN) && !alike[1 - sx][1] && !alike[1][1 - sz])
            out |= SQUARE_TURN | (unsigned)k << SQUARE_TURN_CORNER;
    }
    return out;
}

// ---- triangles, and hexagons of six of them ------------------------------------
// The neighbour across local edge 0 left, 1 right, 2 bottom.
static void across(int64_t i, int64_t j, int edge, int64_t *ni, int64_t *nj)
{
    const bool up = paving_points_up(i, j);
    *ni = i;
    *nj = j;
    if (edge == 2)
        *nj += up ? -1 : 1;
    else
        *ni += (edge == 0) == up ? -1 : 1;
}

// The hexagon (a, b) round the lattice vertex x = (2 + 3a) / 2, z = (a + 2b) h that a
// triangle is a sixth of. Vertices of a triangle, in half columns and rows: left, right,
// apex; exactly one is a centre.
static struct piece hexagon_piece(const struct paving *g, int64_t i, int64_t j)
{
    const bool up = paving_points_up(i, j);
    const int64_t base = up ? j : j + 1, tip = up ? j + 1 : j;
    const int64_t vx[3] = {i, i + 2, i + 1}, vz[3] = {base, base, tip};
    for (int k = 0; k < 3; k++) {
        const int64_t a3 = vx[k] - 2;
        if (a3 % 3)
            continue;
        const int64_t a = a3 / 3, b2 = vz[k] - a;
        if (b2 % 2 == 0)
            return piece_of(g, a, b2 / 2);
    }
    return (struct piece){-1, i, j};
}

static struct piece triangle_piece(const struct paving *g, int64_t i, int64_t j)
{
    return g->sides == 6 ? hexagon_piece(g, i, j) : piece_of(g, i, j);
}

static const int vertex_edges[3][2] = {{0, 1}, {0, 2}, {1, 2}};

// Whether the six triangles round a vertex are all of one piece; on the way, whether the
// second edge met after crossing `edge` is a wall.
static bool round_vertex(const struct paving *g, int64_t i, int64_t j, struct piece own,
                         int vertex, int edge, bool *next_wall)
{
    int e = edge;
    bool one = true;
    for (int step = 0; step < 5; step++) {
        across(i, j, e, &i, &j);
        // A triangle across an edge is turned by 180 degrees: seen from inside it, the
        // edge crossed has the same number, and the vertex is the edge's other end.
        const int *ends = vertex_edges[vertex];
        const int other = ends[0] == e ? ends[1] : ends[0];
        const int turned = 3 - e - other; // the third edge
        const struct piece there = triangle_piece(g, i, j);
        one = one && same(own, there);
        for (int v = 0; v < 3; v++) // the vertex between e and the third edge
            if ((vertex_edges[v][0] == e || vertex_edges[v][1] == e) &&
                (vertex_edges[v][0] == turned || vertex_edges[v][1] == turned)) {
                vertex = v;
                break;
            }
        e = turned;
        if (step == 0) {
            int64_t ni, nj;
            across(i, j, e, &ni, &nj);
            *next_wall = !same(there, triangle_piece(g, ni, nj));
        }
    }
    return one;
}

static unsigned round_triangle(const struct paving *g, int64_t i, int64_t j)
{
    const struct piece own = triangle_piece(g, i, j);
    bool wall[3], far_wall[3][3]; // across edge e, the other edge at vertex k is a wall
    unsigned out = 0;
    for (int e = 0; e < 3; e++) {
        int64_t ni, nj;
        across(i, j, e, &ni, &nj);
        wall[e] = !same(own, triangle_piece(g, ni, nj));
        if (wall[e])
            out |= (unsigned)TRIANGLE_WALL << e;
    }
    for (int k = 0; k < 3; k++) {
        bool one = true;
        for (int side = 0; side < 2; side++) {
            const int e = vertex_edges[k][side];
            one = round_vertex(g, i, j, own, k, e, &far_wall[e][k]);
        }
        if (!wall[vertex_edges[k][0]] && !wall[vertex_edges[k][1]] && !one)
            out |= (unsigned)TRIANGLE_POST << k;
    }
    for (int n = 0; n < 6; n++) {
        const int open = paving_bends[n].open;
        if (!wall[open] && wall[paving_bends[n].closed] &&
            far_wall[open][paving_bends[n].vertex])
            out |= (unsigned)TRIANGLE_BEND << n;
    }
    return out;
}

// ---- tables --------------------------------------------------------------------
// v / by rounded down; *rest is what remains.
static int64_t divide(int64_t v, int by, int64_t *rest)
{
    static const double inverse[13] = {0,        1.0,      1.0 / 2, 1.0 / 3, 1.0 / 4,
                                       1.0 / 5,  1.0 / 6,  1.0 / 7, 1.0 / 8, 1.0 / 9,
                                       1.0 / 10, 1.0 / 11, 1.0 / 12};
    int64_t q = (int64_t)((double)v * inverse[by]), r = v - q * by; // q: off by 1 at most
    const int64_t step = (r >= by) - (r < 0);
    *rest = r - step * by;
    return q + step;
}

// The number of a cell in its period.
static unsigned in_period(const struct paving *g, int64_t i, int64_t j)
{
    int64_t row, column;
    const int64_t n = divide(j, g->c, &row);
    divide(i - n * g->b, g->a, &column);
    return (unsigned)(row * g->a + column);
}

// Which vertex of a triangle is the middle of its hexagon, and which hexagon that is.
static unsigned in_hexagon(const struct paving *g, int64_t i, int64_t j)
{
    const bool up = paving_points_up(i, j);
    int64_t vertex; // left, right, apex
    const int64_t a = divide(i + 1, 3, &vertex) - (vertex == 0);
    const int64_t row = j + ((vertex == 2) == up);
    return (in_period(g, a, (row - a) / 2) * 3 + (unsigned)vertex) * 2 + up;
}

// The inverses: a triangle of each number.
static unsigned round_sixth(const struct paving *g, unsigned number)
{
    const bool up = number % 2;
    const int vertex = (int)(number / 2 % 3), cell = (int)(number / 6);
    const int a = cell % g->a, b = cell / g->a;
    static const int left[3] = {0, 2, 1};
    return round_triangle(g, 2 + 3 * a - left[vertex], a + 2 * b - ((vertex == 2) == up));
}

static void fill(const struct paving *g, uint16_t cell[PAVING_CELLS])
{
    const unsigned n = (unsigned)(g->a * g->c), a = (unsigned)g->a;
    if (g->sides == 6)
        for (unsigned k = 0; k < 6 * n; k++)
            cell[k] = (uint16_t)round_sixth(g, k);
    else
        for (unsigned k = 0; k < n; k++)
            cell[k] = (uint16_t)(g->sides == 4 ? round_square(g, k % a, k / a)
                                               : round_triangle(g, k % a, k / a));
}

const struct paving_map *paving_map_new(struct arena *a, int sides, int tiles,
                                        int pattern)
{
    for (int i = 0; i < PAVINGS; i++) {
        const struct paving *g = &pavings[i];
        if (g->sides != sides || g->tiles != tiles || g->pattern != pattern)
            continue;
        struct paving_map *m = arena_new_struct(a, struct paving_map);
        m->paving = g;
        fill(g, m->cell);
        return m;
    }
    return NULL;
}

unsigned paving_borders(const struct paving_map *m, int64_t i, int64_t j)
{
    const struct paving *g = m->paving;
    return m->cell[g->sides == 6 ? in_hexagon(g, i, j) : in_period(g, i, j)];
}
