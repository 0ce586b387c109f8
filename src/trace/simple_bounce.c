// Rays that go on from simple surfaces: the directions come from the kernels, the rest is
// bookkeeping ray by ray. The rules are those of trace/shade_transmit.c.
#include "trace/inside.h"
#include "trace/near_zero.h"
#include "trace/shade.h"
#include "trace/shade_kernel.h"

// One lane of a group.
struct lane {
    struct tracer *t;
    const struct simple_bounce *b;
    int i;
    const struct path *from; // as it arrives at the surface, but for
    uint16_t level, parent;  // these
    uint8_t flags;
    uint8_t key; // of rays on the inside
};

// There is room for it (path_queue_reserve).
static inline struct path *emit(struct lane *l, const double o[3][8],
                                const double d[3][8], const float through[3][8],
                                float weight, const struct inside *inside, uint32_t way)
{
    struct path_queue *q = l->t->wave.next;
    struct path *p = &q->at[q->count];
    const struct path *from = l->from;
    const int i = l->i;
    q->order[q->count] = q->count;
    q->count++;
    p->o = vec3(o[0][i], o[1][i], o[2][i]);
    p->d = vec3(d[0][i], d[1][i], d[2][i]);
    p->inside = inside;
    p->through = rgb(through[0][i], through[1][i], through[2][i]);
    p->weight = weight;
    p->key = inside ? l->key : 0;
    p->wavelength = from->wavelength;
    p->sample = from->sample;
    p->hash = hash_mix(from->hash, way);
    p->level = l->level;
    p->parent = l->parent;
    p->flags = l->flags;
    return p;
}

static inline void emit_back(struct lane *l, const float through[3][8], float weight,
                             uint32_t way)
{
    const struct simple_bounce *b = l->b;
    struct path *p =
        emit(l, (const double(*)[8])b->mirror_o, (const double(*)[8])b->mirror_d, through,
             weight, l->from->inside, way);
    p->flags |= PATH_REFLECTED;
    p->through_t = 0;
}

// What passes the surface; returns false where all is reflected.
static bool emit_passing(struct lane *l, const struct inside *inside, bool level_counts)
{
    const struct simple_bounce *b = l->b;
    const int i = l->i;
    const bool total = b->total >> i & 1;
    if (!level_counts || !(b->counts >> i & 1))
        return !total;
    if (total) {
        emit_back(l, (const float(*)[8])b->back, b->bent_weight[i], 0);
        return false;
    }
    struct path *p = emit(l, (const double(*)[8])b->bent_o, (const double(*)[8])b->bent_d,
                          (const float(*)[8])b->bent, b->bent_weight[i], inside, 0);
    p->through_t = l->from->through_t * b->clarity[i];
    if (b->straight >> i & 1)
        p->flags |= PATH_CONTINUED;
    return true;
}

// Asks for the fading of the way through the interior.
static void ask_fade(struct simple_bounce *b, int i, const struct interior *x,
                     const struct inside *inside, double way)
{
    struct rgb fade = rgb_even(x->old_refraction);
    if (fabs(x->fade_distance) > NEAR_ZERO && inside_find(inside, x)) {
        if (interior_fades_exponentially(x)) {
            b->fading |= 1u << i;
            interior_fade_exponents(x, way, &b->exponent[0][i], 8);
        } else {
            fade = way_fade(x, inside, way);
        }
    }
    b->fade[0][i] = fade.r;
    b->fade[1][i] = fade.g;
    b->fade[2][i] = fade.b;
}

// Straight on: the direction stays as it is, to the bit.
static void go_straight(const struct simple_group *g, struct simple_bounce *b, int i)
{
    const struct interaction at = {.p = {g->p[0][i], g->p[1][i], g->p[2][i]},
                                   .ng = {g->ng[0][i], g->ng[1][i], g->ng[2][i]},
                                   .error = g->error[i]};
    const struct vec3 d = vec3(g->d[0][i], g->d[1][i], g->d[2][i]);
    const struct vec3 o = trace_offset(&at, d);
    b->bent_d[0][i] = d.x, b->bent_d[1][i] = d.y, b->bent_d[2][i] = d.z;
    b->bent_o[0][i] = o.x, b->bent_o[1][i] = o.y, b->bent_o[2][i] = o.z;
}

// What the sides of a lane's surface are; of the last lane, where that is the same.
struct sides_known {
    const struct inside *inside;
    const struct interior *interior;
    struct crossing_sides sides;
    double eta, index;
};

