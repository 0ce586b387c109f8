// Elements that no light can reach on its way to the camera: the outside of a room, the
// inside of what is closed.
#include <stdlib.h>

#include "radiosity/form_factor.h"
#include "radiosity/patches.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"

enum { EYE_RAYS = 1024, ELEMENT_RAYS = 16 };

struct search {
    struct patches *p;
    void *state;
    struct ray_batch *rays;
    uint32_t *met;
    uint32_t *queue, count; // elements reached
    bool *reached;
};

static void look(struct search *s)
{
    s->p->enclosure.closest(s->state, s->rays, s->met);
    for (uint32_t i = 0; i < s->rays->count; i++) {
        const uint32_t e = s->met[i];
        if (e == ELEMENT_NONE || s->reached[e])
            continue;
        s->reached[e] = true;
        s->queue[s->count++] = e;
    }
    s->rays->count = 0;
}

// Rays all around a camera or a lamp.
static void look_around(struct search *s, struct vec3 from)
{
    for (uint32_t k = 0; k < EYE_RAYS; k++) {
        double x[4];
        sobol_point(k, 1, x);
        const struct vec3 up = vec3(0, 0, x[2] < .5 ? 1 : -1);
        ray_put_from(s->rays, from, cosine_direction(up, x[0], x[1]), INFINITY);
    }
    look(s);
}

static void look_from_elements(struct search *s)
{
    for (uint32_t i = 0; i < s->count && !watch_cancelled(s->p->settings.watch); i++) {
        const uint32_t e = s->queue[i];
        for (uint32_t k = 0; k < ELEMENT_RAYS; k++) {
            struct element_point from;
            double x[4];
            sobol_point(k, e, x);
            if (s->p->enclosure.point(s->state, e, x[0], x[1], &from))
                ray_put(s->rays, &from, cosine_direction(from.normal, x[2], x[3]),
                        INFINITY);
        }
        look(s);
    }
}

static void keep_reached(struct patches *p, const bool *reached)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < p->element_count; i++) {
        struct cell *c = &p->cell[p->element_cell[i] / 2];
        const int side = p->element_cell[i] & 1;
        c->element[side] = reached[i] ? kept : ELEMENT_NONE;
        if (!reached[i])
            continue;
        p->element[kept] = p->element[i];
        p->element_cell[kept++] = p->element_cell[i];
    }
    p->element_count = p->enclosure.count = kept;
}

void patches_prune(struct patches *p)
{
    const uint32_t n = p->element_count;
    struct search s = {p,
                       p->enclosure.thread_begin(p->enclosure.user),
                       ray_batch_new(EYE_RAYS),
                       calloc(EYE_RAYS, sizeof *s.met),
                       calloc(n + 1, sizeof *s.queue),
                       0,
                       calloc(n + 1, sizeof *s.reached)};
    if (!s.met || !s.queue || !s.reached)
        abort();
    look_around(&s, p->job->camera->location);
    for (uint32_t i = 0; i < p->job->lamp_count && i < SHAFT_OBJECTS; i++)
        look_around(&s, p->job->lamp[i].light->location);
    look_from_elements(&s);
    // A camera that sees nothing of the scene's elements tells nothing.
    if (s.count) {
        // Small ones may have been missed: what lies beside a reached element stays.
        for (uint32_t i = 0; i < s.count; i++) {
            const uint32_t e = s.queue[i];
            for (int k = -2; k <= 2; k++) {
                const uint32_t j = e + (uint32_t)k;
                if (j < n && p->element[j].surface == p->element[e].surface)
                    s.reached[j] = true;
            }
        }
        keep_reached(p, s.reached);
    }
    p->enclosure.thread_end(s.state);
    ray_batch_free(s.rays);
    free(s.met);
    free(s.queue);
    free(s.reached);
}
