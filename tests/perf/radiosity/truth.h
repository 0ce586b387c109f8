#ifndef RADIOSITY_TRUTH_H
#define RADIOSITY_TRUTH_H

#include <stdbool.h>

#include "math/vec.h"
#include "radiosity/radiosity.h"

// A parallelogram of a table by radiosity_truth: reflectance, emission relative to the
// brightest, and the mean irradiance for a light of radiosity 1.
struct bin {
    char name[32];
    struct vec3 p, a, b; // a x b points to where the light comes from
    double rho[3], h[3], e;
};

enum { BINS_MOST = 8192 };
extern struct bin bin[BINS_MOST];
extern int bins;

// In place of what was read before. Ends the process when the table cannot be read.
void truth_read(const char *path);

// The error of reflected light: the square root of the sum of area x (reflectance x error
// of the irradiance)^2 over that of area x (reflectance x irradiance)^2.
struct error_sum {
    double off, all;
};
void error_add(struct error_sum *s, double area, const double rho[3], const double got[3],
               const double truth[3]);
double error_of(const struct error_sum *s);

// The error of a solution against the bins that were read; of a furnace, whose every patch
// receives 1. interpolate: between patches, as the picture does. print: tells all differences on stderr.
double truth_error(const struct radiosity *r, bool interpolate, bool print);
double furnace_error(const struct radiosity *r, bool print);

#endif
