// pavement: the plane cut into equal pieces of triangles, squares or hexagons, the value
// rising from 0 inside to 1 at the joints (spec/textures 7)
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

#include <stdint.h>

#define ROOT3      1.73205080756887729353
#define HALF_ROOT3 0.86602540378443864676

struct paving {
    int sides, tiles, pattern;
    int a, b, c; // period: (a, 0) and (b, c)
    int count;
    int8_t cell[12][3]; // column, row, piece
};

static const struct paving pavings[] = {
#define PAVING(s, t, k, a, b, c, n, ...) {s, t, k, a, b, c, n, __VA_ARGS__},
#include "scene/patterns/pavement.def"
#undef PAVING
};

static const struct paving *find(const struct pattern *p)
{
    for (size_t i = 0; i < sizeof pavings / sizeof pavings[0]; i++)
        if (pavings[i].sides == p->integer[0] && pavings[i].tiles == p->integer[1] &&
            pavings[i].pattern == p->integer[2])
            return &pavings[i];
    return &pavings[0];
}

// Which piece a cell belongs to: one of the list, moved by a vector of the period.
struct piece {
    int64_t number, m, n;
};

// Rows and columns far out are of no use to anyone, but must not overflow.
static int64_t whole(double v)
{
    const double far = 1e15;
    return (int64_t)(v > far ? far : v < -far ? -far : v);
}

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
struct square {
    bool same[3][3]; // the neighbour at dx + 1, dz + 1 is of the same piece
    double u, w;     // -1..1
    int form, exterior, interior;
};

static bool wall_x(const struct square *s, int side) { return !s->same[1 + side][1]; }
static bool wall_z(const struct square *s, int side) { return !s->same[1][1 + side]; }

static bool post(const struct square *s, int sx, int sz)
{
    return !wall_x(s, sx) && !wall_z(s, sz) && !s->same[1 + sx][1 + sz];
}

// A bend of the piece, rounded or cut off. False: none in this cell.
static bool square_form(const struct square *s, double *out)
{
    static const int corners[4][2] = {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}};
    if (s->form == 3)
        return false;
    for (int i = 0; i < 4; i++) {
        const int sx = corners[i][0], sz = corners[i][1];
        if (!post(s, sx, sz) || !wall_x(s, -sx) || !wall_z(s, -sz))
            continue;
        const double a = -sx * s->u, b = -sz * s->w;
        if (s->form == 0)
            *out = fmax(fmax(a, b), fmin(-a, -b));
        else if (s->form == 1)
            *out = fmin(fabs(a + b + 1), 1);
        else
            *out = fmin(fabs(sqrt((a + 1) * (a + 1) + (b + 1) * (b + 1)) - 1), 1);
        return true;
    }
    return false;
}

static double square_corner(const struct square *s, int sx, int sz, double r)
{
    if (post(s, sx, sz)) {
        const double a = 1 - sx * s->u, b = 1 - sz * s->w;
        if (s->interior == 0)
            r = fmax(r, fmin(1 - a, 1 - b));
        else
            r = fmax(r, s->interior == 1 ? 1 - (a + b) : 1 - sqrt(a * a + b * b));
    }
    if (wall_x(s, sx) && wall_z(s, sz)) {
        const double a = sx * s->u, b = sz * s->w;
        if (s->exterior == 1)
            r = fmax(r, fmin(a + b, 1));
        else if (s->exterior == 2 && a >= 0 && b >= 0)
            r = fmax(r, fmin(sqrt(a * a + b * b), 1));
    }
    return r;
}

