#ifndef PERF_ACCURACY_QUAD_H
#define PERF_ACCURACY_QUAD_H

// Arithmetic of 113 bits for the reference; +, -, *, / alone, which need no library.
__extension__ typedef __float128 quad;

quad quad_sqrt(quad v);
quad quad_value(const quad *c, int degree, quad t);
// Roots on lo < t < hi at which the sign changes, ascending: between the roots of the
// derivative, bisected and polished to the last bits. Returns their number.
int quad_roots(const quad *c, int degree, quad lo, quad hi, quad *root);

#endif
