#include "trace/photon_flight.h"
#include "trace/projected.h"

#include <stdlib.h>

#include "base/arena.h"
#include "math/elementary.h"
#include "scene/effects.h"
#include "trace/inside.h"
#include "trace/wave.h"

struct photon_flight *photon_flight_new(const struct job *job, struct photons *to)
{
    struct photon_flight *f = calloc(1, sizeof *f);
    if (!f)
        abort();
    f->job = job;
    f->to = to;
    f->t = tracer_new(job);
    f->t->wave.next = &f->out;
    f->eye_arena = arena_new(1024);
    return f;
}

void photon_flight_free(struct photon_flight *f)
{
    tracer_free(f->t);
    arena_free(f->eye_arena);
    path_queue_free(&f->out);
    free(f->leg);
    free(f);
}

static struct leg *leg_add(struct photon_flight *f)
{
    if (f->leg_count == f->leg_capacity) {
        f->leg_capacity = f->leg_capacity ? 2 * f->leg_capacity : 64;
        f->leg = realloc(f->leg, f->leg_capacity * sizeof *f->leg);
        if (!f->leg)
            abort();
    }
    return &f->leg[f->leg_count++];
}

// ---- storing -------------------------------------------------------------------------

bool photon_is_parallel(const struct photon_gun *g)
{
    return g->lamp->light->parallel || g->lamp->light->kind == LIGHT_CYLINDER;
}

// The light's fading; the way counts, not the straight distance.
static double faded(const struct light *l, double length)
{
    if (!(l->fade_power > 0) || l->fade_distance == 0)
        return 1;
    return 2 / (1 + det_pow_single(length / l->fade_distance, l->fade_power));
}

void photon_leave(struct photon_flight *f, struct photon_map *m, const struct leg *leg,
                  struct vec3 p, double way, struct rgb weight)
{
    const struct photon_gun *g = f->gun;
    const struct vec3 d = leg->path.d;
    const double length = leg->length + way;
    double area = g->spread * g->spread;
    if (!photon_is_parallel(g))
        area *= length * length;
    const float k = (float)(area * faded(g->lamp->light, length));
    const struct photon x = {{(float)p.x, (float)p.y, (float)p.z},
                             {(float)-d.x, (float)-d.y, (float)-d.z},
                             rgb_scale(k, rgb_mul(weight, leg->path.through))};
    photon_add(m, &x);
}

// ---- surfaces ------------------------------------------------------------------------

// What lies between the layers of a surface and the next legs.
struct bounce {
    struct photon_flight *f;
    const struct photon_target *target; // of the surface; NULL: nothing was written
};

static void emit(struct shading *s, const struct plain_result *r)
{
    const struct bounce *b = s->user;
    const struct light *light = b->f->gun->lamp->light;
    const struct vec3 *except = NULL;
    if (photons_refract(b->target, light) && !shade_refract(s, r))
        except = &s->layer[r->begin].n;
    if (photons_reflect(b->target, light))
        shade_mirrors(s, r, except);
}

// What a surface that is passed through takes away.
static void weaken(struct shading *s, const struct plain_result *r)
{
    struct rgb *pass = s->user;
    *pass = rgb_add(*pass, r->filter);
}

static void shading_init(struct shading *s, struct photon_flight *f,
                         const struct leg *leg, const struct hit *hit)
{
    const struct ray ray = {leg->path.o, leg->path.d, 0, INFINITY};
    s->t = f->t;
    s->path = &leg->path;
    s->s = hit->b.t;
    s->layer = s->few;
    s->layer_count = 0;
    s->layer_capacity = HIT_LAYERS;
    s->dark = true;
    trace_interaction(f->job->world, &ray, hit, &s->at);
    surface_view_init(&s->view, &s->at, leg->path.d);
}

// Straight on, filtered, without bending.
static void pass_through(struct photon_flight *f, struct shading *s,
                         const struct leg *leg)
{
    struct rgb pass = {0, 0, 0};
    s->user = &pass;
    s->go_on = weaken;
    texture_walk(f->t, &s->view, shade_plain, s);
    struct leg *next = leg_add(f);
    *next = *leg;
    next->path.o = trace_offset(&s->at, leg->path.d);
    next->path.through = rgb_mul(leg->path.through, pass);
    next->path.inside =
        interior_cross(f->t, leg->path.inside, s->at.surface->interior).inside;
    next->through = true;
    next->first = false;
}

