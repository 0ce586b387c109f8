#ifndef SCENE_PATTERNS_CRACKLE_H
#define SCENE_PATTERNS_CRACKLE_H

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

// Shared by crackle.c and crackle_bounds.c.
enum { CRACKLE_CELLS = 81, CRACKLE_NEAREST = 3 };

extern const struct tape_extern crackle_bounds;

// ---- the powers of a metric ----------------------------------------------------------

// x^metric. Up to TWICE_MAX / 2 halves of whole numbers need no logarithm.
struct crackle_power {
    double metric;
    int twice; // 2 * metric, or 0: neither whole nor half
};

enum { TWICE_MAX = 16 };

static inline struct crackle_power crackle_power(double metric)
{
    const double twice = 2 * metric;
    const bool exact = twice >= 1 && twice <= TWICE_MAX && floor(twice) == twice;
    return (struct crackle_power){metric, exact ? (int)twice : 0};
}

static inline double crackle_raised(struct crackle_power p, double x)
{
    if (!p.twice)
        return det_pow(x, p.metric);
    double r = p.twice & 1 ? sqrt(x) : 1;
    for (int n = p.twice >> 1; n; n >>= 1) {
        if (n & 1)
            r *= x;
        x *= x;
    }
    return r;
}

// The root r of s, known in single precision: one step of Newton's method leaves the
// rounding of the power. Else the power itself.
static inline bool crackle_steps(struct crackle_power p, double s)
{
    return p.twice && s >= DBL_MIN && s <= DBL_MAX;
}

static inline double crackle_step(struct crackle_power p, double s, double r)
{
    return r + r * (s / crackle_raised(p, r) - 1) / p.metric;
}

static inline double crackle_lowered(struct crackle_power p, double s)
{
    return crackle_steps(p, s) ? crackle_step(p, s, det_pow_single(s, 1 / p.metric))
                               : det_pow(s, 1 / p.metric);
}

static inline double crackle_distance(double sum, double metric, double offset)
{
    if (metric == 2)
        return sqrt(sum + offset * offset);
    if (metric == 1)
        return sum + offset;
    const struct crackle_power p = crackle_power(metric);
    return crackle_lowered(p, offset != 0 ? sum + crackle_raised(p, offset) : sum);
}

// How many of the nearest points have a say.
static inline int crackle_wanted(const struct pattern *p)
{
    return p->solid ? 1 : p->vector.z != 0 ? 3 : p->vector.y != 0 ? 2 : 1;
}

// Cells that are likely near first.
struct crackle_cell {
    signed char x, y, z;
};

#define FACES(r)                                                                         \
    {-r, 0, 0}, {r, 0, 0}, {0, -r, 0}, {0, r, 0}, {0, 0, -r}, { 0, 0, r }
#define PAIR(r, s)                                                                       \
    {r, s, 0}, {s, r, 0}, {r, 0, s}, {s, 0, r}, {0, r, s}, { 0, s, r }
#define TRIPLE(r, s, t)                                                                  \
    {r, s, t}, {s, r, t}, { s, t, r }

static const struct crackle_cell crackle_cells[CRACKLE_CELLS] = {
    {0, 0, 0},         FACES(1),          {-1, -1, 0},      {-1, 1, 0},
    {1, -1, 0},        {1, 1, 0},         {-1, 0, -1},      {-1, 0, 1},
    {1, 0, -1},        {1, 0, 1},         {0, -1, -1},      {0, -1, 1},
    {0, 1, -1},        {0, 1, 1},         {-1, -1, -1},     {-1, -1, 1},
    {-1, 1, -1},       {-1, 1, 1},        {1, -1, -1},      {1, -1, 1},
    {1, 1, -1},        {1, 1, 1},         FACES(2),         PAIR(-2, -1),
    PAIR(-2, 1),       PAIR(2, -1),       PAIR(2, 1),       TRIPLE(-2, -1, -1),
    TRIPLE(-2, -1, 1), TRIPLE(-2, 1, -1), TRIPLE(-2, 1, 1), TRIPLE(2, -1, -1),
    TRIPLE(2, -1, 1),  TRIPLE(2, 1, -1),  TRIPLE(2, 1, 1),
};

#endif
