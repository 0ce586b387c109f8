// Elements that no light can reach on its way to the camera: the outside of a room, the
// inside of what is closed. Elements that see each other or lie beside each other form
// groups; only the groups of the camera and the lamps stay.
#include <stdlib.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "radiosity/form_factor.h"
#include "radiosity/patches.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"

enum {
    EYE_RAYS = 1024,   // around the camera and each lamp
    EYES_MOST = 64,    // lamps looked around from
    ELEMENT_RAYS = 16, // of each element
    GROUP_RAYS = 4096, // of a group before it is given up, and as many tries to see
    GROUP_RAYS_LEAST = 32,
    TRIES = 1 << 16, // of all groups, up to TRIES_EACH of each element of the scene;
    TRIES_EACH = 64, // and as many as elements have sent before
    CHUNK = 1 << 16,
    ASKED_RAYS = 64 // of an element that are worth looking what it faces
};

// A forest of elements; the last node stands for what is reached.
struct groups {
    struct patches *p;
    uint32_t *parent, *size;
    uint32_t root;
    uint32_t *list; // elements at hand
    uint32_t first; // of their rays' numbers
    uint32_t rays;  // of each
    uint32_t *met;
    uint32_t *reached, reached_count; // what the tries look at
    uint8_t *seen;                    // of each in the list
    uint32_t *sent;                   // rays of each element but the first ones
};

static uint32_t group_of(const struct groups *g, uint32_t i)
{
    while (g->parent[i] != i)
        i = g->parent[i] = g->parent[g->parent[i]];
    return i;
}

static void unite(struct groups *g, uint32_t a, uint32_t b)
{
    a = group_of(g, a);
    b = group_of(g, b);
    if (a == b)
        return;
    const uint32_t large = g->size[a] >= g->size[b] ? a : b, small = a + b - large;
    g->parent[small] = large;
    g->size[large] += g->size[small];
}

static bool is_reached(const struct groups *g, uint32_t element)
{
    return group_of(g, element) == group_of(g, g->root);
}

// Rays all around a camera or a lamp.
static void look_around(struct groups *g, struct vec3 from)
{
    const struct enclosure *e = &g->p->enclosure;
    void *state = e->thread_begin(e->user);
    struct ray_batch *rays = ray_batch_new(EYE_RAYS);
    uint32_t met[EYE_RAYS];
    for (uint32_t k = 0; k < EYE_RAYS; k++) {
        double x[4];
        sobol_point(k, 1, x);
        const struct vec3 up = vec3(0, 0, x[2] < .5 ? 1 : -1);
        ray_put_from(rays, from, cosine_direction(up, x[0], x[1]), INFINITY);
    }
    e->closest(state, rays, met);
    for (uint32_t k = 0; k < EYE_RAYS; k++)
        if (met[k] != ELEMENT_NONE)
            unite(g, g->root, met[k]);
    ray_batch_free(rays);
    e->thread_end(state);
}

// ---- rays of elements --------------------------------------------------------------
struct looker {
    void *of_enclosure;
    struct ray_batch *rays;
    uint32_t *met, *slot;
    uint8_t *hidden;
};

static void *looker_begin(void *user)
{
    const struct groups *g = user;
    struct looker *l = must_calloc(1, sizeof *l);
    l->of_enclosure = g->p->enclosure.thread_begin(g->p->enclosure.user);
    l->rays = ray_batch_new(EYE_RAYS);
    l->met = must_malloc(EYE_RAYS, sizeof *l->met);
    l->slot = must_malloc(EYE_RAYS, sizeof *l->slot);
    l->hidden = must_malloc(EYE_RAYS, sizeof *l->hidden);
    return l;
}

static void looker_end(void *user, void *state)
{
    const struct groups *g = user;
    struct looker *l = state;
    g->p->enclosure.thread_end(l->of_enclosure);
    ray_batch_free(l->rays);
    free(l->met);
    free(l->slot);
    free(l->hidden);
    free(l);
}

