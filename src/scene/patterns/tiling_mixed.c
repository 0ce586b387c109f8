// Tilings of two or three kinds of regular tiles (spec/textures 6, 16 to 24)
#include "scene/patterns/tiling.h"

// Hexagons, squares and triangles; with `six`, told apart by their position.
static double hexa_square_triangle(struct place p, bool six)
{
    const double h = HALF_ROOT3;
    int mx = 0, mz = 0, turned = 0;
    double x = fold(p.x + 0.5, 3 + ROOT3), z = fold(p.z, 2 * (1 + ROOT3));
    if (x > h + 1.5) {
        x -= h + 1.5;
        z += z < ROOT3 + 1 ? h + 0.5 : -(h + 0.5);
    }
    if (z > ROOT3 + 1)
        z -= ROOT3 + 1;
    if (z > 0.5 + h) {
        z = ROOT3 + 1 - z;
        mz = 1;
    }
    if (x > 1 + h) {
        x = ROOT3 + 2 - x;
        mx = 1;
    }
    if (ROOT3 * x + z < h + 2 && x < 0.5 + h) {
        const double a = x - (1 + h), b = z - (0.5 + h);
        x = a / 2 - b * h + 1 + h;
        z = b / 2 + a * h + 0.5 + h;
        turned = 1;
        if (z < 0)
            z = -z;
        if (x > 1 + h) {
            x = ROOT3 + 2 - x;
            mx = 1 - mx;
            mz = 1 - mz;
        }
    }
    const bool hexagon = !(ROOT3 * x + z < h + 2);
    if (hexagon && z >= 0.5) {
        z = fabs(z - 0.5);
        x = fabs(x - h);
        const double m = fmin(2 * ROOT3 * z, ROOT3 * (ROOT3 * x + z) - 1.5);
        return six ? fmax(6 - m, 5.000001) / 6 : fmax(3 - m, 2.0000001) / 3;
    }
    if (z >= 0.5)
        return 0;
    if (x > h + 0.5) {
        x -= h + 0.5;
        z -= 0.5;
        const double m = max3(1 + 2 * ROOT3 * z, 1 - 2 * ROOT3 * x, 0);
        return six ? (m + turned * (1.000001 + (mx + mz) % 2)) / 6 : m / 3;
    }
    x = fabs(x - h - 0.5);
    const double m = fmax(2 - 2 * ROOT3 * x, ROOT3 * (ROOT3 * z + x) + 0.5);
    return six ? (m + ((turned + mx) % 2 ? 2 : 3)) / 6 : m / 3;
}

// Hexagons with a triangle to the right or left.
static struct place hexa_tri_strip(struct place p, bool right)
{
    const double h = HALF_ROOT3;
    const int k = (int)(p.z / h) / 3 - (p.z < 0);
    double x = p.x + (right ? k / 2.0 : -k / 2.0), z = fold(p.z, 3 * h);
    x = fold(x + 7, 7);
    if (right) {
        if (x > 4.5 && z > ROOT3) {
            x -= 4.5;
            z -= h;
        }
        if (x > 5 && z < h) {
            x -= 5;
            z += ROOT3;
        }
        if (x > 2.5 && z < ROOT3) {
            x -= 2.5;
            z += h;
        }
        return (struct place){x, z};
    }
    if (x > 2 && z < h) {
        x -= 2;
        z += ROOT3;
    }
    if (x > 4.5 && z < ROOT3) {
        x -= 4.5;
        z += h;
    }
    if (x > 2.5 && z > ROOT3) {
        x -= 2.5;
        z -= h;
    }
    return (struct place){x, z};
}

static double hexa_tri(struct place p, bool right)
{
    const double h = HALF_ROOT3;
    int other = 0;
    p = hexa_tri_strip(p, right);
    double x = p.x, z = p.z;
    int j = (int)(z / h);
    if (j == 2) {
        j = 1;
        z = 2 * ROOT3 - z;
        other = 1;
    }
    if (j == 0 || x > 2 || z + ROOT3 * x < ROOT3 || ROOT3 * x - z > ROOT3) {
        p = (struct place){fold(x, 1), fold(z, ROOT3)};
        if (p.z > h) {
            p.z = ROOT3 - p.z;
            other = 1 - other;
        }
        if (p.x > 0.5)
            p.x = 1 - p.x;
        if (tile_half(&p))
            other = 1 - other;
        return (other + tile_triangle(p)) / 3;
    }
    z -= h;
    if (x > 1)
        x = 2 - x;
    return fmax(5 - fmin(2 + 2 * ROOT3 * z, 2 + 2 * h * (ROOT3 * x + z - h)), 2.000001) /
           3;
}

