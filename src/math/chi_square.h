#ifndef MATH_CHI_SQUARE_H
#define MATH_CHI_SQUARE_H

// out[k] for 0 <= k <= most: the value that a chi-square variable of k degrees exceeds with
// this probability, to 1e-7 of itself for 0.001 <= probability <= 0.999. Takes O(most).
void chi_square_table(double probability, int most, double *out);

// enough[k] for 1 <= k <= most: the variance of the mean at which k of n samples are enough
// (spec/lighting.md 1.4); 0 (never) for n = 1 and where the confidence is 1.
void chi_square_thresholds(double confidence, double variance, int n, int most,
                           double *enough);

#endif