static void sides_find(struct tracer *t, const struct simple_class *c,
                       const struct inside *inside, const struct interior *x,
                       struct sides_known *k)
{
    if (k->interior == x && k->inside == inside)
        return;
    k->inside = inside;
    k->interior = x;
    k->index = c->finish->fresnel ? fresnel_index(inside, x) : 1;
    k->eta = 1;
    if (c->clear) {
        k->sides = interior_cross(t, inside, x);
        k->eta = crossing_eta(&k->sides);
    }
}

// What the kernel asks for of a lane.
static void lane_ask(struct tracer *t, const struct simple_class *c, int i, uint32_t ray,
                     const struct path *from, struct sides_known *known,
                     struct simple_bounce *b)
{
    const struct world *w = t->job->world;
    const uint32_t surface = w->leaf[t->hit->leaf[ray]].surface;
    const struct interior *x = w->surface[surface].interior;
    b->from_weight[i] = from->weight;
    sides_find(t, c, from->inside, x, known);
    b->index[i] = known->index;
    b->eta[i] = known->eta;
    if (!c->clear)
        return;
    const struct rgb pass = t->job->simple[surface].pass;
    b->pass[0][i] = pass.r;
    b->pass[1][i] = pass.g;
    b->pass[2][i] = pass.b;
    b->straight |= (unsigned)(fabs(known->eta - 1) < NEAR_ZERO) << i;
    ask_fade(b, i, x, from->inside, t->hit->t[ray]);
}

void bounce_from(const struct tracer *t, const struct simple_group *g, unsigned lanes,
                 struct path made[8], const struct path *from[8])
{
    const struct wavefront *wave = &t->wave;
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        if (wave->path && !t->job->has_air) {
            from[i] = &wave->path[wave->order[g->slot[i]]];
        } else {
            made[i] = wave_path(t, g->slot[i]);
            from[i] = &made[i];
        }
    }
}

static struct lane lane_of(struct tracer *t, const struct simple_group *g,
                           const struct path *from, const struct simple_bounce *b, int i)
{
    struct lane l = {.t = t,
                     .b = b,
                     .i = i,
                     .from = from,
                     .level = from->level,
                     .parent = g->slot[i],
                     .flags = from->flags & (uint8_t)~PATH_OF_ONE_WAY};
    if (!(from->flags & PATH_CONTINUED))
        l.level++;
    return l;
}

void bounce_mirrors(struct tracer *t, const struct simple_group *g,
                    const struct path *const from[8], const struct simple_bounce *b,
                    const uint32_t way[8])
{
    path_queue_reserve(t->wave.next, 8);
    for (unsigned lanes = b->mirrors; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        struct lane l = lane_of(t, g, from[i], b, i);
        if (l.level < t->job->max_level)
            emit_back(&l, (const float(*)[8])b->mirrored, b->mirror_weight[i], way[i]);
    }
}

void simple_bounce(struct tracer *t, const struct simple_class *c,
                   const struct simple_group *g)
{
    const struct job *job = t->job;
    struct simple_bounce b; // not set to zero as a whole: it is large
    const struct inside *beyond[8];
    const struct path *from[8];
    struct path camera[8];
    struct sides_known known = {.interior = NULL};
    bounce_from(t, g, g->live, camera, from);
    b.least = job->adc_bailout;
    b.fading = b.straight = 0;
    for (int i = 0; i < 8; i++) {
        b.eta[i] = b.index[i] = 1;
        b.from_weight[i] = 0;
        for (int k = 0; k < 3; k++) {
            b.exponent[k][i] = 0;
            b.pass[k][i] = b.fade[k][i] = 0;
        }
        if (!(g->live >> i & 1))
            continue;
        lane_ask(t, c, i, g->ray[i], from[i], &known, &b);
        beyond[i] = known.sides.inside;
    }
    job->kernels->bounce(c, g, &b);
    path_queue_reserve(t->wave.next, 16);
    for (unsigned live = g->live; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        const uint32_t leaf = t->hit->leaf[g->ray[i]];
        struct lane l = lane_of(t, g, from[i], &b, i);
        l.key = path_key_within(job->world->leaf[leaf].surface);
        const bool level_counts = l.level < job->max_level;
        if (b.straight >> i & 1)
            go_straight(g, &b, i);
        if (c->clear && job->refraction && (b.passes >> i & 1) &&
            !emit_passing(&l, beyond[i], level_counts))
            continue;
        if (c->mirror && level_counts && (b.mirrors >> i & 1))
            emit_back(&l, (const float(*)[8])b.mirrored, b.mirror_weight[i], 1);
    }
}
