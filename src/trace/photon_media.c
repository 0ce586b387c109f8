#include "math/elementary.h"
#include "math/pi.h"
#include "scene/effects.h"
#include "trace/inside.h"
#include "trace/photon_flight.h"

// Photons in media (spec/lighting.md 11.6): left in steps along a leg, gathered in a ball.

static bool receives(const struct media_mix *mix)
{
    bool any = false;
    for (uint32_t i = 0; i < mix->count; i++)
        any |= mix->media[i]->collect;
    return any && mix->scatters;
}

uint8_t photons_instead_in_media(const struct job *job, const struct media_mix *mix,
                                 const struct light *light)
{
    if (!job->photons || !job->photons->media.count || light->photon_refraction < 0 ||
        !receives(mix))
        return 0;
    return light->photon_refraction > 0 ? 2 : 1;
}

static uint32_t steps_of(double length, double wish, int most)
{
    const double n = wish > 0 ? length / wish : most;
    return n >= most ? (uint32_t)most : n > 1 ? (uint32_t)n : 1;
}

static struct rgb clear_through(struct vec3 depth)
{
    return rgb((float)det_exp(-depth.x), (float)det_exp(-depth.y),
               (float)det_exp(-depth.z));
}

static struct vec3 extinction_at(const struct job *job, const struct media_mix *mix,
                                 struct vec3 p, struct vec3 d)
{
    struct media_places place;
    struct media_eight here;
    if (mix->even)
        return mix->everywhere.extinction;
    media_place(&place, 0, p, d);
    media_points(job, mix, &place, 1, &here);
    return vec3(here.extinction[0][0], here.extinction[1][0], here.extinction[2][0]);
}

// Leaves photons on the way, weaker the more of the medium lies behind them.
static void leave(struct photon_flight *f, const struct leg *leg,
                  const struct media_mix *mix, double s)
{
    const struct photon_settings *set = &f->job->scene->settings.photons;
    const double unit = f->gun->spread * set->media_factor;
    const double wish = photon_is_parallel(f->gun) ? unit : unit * leg->length;
    const uint32_t n = steps_of(s, wish, set->media_steps);
    const double step = s / n;
    struct vec3 depth = {0, 0, 0};
    for (uint32_t i = 0; i < n; i++) {
        const double r = hash_unit(hash_mix(leg->path.hash, 1000 + i)) - 0.5;
        const double t = (i + 0.5 + r * set->jitter) * step;
        const struct vec3 at = vec3_mad(leg->path.o, t, leg->path.d);
        const struct vec3 lost = extinction_at(f->job, mix, at, leg->path.d);
        const struct vec3 half = vec3_mad(depth, step / 2, lost);
        depth = vec3_mad(depth, step, lost);
        photon_leave(f, &f->left.media, leg, at, t,
                     rgb_scale((float)step, clear_through(half)));
    }
}

static void cross(struct photon_flight *f, struct leg *leg, const struct media_mix *mix,
                  double s)
{
    if (!leg->first && f->job->scene->settings.photons.media_steps > 0 && receives(mix))
        leave(f, leg, mix, s);
}

void photon_media_cross(struct photon_flight *f, struct leg *leg, double s)
{
    struct tracer *t = f->t;
    const struct path *p = &leg->path;
    if (!inside_hollow(p->inside))
        return;
    if (media_inside(p->inside)) {
        const struct media_mix mix = media_mix_inside(t, p->inside);
        cross(f, leg, &mix, s);
        leg->path.through =
            rgb_mul(p->through, media_shadow(t, p->inside, p->o, p->d, s));
    }
    if (f->job->has_air_media) {
        const struct scene *scene = f->job->scene;
        const struct media_mix mix = media_mix_of(scene->media, scene->media_count);
        cross(f, leg, &mix, s);
        if (!leg->first)
            leg->path.through = rgb_mul(p->through, media_air_shadow(t, p->o, p->d, s));
    }
}

void photon_media_lit(struct media_march *m, struct media_sample *sample,
                      const struct vec3 *scattering, uint32_t count)
{
    static const double ball = 4.0 / 3 * PI;
    const struct vec3 none = {0, 0, 0};
    const struct photons *photons = m->t->job->photons;
    struct photon_near *near = m->t->near_photons;
    if (!receives(m->mix))
        return;
    for (uint32_t k = 0; k < count; k++) {
        double reach;
        const struct media_way *way =
            m->walker[m->interval[sample[k].interval].walker].way;
        const struct vec3 p = vec3_mad(way->o, sample[k].t, way->d);
        const uint32_t n =
            photons_gather(&photons->media, photons->gather, p, none, near, &reach);
        struct vec3 sum = {0, 0, 0};
        for (uint32_t i = 0; i < n; i++) {
            const struct photon *x = &photons->media.photon[near->photon[i]];
            const struct vec3 from = {(double)x->from[0], (double)x->from[1],
                                      (double)x->from[2]};
            sum = vec3_mad(sum, media_phase(m->mix, vec3_dot(from, way->d)),
                           vec3_of_rgb(x->energy));
        }
        if (n && reach > 0)
            sample[k].light =
                vec3_mad(sample[k].light, 1 / (ball * reach * reach * reach),
                         vec3_mul(sum, scattering[k]));
    }
}
