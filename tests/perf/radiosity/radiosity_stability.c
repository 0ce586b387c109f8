// Where methods and solvers get into trouble, as a table: what, name, x, error or steps.
//   rho: steps of a solver to 1 %, cube of 6 x 4 x 4, against the reflectance
//   distance: error of F of two parallel unit squares against their distance
//   occluder: error of F behind a centred square against its side (O2)
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "meshes.h"
#include "radiosity/solver.h"

static void reflectance(void)
{
    static const double rho[] = {.5, .7, .8, .9, .95, .98, .99};
    static const char *const solvers[] = {"jacobi", "gauss-seidel", "cg", "shooting",
                                          "hierarchical"};
    for (size_t s = 0; s < sizeof solvers / sizeof solvers[0]; s++) {
        for (size_t k = 0; k < sizeof rho / sizeof rho[0]; k++) {
            struct mesh *m = mesh_cube(4);
            for (uint32_t i = 0; i < m->e.count; i++) {
                m->element[i].reflectance = rgb_even((float)rho[k]);
                m->element[i].emission = rgb_even(i < 16);
            }
            struct form_factor_settings ff = form_factor_defaults;
            struct solver_settings o = solver_defaults;
            struct factors f;
            struct radiosity_solution out;
            factors_compute(&f, &m->e, &ff);
            factors_balance(&f, &m->e, NULL);
            const struct radiosity_system system = {.e = &m->e, .f = &f, .factors = &ff};
            o.solver = solvers[s];
            o.tolerance = .01;
            o.overshoot = true;
            radiosity_solve(&out, &system, &o);
            printf("rho\t%s\t%g\t%u\n", solvers[s], rho[k], out.steps);
            solution_free(&out);
            factors_free(&f);
            mesh_free(m);
        }
    }
}

// F from the first to the second of two parallel unit squares, a blocker between them.
static double squares(const char *method, double distance, double blocker)
{
    struct mesh *m = mesh_new();
    mesh_add(m, vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), 1, 1);
    mesh_add(m, vec3(0, 0, distance), vec3(0, 1, 0), vec3(1, 0, 0), 1, 1);
    if (blocker > 0)
        mesh_block(m, vec3(.5 - blocker / 2, .5 - blocker / 2, distance / 2),
                   vec3(blocker, 0, 0), vec3(0, blocker, 0));
    mesh_trace(m);
    struct form_factor_settings s = form_factor_defaults;
    s.method = method;
    s.tolerance = 1e-3;
    s.depth = 4;
    struct factors f;
    factors_compute(&f, &m->e, &s);
    const double value = (double)f.f[1];
    factors_free(&f);
    mesh_free(m);
    return value;
}

static double parallel_truth(double h)
{
    const double x = 1 / h, x2 = x * x, r = sqrt(1 + x2), pi = 3.14159265358979323846;
    return 2 / (pi * x2) *
           (log(sqrt((1 + x2) * (1 + x2) / (1 + 2 * x2))) + 2 * x * r * atan(x / r) -
            2 * x * atan(x));
}

// Coaxial squares of sides a and b at distance h, from the first to the second.
static double coaxial(double a, double b, double h)
{
    const double pi = 3.14159265358979323846;
    double sum = 0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            for (int k = 0; k < 2; k++)
                for (int l = 0; l < 2; l++) {
                    const double x = (i ? a : -a) / 2 - (j ? b : -b) / 2;
                    const double y = (k ? a : -a) / 2 - (l ? b : -b) / 2;
                    const double p = sqrt(x * x + h * h), q = sqrt(y * y + h * h);
                    const double g = (y * p * atan(y / p) + x * q * atan(x / q) -
                                      h * h / 2 * log(x * x + y * y + h * h)) /
                                     (2 * pi);
                    sum += ((i + j + k + l) & 1 ? -1 : 1) * g;
                }
    return sum / (a * a);
}

int main(void)
{
    static const char *const methods[] = {"analytic", "area", "disc",
                                          "hemicube", "rays", "sobol"};
    reflectance();
    for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++)
        for (double h = 10; h > .7e-3; h /= sqrt(10))
            printf("distance\t%s\t%.4g\t%.4g\n", methods[k], h,
                   fabs(squares(methods[k], h, 0) / parallel_truth(h) - 1));
    for (size_t k = 0; k < sizeof methods / sizeof methods[0]; k++)
        for (double s = .02; s < .95; s *= 1.6) {
            // What the blocker takes away is what passes from it to the square twice as
            // far; the shadow of s fills 2 s - 1 .. 1 of the other square.
            const double truth = parallel_truth(1) - s * s * coaxial(s, 2 - s, 1);
            printf("occluder\t%s\t%.4g\t%.4g\n", methods[k], s,
                   fabs(squares(methods[k], 1, s) - truth) / parallel_truth(1));
        }
    return 0;
}
