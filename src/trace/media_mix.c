#include "trace/media_mix.h"

#include <string.h>

#include "trace/shade_kernel.h"

static bool is_even(const struct media *m)
{
    for (uint32_t i = 0; i < m->density_count; i++)
        if (m->density[i]->kind != PIGMENT_SOLID && m->density[i]->kind != PIGMENT_NONE)
            return false;
    return true;
}

static bool is_black(struct rgb c) { return c.r == 0 && c.g == 0 && c.b == 0; }

static void point_add(struct media_point *p, const struct media *m, struct vec3 density)
{
    p->extinction = vec3_add(p->extinction, vec3_mul(density, media_extinction(m)));
    p->emission = vec3_add(p->emission, vec3_mul(density, vec3_of_rgb(m->emission)));
    p->scattering =
        vec3_add(p->scattering, vec3_mul(density, vec3_of_rgb(m->scattering)));
}

static struct vec3 even_density(const struct media *m)
{
    struct vec3 density = {1, 1, 1};
    for (uint32_t i = 0; i < m->density_count; i++)
        density = vec3_mul(density, vec3_of_rgb(rgbft_rgb(m->density[i]->color)));
    return density;
}

struct media_mix media_mix_of(const struct media *const *media, uint32_t count)
{
    struct media_mix mix = {
        .media = media, .count = count, .even = true, .isotropic = true};
    for (uint32_t i = 0; i < count; i++) {
        const struct media *m = media[i];
        if (!mix.rules || m->intervals > mix.rules->intervals)
            mix.rules = m;
        if (!i || (double)m->aa_threshold < mix.aa_threshold)
            mix.aa_threshold = (double)m->aa_threshold;
        mix.even &= is_even(m);
        mix.scatters |= !is_black(m->scattering);
        mix.emits |= !is_black(m->emission);
        mix.isotropic &= m->scattering_type < 2;
    }
    for (uint32_t i = 0; i < count && mix.even; i++)
        point_add(&mix.everywhere, media[i], even_density(media[i]));
    return mix;
}

uint32_t media_opaque_only(const struct media *const *media, uint32_t count,
                           const struct media **out)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct vec3 e = media_extinction(media[i]);
        if (e.x != 0 || e.y != 0 || e.z != 0)
            out[n++] = media[i];
    }
    return n;
}

// ---- densities ---------------------------------------------------------------------

static const struct pigment_tape *const *tapes_of(const struct job *job,
                                                  const struct media *m)
{
    uint32_t low = 0, high = job->media_tapes_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (job->media_tapes[middle].media <= m)
            low = middle;
        else
            high = middle;
    }
    return high && job->media_tapes[low].media == m ? job->media_tapes[low].tape : NULL;
}

void media_points(const struct job *job, const struct media_mix *mix,
                  struct media_places *place, uint32_t count, struct media_eight *out)
{
    const uint32_t blocks = (count + 7) / 8;
    memset(out, 0, blocks * sizeof *out);
    for (uint32_t i = count; i < 8 * blocks; i++)
        for (int a = 0; a < 3; a++) {
            struct media_places *last = &place[blocks - 1];
            last->at[a][i % 8] = last->at[a][0];
            last->ray_d[a][i % 8] = last->ray_d[a][0];
        }
    for (uint32_t k = 0; k < mix->count; k++)
        job->kernels->media_add(mix->media[k], tapes_of(job, mix->media[k]), place, count,
                                out);
}

// ---- phase functions -----------------------------------------------------------------

static double power_8(double v)
{
    v *= v;
    v *= v;
    return v * v;
}

// Of one medium (spec/lighting.md 10.4); the constants make the means over the sphere 1 in
// the language's own measure.
static double phase(const struct media *m, double cosine)
{
    const double half = (1 + cosine) / 2, g = (double)m->eccentricity;
    switch (m->scattering_type) {
    case 2: return 0.576655375 * (1 + 9 * power_8(half));
    case 3: return 0.495714547 * (1 + 50 * power_8(half * half * half * half));
    case 4: return 0.799372013 * (1 + cosine * cosine);
    case 5: {
        const double q = 1 + g * g - 2 * g * cosine;
        return q > 0 ? (1 - g * g) / (q * sqrt(q)) : 0;
    }
    default: return 1; // isotropic, and media without scattering
    }
}

double media_phase(const struct media_mix *mix, double cosine)
{
    double sum = 0;
    for (uint32_t i = 0; i < mix->count; i++)
        sum += phase(mix->media[i], cosine);
    return sum / mix->count;
}
