#include "math/pi.h"
#include "trace/indirect_lanes.h"
#include "trace/photons.h"
#include "trace/shade_kernel.h"

static struct rgb photon_lit(const struct shading *s, const struct photon *p,
                             bool side_test)
{
    const struct vec3 from = {(double)p->from[0], (double)p->from[1], (double)p->from[2]};
    const double facing = vec3_dot(s->view.n, from);
    const struct rgb energy =
        rgb_scale((float)(1 / fmax(photon_steepest, facing)), p->energy);
    return rgb_mul(energy, layers_lit(s, NULL, from, side_test));
}

// The light of photons on what lanes do not know, too.
static struct rgb lit_singly(const struct shading *s, const struct photon *photon,
                             const uint32_t *id, uint32_t count, bool side_test)
{
    struct rgb sum = {0, 0, 0};
    for (uint32_t i = 0; i < count; i++)
        sum = rgb_add(sum, photon_lit(s, &photon[id[i]], side_test));
    return sum;
}

void shade_photons(struct shading *s)
{
    const struct photons *photons = s->t->job->photons;
    const struct photon_map *m = &photons->surface;
    bool any = false, plain = true;
    if (!m->count || !photons_collect(s->at.surface))
        return;
    for (uint32_t i = 0; i < s->layer_count; i++) {
        const struct finish *f = s->layer[i].finish;
        any |= finish_takes_light(f);
        plain &= !(f->crand > 0) && f->irid == 0 &&
                 !(f->has_subsurface && s->t->job->subsurface);
    }
    if (!any)
        return;
    double reach;
    const uint32_t count = photons_gather(m, photons->gather, s->at.p, s->layer[0].n,
                                          s->t->near_photons, &reach);
    const bool side_test = !(s->at.surface->flags & OBJECT_DOUBLE_ILLUMINATE);
    const struct rgb sum = (plain ? s->t->job->kernels->caustics : lit_singly)(
        s, m->photon, s->t->near_photons->photon, count, side_test);
    if (reach > 0)
        tracer_add(s->t, rgb_mul(s->path->through,
                                 rgb_scale((float)(1 / (PI * reach * reach)), sum)));
}

void simple_photons(struct tracer *t, const struct simple_class *c,
                    const struct simple_group *g)
{
    if (!t->job->photons)
        return;
    struct shading s; // not set to zero: it is large
    struct path path = {.hash = 0};
    s.t = t;
    s.path = &path;
    s.layer = s.few;
    s.layer_count = 1;
    for (unsigned live = g->live; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        const uint32_t surface = t->job->world->leaf[t->hit->leaf[g->ray[i]]].surface;
        t->slot = g->slot[i];
        path.d = vec3(g->d[0][i], g->d[1][i], g->d[2][i]);
        path.through = rgb(g->through[0][i], g->through[1][i], g->through[2][i]);
        s.at.surface = &t->job->world->surface[surface];
        s.at.p = vec3(g->p[0][i], g->p[1][i], g->p[2][i]);
        s.few[0] =
            (struct layer){.finish = c->finish,
                           .n = vec3(g->n[0][i], g->n[1][i], g->n[2][i]),
                           .color = rgb(g->color[0][i], g->color[1][i], g->color[2][i]),
                           .att = g->att[i],
                           .filter = rgb(1, 1, 1)};
        s.view.n =
            t->job->simple[surface].normal ? bare_normal(t, g->ray[i]) : s.few[0].n;
        shade_photons(&s);
    }
}
