#ifndef SCENE_PATTERN_MATH_H
#define SCENE_PATTERN_MATH_H

#include <float.h>

#include "math/elementary.h"
#include "math/pi.h"
#include "math/quick.h"
#include "math/vec.h"
#include "scene/noise.h"
#include "scene/noise_kernel.h"
#include "scene/pattern.h"

// Not 1: the language wraps at a little more, so that 1 itself stays 1.
#define PATTERN_MODULUS 1.00001

// The pattern's wave of a value that frequency and phase are in.
double pattern_wave(const struct pattern *p, double v);

// The small functions that the formulas of spec/textures are written in (section 0).

#define QUICK_SINE_MOST 1e5
#define PATTERN_EDGE    1e-10 // EPS of the specification: part of the pictures
#define PATTERN_ROOT3   1.7320508075688772
// As the reference has them: hexagons' and cushions' proportions.
#define PATTERN_HALF_ROOT3  0.866025404
#define PATTERN_THREE_ROOT3 5.196152424
#define PATTERN_CUSHION     1.154700538

static inline double clamp01(double v) { return v < 0 ? 0 : v > 1 ? 1 : v; }

// a modulo p, never negative.
static inline double fold(double a, double p) { return a - p * floor(a / p); }

// One period of a sine per unit, but for the last two bits; rounded as the reference does.
static inline double cycloidal(double v)
{
    double sine, cosine;
    const double turn = v >= 0 ? v - floor(v) : -(v + floor(-v));
    quick_sincos(turn * 50000.0 / 50000.0 * (2 * PI), &sine, &cosine);
    return v >= 0 ? sine : -sine;
}

static inline double triangle_wave(double v)
{
    double f = v >= 0 ? v - floor(v) : v + 1 + floor(fabs(v));
    return f < 0.5 ? 2 * f : 2 * (1 - f);
}

// 1 at the centre, 0 from radius 1 on.
static inline double fade_out(double r) { return r < 0 ? 1 : r > 1 ? 0 : 1 - r; }

// A value above 1 wraps; one below 0 is left for pattern_value.
static inline double wrap_above_one(double v) { return v > 1 ? fmod(v, 1) : v; }

static inline double pattern_noise(const struct pattern *p, struct vec3 at)
{
    return noise_value(at, pattern_noise_generator(p));
}

// Turbulence of the classic element; 0 without one.
static inline double pattern_turbulence(const struct pattern *p, struct vec3 at)
{
    const struct turbulence *t = p->turbulence;
    return t ? noise_turbulence(at, t->lambda, t->omega, t->octaves,
                                pattern_noise_generator(p))
             : 0;
}

static inline int pattern_wave_count(const struct pattern *p)
{
    int n = p->defaults ? p->defaults->number_of_waves : 10;
    return n < 1 ? 1 : n;
}

// Angle of (x, z) from the x axis, 0..2pi (spec/textures 4.3).
static inline double azimuth(double x, double z)
{
    if (z == 0)
        return x > 0 ? 0 : PI;
    const double a = quick_atan2(z, x);
    return a < 0 ? 2 * PI + a : a;
}

// sin(x), but for the last two bits of most.
static inline double pattern_sine(double x)
{
    double sine, cosine;
    if (!(fabs(x) < QUICK_SINE_MOST))
        return det_sin(x);
    quick_sincos(x, &sine, &cosine);
    return sine;
}

#endif
