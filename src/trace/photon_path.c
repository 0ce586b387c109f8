#include "trace/contact.h"
#include "trace/photon_flight.h"
#include "trace/projected.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "math/elementary.h"
#include "scene/effects.h"
#include "trace/inside.h"
#include "trace/wave.h"

struct photon_flight *photon_flight_new(const struct job *job)
{
    struct photon_flight *f = must_calloc(1, sizeof *f);
    f->job = job;
    f->t = tracer_new(job);
    f->t->wave.next = &f->out;
    f->eye_arena = arena_new(1024);
    f->flying = must_calloc(BATCH_SIZE, sizeof *f->flying);
    return f;
}

void photon_flight_free(struct photon_flight *f)
{
    tracer_free(f->t);
    arena_free(f->eye_arena);
    path_queue_free(&f->out);
    photon_map_end(&f->left.surface);
    photon_map_end(&f->left.media);
    free(f->leg);
    free(f->flying);
    free(f->place);
    free(f->turn);
    free(f->met);
    free(f);
}

static uint32_t doubled(uint32_t capacity) { return capacity ? 2 * capacity : 64; }

static struct leg *leg_add(struct photon_flight *f)
{
    if (f->leg_count == f->leg_capacity) {
        f->leg_capacity = doubled(f->leg_capacity);
        f->leg = must_realloc(f->leg, f->leg_capacity, sizeof *f->leg);
    }
    return &f->leg[f->leg_count++];
}

