#ifndef MATH_POWER_H
#define MATH_POWER_H

#include "math/dd.h"

// The numbers of math/elementary.c, for those who compute in lanes with the same bits.

// ln 2 in two parts, the first with 32 bits so that k * LN2_HIGH is exact, and
// the second as a double-double.
static const double LN2_HIGH = 0x1.62e42fee00000p-1;
static const struct dd LN2_LOW = {0x1.a39ef35793c76p-33, 0x1.cc01f97b57a08p-87};
static const double INV_LN2 = 0x1.71547652b82fep+0;

// The Taylor series of exp from r^2/2 on.
static const double EXP_TERMS[13] = {
    1. / 2,          1. / 6,           1. / 24,          1. / 120,     1. / 720,
    1. / 5040,       1. / 40320,       1. / 362880,      1. / 3628800, 1. / 39916800.,
    1. / 479001600., 1. / 6227020800., 1. / 87178291200.};

static const double SQRT_HALF = 0.70710678118654752;
static const struct dd TWO_THIRDS = {0x1.5555555555555p-1, 0x1.5555555555555p-55};

#endif
