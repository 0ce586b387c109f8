#include "math/eigen.h"

#include <math.h>
#include <string.h>

// Cyclic Jacobi (Golub & Van Loan, section 8.5); a handful of sweeps reaches the last bits.
struct eigen eigen_of(const double symmetric[3][3])
{
    double a[3][3], v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    memcpy(a, symmetric, sizeof a);
    for (int turn = 0; turn < 24; turn++) {
        const int p = turn % 3 == 2 ? 1 : 0, q = turn % 3 == 0 ? 1 : 2;
        if (a[p][q] == 0)
            continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = copysign(1, theta) / (fabs(theta) + sqrt(theta * theta + 1));
        const double cosine = 1 / sqrt(t * t + 1), sine = t * cosine;
        for (int k = 0; k < 3; k++) {
            const double x = a[k][p], y = a[k][q];
            a[k][p] = cosine * x - sine * y;
            a[k][q] = sine * x + cosine * y;
        }
        for (int k = 0; k < 3; k++) {
            const double x = a[p][k], y = a[q][k];
            a[p][k] = cosine * x - sine * y;
            a[q][k] = sine * x + cosine * y;
            const double vx = v[k][p], vy = v[k][q];
            v[k][p] = cosine * vx - sine * vy;
            v[k][q] = sine * vx + cosine * vy;
        }
    }
    struct eigen e;
    for (int k = 0; k < 3; k++) {
        e.value[k] = a[k][k];
        e.vector[k] = vec3(v[0][k], v[1][k], v[2][k]);
    }
    return e;
}
