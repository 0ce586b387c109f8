#include "trace/simple.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "math/isa.h"
#include "scene/effects.h"
#include "scene/pigment_tape.h"
#include "trace/accel.h"
#include "trace/indirect_lanes.h"
#include "trace/packet.h"
#include "trace/photons.h"
#include "trace/shade.h"
#include "trace/shade_kernel.h"

// ---- which surfaces -------------------------------------------------------------------

static bool is_solid(struct rgbft c) { return c.filter == 0 && c.transmit == 0; }

static bool only_moved(const struct pattern *p)
{
    for (const struct warp *w = p->warps; w; w = w->next)
        if (w->kind != WARP_TRANSFORM)
            return false;
    return !p->turbulence;
}

static enum simple_pigment pigment_kind(const struct pigment *p)
{
    if (p->kind == PIGMENT_SOLID)
        return SIMPLE_SOLID;
    if (p->kind != PIGMENT_COLORS)
        return SIMPLE_TAPE;
    const struct color_map *m = p->colors;
    const bool two = m->count == 2 && m->key[0] == 0 && m->key[1] == 1;
    return p->pattern->ops == &checker_pattern_ops && p->pattern->frequency == 0 &&
                   p->pattern->wave == WAVE_RAMP && two && only_moved(p->pattern)
               ? SIMPLE_CHECKER
               : SIMPLE_TAPE;
}

bool lamps_are_simple(const struct job *job, const struct lamp_list *list)
{
    for (uint32_t i = 0; i < list->count; i++) {
        const struct light *l = list->lamp[i]->light;
        const bool even = l->parallel || l->kind == LIGHT_CYLINDER;
        if (!list->lamp[i]->inert && even && lamp_has_lightlets(job, l))
            return false;
    }
    return true;
}

static bool pigment_is_clear(const struct pigment *p)
{
    return p->kind == PIGMENT_SOLID && !is_solid(p->color);
}

// Colours that go different ways, or rules of their own, are left to the general rule.
static bool has_dispersion(const struct world *w)
{
    for (uint32_t i = 0; i < w->surface_count; i++) {
        const float d = w->surface[i].interior->dispersion;
        if (d > 0 && d != 1)
            return true;
    }
    return false;
}

// Rays that go on ask for both the normal of the surface and that of the layer; patterns
// by slope see the length of one with no_bump_scale.
static bool normal_is_simple(const struct job *job, const struct texture_layer *l)
{
    if (!l->normal || !job->normals)
        return true;
    return !pigment_is_clear(l->pigment) &&
           !(l->normal->no_bump_scale && l->pigment->kind != PIGMENT_SOLID) &&
           !(job->mirrors && finish_has_mirror(l->finish));
}

static bool surface_is_simple(const struct job *job, const struct surface *s,
                              bool dispersion)
{
    const struct texture *x = s->texture;
    if (x->kind != TEXTURE_PLAIN || x->layer_count != 1 || s->interior_texture ||
        s->parts || s->cutaway || s->in_contact)
        return false;
    const struct texture_layer *l = &x->layer[0];
    const struct finish *f = l->finish;
    return normal_is_simple(job, l) && !(dispersion && pigment_is_clear(l->pigment)) &&
           f->irid == 0 && !(f->has_subsurface && job->subsurface) && f->crand <= 0 &&
           f->reflection_exponent == 1 &&
           lamps_are_simple(job, &job->lamps[s->light_group]);
}

