#include "trace/photons.h"

// How obliquely photons may come in before they count no more (spec/lighting.md 11.5).
static const double steepest = 0.1;

// Whether the surface gathers photons.
static bool collects(const struct surface *s)
{
    return !s->photons || s->photons->collect;
}

static struct rgb photon_lit(const struct shading *s, const struct photon *p,
                             bool side_test)
{
    const struct vec3 from = {(double)p->from[0], (double)p->from[1], (double)p->from[2]};
    const double facing = vec3_dot(s->view.n, from);
    const struct rgb energy = rgb_scale((float)(1 / fmax(steepest, facing)), p->energy);
    return rgb_mul(energy, layers_lit(s, NULL, from, side_test));
}

void shade_photons(struct shading *s)
{
    static const double pi = 3.14159265358979323846;
    const struct photons *photons = s->t->job->photons;
    const struct photon_map *m = &photons->surface;
    bool any = false;
    if (!m->count || !collects(s->at.surface))
        return;
    for (uint32_t i = 0; i < s->layer_count; i++)
        any |= finish_takes_light(s->layer[i].finish);
    if (!any)
        return;
    double reach;
    const uint32_t count = photons_gather(m, &photons->gather, s->at.p, s->layer[0].n,
                                          s->t->near_photons, &reach);
    const bool side_test = !(s->at.surface->flags & OBJECT_DOUBLE_ILLUMINATE);
    struct rgb sum = {0, 0, 0};
    for (uint32_t i = 0; i < count; i++)
        sum = rgb_add(sum,
                      photon_lit(s, &m->photon[s->t->near_photons->photon[i]], side_test));
    if (reach > 0)
        tracer_add(s->t, rgb_mul(s->path->through,
                                 rgb_scale((float)(1 / (pi * reach * reach)), sum)));
}
