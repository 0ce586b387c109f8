#ifndef MATH_EIGEN_H
#define MATH_EIGEN_H

#include "math/vec.h"

// The eigenvalues of a symmetric matrix, in no order, and their orthonormal vectors.
struct eigen {
    double value[3];
    struct vec3 vector[3];
};

struct eigen eigen_of(const double symmetric[3][3]);

#endif