static double squares(const struct pattern *p, const struct paving *g, struct vec3 at)
{
    const double fx = floor(at.x), fz = floor(at.z);
    const int64_t i = whole(fx), j = whole(fz);
    const struct piece own = piece_of(g, i, j);
    struct square s = {.u = 2 * (at.x - fx) - 1,
                       .w = 2 * (at.z - fz) - 1,
                       .form = p->integer[3],
                       .exterior = p->exterior_type,
                       .interior = p->interior_type};
    for (int dx = -1; dx <= 1; dx++)
        for (int dz = -1; dz <= 1; dz++)
            s.same[1 + dx][1 + dz] = same(own, piece_of(g, i + dx, j + dz));
    double r = 0;
    if (square_form(&s, &r))
        return r;
    for (int side = -1; side <= 1; side += 2) {
        if (wall_x(&s, side))
            r = fmax(r, side * s.u);
        if (wall_z(&s, side))
            r = fmax(r, side * s.w);
    }
    for (int sx = -1; sx <= 1; sx += 2)
        for (int sz = -1; sz <= 1; sz += 2)
            r = square_corner(&s, sx, sz, r);
    return r;
}

// ---- triangles, and hexagons of six of them ------------------------------------
struct triangle {
    int64_t i, j; // i - j even: points up
    double x, z;  // in the upright triangle (0,0) (1,0) (1/2, h)
};

static struct triangle triangle_at(struct vec3 at)
{
    const double h = HALF_ROOT3;
    const double bx = floor(at.x), bz = floor(at.z / ROOT3);
    double x = at.x - bx, z = at.z - ROOT3 * bz;
    int64_t i = 2 * whole(bx), j = 2 * whole(bz);
    if (z > h) {
        z -= h;
        j++;
        i += x > 0.5 ? 1 : -1;
        x += x > 0.5 ? -0.5 : 0.5;
    }
    if (x == 0 || z / x > ROOT3) {
        x = 0.5 - x;
        z = h - z;
        i--;
    }
    if (x == 1 || z / (1 - x) > ROOT3) {
        x = 1.5 - x;
        z = h - z;
        i++;
    }
    return (struct triangle){i, j, x, z};
}

static bool points_up(int64_t i, int64_t j) { return ((i - j) & 1) == 0; }

// The neighbour across local edge 0 left, 1 right, 2 bottom.
static void across(int64_t i, int64_t j, int edge, int64_t *ni, int64_t *nj)
{
    const bool up = points_up(i, j);
    *ni = i;
    *nj = j;
    if (edge == 2)
        *nj += up ? -1 : 1;
    else
        *ni += (edge == 0) == up ? -1 : 1;
}

static int64_t floor_half(int64_t v) { return v >= 0 ? v / 2 : -((1 - v) / 2); }

// The hexagon (a, b) round the lattice vertex x = (2 + 3a) / 2, z = (a + 2b) h that a
// triangle is a sixth of. Vertices of a triangle, in half columns and rows: left, right,
// apex; exactly one is a centre.
static struct piece hexagon_piece(const struct paving *g, int64_t i, int64_t j)
{
    const bool up = points_up(i, j);
    const int64_t base = up ? j : j + 1, tip = up ? j + 1 : j;
    const int64_t vx[3] = {i, i + 2, i + 1}, vz[3] = {base, base, tip};
    for (int k = 0; k < 3; k++) {
        const int64_t a3 = vx[k] - 2;
        if (a3 % 3)
            continue;
        const int64_t a = a3 / 3, b2 = vz[k] - a;
        if (b2 % 2 == 0)
            return piece_of(g, a, floor_half(b2));
    }
    return (struct piece){-1, i, j};
}

static struct piece triangle_piece(const struct paving *g, int64_t i, int64_t j)
{
    return g->sides == 6 ? hexagon_piece(g, i, j) : piece_of(g, i, j);
}

// Local vertices: top (edges 0, 1), left (0, 2), right (1, 2).
enum vertex { TOP, LEFT, RIGHT };
static const int vertex_edges[3][2] = {{0, 1}, {0, 2}, {1, 2}};

struct view {
    bool wall[3], post[3];
    bool far_wall[3][3]; // across edge e, the other edge at vertex v is a wall
    double x, z, d[3];
    double alpha, beta, gamma;
    int form, exterior, interior;
};

