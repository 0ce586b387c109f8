#ifndef MATH_GAMMA_H
#define MATH_GAMMA_H

// The unit of double rounding, and the bound gamma(n) = n*u/(1 - n*u) on the relative
// error of n roundings in a row (Higham, Accuracy and Stability, 3.1). Every tolerance
// in geometry is one of these times a length that stands in the same expression.
#define ROUNDOFF 0x1p-53
#define GAMMA(n) ((n) * ROUNDOFF / (1 - (n) * ROUNDOFF))

#endif
