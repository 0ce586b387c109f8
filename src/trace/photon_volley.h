#ifndef TRACE_PHOTON_VOLLEY_H
#define TRACE_PHOTON_VOLLEY_H

#include "trace/photon_path.h"

// Shots that are flown together, on all threads of the job. They come in rings; what the
// shots of a ring leave is added to the photons in the order of the shots, whichever thread
// flew them.
struct photon_volley;
struct photon_volley *photon_volley_new(const struct job *job, struct photons *to,
                                        const volatile bool *cancel);
void photon_volley_free(struct photon_volley *v);

// Begins a ring, and adds a shot to the last one.
void photon_volley_ring(struct photon_volley *v);
void photon_volley_shot(struct photon_volley *v, struct vec3 o, struct vec3 d,
                        uint32_t hash);
// Shots and rings since the last clearing.
uint32_t photon_volley_shots(const struct photon_volley *v);
uint32_t photon_volley_rings(const struct photon_volley *v);
// Flies them all; nothing is added to the photons yet.
void photon_volley_fly(struct photon_volley *v, const struct photon_gun *gun);
// Adds what a ring has left, if it was flown; returns how many of its shots met the target.
uint32_t photon_volley_take(struct photon_volley *v, uint32_t ring);
void photon_volley_clear(struct photon_volley *v);

#endif
