// Rays in packets of eight: the choice of an instruction set, and the way from batches to
// packets and back.
#include "trace/packet.h"

#include <stdlib.h>
#include <string.h>

#ifdef LAMBERT_X86
static bool isa_present(const struct packet_kernels *k)
{
    if (k == &packet_kernels_avx512)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx2");
    if (k == &packet_kernels_avx2)
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2");
    return true;
}
#endif

const struct packet_kernels *packet_kernels_choose(void)
{
#ifdef LAMBERT_X86
    static const struct packet_kernels *const best_first[] = {
        &packet_kernels_avx512, &packet_kernels_avx2, &packet_kernels_base};
    const char *wanted = getenv("LAMBERT_ISA");
    const struct packet_kernels *best = NULL;
    for (size_t i = 0; i < 3; i++) {
        if (!isa_present(best_first[i]))
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

static struct ray_query query_of(const struct packet *p, int i)
{
    return (struct ray_query){
        .ray = {vec3(p->o[0][i], p->o[1][i], p->o[2][i]),
                vec3(p->d[0][i], p->d[1][i], p->d[2][i]), p->t_min[i], p->t_max[i]},
        .hidden_by = p->hidden_by[i]};
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

struct hit packet_lane_hit(struct packet *p, int lane)
{
    const uint32_t object = p->object[lane];
    const struct ray_query q = query_of(p, lane);
    struct boundary_list *list = &p->s->crossings;
    list->count = 0;
    const struct world_object *o = &p->w->object[object];
    leaf_crossings(p->w, o->is_csg ? p->leaf[lane] : o->first_leaf, &q.ray, list);
    // A packet's kernel found it: the leaf has a crossing of just this t.
    for (uint32_t i = 0; i < list->count; i++)
        if (list->at[i].t == p->t[lane] && list->at[i].drawn)
            return (struct hit){list->at[i]};
    abort();
}

// ---- batches --------------------------------------------------------------------------

static void load(struct packet *p, const struct ray_batch *r, uint32_t first)
{
    const uint32_t count = r->count - first < 8 ? r->count - first : 8;
    p->alive = (1u << count) - 1;
    p->searching = p->whole = p->hidden_any = 0;
    for (int a = 0; a < 3; a++) {
        memcpy(p->o[a], r->o[a] + first, sizeof p->o[a]);
        memcpy(p->d[a], r->d[a] + first, sizeof p->d[a]);
    }
    memcpy(p->t_min, r->t_min + first, sizeof p->t_min);
    memcpy(p->t_max, r->t_max + first, sizeof p->t_max);
    memcpy(p->hidden_by, r->hidden_by + first, sizeof p->hidden_by);
    for (uint32_t i = count; i < 8; i++) {
        for (int a = 0; a < 3; a++) {
            p->o[a][i] = p->o[a][0];
            p->d[a][i] = p->d[a][0];
        }
        p->t_min[i] = p->t_min[0];
        p->t_max[i] = p->t_max[0];
        p->hidden_by[i] = p->hidden_by[0];
    }
    for (uint32_t i = 0; i < 8; i++) {
        p->t[i] = INFINITY;
        p->object[i] = UINT32_MAX;
        p->hidden_any |= p->hidden_by[i];
    }
}

void trace_closest(const struct world *w, struct trace_scratch *s,
                   const struct ray_batch *rays, struct hit *out)
{
    struct packet p;
    p.w = w;
    p.s = s;
    p.mode = SWEEP_CLOSEST;
    s->stats.rays += rays->count;
    for (uint32_t i = 0; i < rays->count; i += 8) {
        load(&p, rays, i);
        w->accel->kernels->trace(&p, out + i);
    }
}

void trace_occluded(const struct world *w, struct trace_scratch *s,
                    const struct ray_batch *rays, uint8_t *out)
{
    struct packet p;
    p.w = w;
    p.s = s;
    p.mode = SWEEP_OPAQUE;
    s->stats.shadow_rays += rays->count;
    for (uint32_t i = 0; i < rays->count; i += 8) {
        load(&p, rays, i);
        w->accel->kernels->trace(&p, NULL);
        for (uint32_t k = i; k < i + 8 && k < rays->count; k++)
            out[k] = p.object[k - i] != UINT32_MAX;
    }
}
