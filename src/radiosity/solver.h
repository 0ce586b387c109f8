#ifndef RADIOSITY_SOLVER_H
#define RADIOSITY_SOLVER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "radiosity/form_factor.h"

// B = E + rho (lamps + F B): radiosity B, emission E and reflectance rho of the elements,
// irradiance of light sources that are no elements.
struct radiosity_system {
    const struct enclosure *e;
    const double (*lamps)[3];                   // irradiance per element; NULL: none
    const struct factors *f;                    // NULL where the solver needs none
    const struct form_factor_settings *factors; // for solvers that compute their own
    bool closed; // nothing leaves: rows may be scaled to sum to 1 (hierarchical)
};

struct solver_settings {
    const char *solver; // a name of solvers.def
    double tolerance;   // relative error of the reflected light at which it is solved
    uint32_t steps_max; // sweeps, steps or shots; 0: what never ends a solvable case
    bool ambient;       // energy correction (gauss-seidel), ambient term (shooting)
    bool overshoot;     // shooting
    uint64_t rays;      // stochastic: in all; 0: until the tolerance is met
    double link_error;  // hierarchical: allowed error of a link, relative
    uint32_t seed;
    int threads;
    struct watch *watch;
};
extern const struct solver_settings solver_defaults;
// Bytes an element takes in the solver without a matrix.
enum { STOCHASTIC_BYTES = 900 };

struct radiosity_solution {
    uint32_t count;
    double (*b)[3];         // radiosity
    double (*h)[3];         // irradiance by the elements (without lamps)
    double (*h_emitted)[3]; // the part of h that elements emit
    uint32_t steps;
    uint64_t rays, links;
    bool converged;
    double defect; // relative defect of the energy identity, signed
    double error;  // estimated relative error of the reflected part; < 0: unknown
    double bytes;  // taken by factors or links
};

enum solver_kind {
#define SOLVER(name, option, function, matrix, help) SOLVER_##name,
#include "radiosity/solvers.def"
#undef SOLVER
    SOLVER_COUNT
};
enum solver_kind solver_find(const char *name); // SOLVER_COUNT: no such name
const char *solver_name(enum solver_kind k);
bool solver_needs_matrix(enum solver_kind k);

// False: no memory.
bool radiosity_solve(struct radiosity_solution *out, const struct radiosity_system *s,
                     const struct solver_settings *settings);
bool solution_init(struct radiosity_solution *s, uint32_t count);
void solution_free(struct radiosity_solution *s);

typedef void solver_function(struct radiosity_solution *out,
                             const struct radiosity_system *s,
                             const struct solver_settings *settings);
solver_function solve_elimination, solve_jacobi, solve_gauss_seidel, solve_shooting,
    solve_cg, solve_stochastic, solve_hierarchical;

// ---- between the solvers -------------------------------------------------
// The source term E + rho lamps.
void system_source(const struct radiosity_system *s, double (*source)[3]);
static inline void element_reflectance(const struct element *e, double rho[3])
{
    rho[0] = (double)e->reflectance.r;
    rho[1] = (double)e->reflectance.g;
    rho[2] = (double)e->reflectance.b;
}
static inline void element_emission(const struct element *e, double b[3])
{
    b[0] = (double)e->emission.r;
    b[1] = (double)e->emission.g;
    b[2] = (double)e->emission.b;
}
// h = F b.
void factors_apply(const struct factors *f, double (*b)[3], double (*h)[3], int threads);
// Gathers once more from out->b, fills h, h_emitted and the energy defect.
void solution_gather(struct radiosity_solution *out, const struct radiosity_system *s,
                     int threads);
// Area-weighted mean reflectance of a channel, at most just below 1.
double mean_reflectance(const struct enclosure *e, int channel);

#endif
