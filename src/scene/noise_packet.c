// Turbulence of eight points at a time, as scene/noise.c does one.

#include <stdbool.h>
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
    const bool signed_noise =
        generator == NOISE_RANGE_CORRECTED || generator == NOISE_PERLIN;
    double n[8], l = lambda, o = omega;
    k->value(p, 1, generator, out);
    for (int i = 0; i < 8 && signed_noise; i++) {
        const double v = 2 * out[i] - 0.5;
        out[i] = v < 0 ? 0 : v > 1 ? 1 : v;
    }
    for (int octave = 2; octave <= octaves; octave++) {
        k->value(p, l, generator, n);
        for (int i = 0; i < 8; i++)
            out[i] += o * (signed_noise ? 2 * n[i] - 0.5 : n[i]);
        l *= lambda;
        o *= omega;
    }
}

void noise_dturbulence8(const struct noise_kernels *k, const double p[3][8],
                        double lambda, double omega, int octaves, double out[3][8])
{
    double v[3][8], l = lambda, o = omega;
    k->vector(p, 1, out);
    for (int octave = 2; octave <= octaves; octave++) {
        k->vector(p, l, v);
        for (int a = 0; a < 3; a++)
            for (int i = 0; i < 8; i++)
                out[a][i] += o * v[a][i];
        l *= lambda;
        o *= omega;
    }
}