static void cast(const struct groups *g, struct looker *l)
{
    g->p->enclosure.closest(l->of_enclosure, l->rays, l->met);
    for (uint32_t k = 0; k < l->rays->count; k++)
        g->met[l->slot[k]] = l->met[k];
    l->rays->count = 0;
}

static void look(void *user, void *state, uint32_t begin, uint32_t end)
{
    const struct groups *g = user;
    struct looker *l = state;
    for (uint32_t i = begin; i < end; i++) {
        for (uint32_t k = 0; k < g->rays; k++) {
            struct element_point from;
            double x[4];
            sobol_point(g->first + k, g->list[i], x);
            g->met[i * g->rays + k] = ELEMENT_NONE;
            if (!g->p->enclosure.point(l->of_enclosure, g->list[i], x[0], x[1], &from))
                continue;
            l->slot[l->rays->count] = i * g->rays + k;
            ray_put(l->rays, &from, cosine_direction(from.normal, x[2], x[3]), INFINITY);
            if (l->rays->count == EYE_RAYS)
                cast(g, l);
        }
    }
    cast(g, l);
}

static void run(struct groups *g, uint32_t count,
                void (*work)(void *, void *, uint32_t, uint32_t))
{
    const struct parallel p = {.threads = g->p->settings.threads,
                               .piece = 64,
                               .watch = g->p->settings.watch,
                               .user = g,
                               .begin = looker_begin,
                               .end = looker_end,
                               .work = work};
    parallel_run(&p, count);
}

// Light that reaches an element reaches those beside it with nothing between.
static void unite_neighbours(struct groups *g)
{
    for (uint32_t i = 0; i < g->p->element_count; i++)
        for (int k = 0; k < 8; k++) {
            const uint32_t j = patch_neighbour(g->p, i, k);
            if (j != ELEMENT_NONE)
                unite(g, i, j);
        }
}

// Sends rays [first, first + rays) of the elements in the list and unites what they meet.
static void look_from(struct groups *g, uint32_t *list, uint32_t count, uint32_t first,
                      uint32_t rays)
{
    const uint32_t chunk = rays < CHUNK ? CHUNK / rays : 1;
    g->met = must_malloc((size_t)chunk * rays, sizeof *g->met);
    g->first = first;
    g->rays = rays;
    for (uint32_t at = 0; at < count && !watch_cancelled(g->p->settings.watch);
         at += chunk) {
        const uint32_t n = count - at < chunk ? count - at : chunk;
        g->list = list + at;
        run(g, n, look);
        for (size_t k = 0; k < (size_t)n * rays && !watch_cancelled(g->p->settings.watch);
             k++)
            if (g->met[k] != ELEMENT_NONE)
                unite(g, g->list[k / rays], g->met[k]);
    }
    free(g->met);
}

// The elements not reached so far that are to send as many rays. Returns how many.
static uint32_t list_left(const struct groups *g, const uint32_t *rays, uint32_t least,
                          uint32_t *list)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < g->p->element_count; i++)
        if ((!rays || rays[i] >= least) && !is_reached(g, i))
            list[count++] = i;
    return count;
}

// ELEMENT_RAYS of each element until it is known to be reached: most need few.
static void look_first(struct groups *g)
{
    uint32_t *list = must_malloc(g->p->element_count + 1, sizeof *list);
    for (uint32_t first = 0, rays = 2; first < ELEMENT_RAYS; first += rays, rays = first)
        look_from(g, list, list_left(g, NULL, 0, list), first, rays);
    free(list);
}

// ---- what is small or far ----------------------------------------------------------
// The k-th place that element i tries to see: in turn the camera, a lamp, a reached
// element. False: there is none.
static bool goal(const struct groups *g, const struct looker *l, const double x[4],
                 uint32_t k, struct vec3 *out)
{
    const struct job *job = g->p->job;
    if (k % 4 == 0) {
        *out = job->camera->location;
        return true;
    }
    if (k % 4 == 1) {
        if (job->lamp_count)
            *out = job->lamp[(k / 4) % job->lamp_count].light->location;
        return job->lamp_count > 0;
    }
    struct element_point at;
    const uint32_t e = g->reached[(uint32_t)(x[2] * g->reached_count)];
    if (!g->reached_count || !g->p->enclosure.point(l->of_enclosure, e, x[0], x[3], &at))
        return false;
    *out = point_lifted(&at);
    return true;
}

