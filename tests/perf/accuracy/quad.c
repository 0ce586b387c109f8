#include "quad.h"

#include <math.h>

quad quad_sqrt(quad v)
{
    if (!(v > 0))
        return 0;
    quad r = sqrt((double)v);
    if (!(r > 0))
        return 0;
    for (int i = 0; i < 3; i++)
        r = (r + v / r) / 2;
    return r;
}

quad quad_value(const quad *c, int degree, quad t)
{
    quad v = c[degree];
    for (int i = degree - 1; i >= 0; i--)
        v = v * t + c[i];
    return v;
}

// Newton's method kept in the bracket by halving.
static quad root_between(const quad *c, const quad *d, int degree, quad lo, quad hi)
{
    const int rising = quad_value(c, degree, hi) >= 0;
    quad t = (lo + hi) / 2;
    for (int i = 0; i < 240; i++) {
        const quad v = quad_value(c, degree, t);
        if (v == 0)
            return t;
        if ((v > 0) == rising)
            hi = t;
        else
            lo = t;
        quad next = t - v / quad_value(d, degree - 1, t);
        if (!(next > lo && next < hi))
            next = (lo + hi) / 2;
        if (next == t || next <= lo || next >= hi)
            return t;
        t = next;
    }
    return t;
}

int quad_roots(const quad *c, int degree, quad lo, quad hi, quad *root)
{
    quad d[36], turn[37];
    if (degree < 1)
        return 0;
    for (int i = 0; i < degree; i++)
        d[i] = c[i + 1] * (i + 1);
    const int turns = quad_roots(d, degree - 1, lo, hi, turn + 1);
    turn[0] = lo;
    turn[turns + 1] = hi;
    int n = 0;
    for (int i = 0; i <= turns; i++)
        if ((quad_value(c, degree, turn[i]) >= 0) !=
            (quad_value(c, degree, turn[i + 1]) >= 0))
            root[n++] = root_between(c, d, degree, turn[i], turn[i + 1]);
    return n;
}
