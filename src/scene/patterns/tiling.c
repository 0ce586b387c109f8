// tiling N: the plane covered by tiles, value 1 at the joints (spec/textures 6)
#include "scene/patterns/tiling.h"
#include "scene/pattern_formula.h"

double tile_lozenge(struct place p)
{
    const double h = HALF_ROOT3;
    if (2 * p.z > h)
        p = (struct place){1.5 - p.x, h - p.z};
    if (p.x > 0.75)
        p.x -= 1;
    if (p.x != 0 && p.z / p.x > ROOT3)
        p = (struct place){0.5 - p.x, h - p.z};
    return fmax(1 - 4 * ROOT3 * p.z / 3, 1 - 2 * ROOT3 * fabs(ROOT3 * p.x - p.z) / 3);
}

// A cell of a block of squares: where its tile starts, and which kind it is.
struct cell {
    signed char x, z, kind;
};

static struct place in_cell(struct place p, struct cell c)
{
    return (struct place){p.x - c.x, p.z - c.z};
}

static const struct cell *cell_at(const struct cell *cells, struct place p, int width)
{
    return &cells[(int)p.x + width * (int)p.z];
}

static struct place fold_both(struct place p, double period)
{
    return (struct place){fold(p.x, period), fold(p.z, period)};
}

static double hexagon(struct place p)
{
    const double h = HALF_ROOT3;
    double x = fold(p.x + 0.5, 3), z = fold(p.z, ROOT3);
    if (z > h)
        z = ROOT3 - z;
    if (x > 1.5) {
        x -= 1.5;
        z = h - z;
    }
    if (ROOT3 * x + z < h) {
        x = 0.5 - x;
        z = h - z;
    }
    if (x > 1)
        x = 2 - x;
    return clamp01(fmax(1 - z / h, 1 - (ROOT3 * x + z - h) / ROOT3));
}

static double triangle(struct place p)
{
    int other = 0;
    p.x = fold(p.x, 1);
    p.z = fold(p.z, ROOT3);
    if (p.z > HALF_ROOT3) {
        p.z = ROOT3 - p.z;
        other = 1;
    }
    if (p.x > 0.5)
        p.x = 1 - p.x;
    if (tile_half(&p) == 1)
        other = 1 - other;
    return other / 2.0 + tile_triangle(p) / 2;
}

static double lozenge(struct place p)
{
    p.x = fold(p.x, 1);
    p.z = fold(p.z, ROOT3);
    if (p.z > HALF_ROOT3) {
        p.z -= HALF_ROOT3;
        p.x += 0.5;
    }
    return tile_lozenge(p);
}

static double rhombus(struct place p)
{
    const double h = HALF_ROOT3;
    int kind = 0;
    double x = fold(p.x + 0.5, 3), z = fold(p.z, ROOT3);
    if (z > h) {
        z = ROOT3 - z;
        kind = 2 - kind;
    }
    if (x > 1.5) {
        x -= 1.5;
        z = h - z;
        kind = 2 - kind;
    }
    if (x < 0.5) {
        x = 1 - x;
        kind = 2 - kind;
    }
    x -= 0.5;
    p = (struct place){x, z};
    if (x == 0 || z / x > ROOT3) {
        p = (struct place){x / 2 + z * h, z / 2 - x * h};
        kind = 1;
    }
    return clamp01(tile_lozenge(p) / 3 + kind / 3.0);
}

static double rectangle(struct place p)
{
    static const struct cell cells[16] = {{0, 1, 1}, {2, 0, 0}, {2, 0, 0}, {3, 0, 1},
                                          {0, 1, 1}, {1, 2, 1}, {3, 1, 0}, {3, 1, 0},
                                          {0, 2, 0}, {1, 2, 1}, {2, 3, 1}, {4, 2, 0},
                                          {1, 3, 0}, {1, 3, 0}, {2, 3, 1}, {3, 4, 1}};
    p = fold_both(p, 4);
    const struct cell *c = cell_at(cells, p, 4);
    return tile_rectangle(in_cell(p, *c), c->kind) / 2 + c->kind / 2.0;
}

static double rectangle_pair(struct place p)
{
    static const struct cell cells[16] = {{0, 1, 1}, {1, 1, 1}, {3, 0, 0}, {3, 0, 0},
                                          {0, 1, 1}, {1, 1, 1}, {3, 1, 0}, {3, 1, 0},
                                          {1, 2, 0}, {1, 2, 0}, {2, 3, 1}, {3, 3, 1},
                                          {1, 3, 0}, {1, 3, 0}, {2, 3, 1}, {3, 3, 1}};
    p = fold_both(p, 4);
    const struct cell *c = cell_at(cells, p, 4);
    return (tile_rectangle(in_cell(p, *c), c->kind) + c->kind) / 2;
}

static double octa_square(struct place p)
{
    const double period = ROOT2 + 1, half = ROOT2 / 2 + 0.5;
    double x = fabs(fold(p.x, period) - half), z = fabs(fold(p.z, period) - half);
    if (z > x) {
        double swap = x;
        x = z;
        z = swap;
    }
    if (x + z < ROOT2 / 2)
        return (x + z) / ROOT2;
    return max3(0.500000000001, 1 - z, (1.5 * ROOT2 - (x + z)) / ROOT2);
}

