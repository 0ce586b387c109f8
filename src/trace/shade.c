#include "trace/shade.h"

#include "base/arena.h"
#include "trace/contact.h"
#include "trace/media.h"
#include "trace/paint.h"
#include "trace/photons.h"
#include "trace/subsurface.h"

static struct layer *layer_new(struct shading *s)
{
    if (s->layer_count == s->layer_capacity) {
        struct layer *more =
            arena_new_array(s->t->arena, struct layer, 2 * (size_t)s->layer_capacity);
        for (uint32_t i = 0; i < s->layer_count; i++)
            more[i] = s->layer[i];
        s->layer = more;
        s->layer_capacity *= 2;
    }
    return &s->layer[s->layer_count++];
}

// Light that a layer gives off by itself.
static void add_own(struct shading *s, const struct layer *l)
{
    const struct job *job = s->t->job;
    const struct finish *f = l->finish;
    const struct rgb own = rgb_add(rgb_mul(f->ambient, job->ambient_light), f->emission);
    const struct rgb c = rgb_mul(rgb_mul(l->color, l->filter), rgb_scale(l->att, own));
    tracer_add(s->t, rgb_mul(s->path->through, c));
}

// The layers of one plain texture, from the top (spec/lighting.md 5.2).
void shade_plain(void *user, const struct surface_view *v, const struct texture *x,
                 const struct texture_point *at, const struct texture_chain *chain,
                 double weight)
{
    struct shading *s = user;
    const struct job *job = s->t->job;
    struct plain_result r = {.begin = s->layer_count,
                             .weight = (float)weight,
                             .trans = 1,
                             .filter = rgb_even((float)weight)};
    struct rgb filter = {1, 1, 1}, plain = {0, 0, 0};
    for (uint32_t i = x->layer_count; i-- > 0 && r.trans > job->adc_bailout;) {
        struct layer *l = layer_new(s);
        if (v->painted)
            layer_painted(s->t, &x->layer[i], &v->painted[i], l);
        else
            layer_eval(s->t, v, &x->layer[i], at, chain, true, l);
        l->filter = r.filter;
        l->trans = r.trans;
        plain = l->color;
        if (!s->dark && job->lights)
            add_own(s, l);
        if (!l->found)
            continue;
        r.any = true;
        struct rgb pass = l->pass;
        if (l->finish->conserve_energy) {
            float weight_unused;
            const struct rgb mirror = layer_reflectivity(s, l, &weight_unused);
            pass = rgb_mul(pass, rgb(fminf(1, 1 - mirror.r), fminf(1, 1 - mirror.g),
                                     fminf(1, 1 - mirror.b)));
        }
        filter = rgb_mul(filter, pass);
        r.filter = rgb_scale((float)weight, filter);
        r.trans = fminf(1, fabsf(rgb_luminance(filter)));
    }
    if (!job->lights) {
        // The quickest levels show the plain colour of the lowest layer that is seen.
        s->layer_count = r.begin;
        tracer_add(s->t, rgb_mul(s->path->through, rgb_scale((float)weight, plain)));
        return;
    }
    r.end = s->layer_count;
    s->go_on(s, &r);
}

struct rgb matt_part(const struct shading *s, bool back, const struct layer **first)
{
    struct rgb sum = {0, 0, 0};
    *first = NULL;
    for (uint32_t i = 0; i < s->layer_count; i++) {
        const struct layer *l = &s->layer[i];
        const float matt = (back ? l->finish->matt_back : l->finish->matt) * l->att;
        if (!(rgb_luminance(l->filter) * matt > s->t->job->settings.indirect.least))
            continue;
        if (!*first)
            *first = l;
        sum = rgb_add(sum, rgb_scale(matt, rgb_mul(l->color, l->filter)));
    }
    return sum;
}

struct rgb indirect_light(struct tracer *t, const struct indirect_hit *h, bool back)
{
    const struct indirect *indirect = &t->job->settings.indirect;
    const struct interaction *at = h->at;
    const struct vec3 d = h->ray->d;
    struct vec3 side = vec3_dot(at->ng, d) > 0 ? vec3_neg(at->ng) : at->ng;
    struct vec3 n = vec3_dot(at->ns, d) > 0 ? vec3_neg(at->ns) : at->ns;
    if (indirect->layer_normals)
        n = h->n;
    if (back) {
        side = vec3_neg(side);
        n = vec3_neg(n);
    }
    const struct path *p = h->path;
    const struct indirect_query q = {h->ray,    h->hit,    at,      n,         side,
                                     p->weight, p->inside, p->hash, p->sample, p->level};
    return indirect->irradiance(indirect->data, t->indirect, t, &q);
}

// Light by way of other surfaces, on what is matt of all layers of one side.
static void shade_indirect(struct shading *s, const struct hit *hit,
                           const struct ray *ray, bool back, const struct rgb *known)
{
    const struct layer *first;
    const struct rgb matt = matt_part(s, back, &first);
    if (rgb_max(matt) <= 0)
        return;
    const struct indirect_hit h = {ray, hit, &s->at, first->n, s->path};
    const struct rgb c = known ? *known : indirect_light(s->t, &h, back);
    tracer_add(s->t, rgb_mul(s->path->through, rgb_mul(matt, c)));
}

void shade_painted(struct tracer *t, const struct path *path, const struct hit *hit,
                   const struct interaction *at, const struct paint_part *part,
                   uint32_t part_count, const struct rgb *known)
{
    struct path here = *path;
    if (t->job->has_media && t->job->general) { // else media_wave has been there
        const struct world *w = t->job->world;
        media_apply(t, &here, hit->b.t,
                    w->surface[w->leaf[hit->b.leaf].surface].light_group);
    }
    path_meets(&here);
    struct shading s;
    s.t = t;
    s.path = &here;
    s.s = hit->b.t;
    s.at = *at;
    s.layer = s.few;
    s.layer_count = 0;
    s.layer_capacity = HIT_LAYERS;
    s.dark = false;
    s.contact = contact_at(&s);
    s.go_on = shade_transmit;
    const struct ray ray = {path->o, path->d, 0, INFINITY};
    surface_view_init(&s.view, &s.at, path->d);
    for (uint32_t i = 0; i < part_count; i++) {
        s.view.painted = part[i].layer;
        shade_plain(&s, &s.view, part[i].texture, NULL, NULL, part[i].weight);
    }
    if (!part_count)
        texture_walk(t, &s.view, shade_plain, &s);
    if (!t->job->lights)
        return;
    if (t->job->settings.indirect.data)
        shade_indirect(&s, hit, &ray, false, known);
    if (t->job->settings.indirect.both_sides)
        shade_indirect(&s, hit, &ray, true, NULL);
    shade_lights(&s);
    if (t->job->photons)
        shade_photons(&s);
    for (uint32_t i = 0; t->job->subsurface && i < s.layer_count; i++)
        if (s.layer[i].finish->has_subsurface)
            shade_subsurface(&s, &s.layer[i]);
}

void shade_hit(struct tracer *t, const struct path *path, const struct hit *hit)
{
    const struct ray ray = {path->o, path->d, 0, INFINITY};
    struct interaction at;
    trace_interaction(t->job->world, &ray, hit, &at);
    shade_painted(t, path, hit, &at, NULL, 0, NULL);
}
