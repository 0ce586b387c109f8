#ifndef EVAL_INTERNAL_MATH_H
#define EVAL_INTERNAL_MATH_H

#include <math.h>

#include "eval/internal.h"
#include "math/elementary.h"

// What the formulas of the internal functions are written in.

#define INTERNAL_PI 3.14159265358979323846

static inline double square(double v) { return v * v; }
static inline double cube(double v) { return v * v * v; }
static inline double smaller(double a, double b) { return a < b ? a : b; }
static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double power(double a, double b) { return det_pow(a, b); }

static inline double bounded(double v, double limit)
{
    return smaller(limit, larger(v, -limit));
}

// fmod made positive.
static inline double positive_mod(double v, double period)
{
    double r = fmod(v, period);
    return r < 0 ? r + period : r;
}

// Turns the point about the y axis into the plane of the curve, moved by p[1] and
// turned by p[2] degrees; p[0] switches it on.
static inline struct vec3 revolved(struct vec3 at, const double *p)
{
    if (!(p[0] > 0))
        return at;
    double r = sqrt(at.x * at.x + at.z * at.z) - p[1];
    if (p[2] == 0)
        return vec3(r, at.y, at.z);
    double t = p[2] * INTERNAL_PI / 180, c = det_cos(t), s = det_sin(t);
    return vec3(r * c - at.y * s, r * s + at.y * c, at.z);
}

// An angle needs a direction: x for a point on the y axis.
static inline double off_axis(struct vec3 at, double x)
{
    return at.x == 0 && at.z == 0 ? x : at.x;
}

// The radius of a cross section: 1 round, 0 square, others by power.
static inline double section(double u, double v, double shape)
{
    if (shape == 1)
        return sqrt(u * u + v * v);
    u = fabs(u);
    v = fabs(v);
    if (shape == 0)
        return larger(u, v);
    return power(power(u, 2 / shape) + power(v, 2 / shape), shape * 0.5);
}

#endif
