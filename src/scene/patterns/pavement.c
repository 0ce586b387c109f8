// pavement: the plane cut into equal pieces of triangles, squares or hexagons, the value
// rising from 0 inside to 1 at the joints (spec/textures 7)
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"
#include "scene/patterns/paving.h"

#define ROOT3      1.73205080756887729353
#define HALF_ROOT3 0.86602540378443864676

// Rows and columns far out are of no use to anyone, but must not overflow.
static int64_t whole(double v)
{
    const double far = 1e14;
    return (int64_t)(!(v < far) ? far : v < -far ? -far : v);
}

// One instruction each; fmax and fmin are calls.
static double most(double a, double b) { return a < b ? b : a; }
static double least(double a, double b) { return b < a ? b : a; }

// ---- squares -----------------------------------------------------------------
struct square {
    unsigned borders; // enum paving_square
    double u, w;      // -1..1
    int form, exterior, interior;
};

// A bend of the piece, rounded or cut off, at a corner.
static double square_turn(const struct square *s, int corner)
{
    const double a = -paving_corners[corner][0] * s->u,
                 b = -paving_corners[corner][1] * s->w;
    if (s->form == 0)
        return most(most(a, b), least(-a, -b));
    if (s->form == 1)
        return least(fabs(a + b + 1), 1);
    return least(fabs(sqrt((a + 1) * (a + 1) + (b + 1) * (b + 1)) - 1), 1);
}

static double square_post(const struct square *s, int corner, double r)
{
    const double a = 1 - paving_corners[corner][0] * s->u,
                 b = 1 - paving_corners[corner][1] * s->w;
    if (s->interior == 0)
        return most(r, least(1 - a, 1 - b));
    return most(r, s->interior == 1 ? 1 - (a + b) : 1 - sqrt(a * a + b * b));
}

// Between two walls.
static double square_outside(const struct square *s, int corner, double r)
{
    const double a = paving_corners[corner][0] * s->u,
                 b = paving_corners[corner][1] * s->w;
    if (s->exterior == 1)
        return most(r, least(a + b, 1));
    return a >= 0 && b >= 0 ? most(r, least(sqrt(a * a + b * b), 1)) : r;
}

static double squares(const struct pattern *p, const struct paving_map *m, struct vec3 at)
{
    const double fx = floor(at.x), fz = floor(at.z);
    const struct square s = {.borders = paving_borders(m, whole(fx), whole(fz)),
                             .u = 2 * (at.x - fx) - 1,
                             .w = 2 * (at.z - fz) - 1,
                             .form = p->integer[3],
                             .exterior = p->exterior_type,
                             .interior = p->interior_type};
    if (s.form != 3 && s.borders & SQUARE_TURN)
        return square_turn(&s, s.borders >> SQUARE_TURN_CORNER);
    const double side[4] = {-s.u, s.u, -s.w, s.w};
    double r = 0;
    for (int k = 0; k < 4; k++)
        r = s.borders & (unsigned)SQUARE_WALL << k ? most(r, side[k]) : r;
    for (int k = 0; k < 4; k++) {
        const unsigned walls = 1u << (k >> 1) | 4u << (k & 1); // of this corner
        if (s.borders & (unsigned)SQUARE_POST << k)
            r = square_post(&s, k, r);
        if (s.exterior && (s.borders & walls) == walls)
            r = square_outside(&s, k, r);
    }
    return r;
}

// ---- triangles, and hexagons of six of them ------------------------------------
struct view {
    unsigned borders; // enum paving_triangle
    double x, z;      // in the upright triangle (0, 0) (1, 0) (1/2, h)
    double d[3], alpha, beta, gamma;
    int form, exterior, interior;
};

static struct view view_of(const struct paving_map *m, struct vec3 at)
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
    return (struct view){.borders = paving_borders(m, i, j),
                         .x = x,
                         .z = z,
                         .d = {1 - ROOT3 * fabs(ROOT3 * x - z),
                               1 - ROOT3 * fabs(ROOT3 * (1 - x) - z), 1 - 2 * ROOT3 * z},
                         .alpha = 1 - fabs(ROOT3 * z + x),
                         .beta = 1 - fabs(ROOT3 * z - x + 1),
                         .gamma = 1 - 2 * x};
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
    return vertex == TOP    ? least(left - 2, right - 2)
           : vertex == LEFT ? least(1 - left, 1 - 3 * x)
                            : least(1 - right, 3 * x - 2);
}

