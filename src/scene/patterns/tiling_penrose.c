// The three aperiodic tilings of Penrose, by repeated subdivision (spec/textures 6.1, 6.2)
#include "scene/patterns/tiling.h"

#define GOLDEN 1.6180339887498949
#define SMALL  (GOLDEN - 1)
#define TINY   1e-6

// sine and cosine of whole degrees
struct angle {
    double s, c;
};
static const struct angle a18 = {0.30901699437494742, 0.95105651629515357},
                          a36 = {0.58778525229247313, 0.80901699437494742},
                          a54 = {0.80901699437494742, 0.58778525229247313},
                          a72 = {0.95105651629515357, 0.30901699437494742},
                          a108 = {0.95105651629515357, -0.30901699437494742},
                          a126 = {0.80901699437494742, -0.58778525229247313},
                          a144 = {0.58778525229247313, -0.80901699437494742},
                          a162 = {0.30901699437494742, -0.95105651629515357};

static double tangent(struct angle a) { return a.s / a.c; }
static struct angle minus(struct angle a) { return (struct angle){-a.s, a.c}; }

static struct place turn(struct place p, struct angle a)
{
    return (struct place){p.x * a.c + p.z * a.s, p.z * a.c - p.x * a.s};
}

static struct place grown(struct place p)
{
    return (struct place){GOLDEN * p.x, GOLDEN * p.z};
}
static struct place shifted(struct place p, double dx)
{
    return (struct place){p.x + dx, p.z};
}

// Into the first tenth of the circle.
static struct place fold_five(struct place p)
{
    const double r = sqrt(p.x * p.x + p.z * p.z);
    p.z = fabs(p.z);
    if (p.x < r * a36.c) {
        p = turn(p, p.x < r * a108.c ? a144 : a72);
        p.z = fabs(p.z);
    }
    return p;
}

// Distance to the line through (at, 0) in the direction of an angle.
static double off(struct place p, double at, struct angle a)
{
    return fabs(a.s * (p.x - at) - a.c * p.z);
}

static int levels(double ratio, double base)
{
    const double n = ceil(det_log(ratio) / det_log(base));
    return n > 0 ? (int)fmin(n, 1000) : 0;
}

// ---- kites and darts, thick and thin rhombs ------------------------------------
static double low(double a, double b)
{
    return fmin(max3(0.5 - a / 2, 0.5 - b / 2, 0), 0.5 - TINY);
}
static double high(double a, double b) { return max3(1 - a / 2, 1 - b / 2, 0.5 + TINY); }

static double kite_value(struct place p, bool rhombs)
{
    if (!rhombs)
        return low(4.46 * off(p, 0, a36), 4.46 * off(p, 1, a108));
    const double edge = 5.55 * off(p, SMALL, a72);
    if (p.z < (p.x - SMALL) * tangent(a72))
        return high(edge, 5.55 * off(p, 1, a108));
    return low(5.55 * fabs(p.z), edge);
}

static double dart_value(struct place p, bool rhombs)
{
    if (!rhombs)
        return high(4.46 * fabs(p.z), 4.46 * off(p, 1, a144));
    return low(5.55 * off(p, 0, a36), 5.55 * off(p, 1, a144));
}

static double kites_and_darts(struct place p, int n, bool rhombs)
{
    bool kite = true;
    for (; n > 0; n--) {
        p.z = fabs(p.z);
        if (kite) {
            if (p.z < (p.x - SMALL) * tangent(a144))
                kite = false;
            else
                p = turn((struct place){p.x - a36.c, p.z - a36.s}, minus(a108));
        } else if (p.z < (p.x - SMALL) * tangent(a108)) {
            p = turn(p, a36);
            kite = true;
        } else {
            p = turn(shifted(p, -1), a144);
        }
        p = grown(p);
    }
    p.z = fabs(p.z);
    return kite ? kite_value(p, rhombs) : dart_value(p, rhombs);
}

static double two_tiles(struct place p, bool rhombs)
{
    if (sqrt(p.x * p.x + p.z * p.z) <= PATTERN_EDGE)
        return 1;
    p = fold_five(p);
    if (rhombs)
        p = (struct place){p.x * SMALL, p.z * SMALL};
    const int n = levels(off(p, 0, a108) / a18.c, GOLDEN + 1);
    const double scale = det_pow(2 - GOLDEN, n);
    p = (struct place){p.x * scale, p.z * scale};
    if (n & 1) {
        p = turn(p, a36);
        p.z = fabs(p.z);
    }
    return kites_and_darts(p, 2 * n, rhombs);
}

// ---- pentagons, stars, boats, diamonds ------------------------------------------
enum tile { PENTAGON_A, PENTAGON_B, PENTAGON_C, STAR, BOAT, DIAMOND };

struct walk {
    enum tile tile;
    bool flag; // PENTAGON_B: quad; PENTAGON_C, BOAT: wedge; DIAMOND: variant a
    struct place p;
};

