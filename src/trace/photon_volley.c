#include "trace/photon_volley.h"

#include <stdatomic.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "trace/photon_flight.h"

// Consecutive shots of one ring, and what they left.
struct flock {
    uint32_t begin, end; // shots
    uint32_t ring, met;
    struct photons left;
};

enum {
    FLOCK = 64,   // shots that one thread takes at once
    THREADS = 256 // as parallel_run has at most
};

struct photon_volley {
    const struct job *job;
    struct photons *to;
    const volatile bool *cancel;
    const struct photon_gun *gun;
    struct photon_shot *shot;
    uint32_t shot_count, shot_capacity;
    struct flock *flock; // those past flock_count keep their memory
    uint32_t flock_count, flock_capacity, flock_made;
    uint32_t rings, taken;                 // flocks before `taken` were added
    struct photon_flight *flight[THREADS]; // made when first needed
    atomic_uint next_flight;
};

struct photon_volley *photon_volley_new(const struct job *job, struct photons *to,
                                        const volatile bool *cancel)
{
    struct photon_volley *v = must_calloc(1, sizeof *v);
    v->job = job;
    v->to = to;
    v->cancel = cancel;
    return v;
}

void photon_volley_free(struct photon_volley *v)
{
    for (uint32_t i = 0; i < v->flock_made; i++) {
        photon_map_end(&v->flock[i].left.surface);
        photon_map_end(&v->flock[i].left.media);
    }
    for (int i = 0; i < THREADS && v->flight[i]; i++)
        photon_flight_free(v->flight[i]);
    free(v->flock);
    free(v->shot);
    free(v);
}

// ---- filling -------------------------------------------------------------------------

static void flock_begin(struct photon_volley *v)
{
    v->flock = must_grow(v->flock, v->flock_count, &v->flock_capacity, sizeof *v->flock);
    struct flock *f = &v->flock[v->flock_count++];
    if (v->flock_count > v->flock_made) {
        v->flock_made = v->flock_count;
        f->left = (struct photons){.surface = {0}};
    }
    f->begin = f->end = v->shot_count;
    f->ring = v->rings - 1;
    f->met = 0;
    f->left.surface.count = f->left.media.count = 0;
}

void photon_volley_ring(struct photon_volley *v)
{
    v->rings++;
    flock_begin(v);
}

void photon_volley_shot(struct photon_volley *v, struct vec3 o, struct vec3 d,
                        uint32_t hash)
{
    const struct flock *last = &v->flock[v->flock_count - 1];
    if (last->end - last->begin == FLOCK)
        flock_begin(v);
    v->shot = must_grow(v->shot, v->shot_count, &v->shot_capacity, sizeof *v->shot);
    v->shot[v->shot_count++] = (struct photon_shot){o, d, hash};
    v->flock[v->flock_count - 1].end++;
}

uint32_t photon_volley_shots(const struct photon_volley *v) { return v->shot_count; }

uint32_t photon_volley_rings(const struct photon_volley *v) { return v->rings; }

void photon_volley_clear(struct photon_volley *v)
{
    v->shot_count = v->flock_count = v->rings = v->taken = 0;
}

// ---- flying --------------------------------------------------------------------------

static void *flight_of_thread(void *user)
{
    struct photon_volley *v = user;
    struct photon_flight **f = &v->flight[atomic_fetch_add(&v->next_flight, 1)];
    if (!*f)
        *f = photon_flight_new(v->job);
    return *f;
}

static void flocks_fly(void *user, void *state, uint32_t begin, uint32_t end)
{
    struct photon_volley *v = user;
    struct photon_flight *f = state;
    for (uint32_t i = begin; i < end; i++) {
        struct flock *flock = &v->flock[i];
        flock->met = photon_fly(f, v->gun, v->shot + flock->begin,
                                flock->end - flock->begin, v->cancel, &flock->left);
    }
}

void photon_volley_fly(struct photon_volley *v, const struct photon_gun *gun)
{
    const struct parallel p = {.threads = v->job->settings.threads,
                               .piece = 1,
                               .user = v,
                               .begin = flight_of_thread,
                               .work = flocks_fly};
    v->gun = gun;
    atomic_store(&v->next_flight, 0);
    parallel_run(&p, v->flock_count);
}

uint32_t photon_volley_take(struct photon_volley *v, uint32_t ring)
{
    uint32_t met = 0;
    for (; v->taken < v->flock_count && v->flock[v->taken].ring == ring; v->taken++) {
        const struct flock *f = &v->flock[v->taken];
        photon_map_append(&v->to->surface, &f->left.surface);
        photon_map_append(&v->to->media, &f->left.media);
        met += f->met;
    }
    return met;
}
