#include "scene/effects.h"
#include "trace/area.h"
#include "trace/media_march.h"
#include "trace/photons.h"
#include "trace/projected.h"
#include "trace/shade_kernel.h"

// Samples that a lamp lights, and what of its light reaches them.
struct lighting {
    struct media_march *m;
    const struct lamp *lamp;
    uint32_t sample[MEDIA_SAMPLES];
    uint32_t count;
    double phase[MEDIA_SAMPLES];
    float color[3][MEDIA_SAMPLES];
    struct rgb factor[MEDIA_SAMPLES];
};

// The grids of all places together.
static void area_lights(struct lighting *l, const struct media_sample *sample)
{
    enum { SEEDS = 64 }; // samples of a way that are told apart by their numbers
    struct tracer *t = l->m->t;
    const struct ray_batch *b = t->near.rays;
    struct area_request place[MEDIA_SAMPLES];
    const struct area_request *at[MEDIA_SAMPLES];
    for (uint32_t i = 0; i < l->count; i++) {
        const struct media_sample *s = &sample[l->sample[i]];
        const struct media_way *way =
            l->m->walker[l->m->interval[s->interval].walker].way;
        // A place in the open air: no surface to start from.
        place[i] =
            (struct area_request){.lamp = l->lamp,
                                  .p = {b->o[0][i], b->o[1][i], b->o[2][i]},
                                  .slot = way->slot,
                                  .hash = hash_mix(way->hash, ~(s->number % SEEDS)),
                                  .photons = t->near.photons[i]};
        at[i] = &place[i];
    }
    area_shadows(t, at, l->count, l->factor);
}

static void shadows(struct lighting *l, const struct media_sample *sample)
{
    struct tracer *t = l->m->t;
    const struct light *light = l->lamp->light;
    if (!t->job->shadows) {
        for (uint32_t i = 0; i < l->count; i++)
            l->factor[i] = rgb(1, 1, 1);
    } else if (light->area && t->job->area_lights) {
        area_lights(l, sample);
    } else if (l->lamp->window) {
        window_factors_near(t, l->lamp, l->count, l->factor);
    } else {
        shadow_factors_near(t, l->lamp->index, l->count, l->factor);
    }
}

// A walker's samples among those that are found together, which stand in its order, and its
// lamps that are still to come.
struct turn {
    uint32_t walker, begin, end, lamp;
};

static uint32_t turns_of(const struct media_march *m, const struct media_sample *sample,
                         uint32_t count, struct turn *turn)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++) {
        const struct media_interval *v = &m->interval[sample[i].interval];
        if (!n || turn[n - 1].walker != v->walker)
            turn[n++] = (struct turn){v->walker, i, i, 0};
        turn[n - 1].end = i + 1;
    }
    return n;
}

// Those that the lamp may light become rays in `near`.
static void ask(struct lighting *l, const struct turn *turn,
                const struct media_lamp *lamp, const struct media_sample *sample,
                uint8_t photons)
{
    const struct media_march *m = l->m;
    const struct media_way *way = m->walker[turn->walker].way;
    struct shadow_batch *b = &m->t->near;
    for (uint32_t i = turn->begin; i < turn->end; i++) {
        if (!m->interval[sample[i].interval].lit || sample[i].t < lamp->begin ||
            sample[i].t > lamp->end)
            continue;
        const uint32_t n = l->count++;
        const struct vec3 p = vec3_mad(way->o, sample[i].t, way->d);
        l->sample[n] = i;
        b->rays->o[0][n] = p.x;
        b->rays->o[1][n] = p.y;
        b->rays->o[2][n] = p.z;
        b->slot[n] = (uint16_t)way->slot;
        b->photons[n] = photons;
    }
}

// Leaves out those that the lamp does not shine on.
static void keep_lit(struct lighting *l)
{
    struct shadow_batch *b = &l->m->t->near;
    uint32_t n = 0;
    for (uint32_t i = 0; i < l->count; i++) {
        if (!b->occluded[i]) {
            for (int a = 0; a < 3; a++) {
                b->rays->o[a][n] = b->rays->o[a][i];
                b->rays->d[a][n] = b->rays->d[a][i];
                l->color[a][n] = l->color[a][i];
            }
            b->rays->t_max[n] = b->rays->t_max[i];
            b->slot[n] = b->slot[i];
            l->sample[n++] = l->sample[i];
        }
    }
    l->count = n;
}