static bool same_rgb(struct rgb a, struct rgb b)
{
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

// What shading of simple surfaces looks at.
static bool same_finish(const struct finish *a, const struct finish *b)
{
    return a == b ||
           (same_rgb(a->ambient, b->ambient) && same_rgb(a->emission, b->emission) &&
            a->diffuse == b->diffuse && a->diffuse_back == b->diffuse_back &&
            a->brilliance == b->brilliance && a->phong == b->phong &&
            a->phong_size == b->phong_size && a->specular == b->specular &&
            a->roughness == b->roughness && a->metallic == b->metallic &&
            same_rgb(a->reflection_min, b->reflection_min) &&
            same_rgb(a->reflection_max, b->reflection_max) &&
            a->reflection_falloff == b->reflection_falloff &&
            a->reflection_metallic == b->reflection_metallic &&
            a->fresnel == b->fresnel && a->conserve_energy == b->conserve_energy);
}

// Whether what a surface asks, in the order of the rays, is known before its hits are placed.
// What it gives off is added after that: no third sum.
static bool asks_simply(const struct job *job, const struct texture_layer *l,
                        const struct simple_surface *x)
{
    const struct finish *f = l->finish;
    const struct rgb own = rgb_add(rgb_mul(f->ambient, job->ambient_light), f->emission);
    return x->kind == SIMPLE_SOLID && !(l->normal && job->normals) &&
           !(f->matt_back > 0 && rgb_max(own) > 0);
}

enum { RECENT = 16 }; // classes that a surface is compared with

static uint32_t class_of(struct job *job, struct simple_class *all,
                         const struct surface *s)
{
    const struct finish *f = s->texture->layer[0].finish;
    const bool side_test = !(s->flags & OBJECT_DOUBLE_ILLUMINATE);
    const bool clear = pigment_is_clear(s->texture->layer[0].pigment);
    const bool collects = job->shoots && photons_collect(s);
    const uint32_t count = job->simple_class_count;
    for (uint32_t i = count; i-- > 0 && count - i <= RECENT;)
        if (all[i].side_test == side_test && all[i].light_group == s->light_group &&
            all[i].clear == clear && all[i].collects == collects &&
            same_finish(all[i].finish, f))
            return i;
    all[count] = (struct simple_class){
        .finish = f,
        .light_group = s->light_group,
        .lamps = &job->lamps[s->light_group],
        .own = rgb_add(rgb_mul(f->ambient, job->ambient_light), f->emission),
        .side_test = side_test,
        .takes_light = finish_takes_light(f),
        .clear = clear,
        .collects = collects,
        .mirror = job->mirrors && finish_has_mirror(f),
    };
    return job->simple_class_count++;
}

// False: its colours are not opaque, or it is nested too deeply.
static bool color_compile(const struct job *job, struct pigment_compiler *c,
                          const struct pigment *p, struct simple_surface *x)
{
    x->pigment = p;
    x->att = 1;
    if (p->kind == PIGMENT_SOLID) {
        const struct rgbft color = p->color;
        x->kind = SIMPLE_SOLID;
        x->color[0] = rgbft_rgb(color);
        x->pass = rgbft_pass(color);
        x->att = job->old_opacity
                     ? 1 - (color.filter * rgb_max(rgbft_rgb(color)) + color.transmit)
                     : rgbft_opacity(color);
        return true;
    }
    x->kind = pigment_kind(p);
    x->tape = pigment_compile(c, p);
    for (uint32_t k = 0; k < 2 && x->kind == SIMPLE_CHECKER; k++)
        x->color[k] = rgbft_rgb(p->colors->color[k]);
    return x->tape && x->tape->channels == 3;
}

void simple_compile(struct job *job, struct arena *a)
{
    const struct world *w = job->world;
    struct pigment_compiler compiler = {.arena = a};
    const bool general = job->general;
    const struct camera *c = job->camera;
    job->kernels = ISA_NAMED(w->accel->kernels->name, shade_kernels);
    job->quick_camera = !general && c->kind != CAMERA_MESH;
    // Scouts look at little of a hit.
    if (general || job->settings.purpose == RENDER_SCOUT || !job->lights ||
        !job->pigments || !(1 > job->adc_bailout))
        return;
    struct simple_surface *simple =
        arena_new_array(a, struct simple_surface, w->surface_count + 1);
    struct simple_class *all =
        arena_new_array(a, struct simple_class, w->surface_count + 1);
    const bool dispersion = has_dispersion(w);
    for (uint32_t i = 0; i < w->surface_count; i++) {
        simple[i].class = SIMPLE_NONE;
        if (!surface_is_simple(job, &w->surface[i], dispersion))
            continue;
        const struct texture_layer *l = &w->surface[i].texture->layer[0];
        struct simple_surface x = {0};
        if (i && w->surface[i - 1].texture->kind == TEXTURE_PLAIN &&
            w->surface[i - 1].texture->layer[0].pigment == l->pigment &&
            simple[i - 1].class != SIMPLE_NONE)
            x = simple[i - 1];
        else if (!color_compile(job, &compiler, l->pigment, &x))
            continue;
        if (job->collects && !asks_simply(job, l, &x))
            continue;
        x.class = class_of(job, all, &w->surface[i]);
        x.normal = job->normals ? l->normal : NULL;
        job->simple_uv |= w->surface[i].wants_uv;
        simple[i] = x;
    }
    job->simple_class = all;
    job->simple = job->simple_class_count ? simple : NULL;
}

// ---- hits ------------------------------------------------------------------------------

enum { END = UINT16_MAX };

// Rays side by side that hit surfaces of one class.
struct hit_run {
    uint16_t first, count, next; // next: of the class; END: none
};

void simple_init(struct tracer *t)
{
    const uint32_t classes = t->job->simple_class_count;
    if (!classes)
        return;
    t->group = must_align(64, BATCH_SIZE / 8, sizeof *t->group);
    t->class_head = must_malloc(classes, sizeof *t->class_head);
    t->class_tail = must_malloc(classes, sizeof *t->class_tail);
    t->class_seen = must_malloc(BATCH_SIZE, sizeof *t->class_seen);
    t->run = must_malloc(BATCH_SIZE, sizeof *t->run);
    t->class_ray = must_malloc(BATCH_SIZE, sizeof *t->class_ray);
    for (uint32_t i = 0; i < classes; i++)
        t->class_head[i] = END;
}

void simple_end(struct tracer *t)
{
    free(t->group);
    free(t->class_head);
    free(t->class_tail);
    free(t->class_seen);
    free(t->run);
    free(t->class_ray);
}

bool simple_take(struct tracer *t, uint32_t k, uint32_t count)
{
    const struct job *job = t->job;
    if (!job->simple)
        return false;
    const uint32_t class = job->simple[job->world->leaf[t->hit->leaf[k]].surface].class;
    if (class == SIMPLE_NONE)
        return false;
    const uint16_t at = (uint16_t)t->run_count++;
    if (t->class_head[class] == END) {
        t->class_head[class] = at;
        t->class_seen[t->class_count++] = class;
    } else {
        t->run[t->class_tail[class]].next = at;
    }
    t->class_tail[class] = at;
    t->run[at] = (struct hit_run){(uint16_t)k, (uint16_t)count, END};
    return true;
}

void simple_ask(struct tracer *t, uint32_t k, uint32_t end)
{
    const struct world *w = t->job->world;
    const struct indirect *indirect = &t->job->settings.indirect;
    for (; k < end; k++) {
        const uint32_t surface = w->leaf[t->hit->leaf[k]].surface;
        const struct simple_surface *x = &t->job->simple[surface];
        const struct finish *f = t->job->simple_class[x->class].finish;
        for (int back = 0; back <= indirect->both_sides; back++) {
            const float matt = (back ? f->matt_back : f->matt) * x->att;
            const struct rgb color = rgb_scale(matt, x->color[0]);
            if (rgb_luminance(rgb(1, 1, 1)) * matt > indirect->least &&
                rgb_max(color) > 0)
                indirect_ask(t, k, color, NULL, back);
        }
    }
}

// Light by way of other surfaces on one side of a group, as shade_indirect.
static void side_indirect(struct tracer *t, const struct simple_class *c,
                          const struct simple_group *g, bool back)
{
    const struct world *w = t->job->world;
    struct indirect_side side = {.back = back};
    for (unsigned live = g->live; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        const float matt = (back ? c->finish->matt_back : c->finish->matt) * g->att[i];
        const struct rgb color =
            rgb_scale(matt, rgb(g->color[0][i], g->color[1][i], g->color[2][i]));
        if (!(rgb_luminance(rgb(1, 1, 1)) * matt > t->job->settings.indirect.least))
            continue;
        indirect_side_add(&side, i, color, vec3(g->n[0][i], g->n[1][i], g->n[2][i]));
        if (t->job->simple[w->leaf[t->hit->leaf[g->ray[i]]].surface].normal)
            side.perturbed |= 1u << i;
    }
    indirect_side_light(t, g, &side);
}

static void group_indirect(struct tracer *t, const struct simple_class *c,
                           const struct simple_group *g)
{
    side_indirect(t, c, g, false);
    if (t->job->settings.indirect.both_sides)
        side_indirect(t, c, g, true);
}

// An image does not reach there.
static void shade_bare(struct tracer *t, const struct simple_group *g)
{
    for (unsigned bits = g->bare; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        t->slot = g->slot[i];
        const struct path p = wave_path(t, t->slot);
        const struct hit hit = hit_batch_at(t->hit, g->ray[i]);
        shade_hit(t, &p, &hit);
    }
}

static void shade_class(struct tracer *t, const struct simple_class *c, uint32_t first,
                        uint32_t *queued)
{
    const struct shade_kernels *kernels = t->job->kernels;
    uint32_t count = 0;
    for (uint32_t i = first; i != END; i = t->run[i].next)
        for (uint32_t k = 0; k < t->run[i].count; k++)
            t->class_ray[count++] = (uint16_t)(t->run[i].first + k);
    const uint32_t groups = (count + 7) / 8;
    for (uint32_t i = 0; i < groups; i++) {
        const uint32_t left = count - 8 * i;
        kernels->place(t, t->class_ray + 8 * i, left < 8 ? left : 8, &t->group[i]);
        if (t->group[i].bare)
            shade_bare(t, &t->group[i]);
        kernels->own(t, c, &t->group[i]);
        if (t->job->settings.indirect.data && !t->job->collects)
            group_indirect(t, c, &t->group[i]);
    }
    for (uint32_t i = 0; i < c->lamps->count && c->takes_light; i++)
        if (!c->lamps->lamp[i]->inert)
            *queued = kernels->light(t, c, c->lamps->lamp[i], t->group, groups, *queued);
    for (uint32_t i = 0; i < groups && c->collects && c->takes_light; i++)
        simple_photons(t, c, &t->group[i]);
    for (uint32_t i = 0; i < groups && (c->mirror || c->clear); i++)
        simple_bounce(t, c, &t->group[i]);
}

void simple_shade(struct tracer *t)
{
    uint32_t queued = 0;
    for (uint32_t i = 0; i < t->class_count; i++) {
        const uint32_t class = t->class_seen[i];
        shade_class(t, &t->job->simple_class[class], t->class_head[class], &queued);
        t->class_head[class] = END;
    }
    t->class_count = t->run_count = 0;
    if (queued)
        shadow_flush_simple(t, queued);
}