static void try_to_see(void *user, void *state, uint32_t begin, uint32_t end)
{
    const struct groups *g = user;
    struct looker *l = state;
    for (uint32_t i = begin; i < end; i++) {
        g->seen[i] = 0;
        const uint32_t last = g->first + g->rays;
        for (uint32_t k = g->first; k < last && !g->seen[i];) {
            l->rays->count = 0;
            for (; k < last && l->rays->count < EYE_RAYS; k++) {
                struct element_point from;
                struct vec3 to;
                double x[4];
                sobol_point(k, sequence_seed(g->list[i], 7), x);
                if (!g->p->enclosure.point(l->of_enclosure, g->list[i], x[0], x[1],
                                           &from) ||
                    !goal(g, l, x, k, &to))
                    continue;
                const struct vec3 o = point_lifted(&from), d = vec3_sub(to, o);
                if (vec3_dot(d, from.normal) > 0)
                    ray_put_from(l->rays, o, d, 1);
            }
            g->p->enclosure.occluded(l->of_enclosure, l->rays, l->hidden);
            for (uint32_t r = 0; r < l->rays->count; r++)
                g->seen[i] |= !l->hidden[r];
        }
    }
}

// Whether a point lies above the plane of a flat element, by more than rounding.
static bool above(const struct element *e, struct vec3 p)
{
    static const double flush = 1e-9; // of the coordinates
    const double height = vec3_dot(vec3_sub(p, e->corner[0]), e->normal);
    return height > flush * (vec3_max_abs(p) + vec3_max_abs(e->corner[0]));
}

static bool any_above(const struct element *e, const struct element *other)
{
    for (uint32_t k = 0; k < other->corner_count; k++)
        if (above(e, other->corner[k]))
            return true;
    return false;
}

// Whether a way from an element to the camera, a lamp or what is reached can be: both
// ends of it lie above the plane of the other.
static bool faces_reached(const struct groups *g, uint32_t i)
{
    const struct job *job = g->p->job;
    const struct element *e = &g->p->element[i];
    if (!patch_is_flat(g->p, e) || above(e, job->camera->location))
        return true;
    for (uint32_t k = 0; k < job->lamp_count; k++)
        if (above(e, job->lamp[k].light->location))
            return true;
    for (uint32_t k = 0; k < g->reached_count; k++) {
        const struct element *other = &g->p->element[g->reached[k]];
        if (!patch_is_flat(g->p, other) || (any_above(e, other) && any_above(other, e)))
            return true;
    }
    return false;
}

// Sends rays [first, end) of the elements in the list that have not sent them before.
static void look_once(struct groups *g, const uint32_t *list, uint32_t count,
                      uint32_t first, uint32_t end)
{
    uint32_t *fresh = must_malloc(count + 1, sizeof *fresh), n = 0;
    for (uint32_t k = 0; k < count; k++)
        if (g->sent[list[k]] < end) {
            g->sent[list[k]] = end;
            fresh[n++] = list[k];
        }
    look_from(g, fresh, n, ELEMENT_RAYS + first, end - first);
    free(fresh);
}