// A leg that waits. Those that go on from one surface are added one after the other, in their
// order.
static void leg_wait(struct photon_flight *f, const struct leg *leg)
{
    if (f->place_count == f->place_capacity) {
        f->place_capacity = doubled(f->place_capacity);
        f->place = must_realloc(f->place, f->place_capacity, sizeof *f->place);
    }
    struct leg *to = leg_add(f);
    *to = *leg;
    to->place = f->place_count;
    f->place[f->place_count++] = (struct leg_place){.next = {0, 0}};
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
    s->contact = contact_at(s);
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
    struct leg next = *leg;
    next.path.o = trace_offset(&s->at, leg->path.d);
    next.path.through = rgb_mul(leg->path.through, pass);
    if (s->contact)
        next.path.through = rgb_mul(next.path.through, s->contact->pass);
    next.path.inside = shading_crosses(s).inside;
    next.through = true;
    next.first = false;
    leg_wait(f, &next);
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
    for (uint32_t i = 0; i < f->out.count; i++)
        leg_wait(f, &(struct leg){.path = f->out.at[i],
                                  .length = leg->length,
                                  .shot = leg->shot,
                                  .past_target = true});
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
    f->met[leg->shot] = true;
    if (leg->path.level > 1 && !leg->through && (!target || target->collect))
        photon_leave(f, &f->left.surface, leg, s.at.p, 0, rgb(1, 1, 1));
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

static void leg_ends(struct photon_flight *f, struct leg *leg, const struct hit *hit)
{
    if (!(hit->b.t < INFINITY))
        return;
    if (f->job->has_media)
        photon_media_cross(f, leg, hit->b.t);
    leg->length += hit->b.t;
    leg->path.level++; // also where it went straight on, unlike rays to the eye
    leg->path.flags &= (uint8_t)~PATH_OF_ONE_WAY;
    surface_met(f, leg, hit);
}

static void legs_sort(const struct leg *from, uint32_t count, struct leg *to)
{
    uint32_t begin[PATH_KEYS_DIRECTION + 1] = {0};
    for (uint32_t k = 0; k < count; k++)
        begin[path_key_direction(&from[k].path) + 1]++;
    for (int i = 1; i < PATH_KEYS_DIRECTION; i++)
        begin[i] += begin[i - 1];
    for (uint32_t k = 0; k < count; k++)
        to[begin[path_key_direction(&from[k].path)]++] = from[k];
}

// Follows the last legs that wait to their ends.
static void legs_fly(struct photon_flight *f)
{
    struct ray_batch *r = f->t->rays;
    r->count = f->leg_count < BATCH_SIZE ? f->leg_count : BATCH_SIZE;
    f->leg_count -= r->count;
    legs_sort(f->leg + f->leg_count, r->count, f->flying);
    for (uint32_t k = 0; k < r->count; k++) {
        const struct path *p = &f->flying[k].path;
        r->o[0][k] = p->o.x, r->o[1][k] = p->o.y, r->o[2][k] = p->o.z;
        r->d[0][k] = p->d.x, r->d[1][k] = p->d.y, r->d[2][k] = p->d.z;
        r->hidden_by[k] = OBJECT_NO_IMAGE | OBJECT_NO_SHADOW;
    }
    trace_closest(f->job->world, f->t->scratch, r, f->t->hit);
    for (uint32_t k = 0; k < r->count; k++) {
        const uint32_t place = f->flying[k].place;
        const struct hit hit = hit_batch_at(f->t->hit, k);
        struct leg_place x = {
            {f->left.surface.count}, {f->left.media.count}, {f->place_count}};
        leg_ends(f, &f->flying[k], &hit);
        x.surface[1] = f->left.surface.count;
        x.media[1] = f->left.media.count;
        x.next[1] = f->place_count;
        f->place[place] = x;
    }
}

static void range_append(struct photon_map *to, const struct photon_map *from,
                         const uint32_t range[2])
{
    const struct photon_map part = {.photon = from->photon + range[0],
                                    .count = range[1] - range[0],
                                    .full = from->full};
    if (part.count)
        photon_map_append(to, &part);
}

// Adds what the legs have left in the order in which it counts; the first `shots` places are of
// legs from the lamp.
static void left_append(struct photon_flight *f, uint32_t shots, struct photons *to)
{
    uint32_t count = 0;
    f->turn = must_realloc(f->turn, f->place_capacity, sizeof *f->turn);
    for (uint32_t i = shots; i-- > 0;)
        f->turn[count++] = i;
    while (count) {
        const struct leg_place *p = &f->place[f->turn[--count]];
        range_append(&to->surface, &f->left.surface, p->surface);
        range_append(&to->media, &f->left.media, p->media);
        for (uint32_t i = p->next[1]; i-- > p->next[0];)
            f->turn[count++] = i;
    }
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
    if (photon_is_parallel(f->gun)) // each from elsewhere
        return inside_at(f->t->arena, f->job->world, o);
    if (f->eye_lamp == f->gun->lamp && f->eye.x == o.x && f->eye.y == o.y &&
        f->eye.z == o.z)
        return f->eye_inside;
    arena_reset(f->eye_arena);
    f->eye_lamp = f->gun->lamp;
    f->eye = o;
    f->eye_inside = inside_at(f->eye_arena, f->job->world, o);
    return f->eye_inside;
}

static void shot_wait(struct photon_flight *f, const struct photon_shot *s,
                      uint32_t number)
{
    const struct rgb c = light_sent(f->gun, s->o, s->d);
    const struct window *window = f->gun->lamp->window;
    if (is_black(c) || (window && !(window_hit(window, s->o, s->d) < INFINITY)))
        return;
    leg_wait(f, &(struct leg){.path = {.o = s->o,
                                       .d = s->d,
                                       .inside = interiors_at(f, s->o),
                                       .through = c,
                                       .weight = 1,
                                       .hash = s->hash},
                              .shot = number,
                              .first = true});
}

uint32_t photon_fly(struct photon_flight *f, const struct photon_gun *gun,
                    const struct photon_shot *shot, uint32_t count,
                    const volatile bool *cancel, struct photons *to)
{
    uint32_t met = 0;
    if (!count)
        return 0;
    f->gun = gun;
    f->met = must_realloc(f->met, count, sizeof *f->met);
    memset(f->met, 0, count * sizeof *f->met);
    f->leg_count = f->place_count = f->left.surface.count = f->left.media.count = 0;
    arena_reset(f->t->arena);
    f->t->last_push = (struct inside_pushed){0};
    for (uint32_t i = 0; i < count; i++)
        shot_wait(f, &shot[i], i);
    const uint32_t first = f->place_count;
    while (f->leg_count && !(cancel && *cancel))
        legs_fly(f);
    if (first)
        left_append(f, first, to);
    for (uint32_t i = 0; i < count; i++)
        met += f->met[i];
    return met;
}
