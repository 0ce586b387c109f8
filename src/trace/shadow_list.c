#include "trace/shadow_list.h"

#include <stdlib.h>

#include "base/memory.h"
#include "trace/accel.h"
#include "trace/inside.h"
#include "trace/near_zero.h"
#include "trace/packet.h"
#include "trace/photons.h"
#include "trace/shade_kernel.h"

enum {
    STEPS = 2048,        // that wait at most
    NO_FADE = UINT16_MAX // a step without
};

// A ray crosses a surface. The steps of a ray stand side by side, in their order.
struct step {
    struct rgb pass; // of the surface, and of the way to it where exp does not tell it
    uint16_t ray;
    uint16_t fade; // of the way to it: its exponents and their exp are three from here on
};

struct shadow_list {
    uint32_t steps, fades;
    struct step step[STEPS];
    double exponent[3 * STEPS + 8]; // the kernel takes eight at a time
    float fade[3 * STEPS + 8];
    struct crossings8 met;
};

struct shadow_list *shadow_list_new(void)
{
    return must_calloc(1, sizeof(struct shadow_list));
}

void shadow_list_free(struct shadow_list *l) { free(l); }

static struct step *step_add(struct shadow_list *l, uint32_t ray, struct rgb pass)
{
    struct step *s = &l->step[l->steps++];
    *s = (struct step){pass, (uint16_t)ray, NO_FADE};
    return s;
}

// What the way of length `way` through an interior lets through.
static void fade_way(struct shadow_list *l, struct step *s, const struct interior *x,
                     double way)
{
    if (!(x->fade_power > 0 && fabs(x->fade_distance) > NEAR_ZERO))
        return;
    if (!interior_fades_exponentially(x)) {
        s->pass = rgb_mul(s->pass, interior_fade(x, way));
        return;
    }
    interior_fade_exponents(x, way, l->exponent + l->fades, 1);
    s->fade = (uint16_t)l->fades;
    l->fades += 3;
}

// As walk_on of trace/shadow.c, over all that the lane crosses.
static void lane_steps(struct tracer *t, const struct shadow_batch *b, uint32_t ray,
                       int lane)
{
    struct shadow_list *l = t->list;
    const struct world *w = t->job->world;
    const struct inside *inside = wave_inside(t, b->slot[ray]);
    double last = 0;
    for (uint32_t i = 0; i < l->met.count[lane]; i++) {
        const double at = l->met.t[lane][i];
        if (!(at > last))
            continue;
        const uint32_t surface = w->leaf[l->met.leaf[lane][i]].surface;
        const struct surface *s = &w->surface[surface];
        const struct interior *x = s->interior;
        const bool dark =
            s->opaque || (b->photons[ray] && photons_instead_of(s, b->photons[ray]));
        struct step *step =
            step_add(l, ray, dark ? rgb(0, 0, 0) : t->job->pass[surface].pass);
        if (inside_find(inside, x)) {
            fade_way(l, step, x, at - last);
            inside = inside_remove(t->arena, inside, x);
        } else {
            inside = inside_enter(t, inside, x);
        }
        last = at;
    }
}

unsigned shadow_list_take(struct tracer *t, const struct shadow_batch *b, uint32_t first,
                          unsigned lanes)
{
    struct shadow_list *l = t->list;
    const struct world *clear = t->job->world->clear;
    if (l->steps + 8 * CROSSINGS > STEPS)
        shadow_list_end(t, b);
    clear->accel->kernels->crossings(clear, t->scratch, b->rays, first, lanes, &l->met);
    const unsigned left = lanes & l->met.left;
    for (lanes &= ~left; lanes; lanes &= lanes - 1) {
        const int lane = __builtin_ctz(lanes);
        lane_steps(t, b, first + (uint32_t)lane, lane);
    }
    return left;
}

void shadow_list_end(struct tracer *t, const struct shadow_batch *b)
{
    struct shadow_list *l = t->list;
    uint32_t dark = UINT32_MAX; // a ray of which nothing is left
    t->job->kernels->exps(l->exponent, l->fades, l->fade);
    for (uint32_t i = 0; i < l->steps; i++) {
        const struct step *s = &l->step[i];
        if (s->ray == dark)
            continue;
        struct rgb pass = s->pass;
        if (s->fade != NO_FADE) {
            const float *f = l->fade + s->fade;
            pass = rgb_mul(pass, rgb(f[0], f[1], f[2]));
        }
        b->pass[s->ray] = rgb_mul(b->pass[s->ray], pass);
        const float least = (float)NEAR_ZERO;
        if (fabsf(pass.r) >= least || fabsf(pass.g) >= least || fabsf(pass.b) >= least)
            continue;
        b->pass[s->ray] = rgb(0, 0, 0);
        dark = s->ray;
    }
    l->steps = l->fades = 0;
}