#define P1_B     (0.5 / a36.s)
#define P1_A     (0.5 / tangent(a36))
#define P1_EDGE  (5.55 * SMALL)
#define SMALLEST (2 - GOLDEN)

static struct walk step_to(enum tile tile, bool flag, double x, double z)
{
    return (struct walk){tile, flag, {x, z}};
}

static struct walk from_b(struct place p, bool quad)
{
    const double B = P1_B, A = P1_A;
    if (!quad) {
        if (p.z < (p.x + B) * tangent(a18))
            return step_to(DIAMOND, false, p.x + B - SMALLEST * B, p.z);
        p = turn(p, a36);
        return step_to(PENTAGON_C, false, -p.x - a72.c * B, p.z - a72.s * B);
    }
    (void)A;
    if (p.z < (p.x - SMALLEST * B) * tangent(a54))
        return step_to(PENTAGON_A, false, p.x - B, p.z);
    if (p.z < (p.x - SMALLEST * B) * tangent(a162))
        return step_to(DIAMOND, true, -p.x, p.z);
    p = turn(p, minus(a108));
    return step_to(PENTAGON_B, true, p.x + SMALL * B, p.z);
}

static struct walk from_c(struct place p, bool wedge)
{
    const double B = P1_B, A = P1_A;
    if (wedge && p.x > SMALLEST * B * a72.c)
        return step_to(PENTAGON_B, true, -(p.x - SMALLEST * B * a72.c - SMALL * A), p.z);
    if (!wedge && p.x < B * a108.c) {
        p = turn(p, a144);
        return step_to(PENTAGON_B, false, p.x - B, p.z);
    }
    if (!wedge && p.z > (p.x - SMALLEST * B) * tangent(a126)) {
        p = turn(p, minus(a36));
        return step_to(PENTAGON_C, false, -p.x - a72.c * B, p.z - a72.s * B);
    }
    return step_to(BOAT, wedge, p.x, p.z);
}

static struct walk step(struct walk w)
{
    const double B = P1_B, A = P1_A;
    struct place p = w.p;
    p.z = fabs(p.z);
    switch (w.tile) {
    case PENTAGON_A:
        p = fold_five(p);
        if (p.z < (p.x - A) * tangent(a54) + 0.5)
            return step_to(PENTAGON_B, false, p.x - A - SMALL * B * a72.c, p.z);
        p = turn(p, a36);
        return step_to(STAR, false, p.x, p.z);
    case PENTAGON_B: return from_b(p, w.flag);
    case PENTAGON_C: return from_c(p, w.flag);
    case STAR:
        if (p.x < SMALL * A)
            return step_to(PENTAGON_A, false, p.x, p.z);
        return step_to(PENTAGON_C, true, -(p.x - 2 * SMALL * A), p.z);
    case BOAT:
        if (w.flag && p.x > GOLDEN * B * a108.c)
            return step_to(PENTAGON_A, false, -p.x, p.z);
        if (!w.flag)
            p = turn(p, minus(a72));
        return step_to(PENTAGON_C, true, p.x + B, p.z);
    default:
        return w.flag ? step_to(PENTAGON_A, false, p.x, p.z)
                      : step_to(PENTAGON_C, true, p.x, p.z);
    }
}

static double sixth(double v, int n)
{
    return fmin(fmax(v, n ? n / 6.0 + TINY : 0), (n + 1) / 6.0 - TINY);
}

static double last_value(struct walk w)
{
    const double B = P1_B, F = P1_EDGE;
    struct place p = w.p;
    p.z = fabs(p.z);
    if (w.tile <= PENTAGON_C) {
        p = fold_five(p);
        return sixth((1 + (int)w.tile - F * fabs(p.x - P1_A)) / 6, (int)w.tile);
    }
    if (w.tile == DIAMOND)
        return fmin(fmax(1 - F * off(p, -SMALL * B, a18) / 6, 5 / 6.0 + TINY), 1 - TINY);
    if (w.tile == STAR)
        return sixth((4 - F * off(p, GOLDEN * B, a162)) / 6, 3);
    const double e1 = F * fabs(p.x - SMALL * B * a72.c);
    p = fold_five((struct place){-p.x, p.z});
    const double e2 = F * off(p, GOLDEN * B, a162);
    return fmin(max3((5 - e1) / 6, (5 - e2) / 6, 4 / 6.0 + TINY), 5 / 6.0 - TINY);
}

static double pentagons(struct place p)
{
    if (sqrt(p.x * p.x + p.z * p.z) <= PATTERN_EDGE)
        return 1;
    p = fold_five(p);
    const int n = levels(2 * p.x * tangent(a36), (GOLDEN + 1) * (GOLDEN + 1));
    const double scale = det_pow(SMALLEST * SMALLEST, n);
    struct walk w = {PENTAGON_A, false, {p.x * scale, p.z * scale}};
    for (int i = 4 * n; i > 0; i--) {
        w = step(w);
        w.p = grown(w.p);
    }
    return last_value(w);
}

double tile_penrose(int n, struct place p)
{
    return n == 25 ? pentagons(p) : two_tiles(p, n == 27);
}