// Groups not reached so far send more rays, and look for camera, lamps and what is
// reached. True: one of them was found.
static bool look_again(struct groups *g)
{
    const uint32_t n = g->p->element_count;
    uint32_t left = 0;
    uint32_t *list = must_malloc(n + 1, sizeof *list);
    uint32_t *rays = must_malloc(n + 1, sizeof *rays);
    g->reached = must_malloc(n + 1, sizeof *g->reached);
    g->reached_count = 0;
    g->seen = must_malloc(n + 1, sizeof *g->seen);
    for (uint32_t i = 0; i < n; i++) {
        if (is_reached(g, i))
            g->reached[g->reached_count++] = i;
        else
            left += group_of(g, i) == i;
    }
    const uint64_t tries =
        g->p->settings.trial ? 0 : (uint64_t)fmin(TRIES, (double)TRIES_EACH * n);
    const uint32_t share = (uint32_t)((tries + (uint64_t)ELEMENT_RAYS * n) / (left + 1));
    const uint32_t each = share < GROUP_RAYS_LEAST ? GROUP_RAYS_LEAST
                          : share < GROUP_RAYS     ? share
                                                   : GROUP_RAYS;
    // The smaller a group, the more each of its elements does.
    for (uint32_t i = 0; i < n; i++) {
        rays[i] = is_reached(g, i) ? 0 : each / g->size[group_of(g, i)] + 1;
        if (rays[i] >= ASKED_RAYS && !faces_reached(g, i))
            rays[i] = 0;
    }
    const uint32_t before = g->size[group_of(g, g->root)];
    for (uint32_t done = 0, step = 1; step <= each + 1; done = step, step *= 4) {
        const uint32_t count = list_left(g, rays, step, list);
        look_once(g, list, count, done, step);
        g->list = list;
        g->first = done;
        g->rays = step - done;
        run(g, count, try_to_see);
        for (uint32_t i = 0; i < count; i++)
            if (g->seen[i] && !watch_cancelled(g->p->settings.watch))
                unite(g, g->root, list[i]);
    }
    free(list);
    free(rays);
    free(g->reached);
    free(g->seen);
    return g->size[group_of(g, g->root)] > before;
}

// ---- the whole ---------------------------------------------------------------------
static void keep_reached(struct patches *p, const bool *reached)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < p->element_count; i++) {
        struct cell *c = &p->cell[p->element_cell[i] / 2];
        const int side = p->element_cell[i] & 1;
        c->element[side] = reached[i] ? kept : ELEMENT_NONE;
        if (!reached[i]) {
            c->dead |= (uint8_t)(1u << side);
            continue;
        }
        p->element[kept] = p->element[i];
        p->neighbours[kept] = p->neighbours[i];
        p->element_cell[kept++] = p->element_cell[i];
    }
    p->element_count = p->enclosure.count = kept;
}

static void keep_groups(struct groups *g)
{
    struct patches *p = g->p;
    const uint32_t n = p->element_count;
    bool *keep = must_calloc(n + 1, sizeof *keep);
    // Slivers have no ray that starts on them: what lies beside a reached element stays.
    for (uint32_t i = 0; i < n; i++) {
        if (!is_reached(g, i))
            continue;
        for (uint32_t j = i < 2 ? 0 : i - 2; j <= i + 2 && j < n; j++)
            keep[j] = keep[j] || p->element[j].surface == p->element[i].surface;
    }
    keep_reached(p, keep);
    free(keep);
}

void patches_prune(struct patches *p)
{
    enum { ROUNDS = 8 };
    const uint32_t n = p->element_count;
    struct groups g = {.p = p, .root = n};
    g.parent = must_malloc(n + 1, sizeof *g.parent);
    g.size = must_malloc(n + 1, sizeof *g.size);
    g.sent = must_calloc(n + 1, sizeof *g.sent);
    for (uint32_t i = 0; i <= n; i++) {
        g.parent[i] = i;
        g.size[i] = 1;
    }
    look_around(&g, p->job->camera->location);
    for (uint32_t i = 0; i < p->job->lamp_count && i < EYES_MOST; i++)
        look_around(&g, p->job->lamp[i].light->location);
    unite_neighbours(&g);
    look_first(&g);
    const int rounds = p->settings.trial ? 1 : ROUNDS;
    for (int round = 0; round < rounds && g.size[group_of(&g, n)] <= n && look_again(&g);
         round++)
        ;
    // A camera that sees nothing of the scene's elements tells nothing.
    if (g.size[group_of(&g, n)] > 1)
        keep_groups(&g);
    free(g.parent);
    free(g.size);
    free(g.sent);
}