// Takes what the surface has sent on as new legs.
static void legs_take(struct photon_flight *f, const struct leg *leg)
{
    struct tracer *t = f->t;
    // Mirrors with an exponent change light they have; photons only lose.
    for (uint32_t i = 0; i < t->power_count; i++) {
        struct path *p = path_queue_add(&f->out);
        *p = t->power[i].path;
        p->through = rgb_mul(p->through, t->power[i].factor);
    }
    t->power_count = 0;
    for (uint32_t i = f->out.count; i-- > 0;) {
        struct leg *next = leg_add(f);
        *next = (struct leg){
            .path = f->out.at[i], .length = leg->length, .past_target = true};
    }
    f->out.count = 0;
}

static void surface_met(struct photon_flight *f, struct leg *leg, const struct hit *hit)
{
    const struct world *w = f->job->world;
    const struct leaf *leaf = &w->leaf[hit->b.leaf];
    const struct photon_target *target = w->surface[leaf->surface].photons;
    struct shading s;
    shading_init(&s, f, leg, hit);
    if (!leg->past_target &&
        (leaf->object != f->gun->object || !target || !target->target)) {
        if (target && target->pass_through)
            pass_through(f, &s, leg);
        return;
    }
    f->met = true;
    if (leg->path.level > 1 && !leg->through && (!target || target->collect))
        photon_leave(f, &f->to->surface, leg, s.at.p, 0, rgb(1, 1, 1));
    if (target && target->pass_through && leg->past_target) {
        pass_through(f, &s, leg);
        return;
    }
    struct bounce b = {f, target};
    s.user = &b;
    s.go_on = emit;
    texture_walk(f->t, &s.view, shade_plain, &s);
    legs_take(f, leg);
}

// ---- flights -------------------------------------------------------------------------

static bool is_black(struct rgb c)
{
    static const float least = 1e-5f;
    return fabsf(c.r) < least && fabsf(c.g) < least && fabsf(c.b) < least;
}

static void leg_fly(struct photon_flight *f)
{
    struct leg leg = f->leg[--f->leg_count];
    const struct ray_query q = {{leg.path.o, leg.path.d, 0, INFINITY},
                                OBJECT_NO_IMAGE | OBJECT_NO_SHADOW};
    const struct hit hit = trace_closest_1(f->job->world, f->t->scratch, &q);
    if (!(hit.b.t < INFINITY))
        return;
    if (f->job->has_media)
        photon_media_cross(f, &leg, hit.b.t);
    leg.length += hit.b.t;
    leg.path.level++; // also where it went straight on, unlike rays to the eye
    leg.path.flags &= (uint8_t)~PATH_OF_ONE_WAY;
    surface_met(f, &leg, &hit);
}

// Light of the lamp in direction d, without its fading.
static struct rgb light_sent(const struct photon_gun *g, struct vec3 o, struct vec3 d)
{
    const struct light *l = g->lamp->light;
    struct light even = *l;
    struct lamp lamp = *g->lamp;
    even.fade_power = 0;
    lamp.light = &even;
    const struct lamp_view v = {vec3_neg(d), 1, l->color};
    const double k = lamp_attenuation(&lamp, g->from, vec3_add(o, d), &v);
    return rgb_scale((float)k * g->share, l->color);
}

static const struct inside *interiors_at(struct photon_flight *f, struct vec3 o)
{
    if (f->eye_lamp == f->gun->lamp && f->eye.x == o.x && f->eye.y == o.y &&
        f->eye.z == o.z)
        return f->eye_inside;
    arena_reset(f->eye_arena);
    f->eye_lamp = f->gun->lamp;
    f->eye = o;
    f->eye_inside = inside_at(f->eye_arena, f->job->world, o);
    return f->eye_inside;
}

bool photon_fly(struct photon_flight *f, const struct photon_gun *gun, struct vec3 o,
                struct vec3 d, uint32_t hash)
{
    f->gun = gun;
    f->met = false;
    f->leg_count = 0;
    arena_reset(f->t->arena);
    f->t->last_push = (struct inside_pushed){0};
    const struct rgb c = light_sent(gun, o, d);
    const struct window *window = gun->lamp->window;
    if (is_black(c) || (window && !(window_hit(window, o, d) < INFINITY)))
        return false;
    *leg_add(f) = (struct leg){.path = {.o = o,
                                        .d = d,
                                        .inside = interiors_at(f, o),
                                        .through = c,
                                        .weight = 1,
                                        .hash = hash},
                               .first = true};
    while (f->leg_count)
        leg_fly(f);
    return f->met;
}
