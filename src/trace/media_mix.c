#include "trace/media_mix.h"

#include "math/elementary.h"
#include "scene/effects.h"
#include "scene/pigment_tape.h"

static bool is_even(const struct media *m)
{
    for (uint32_t i = 0; i < m->density_count; i++)
        if (m->density[i]->kind != PIGMENT_SOLID && m->density[i]->kind != PIGMENT_NONE)
            return false;
    return true;
}

static bool is_black(struct rgb c) { return c.r == 0 && c.g == 0 && c.b == 0; }

static struct vec3 extinction(const struct media *m)
{
    return vec3_mad(vec3_of_rgb(m->absorption), (double)m->extinction,
                    vec3_of_rgb(m->scattering));
}

static void point_add(struct media_point *p, const struct media *m, struct vec3 density)
{
    p->extinction = vec3_add(p->extinction, vec3_mul(density, extinction(m)));
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
    struct media_mix mix = {.media = media, .count = count, .even = true};
    for (uint32_t i = 0; i < count; i++) {
        const struct media *m = media[i];
        if (!mix.rules || m->intervals > mix.rules->intervals)
            mix.rules = m;
        if (!i || (double)m->aa_threshold < mix.aa_threshold)
            mix.aa_threshold = (double)m->aa_threshold;
        mix.even &= is_even(m);
        mix.scatters |= !is_black(m->scattering);
        mix.emits |= !is_black(m->emission);
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
        const struct vec3 e = extinction(media[i]);
        if (e.x != 0 || e.y != 0 || e.z != 0)
            out[n++] = media[i];
    }
    return n;
}

// ---- densities ---------------------------------------------------------------------

// At most eight points at a time.
struct places {
    double at[3][8], ray_d[3][8], normal[3][8];
    uint32_t count;
};

static void density_alone(const struct pigment *p, const struct places *w,
                          double out[3][8])
{
    for (uint32_t i = 0; i < w->count; i++) {
        const struct vec3 at = {w->at[0][i], w->at[1][i], w->at[2][i]};
        const struct vec3 d = {w->ray_d[0][i], w->ray_d[1][i], w->ray_d[2][i]};
        const struct texture_point point = {.p = at, .p_world = at, .ray_d = d};
        struct rgbft c;
        if (!pigment_color(p, &point, &c))
            c = (struct rgbft){0};
        out[0][i] *= (double)c.r;
        out[1][i] *= (double)c.g;
        out[2][i] *= (double)c.b;
    }
}

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

// The densities' tapes run through eight points at once (scene/pigment_tape.h).
static void density_times(const struct job *job, const struct pigment *p,
                          const struct pigment_tape *tape, const struct places *w,
                          double out[3][8])
{
    enum { WORTH = 3 };
    float c[5][8];
    if (!tape || w->count < WORTH) {
        density_alone(p, w, out);
        return;
    }
    const struct pattern_packet packet = {w->at, w->normal, w->ray_d, NULL};
    const unsigned live = (1u << w->count) - 1;
    const unsigned found = job->surface_kernels->colors(tape, &packet, w->at, live, c);
    for (int k = 0; k < 3 && found == 255; k++)
        for (uint32_t i = 0; i < 8; i++)
            out[k][i] *= (double)c[k][i];
    for (int k = 0; k < 3 && found != 255; k++)
        for (uint32_t i = 0; i < w->count; i++)
            out[k][i] *= found >> i & 1 ? (double)c[k][i] : 0;
}

static void places_fill(struct places *w, const struct media_at *at)
{
    for (uint32_t i = 0; i < 8; i++) {
        const struct media_at *p = &at[i < w->count ? i : 0];
        w->at[0][i] = p->o.x + p->t * p->d.x;
        w->at[1][i] = p->o.y + p->t * p->d.y;
        w->at[2][i] = p->o.z + p->t * p->d.z;
        w->ray_d[0][i] = p->d.x;
        w->ray_d[1][i] = p->d.y;
        w->ray_d[2][i] = p->d.z;
        w->normal[0][i] = w->normal[1][i] = w->normal[2][i] = 0;
    }
}

// Adds the density of a medium times one of its colours.
static void add_times(double sum[3][8], const double density[3][8], struct vec3 color)
{
    const double c[3] = {color.x, color.y, color.z};
    if (c[0] == 0 && c[1] == 0 && c[2] == 0)
        return;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 8; i++)
            sum[k][i] += density[k][i] * c[k];
}

static void eight(const struct job *job, const struct media_mix *mix,
                  const struct places *w, struct media_point *out)
{
    double lost[3][8] = {{0}}, given[3][8] = {{0}}, scattered[3][8] = {{0}};
    for (uint32_t k = 0; k < mix->count; k++) {
        const struct media *m = mix->media[k];
        double density[3][8];
        for (uint32_t i = 0; i < 8; i++)
            density[0][i] = density[1][i] = density[2][i] = 1;
        const struct pigment_tape *const *tape = tapes_of(job, m);
        for (uint32_t j = 0; j < m->density_count; j++)
            density_times(job, m->density[j], tape ? tape[j] : NULL, w, density);
        add_times(lost, (const double(*)[8])density, extinction(m));
        add_times(given, (const double(*)[8])density, vec3_of_rgb(m->emission));
        add_times(scattered, (const double(*)[8])density, vec3_of_rgb(m->scattering));
    }
    for (uint32_t i = 0; i < w->count; i++)
        out[i] =
            (struct media_point){{lost[0][i], lost[1][i], lost[2][i]},
                                 {given[0][i], given[1][i], given[2][i]},
                                 {scattered[0][i], scattered[1][i], scattered[2][i]}};
}

void media_points(const struct job *job, const struct media_mix *mix,
                  const struct media_at *at, uint32_t count, struct media_point *out)
{
    struct places w;
    for (uint32_t i = 0; i < count; i += 8) {
        w.count = count - i < 8 ? count - i : 8;
        places_fill(&w, at + i);
        eight(job, mix, &w, out + i);
    }
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