static double square_triangle(struct place p)
{
    const double h = HALF_ROOT3;
    p.x = fold(p.x, 1);
    p.z = fold(p.z, 2 + ROOT3);
    if (p.z > h + 1) {
        p.z -= h + 1;
        p.x += p.x > 0.5 ? -0.5 : 0.5;
    }
    if (p.x > 0.5)
        p.x = 1 - p.x;
    p.z -= 1;
    if (p.z > 0) {
        int other = tile_half(&p) != 0;
        return (other + tile_triangle(p)) / 3;
    }
    if (p.z < -0.5)
        p.z = -1 - p.z;
    if (p.x > 0.5)
        p.x = 1 - p.x;
    return (5.0000001 - min3(2 + 2 * ROOT3 * fabs(p.x), 2 + 2 * ROOT3 * fabs(p.z), 3)) /
           3;
}

static double hexa_triangle(struct place p)
{
    const double h = HALF_ROOT3;
    int other = 0;
    double x = fold(p.x + 0.5, 2), z = fold(p.z, 2 * ROOT3);
    if (z > ROOT3) {
        z -= ROOT3;
        x += x < 1 ? 1 : -1;
    }
    if (z > h) {
        z = ROOT3 - z;
        other = 1;
    }
    if (x > 1)
        x = 2 - x;
    const double t = ROOT3 * x + z - h;
    if (ROOT3 * x + z < h)
        return (other + fmax(1 - 2 * ROOT3 * z, 1 + t * ROOT3)) / 3;
    return fmax(5 - fmin(2 + 2 * ROOT3 * z, 2 + 2 * h * t), 2.0000001) / 3;
}

static double square_offset(struct place p)
{
    p.z = fold(p.z, 2);
    if (p.z > 1) {
        p.x += 0.5;
        p.z -= 1;
    }
    p.x = fold(p.x, 1);
    return tile_square(p);
}

static double square_and_rectangles(struct place p)
{
    static const struct cell cells[9] = {{0, 1, 2}, {2, 0, 1}, {2, 0, 1},
                                         {0, 1, 2}, {1, 1, 0}, {2, 2, 2},
                                         {1, 2, 1}, {1, 2, 1}, {2, 2, 2}};
    const struct cell *c = cell_at(cells, p, 3);
    p = in_cell(p, *c);
    const double m = c->kind == 0 ? tile_square(p) : tile_rectangle(p, c->kind == 2);
    return (m + c->kind) / 3;
}

static double square_internal(struct place p, bool five)
{
    const double u = fold(p.x * ROOT2, 4) - 2, w = fold(p.z * ROOT2, 4) - 2;
    const double x = fabs(u), z = fabs(w);
    const int c = (int)x + 2 * (int)z;
    if (c == 0) {
        double m = 2 * fmax(fmax(x - 0.5, 0), fmax(z - 0.5, 0));
        return five ? (4.000001 + m) / 5 : m / 3;
    }
    const bool side = c == 1 || (c == 3 && x > z);
    double a = 2 * fabs(1.5 - (side ? x : z));
    const double b = side ? (five ? u < 0 : 2) : (five ? (w < 0 ? 2 : 3) : 1);
    if (c == 3 || (side ? z : x) > 0.5)
        a = fmax(a, 1 - ROOT2 * fabs(x - z));
    return (a + b) / (five ? 5 : 3);
}

static double square_double(struct place p)
{
    static const struct cell cells[25] = {
        {0, 0, 0}, {2, 0, 1}, {2, 0, 1}, {4, 1, 1}, {4, 1, 1}, {1, 2, 1}, {1, 2, 1},
        {2, 1, 0}, {4, 1, 1}, {4, 1, 1}, {1, 2, 1}, {1, 2, 1}, {3, 3, 1}, {3, 3, 1},
        {4, 2, 0}, {0, 4, 1}, {1, 3, 0}, {3, 3, 1}, {3, 3, 1}, {5, 4, 1}, {0, 4, 1},
        {2, 5, 1}, {2, 5, 1}, {3, 4, 0}, {5, 4, 1}};
    p = fold_both(p, 5);
    const struct cell *c = cell_at(cells, p, 5);
    p = in_cell(p, *c);
    if (c->kind == 0)
        return tile_square(p) / 2;
    return fmax(2 * (fmax(fabs(p.x), 0.5) - 0.5), 2 * (fmax(fabs(p.z), 0.5) - 0.5)) / 2 +
           0.50000001;
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *context)
{
    (void)context;
    struct place q = {at.x, at.z};
    const int n = p->integer[0];
    switch (n) {
    case 1:
        return tile_square(
            (struct place){fabs(q.x) - floor(fabs(q.x)), fabs(q.z) - floor(fabs(q.z))});
    case 2: return hexagon(q);
    case 3: return triangle(q);
    case 4: return lozenge(q);
    case 5: return rhombus(q);
    case 6: return rectangle(q);
    case 7: return octa_square(q);
    case 8: return square_triangle(q);
    case 9: return hexa_triangle(q);
    case 10: return square_offset(q);
    case 11: return square_and_rectangles(fold_both(q, 3));
    case 12:
        q = fold_both(q, 6);
        return square_and_rectangles((struct place){fabs(q.x - 3), fabs(q.z - 3)});
    case 13: return square_internal(q, false);
    case 14: return square_internal(q, true);
    case 15: return square_double(q);
    case 18: return rectangle_pair(q);
    case 25:
    case 26:
    case 27: return tile_penrose(n, q);
    default: return tile_mixed(n, q);
    }
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    return formula_unknown(f, -1, 2, at); // 0 to a little more than 1
}

const struct pattern_ops tiling_pattern_ops = {
    .keyword = "tiling", .frequency = 1, .value = value, .formula = formula};
