#ifndef MATH_ELEMENTARY_H
#define MATH_ELEMENTARY_H

// Elementary functions with the same bits on every CPU: glibc picks FMA
// variants at run time, so its results differ by an ulp between machines
// (measured with glibc 2.36). Only + - * / sqrt and explicit fma-free error
// compensation are used; errors are below 1 ulp (tests/unit/math). sqrt, floor,
// fmod, fabs of libm are exact or correctly rounded and are used as they are.
double det_sin(double x);
double det_cos(double x);
double det_tan(double x);
double det_asin(double x);
double det_acos(double x);
double det_atan(double x);
double det_atan2(double y, double x);
double det_exp(double x);
double det_log(double x);
double det_log10(double x);
double det_pow(double x, double y);
double det_sinh(double x);
double det_cosh(double x);
double det_tanh(double x);
double det_asinh(double x);
double det_acosh(double x);
double det_atanh(double x);
// For results that are kept in single precision: several times as fast, and the relative
// error is below 2^-35.
double det_exp_single(double x);
double det_pow_single(double x, double y);

#endif
