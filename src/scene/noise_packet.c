// Turbulence of eight points at a time, as scene/noise.c does one.

#include <stddef.h>
#include <string.h>

#include "scene/noise.h"
#include "scene/noise_kernel.h"

const struct noise_kernels *noise_kernels_find(const char *name)
{
#ifdef LAMBERT_X86
    if (strcmp(name, "avx512") == 0)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                       __builtin_cpu_supports("avx512vl") &&
                       __builtin_cpu_supports("avx512bw")
                   ? &noise_kernels_avx512
                   : NULL;
    if (strcmp(name, "avx2") == 0)
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2")
                   ? &noise_kernels_avx2
                   : NULL;
#endif
    return strcmp(name, "base") == 0 ? &noise_kernels_base : NULL;
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
