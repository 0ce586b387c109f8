// Light of painted hits, eight at a time, with the bits of trace/shade.c: what the layers give
// off, what lamps bring, and the rays that go on.
#include "scene/effects.h"
#include "trace/indirect_lanes.h"
#include "trace/paint.h"
#include "trace/photons.h"
#include "trace/shade.h"
#include "trace/shade_kernel.h"

// ---- which surfaces ---------------------------------------------------------------------

static bool lights_finish(const struct job *job, const struct finish *f)
{
    return !(f->has_subsurface && job->subsurface);
}

bool paint_lights_texture(const struct job *job, const struct texture *x)
{
    bool lights = true;
    if (x->kind == TEXTURE_PLAIN)
        for (uint32_t i = 0; i < x->layer_count; i++)
            lights &= lights_finish(job, x->layer[i].finish);
    else
        for (uint32_t i = 0; lights && i < (x->kind == TEXTURE_UV ? 1 : x->map->count);
             i++)
            lights = paint_lights_texture(job, x->map->entry[i]);
    return lights;
}

// Their light, and that of photons, would be added before that by way of others where it waits for
// the ray's turn.
static bool some_unshadowed(const struct job *job, const struct lamp_list *lamps)
{
    bool some = false;
    for (uint32_t i = 0; i < lamps->count; i++)
        some |= !lamps->lamp[i]->inert &&
                (lamps->lamp[i]->light->shadowless || !job->shadows);
    return some;
}

bool paint_lights_surface(const struct job *job, const struct surface *s)
{
    const struct lamp_list *lamps = &job->lamps[s->light_group];
    const bool more = some_unshadowed(job, lamps) || (job->shoots && photons_collect(s));
    return !(job->collects && more) && lamps_are_simple(job, lamps);
}

// ---- rays that go on --------------------------------------------------------------------

void paint_mirror(const struct tracer *t, const struct paint_group *g,
                  const struct paint_sheet *s, unsigned lanes, float out[3][8])
{
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        const struct simple_group *h = &g->hits;
        const struct vec3 d = vec3(h->d[0][i], h->d[1][i], h->d[2][i]);
        const struct vec3 n = vec3(s->n[0][i], s->n[1][i], s->n[2][i]);
        float weight;
        const struct rgb c = finish_reflectivity(
            s->layer->finish, -vec3_dot(d, n),
            rgb(s->color[0][i], s->color[1][i], s->color[2][i]),
            s->layer->finish->fresnel
                ? fresnel_index(wave_inside(t, h->slot[i]), g->surface->interior)
                : 1,
            &weight);
        out[0][i] = c.r, out[1][i] = c.g, out[2][i] = c.b;
    }
}

static const struct paint_sheet *sheets_of(const struct tracer *t,
                                           const struct paint_group *g)
{
    return t->paint->sheet + g->sheet;
}

// The lanes that send rays on; of them `alone`: one by one, since they do not only mirror, or by
// rules that lanes do not know.
static unsigned going_on(const struct tracer *t, const struct paint_group *g,
                         unsigned *alone)
{
    unsigned mirror = 0;
    *alone = 0;
    for (uint32_t i = 0; i < g->coat_count && t->job->refraction; i++)
        *alone |= t->paint->coat[g->coat + i].open;
    for (uint32_t i = 0; i < g->sheet_count && t->job->mirrors; i++) {
        const struct paint_sheet *s = &sheets_of(t, g)[i];
        const struct finish *f = s->layer->finish;
        if (!finish_has_mirror(f))
            continue;
        mirror |= s->lanes;
        if (f->irid != 0 || f->reflection_exponent != 1)
            *alone |= s->lanes;
    }
    return mirror | *alone;
}

// What Fresnel's formula asks of the lanes.
static void fresnel_indices(const struct paint_group *g, const struct path *const from[8],
                            unsigned lanes, double index[8])
{
    const struct inside *inside = NULL;
    double last = 1;
    for (int i = 0, any = 0; i < 8; i++) {
        index[i] = 1;
        if (!(lanes >> i & 1))
            continue;
        if (!any++ || from[i]->inside != inside)
            last = fresnel_index(inside = from[i]->inside, g->surface->interior);
        index[i] = last;
    }
}

// shade_mirrors of lanes that only mirror.
static void group_mirror(struct tracer *t, const struct paint_group *g, unsigned lanes)
{
    struct simple_bounce b; // not set to zero: it is large
    struct path made[8];
    const struct path *from[8];
    uint32_t way[8];
    bounce_from(t, &g->hits, lanes, made, from);
    b.least = t->job->adc_bailout;
    for (int i = 0; i < 8; i++) {
        b.from_weight[i] = lanes >> i & 1 ? from[i]->weight : 0;
        way[i] = 1;
    }
    for (const struct paint_coat *c = t->paint->coat + g->coat, *end = c + g->coat_count;
         c < end; c++) {
        float share[8];
        for (int i = 0; i < 8; i++)
            share[i] = (float)c->weight[i];
        for (uint32_t k = c->sheet; k < c->sheet + c->sheet_count; k++) {
            const struct paint_sheet *s = &t->paint->sheet[k];
            const struct finish *f = s->layer->finish;
            if (s->lanes & lanes && finish_has_mirror(f)) {
                if (f->fresnel)
                    fresnel_indices(g, from, s->lanes & lanes, b.index);
                t->job->kernels->mirror_sheet(g, s, share, &b);
                b.mirrors &= s->lanes & lanes;
                bounce_mirrors(t, &g->hits, from, &b, way);
            }
            for (int i = 0; i < 8; i++)
                way[i] += 2 * (s->lanes >> i & 1);
        }
    }
}

