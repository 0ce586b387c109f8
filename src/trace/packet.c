// Rays in packets of eight: the choice of an instruction set, and the way from batches to
// packets and back.
#include "trace/packet.h"

#include <stdlib.h>
#include <string.h>

#include "math/processor.h"

const struct packet_kernels *packet_kernels_choose(void)
{
#ifdef LAMBERT_X86
    static const struct packet_kernels *const best_first[] = {
        &packet_kernels_avx512, &packet_kernels_avx2, &packet_kernels_base};
    const char *wanted = getenv("LAMBERT_ISA");
    const struct packet_kernels *best = NULL;
    for (size_t i = 0; i < 3; i++) {
        if (!processor_has(best_first[i]->name))
            continue;
        if (wanted && strcmp(wanted, best_first[i]->name) == 0)
            return best_first[i];
        if (!best)
            best = best_first[i];
    }
    return best;
#else
    return &packet_kernels_base;
#endif
}

// ---- lanes ----------------------------------------------------------------------------

static struct ray_query query_of(const struct packet *p, int lane)
{
    const struct ray_batch *r = p->rays;
    const uint32_t i = p->first + (uint32_t)lane;
    return (struct ray_query){.ray = {vec3(r->o[0][i], r->o[1][i], r->o[2][i]),
                                      vec3(r->d[0][i], r->d[1][i], r->d[2][i]),
                                      r->t_min[i], r->t_max[i]},
                              .hidden_by = r->hidden_by[i]};
}

struct search *packet_lane_begin(struct packet *p, int lane)
{
    struct search *f = &p->search[lane];
    if (!(p->searching >> lane & 1)) {
        p->query[lane] = query_of(p, lane);
        *f = search_of(p->w, p->s, &p->query[lane], p->mode);
        p->searching |= 1u << lane;
    }
    if (f->object != p->object[lane]) {
        f->t = p->t[lane];
        f->object = p->object[lane];
        f->known = false;
    }
    return f;
}

void packet_lane_end(struct packet *p, int lane)
{
    const struct search *f = &p->search[lane];
    if (p->object[lane] != f->object || p->t[lane] != f->t)
        p->whole &= ~(1u << lane);
    p->t[lane] = f->t;
    p->object[lane] = f->object;
}

unsigned packet_try_object(struct packet *p, unsigned lanes, uint32_t object)
{
    unsigned found = 0;
    for (; lanes; lanes &= lanes - 1) {
        const int lane = __builtin_ctz(lanes);
        if (search_try_object(packet_lane_begin(p, lane), object))
            found |= 1u << lane;
        packet_lane_end(p, lane);
    }
    return found;
}

struct boundary boundary_at(const struct world *w, struct trace_scratch *s,
                            const struct ray *ray, uint32_t leaf, double t)
{
    struct boundary_list *list = &s->crossings;
    list->count = 0;
    leaf_crossings(w, leaf, ray, list);
    for (uint32_t i = 0; i < list->count; i++)
        if (list->at[i].t == t && list->at[i].drawn)
            return list->at[i];
    abort();
}

struct boundary packet_lane_hit(struct packet *p, int lane)
{
    const struct ray_query q = query_of(p, lane);
    return boundary_at(p->w, p->s, &q.ray, p->leaf[lane], p->t[lane]);
}

// ---- all crossings --------------------------------------------------------------------

bool packet_lists_crossings(const struct world *w)
{
    for (uint32_t i = 0; i < w->object_count; i++) {
        const enum packet_shape shape = w->accel->object_shape[i];
        if (w->object[i].mixed)
            return false;
        if (!w->object[i].opaque && shape != PACKET_PRODUCT &&
            (shape < PACKET_SPHERE || shape > PACKET_TRIANGLE))
            return false;
    }
    return true;
}

// ---- batches --------------------------------------------------------------------------

void trace_closest(const struct world *w, struct trace_scratch *s,
                   const struct ray_batch *rays, const struct hit_batch *out)
{
    w->accel->kernels->hits(w, s, rays, out);
}

void trace_occluded(const struct world *w, struct trace_scratch *s,
                    const struct ray_batch *rays, uint8_t *out)
{
    w->accel->kernels->occluded(w->dark, s, rays, NULL, out);
}

void trace_occluded_by(const struct world *w, struct trace_scratch *s,
                       const struct ray_batch *rays, uint64_t some, uint8_t *out)
{
    w->accel->kernels->occluded(w->dark, s, rays, &some, out);
}
