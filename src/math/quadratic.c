#include "math/quadratic.h"

int quadratic_roots(double a, double b, double c, double root[2])
{
    double d = b * b - a * c;
    if (!(d > 0) || a == 0)
        return 0;
    double q = -(b + copysign(sqrt(d), b));
    double t0 = q / a, t1 = c / q;
    root[0] = fmin(t0, t1);
    root[1] = fmax(t0, t1);
    return 2;
}