static void lane_layer(const struct tracer *t, const struct paint_sheet *s, int i,
                       struct layer *to)
{
    const struct painted p = {
        {s->n[0][i], s->n[1][i], s->n[2][i]},
        {s->color[0][i], s->color[1][i], s->color[2][i], s->color[3][i], s->color[4][i]},
        s->found >> i & 1};
    layer_painted(t, s->layer, &p, to);
    to->filter = rgb(s->filter[0][i], s->filter[1][i], s->filter[2][i]);
    to->trans = s->trans[i];
}

// shade_transmit of one lane, coat by coat.
static void lane_go_on(struct tracer *t, const struct paint_group *g, int i)
{
    const struct simple_group *h = &g->hits;
    struct path here = wave_path(t, h->slot[i]);
    t->slot = h->slot[i];
    path_meets(&here);
    struct shading s;
    s.t = t;
    s.path = &here;
    s.s = t->hit->t[h->ray[i]];
    s.at.surface = g->surface;
    s.at.p = vec3(h->p[0][i], h->p[1][i], h->p[2][i]);
    s.at.ng = vec3(h->ng[0][i], h->ng[1][i], h->ng[2][i]);
    s.at.error = h->error[i];
    s.view.n = vec3(h->n[0][i], h->n[1][i], h->n[2][i]);
    s.layer = s.few;
    s.layer_count = 0;
    s.dark = false;
    s.contact = NULL; // such surfaces are not painted
    for (uint32_t k = 0; k < g->coat_count; k++) {
        const struct paint_coat *c = &t->paint->coat[g->coat + k];
        if (!(c->lanes >> i & 1))
            continue;
        struct plain_result r = {
            .begin = s.layer_count,
            .weight = (float)c->weight[i],
            .trans = c->trans[i],
            .filter = {c->filter[0][i], c->filter[1][i], c->filter[2][i]},
            .any = c->any >> i & 1};
        for (uint32_t l = c->sheet; l < c->sheet + c->sheet_count; l++)
            if (t->paint->sheet[l].lanes >> i & 1)
                lane_layer(t, &t->paint->sheet[l], i, &s.few[s.layer_count++]);
        r.end = s.layer_count;
        shade_transmit(&s, &r);
    }
}

// ---- light ------------------------------------------------------------------------------

// The layers of one lane, as shade_plain collects them.
static void lane_layers(const struct tracer *t, const struct paint_group *g, int i,
                        struct shading *s)
{
    s->layer = s->few;
    s->layer_count = 0;
    for (uint32_t k = 0; k < g->sheet_count; k++)
        if (sheets_of(t, g)[k].lanes >> i & 1)
            lane_layer(t, &sheets_of(t, g)[k], i, &s->few[s->layer_count++]);
}

// As shade_indirect.
static void group_indirect(struct tracer *t, const struct paint_group *g)
{
    struct indirect_side side[2] = {{.back = false}, {.back = true}};
    const int sides = t->job->settings.indirect.both_sides ? 2 : 1;
    for (unsigned live = g->hits.live; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        struct shading s;
        s.t = t;
        lane_layers(t, g, i, &s);
        for (int k = 0; k < sides; k++) {
            const struct layer *first;
            const struct rgb matt = matt_part(&s, side[k].back, &first);
            if (first)
                indirect_side_add(&side[k], i, matt, first->n);
        }
    }
    for (int k = 0; k < sides; k++)
        if (t->paint->asks)
            indirect_keep(&g->hits, &side[k], t->paint->asks);
        else
            indirect_side_light(t, &g->hits, &side[k]);
}

// As shade_photons of each lane.
static void group_photons(struct tracer *t, const struct paint_group *g)
{
    const struct simple_group *h = &g->hits;
    struct shading s; // not set to zero: it is large
    s.t = t;
    s.at.surface = g->surface;
    for (unsigned live = h->live; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        const struct path path = wave_path(t, h->slot[i]);
        t->slot = h->slot[i];
        s.path = &path;
        s.at.p = vec3(h->p[0][i], h->p[1][i], h->p[2][i]);
        s.view.n = vec3(h->n[0][i], h->n[1][i], h->n[2][i]);
        lane_layers(t, g, i, &s);
        shade_photons(&s);
    }
}

void paint_light(struct tracer *t, const struct paint_group *g, uint32_t count)
{
    const struct shade_kernels *kernels = t->job->kernels;
    const struct surface *surface = g->surface;
    const struct lamp_list *lamps = &t->job->lamps[surface->light_group];
    const bool side_test = !(surface->flags & OBJECT_DOUBLE_ILLUMINATE);
    uint32_t queued = 0;
    for (uint32_t i = 0; i < count; i++) {
        kernels->own_sheets(t, &g[i]);
        unsigned alone;
        const unsigned on = going_on(t, &g[i], &alone);
        if (on & ~alone)
            group_mirror(t, &g[i], on & ~alone);
        for (; alone; alone &= alone - 1)
            lane_go_on(t, &g[i], __builtin_ctz(alone));
        if (t->job->lights && t->job->settings.indirect.data)
            group_indirect(t, &g[i]);
    }
    for (uint32_t i = 0; i < lamps->count; i++)
        if (!lamps->lamp[i]->inert)
            queued =
                kernels->light_sheets(t, side_test, lamps->lamp[i], g, count, queued);
    if (queued)
        shadow_flush_simple(t, queued);
    for (uint32_t i = 0; i < count && t->job->photons && photons_collect(surface); i++)
        group_photons(t, &g[i]);
}
