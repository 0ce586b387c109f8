#ifndef MATH_GAMMA_H
#define MATH_GAMMA_H

// The unit of double rounding, and the bound gamma(n) = n*u/(1 - n*u) on the relative
// error of n roundings in a row (Higham, Accuracy and Stability, 3.1). Every tolerance
// in geometry is one of these times a length that stands in the same expression.
#define ROUNDOFF 0x1p-53
#define GAMMA(n) ((n)*ROUNDOFF / (1 - (n)*ROUNDOFF))

// Whether a direction whose largest component is `size` runs along a plane: `down`, its
// component across the plane, is no more than its own rounding error. Such a crossing
// could be anywhere on the line; its error bound would swallow all others.
#define RUNS_ALONG(down, size) (!(fabs(down) > GAMMA(12) * (size)))

#endif