// Corners between two walls, of triangular cells.
static double outside(const struct view *v, double r)
{
    const double X = v->x - 0.5, Z = v->z - HALF_ROOT3 / 3;
    const bool w[3] = {v->borders & TRIANGLE_WALL, v->borders & TRIANGLE_WALL << 1,
                       v->borders & TRIANGLE_WALL << 2};
    if (v->exterior == 2 && ((w[0] && w[1] && v->alpha <= 0 && v->beta <= 0) ||
                             (w[1] && w[2] && v->beta >= 0 && v->gamma <= 0) ||
                             (w[0] && w[2] && v->alpha >= 0 && v->gamma >= 0)))
        return least(1, 2 * ROOT3 * sqrt(X * X + Z * Z));
    if (v->exterior != 1)
        return r;
    if (w[0] && w[1] && v->d[0] >= 0 && v->d[1] >= 0)
        r = least(1, fabs(2 * ROOT3 * Z));
    if (w[1] && w[2] && v->d[1] >= 0 && v->d[2] >= 0)
        r = least(1, ROOT3 * fabs(ROOT3 * X - Z));
    if (w[0] && w[2] && v->d[0] >= 0 && v->d[2] >= 0)
        r = least(1, ROOT3 * fabs(ROOT3 * X + Z));
    return r;
}

// Inner angles of 120 degrees, cut off or rounded.
static double bent(const struct view *v, double r)
{
    const double bevel[6] = {-2 * v->alpha, 2 * v->alpha, -2 * v->beta,
                             2 * v->beta,   2 * v->gamma, -2 * v->gamma};
    static const double vx[3] = {0.5, 0, 1};
    for (int i = 0; i < 6; i++) {
        const int c = paving_bends[i].centre;
        if (!(v->borders & (unsigned)TRIANGLE_BEND << i) ||
            !in_region(v, paving_bends[i].vertex))
            continue;
        if (v->form == 1)
            return least(bevel[i], 1);
        const double dx = v->x - vx[c], dz = v->z - (c == TOP ? HALF_ROOT3 : 0);
        const double d = sqrt(dx * dx + dz * dz) - ROOT3 / 3;
        return least(most(2 * ROOT3 * d, 0), 1);
    }
    return r;
}

static double triangles(const struct pattern *p, const struct paving_map *m,
                        struct vec3 at)
{
    struct view v = view_of(m, at);
    v.form = p->integer[3];
    v.exterior = p->exterior_type;
    v.interior = p->interior_type;
    double r = 0;
    for (int e = 0; e < 3; e++)
        r = v.borders & (unsigned)TRIANGLE_WALL << e ? most(r, v.d[e]) : r;
    for (int k = 0; k < 3; k++)
        if (v.borders & (unsigned)TRIANGLE_POST << k)
            r = most(r, at_post(&v, k));
    if (m->paving->sides == 3 && v.exterior)
        r = outside(&v, r);
    return v.form ? bent(&v, r) : r;
}

static void init(struct pattern *p)
{
    p->integer[0] = 3;
    p->integer[1] = p->integer[2] = 1;
}

static const char *wrong(struct pattern *p, struct arena *a)
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
    p->paving = paving_map_new(a, sides, p->integer[1], p->integer[2]);
    return p->paving ? NULL : "pavement: there is no such pattern of these tiles";
}

static const char *finish(struct pattern *p, struct arena *a)
{
    const char *error = wrong(p, a);
    if (error) { // the scene is read on, and may ask for values
        init(p);
        p->paving = paving_map_new(a, 3, 1, 1);
    }
    return error;
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const struct paving_map *m = p->paving;
    return m->paving->sides == 4 ? squares(p, m, at) : triangles(p, m, at);
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
