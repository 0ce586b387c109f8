#include "scene/effects.h"
#include "trace/area.h"
#include "trace/media_march.h"
#include "trace/photons.h"

// What of a lamp reaches the samples that it lights, at most as many as fit a batch.
struct lighting {
    struct media_march *m;
    const struct lamp *lamp;
    uint8_t photons; // photons_instead_in_media
    struct shadow_request request[64];
    struct rgb factor[64];
    uint32_t sample[64];
    uint32_t count;
};

// The grids of all places together.
static void area_lights(struct lighting *l)
{
    struct area_request place[64];
    const struct area_request *at[64];
    for (uint32_t i = 0; i < l->count; i++) {
        const struct shadow_request *r = &l->request[i];
        // A place in the open air: no surface to start from.
        place[i] = (struct area_request){.lamp = l->lamp,
                                         .p = r->o,
                                         .slot = r->slot,
                                         .hash = hash_mix(l->m->way->hash, ~l->sample[i]),
                                         .photons = r->photons};
        at[i] = &place[i];
    }
    area_shadows(l->m->t, at, l->count, l->factor);
}

static void shadows(struct lighting *l)
{
    const struct job *job = l->m->t->job;
    const struct light *light = l->lamp->light;
    if (!job->shadows) {
        for (uint32_t i = 0; i < l->count; i++)
            l->factor[i] = rgb(1, 1, 1);
    } else if (light->area && job->area_lights) {
        area_lights(l);
    } else if (light->projected_through) {
        for (uint32_t i = 0; i < l->count; i++)
            l->factor[i] = projected_shadow(l->m->t, l->lamp, &l->request[i]);
    } else {
        shadow_factors(l->m->t, l->request, l->count, l->factor);
    }
}

static void ask(struct lighting *l, uint32_t sample, struct vec3 p)
{
    struct lamp_view view;
    if (!lamp_view(l->lamp, l->lamp->light->location, p, &view))
        return;
    l->sample[l->count] = sample;
    l->request[l->count++] = (struct shadow_request){.o = p,
                                                     .d = view.l,
                                                     .t_max = view.distance,
                                                     .value = view.color,
                                                     .inside = l->m->way->inside,
                                                     .slot = l->m->t->slot,
                                                     .lamp = l->lamp->index,
                                                     .photons = l->photons};
}

void media_samples_lit(struct media_march *m, struct media_sample *sample,
                       const struct media_point *point, uint32_t count)
{
    struct lighting l = {.m = m};
    for (uint32_t k = 0; k < m->lamp_count; k++) {
        const struct media_lamp *lamp = &m->lamp[k];
        l.lamp = lamp->lamp;
        l.photons = photons_instead_in_media(m->t->job, m->mix, l.lamp->light);
        l.count = 0;
        for (uint32_t i = 0; i < count; i++)
            if (m->interval[sample[i].interval].lit && sample[i].t >= lamp->begin &&
                sample[i].t <= lamp->end)
                ask(&l, i, vec3_mad(m->way->o, sample[i].t, m->way->d));
        if (!l.count)
            continue;
        shadows(&l);
        for (uint32_t i = 0; i < l.count; i++) {
            const double phase = media_phase(m->mix, vec3_dot(l.request[i].d, m->way->d));
            const struct vec3 c = vec3_of_rgb(rgb_mul(l.request[i].value, l.factor[i]));
            struct media_sample *s = &sample[l.sample[i]];
            s->light =
                vec3_mad(s->light, phase, vec3_mul(c, point[l.sample[i]].scattering));
        }
    }
}