// Whether the six triangles round a vertex are all of one piece; on the way, whether the
// second edge met after crossing `edge` is a wall.
static bool round_vertex(const struct paving *g, struct triangle t, struct piece own,
                         int vertex, int edge, bool *next_wall)
{
    int64_t i = t.i, j = t.j;
    int e = edge;
    bool one = true, first = true;
    struct piece here = own;
    for (int step = 0; step < 5; step++) {
        across(i, j, e, &i, &j);
        // A triangle across an edge is turned by 180 degrees: seen from inside it, the
        // edge crossed has the same number, and the vertex is the edge's other end.
        const int *ends = vertex_edges[vertex];
        const int other = ends[0] == e ? ends[1] : ends[0];
        const int turned = 3 - e - other; // the third edge
        const struct piece there = triangle_piece(g, i, j);
        one = one && same(own, there);
        here = there;
        for (int v = 0; v < 3; v++) // the vertex between e and the third edge
            if ((vertex_edges[v][0] == e || vertex_edges[v][1] == e) &&
                (vertex_edges[v][0] == turned || vertex_edges[v][1] == turned)) {
                vertex = v;
                break;
            }
        e = turned;
        if (first) {
            int64_t ni, nj;
            across(i, j, e, &ni, &nj);
            *next_wall = !same(here, triangle_piece(g, ni, nj));
            first = false;
        }
    }
    return one;
}

static void look_round(const struct paving *g, struct triangle t, struct view *v)
{
    const struct piece own = triangle_piece(g, t.i, t.j);
    for (int e = 0; e < 3; e++) {
        int64_t ni, nj;
        across(t.i, t.j, e, &ni, &nj);
        v->wall[e] = !same(own, triangle_piece(g, ni, nj));
    }
    for (int k = 0; k < 3; k++) {
        bool one = true;
        for (int side = 0; side < 2; side++) {
            const int e = vertex_edges[k][side];
            one = round_vertex(g, t, own, k, e, &v->far_wall[e][k]);
        }
        v->post[k] = !v->wall[vertex_edges[k][0]] && !v->wall[vertex_edges[k][1]] && !one;
    }
}

static bool in_region(const struct view *v, int vertex)
{
    switch (vertex) {
    case TOP: return v->alpha < 0 && v->beta < 0;
    case LEFT: return v->alpha > 0 && v->gamma > 0;
    default: return v->gamma < 0 && v->beta > 0;
    }
}

static double at_post(const struct view *v, int vertex)
{
    const double x = v->x, z = v->z, h = HALF_ROOT3;
    const double left = 1.5 * fabs(ROOT3 * z + x), right = 1.5 * fabs(ROOT3 * z - x + 1);
    static const double vx[3] = {0.5, 0, 1};
    const double dx = x - vx[vertex], dz = z - (vertex == TOP ? h : 0);
    if (v->interior == 2)
        return 1 - 3 * sqrt(dx * dx + dz * dz);
    if (v->interior == 0)
        return vertex == TOP    ? 1 - 2 * ROOT3 * (h - z)
               : vertex == LEFT ? 1 - ROOT3 * fabs(ROOT3 * x + z)
                                : 1 - ROOT3 * fabs(ROOT3 * (x - 1) - z);
    if (!in_region(v, vertex))
        return 0;
    return vertex == TOP    ? fmin(left - 2, right - 2)
           : vertex == LEFT ? fmin(1 - left, 1 - 3 * x)
                            : fmin(1 - right, 3 * x - 2);
}

// Corners between two walls, of triangular cells.
static double outside(const struct view *v, double r)
{
    const double X = v->x - 0.5, Z = v->z - HALF_ROOT3 / 3;
    const bool *w = v->wall;
    if (v->exterior == 2 && ((w[0] && w[1] && v->alpha <= 0 && v->beta <= 0) ||
                             (w[1] && w[2] && v->beta >= 0 && v->gamma <= 0) ||
                             (w[0] && w[2] && v->alpha >= 0 && v->gamma >= 0)))
        return fmin(1, 2 * ROOT3 * sqrt(X * X + Z * Z));
    if (v->exterior != 1)
        return r;
    if (w[0] && w[1] && v->d[0] >= 0 && v->d[1] >= 0)
        r = fmin(1, fabs(2 * ROOT3 * Z));
    if (w[1] && w[2] && v->d[1] >= 0 && v->d[2] >= 0)
        r = fmin(1, ROOT3 * fabs(ROOT3 * X - Z));
    if (w[0] && w[2] && v->d[0] >= 0 && v->d[2] >= 0)
        r = fmin(1, ROOT3 * fabs(ROOT3 * X + Z));
    return r;
}