// Squares and triangles in six kinds of positions.
static double square_tri(struct place p)
{
    const double h = HALF_ROOT3, period = 1 + ROOT3;
    int other = 0, group = 0, b = 0;
    double x = fold(p.x, period), z = fold(p.z, period);
    if (z > 0.5 + h) {
        z = period - z;
        other = 1 - other;
    }
    if (x > 0.5 + h) {
        x = period - x;
        other = 1 - other;
        b = 1;
    }
    const bool first = 2 * x + 2 * (ROOT3 - 1) * z / (ROOT3 + 1) > ROOT3;
    const bool second = 2 * ROOT3 * z + 2 * (ROOT3 - 3) * x / (ROOT3 + 1) > ROOT3;
    const double ox = x, oz = z;
    if (first && second) {
        group = b ? 0 : 2;
        x = h + 0.5 - ox;
        z = h + 0.5 - oz;
    } else if (first) {
        group = b ? 1 + 2 * other : 3 - 2 * other;
        x = oz;
        z = h + 0.5 - ox;
    } else if (second) {
        group = b ? 3 - 2 * other : 1 + 2 * other;
        x = h + 0.5 - oz;
        z = ox;
    } else {
        group = 2 * b;
    }
    if (x == 0)
        z = 0;
    double s = 2 * ROOT3 * z - ROOT3 + 2 * x;
    if (s < 0)
        return (group + 1 - fmin(-1.5 * s / ROOT3, 2 * ROOT3 * x)) / 6;
    s = fmin(1.5 * s / ROOT3, 1);
    return other ? fmin(fmax((6 - s) / 6, 5.000001 / 6), 1)
                 : fmax(fmin((5 - s) / 6, 5.0 / 6), 4.000001 / 6);
}

static double dodeca_tri(struct place p)
{
    const double h = HALF_ROOT3;
    int t = 0;
    double x = fold(p.x, 2 + ROOT3), z = fold(p.z, 3 + 2 * ROOT3);
    if (z > ROOT3 + 1.5) {
        z -= ROOT3 + 1.5;
        x += x < 1 + h ? 1 + h : -(1 + h);
    }
    if (x > 1 + h)
        x = 2 + ROOT3 - x;
    if (z > 1 + h) {
        z = 2 + ROOT3 - z;
        t = 1;
    }
    double d2 = x - h - 0.5 + ROOT3 * z;
    if (d2 < 0) {
        const double a = x, b = z;
        x = (1 + ROOT3) / 4 + a / 2 - h * b;
        z = (3 + ROOT3) / 4 - h * a - b / 2;
        d2 = -d2;
    }
    const double d1 = 3 * z, d3 = ROOT3 * (z - h - 0.5 + ROOT3 * x), d4 = 3 * x;
    d2 *= ROOT3;
    if (d3 < 0)
        return (fmax(d3, -1) + 1 + t) / 3;
    return (3.0000001 - fmin(fmin(d1, d2), min3(d3, d4, 1))) / 3;
}

static double dodeca_hex(struct place p, bool five)
{
    const double h = HALF_ROOT3;
    int mx = 0, mz = 0;
    double x = fold(p.x, 3 + ROOT3), z = fold(p.z, 3 + 3 * ROOT3);
    if (z > 1.5 * ROOT3 + 1.5) {
        z -= 1.5 * ROOT3 + 1.5;
        x += x < 1.5 + h ? 1.5 + h : -(1.5 + h);
    }
    if (x > 1.5 + h) {
        x = 3 + ROOT3 - x;
        mx = 1;
    }
    if (z > 1 + ROOT3) {
        z = 2 + 2 * ROOT3 - z;
        mz = 1;
    }
    if (x - h - 1.5 + ROOT3 * z < 0) {
        const double a = x, b = z;
        x = (3 + ROOT3) / 4 + a / 2 - h * b;
        z = (3 + 3 * ROOT3) / 4 - h * a - b / 2;
    }
    const double d1 = 2 * z - ROOT3, d2 = x - h - 2.5 + ROOT3 * z;
    const double d3 = z - 1.5 * ROOT3 - 0.5 + ROOT3 * x, d4 = 2 * (x - 0.5);
    const double d5 = 2 * z - 2 * ROOT3 - 1, d6 = ROOT3 * x - z - h + 0.5, d7 = d6 - 2;
    double r;
    if (d1 >= 0 && d2 >= 0 && d3 >= 0 && d4 >= 0)
        r = (five ? 5.000001 : 3.000001) - fmin(fmin(d1, d2), min3(d3, d4, 1));
    else if (d5 >= 0)
        r = 2 - fmin(d5, -d4);
    else if (d6 < 0 && d7 < 0)
        r = 1 - fmin(fmin(-d6, -d3), fmin(-d5, 1));
    else if (d6 >= 0 && d7 >= 0)
        r = 1 - min3(d7, -d1, 1);
    else
        r = (five ? 3 + (mx + mz) % 2 : 2) - min3(d6, -d2, -d7);
    return r / (five ? 5 : 3);
}

double tile_mixed(int n, struct place p)
{
    switch (n) {
    case 16: return hexa_square_triangle(p, false);
    case 17: return hexa_square_triangle(p, true);
    case 19: return hexa_tri(p, true);
    case 20: return hexa_tri(p, false);
    case 21: return square_tri(p);
    case 22: return dodeca_tri(p);
    case 23: return dodeca_hex(p, false);
    default: return dodeca_hex(p, true);
    }
}
