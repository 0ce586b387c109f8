#include "math/chi_square.h"

#include "math/elementary.h"
#include "math/larger.h"
#include "math/pi.h"

#include <math.h>

// Degrees up to which the tail is summed: the terms are as many as the degrees, and beyond
// 1,400 they leave the doubles.
enum { SUMMED = 256 };

// The upper tail of the chi-square distribution: closed sums for whole degrees
// (Abramowitz and Stegun 26.4.4 and 26.4.5).
static double chi_tail(double x, int degrees)
{
    if (degrees % 2 == 0) {
        double term = 1, sum = 1;
        for (int i = 1; i < degrees / 2; i++) {
            term *= x / (2 * i);
            sum += term;
        }
        return det_exp(-x / 2) * sum;
    }
    // erfc(sqrt(x/2)) by its series, exact enough for a bisection to 1e-10
    const double z = sqrt(x / 2);
    double term = z, sum = z;
    for (int i = 1; i < 400 && term > 1e-17 * sum; i++) {
        term *= 2 * z * z / (2 * i + 1);
        sum += term;
    }
    double tail = 1 - 2 / sqrt(PI) * det_exp(-z * z) * sum;
    double part = sqrt(2 * x / PI) * det_exp(-x / 2);
    for (int i = 1; 2 * i + 1 <= degrees; i++) {
        tail += part;
        part *= x / (2 * i + 1);
    }
    return tail;
}

static double chi_summed(double probability, int degrees)
{
    double low = 0, high = 1;
    while (chi_tail(high, degrees) > probability)
        high *= 2;
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2;
        if (chi_tail(middle, degrees) > probability)
            low = middle;
        else
            high = middle;
    }
    return (low + high) / 2;
}

// The value that a normal variable exceeds with this probability: its square is of one
// degree.
static double normal_quantile(double probability)
{
    return probability < 0.5 ? sqrt(chi_summed(2 * probability, 1))
                             : -sqrt(chi_summed(2 * (1 - probability), 1));
}

// The first terms of the expansion of Cornish and Fisher (Goldberg and Levine 1946;
// Abramowitz and Stegun 26.2.49 with the cumulants of chi-square). z: the normal quantile.
static double chi_expanded(double z, int degrees)
{
    const double d = degrees, root = sqrt(2 * d), z2 = z * z;
    const double x = d + z * root + 2 * (z2 - 1) / 3 + z * (z2 - 7) / (9 * root) -
                     (z2 * (6 * z2 + 14) - 32) / (405 * d) +
                     z * (z2 * (9 * z2 + 256) - 433) / (4860 * d * root);
    return larger(x, 0);
}

void chi_square_table(double probability, int most, double *out)
{
    const double z = most > SUMMED ? normal_quantile(probability) : 0;
    out[0] = 0;
    for (int k = 1; k <= most; k++)
        out[k] = k > SUMMED ? chi_expanded(z, k) : chi_summed(probability, k);
}

void chi_square_thresholds(double confidence, double variance, int n, int most,
                           double *enough)
{
    chi_square_table(confidence, most, enough);
    const double whole = enough[n - 1];
    for (int k = 0; k <= most; k++)
        enough[k] = whole > 0 ? variance * enough[k] / whole : 0;
}