// Inner angles of 120 degrees, cut off or rounded.
static double bent(const struct view *v, double r)
{
    static const struct {
        int open, closed, vertex, center; // center: of the arc
    } bends[6] = {{0, 1, TOP, LEFT},  {0, 2, LEFT, TOP},   {1, 0, TOP, RIGHT},
                  {1, 2, RIGHT, TOP}, {2, 0, LEFT, RIGHT}, {2, 1, RIGHT, LEFT}};
    const double bevel[6] = {-2 * v->alpha, 2 * v->alpha, -2 * v->beta,
                             2 * v->beta,   2 * v->gamma, -2 * v->gamma};
    static const double vx[3] = {0.5, 0, 1};
    for (int i = 0; i < 6; i++) {
        const int o = bends[i].open, k = bends[i].vertex, c = bends[i].center;
        if (v->wall[o] || !v->wall[bends[i].closed] || !v->far_wall[o][k] ||
            !in_region(v, k))
            continue;
        if (v->form == 1)
            return fmin(bevel[i], 1);
        const double dx = v->x - vx[c], dz = v->z - (c == TOP ? HALF_ROOT3 : 0);
        const double d = sqrt(dx * dx + dz * dz) - ROOT3 / 3;
        return fmin(fmax(2 * ROOT3 * d, 0), 1);
    }
    return r;
}

static double triangles(const struct pattern *p, const struct paving *g, struct vec3 at)
{
    const struct triangle t = triangle_at(at);
    struct view v = {.x = t.x,
                     .z = t.z,
                     .d = {1 - ROOT3 * fabs(ROOT3 * t.x - t.z),
                           1 - ROOT3 * fabs(ROOT3 * (1 - t.x) - t.z),
                           1 - 2 * ROOT3 * t.z},
                     .alpha = 1 - fabs(ROOT3 * t.z + t.x),
                     .beta = 1 - fabs(ROOT3 * t.z - t.x + 1),
                     .gamma = 1 - 2 * t.x,
                     .form = p->integer[3],
                     .exterior = p->exterior_type,
                     .interior = p->interior_type};
    look_round(g, t, &v);
    double r = 0;
    for (int e = 0; e < 3; e++)
        if (v.wall[e])
            r = fmax(r, v.d[e]);
    for (int k = 0; k < 3; k++)
        if (v.post[k])
            r = fmax(r, at_post(&v, k));
    if (g->sides == 3)
        r = outside(&v, r);
    return v.form ? bent(&v, r) : r;
}

static void init(struct pattern *p)
{
    p->integer[0] = 3;
    p->integer[1] = p->integer[2] = 1;
}

static const char *finish(struct pattern *p)
{
    const int sides = p->integer[0];
    p->exterior_type %= 3;
    p->interior_type %= 3;
    p->integer[3] %= sides == 4 ? 4 : 3;
    if (p->exterior_type < 0 || p->interior_type < 0 || p->integer[3] < 0)
        return "pavement: exterior, interior and form are 0 or more";
    if (sides != 3 && sides != 4 && sides != 6)
        return "pavement: number_of_sides is 3, 4 or 6";
    if (p->integer[1] > (sides == 6 ? 5 : 6))
        return "pavement: so many tiles cannot be joined";
    const struct paving *g = find(p);
    return g->sides == sides && g->tiles == p->integer[1] && g->pattern == p->integer[2]
               ? NULL
               : "pavement: there is no such pattern of these tiles";
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const struct paving *g = find(p);
    return g->sides == 4 ? squares(p, g, at) : triangles(p, g, at);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    return formula_unknown(f, -1, 2, at); // 0 to a little more than 1
}

const struct pattern_ops pavement_pattern_ops = {.keyword = "pavement",
                                                 .frequency = 1,
                                                 .init = init,
                                                 .finish = finish,
                                                 .value = value,
                                                 .formula = formula};
