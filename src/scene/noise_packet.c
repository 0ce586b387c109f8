// Turbulence of eight points at a time, as scene/noise.c does one.

#include <stddef.h>
#include <string.h>

#include "math/isa.h"
#include "math/processor.h"
#include "scene/noise_kernel.h"

const struct noise_kernels *noise_kernels_find(const char *name)
{
    return processor_has(name) ? ISA_NAMED(name, noise_kernels) : NULL;
}

void noise_turbulence8(const struct noise_kernels *k, const double p[3][8], double lambda,
                       double omega, int octaves, int generator, double out[8])
{
    const struct noise_octaves o = {1, lambda, 1, omega, octaves, OCTAVES_TURBULENCE};
    k->values(p, &o, generator, out);
}

void noise_dturbulence8(const struct noise_kernels *k, const double p[3][8],
                        double lambda, double omega, int octaves, double out[3][8])
{
    const struct noise_octaves o = {1, lambda, 1, omega, octaves, OCTAVES_TURBULENCE};
    k->vectors(p, &o, out);
}
