#ifndef MATH_TRIG_H
#define MATH_TRIG_H

#include "math/dd.h"

// The numbers of math/trig.c, for those who compute in lanes with the same bits.
extern const struct dd trig_half_pi;
extern const struct dd trig_atan_eighth[9]; // atan(k / 8)

// (sin(r)/r - 1)/r^2 and (cos(r) - 1 + r^2/2)/r^4 by powers of r^2, |r| <= pi/4.
static const double TRIG_SIN[8] = {
    -1. / 6,         1. / 120,         -1. / 5040,           1. / 362880,
    -1. / 39916800., 1. / 6227020800., -1. / 1307674368000., 1. / 355687428096000.};
static const double TRIG_COS[8] = {
    1. / 24,         -1. / 720,          1. / 40320,           -1. / 3628800,
    1. / 479001600., -1. / 87178291200., 1. / 20922789888000., -1. / 6402373705728000.};

#endif
