#ifndef EVAL_INTERNAL_H
#define EVAL_INTERNAL_H

#include "scene/pattern.h"
#include "scene/tape_build.h"

// The functions `internal(i)` (spec/language Appendix A), as steps of a tape.

enum { INTERNAL_PARAMETERS_MAX = 10 };

struct internal_function {
    const char *name;  // as functions.inc has it, without f_
    int parameters;    // after x, y, z
    int revolved;      // parameter that switches a surface of revolution on; -1: none
    const char *limit; // formula of the bound of p[0] times the value; NULL: no bound
    const char *formula;
    const struct tape_extern *noise; // instead of a formula
};

// NULL: there is no such number.
const struct internal_function *internal_function(double number);
// Its value for x, y, z and the parameters in `in`.
uint32_t internal_build(struct tape_builder *b, const struct internal_function *f,
                        const uint32_t *in, const struct pattern_defaults *d);

extern const struct tape_extern internal_tubes; // x, z, number, radius
extern const struct tape_extern internal_noise3d, internal_noise_generator,
    internal_hetero_mf, internal_ridge, internal_ridged_mf;

#endif