static void samples_lit(struct lighting *l, struct media_sample *sample,
                        const struct vec3 *scattering)
{
    const struct media_march *m = l->m;
    struct shadow_batch *b = &m->t->near;
    if (m->t->job->kernels->views(l->lamp, l->count, b->rays, b->occluded,
                                  &l->color[0][0], MEDIA_SAMPLES))
        keep_lit(l);
    if (!l->count)
        return;
    for (uint32_t i = 0; i < l->count; i++) {
        l->phase[i] = 1;
        if (m->mix->isotropic)
            continue;
        const struct media_sample *s = &sample[l->sample[i]];
        const struct media_way *way = m->walker[m->interval[s->interval].walker].way;
        const struct vec3 d = {b->rays->d[0][i], b->rays->d[1][i], b->rays->d[2][i]};
        l->phase[i] = media_phase(m->mix, vec3_dot(d, way->d));
    }
    shadows(l, sample);
    for (uint32_t i = 0; i < l->count; i++) {
        struct media_sample *s = &sample[l->sample[i]];
        const struct rgb color = {l->color[0][i], l->color[1][i], l->color[2][i]};
        s->light = vec3_mad(s->light, l->phase[i],
                            vec3_mul(vec3_of_rgb(rgb_mul(color, l->factor[i])),
                                     scattering[l->sample[i]]));
    }
}

void media_samples_lit(struct media_march *m, struct media_sample *sample,
                       const struct vec3 *scattering, uint32_t count)
{
    const struct lamp_list *all = &m->t->job->lamps[m->walker[0].way->group];
    struct turn turn[MEDIA_SAMPLES];
    const uint32_t turns = turns_of(m, sample, count, turn);
    struct lighting l; // not set to zero as a whole: it is large
    l.m = m;
    for (uint32_t k = 0; k < all->count; k++) {
        l.lamp = all->lamp[k];
        l.count = 0;
        const uint8_t photons =
            photons_instead_in_media(m->t->job, m->mix, l.lamp->light);
        for (uint32_t i = 0; i < turns; i++) {
            const struct media_walker *w = &m->walker[turn[i].walker];
            if (turn[i].lamp < w->lamp_count && w->lamp[turn[i].lamp].lamp == l.lamp)
                ask(&l, &turn[i], &w->lamp[turn[i].lamp++], sample, photons);
        }
        if (l.count)
            samples_lit(&l, sample, scattering);
    }
}

// The mean of the phase functions over the sphere, and how much it leans forwards: the first
// two terms of Legendre's series.
static void phase_terms(const struct media_mix *mix, double term[2])
{
    enum { POINTS = 64 };
    term[0] = term[1] = 0;
    for (int i = 0; i < POINTS; i++) {
        const double cosine = (2 * i + 1.0) / POINTS - 1, p = media_phase(mix, cosine);
        term[0] += p / POINTS;
        term[1] += 3 * p * cosine / POINTS;
    }
}

void media_open_lit(const struct media_march *m, struct media_sample *sample,
                    const struct vec3 *scattering, uint32_t count)
{
    const struct job *job = m->t->job;
    const struct indirect *indirect = &job->settings.indirect;
    double term[2];
    if (!indirect->open || !job->lights)
        return;
    phase_terms(m->mix, term);
    for (uint32_t i = 0; i < count; i++) {
        struct media_sample *s = &sample[i];
        const struct media_way *way = m->walker[m->interval[s->interval].walker].way;
        struct open_light x;
        double light[3];
        indirect->open(indirect->data, vec3_mad(way->o, s->t, way->d), &x);
        for (int c = 0; c < 3; c++)
            light[c] =
                fmax(0, term[0] * x.all[c] + term[1] * vec3_dot(x.from[c], way->d));
        for (uint32_t k = 0; k < x.beam_count; k++) {
            const double phase = media_phase(m->mix, vec3_dot(x.beam[k].to, way->d));
            for (int c = 0; c < 3; c++)
                light[c] += phase * x.beam[k].light[c];
        }
        s->light = vec3_add(s->light,
                            vec3_mul(vec3(light[0], light[1], light[2]), scattering[i]));
    }
}
