#ifndef RADIOSITY_SOLVE_GATHER_H
#define RADIOSITY_SOLVE_GATHER_H

#include "radiosity/solver.h"

struct gather {
    const struct radiosity_system *s;
    const struct solver_settings *settings;
    uint32_t seed;
    bool direct; // emitters are looked at by themselves
    uint32_t *emitter, emitter_count;
    double *up_to, power; // of emitters up to each, and of all
    double *radius;       // of emitters
    uint32_t *rank;       // of elements among emitters; or ELEMENT_NONE
    // Of the pass at hand:
    double (*b)[3], (*h)[3], (*h_emitted)[3];
    uint32_t first, count; // of the elements' rays
    uint32_t *rays;        // that had a point to start from
};
void gather_init(struct gather *g, const struct radiosity_system *s,
                 const struct solver_settings *settings, uint32_t half);
void gather_free(struct gather *g);
// Irradiance of every element from radiosities b by rays [first, first + count) of its
// sequence; h_emitted: the part that elements emit. Returns how many rays were cast.
uint64_t gather_pass(struct gather *g, double (*b)[3], uint32_t first, uint32_t count,
                     double (*h)[3], double (*h_emitted)[3]);

// Irradiance at one point by elements of radiosity g->b, from so many rays (at most 1024).
void gather_at(const struct gather *g, struct factor_state *s,
               const struct element_point *at, uint32_t seed, uint32_t rays, double h[3]);

#endif
