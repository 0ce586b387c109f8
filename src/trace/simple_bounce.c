// Rays that go on from simple surfaces: the directions come from the kernels, the rest is
// bookkeeping ray by ray. The rules are those of trace/shade_transmit.c.
#include "trace/inside.h"
#include "trace/shade.h"
#include "trace/shade_kernel.h"

static const double zero = 1e-10; // spec/lighting.md 0

// One lane of a group.
struct lane {
    struct tracer *t;
    const struct simple_class *c;
    const struct simple_bounce *b;
    int i;
    const struct path *from; // as it arrives at the surface, but for
    uint16_t level, parent;  // these
    uint8_t flags;
    struct rgb mirror;
};

// fminf(1, x) and the like are calls.
static inline float at_most_1(float x) { return x < 1 ? x : 1; }

static inline float most_abs(struct rgb c)
{
    const float r = fabsf(c.r), g = fabsf(c.g), b = fabsf(c.b);
    const float m = r > g ? r : g;
    return m > b ? m : b;
}

// There is room for it (path_queue_reserve). What it shows, and inside what it is, is left
// to the caller.
static inline struct path *emit(struct lane *l, const double o[3][8],
                                const double d[3][8], uint32_t way)
{
    struct path_queue *q = l->t->wave.next;
    struct path *p = &q->at[q->count];
    const struct path *from = l->from;
    const int i = l->i;
    q->order[q->count] = q->count;
    q->count++;
    p->o = vec3(o[0][i], o[1][i], o[2][i]);
    p->d = vec3(d[0][i], d[1][i], d[2][i]);
    p->inside = from->inside;
    p->wavelength = from->wavelength;
    p->sample = from->sample;
    p->hash = hash_mix(from->hash, way);
    p->level = l->level;
    p->parent = l->parent;
    p->flags = l->flags;
    return p;
}

static inline void emit_back(struct lane *l, uint32_t way, float weight,
                             struct rgb through)
{
    const struct simple_bounce *b = l->b;
    struct path *p =
        emit(l, (const double(*)[8])b->mirror_o, (const double(*)[8])b->mirror_d, way);
    p->flags |= PATH_REFLECTED;
    p->through_t = 0;
    p->weight = weight;
    p->through = through;
}

static void emit_mirrored(struct lane *l)
{
    const float weight = l->from->weight * l->b->weight[l->i];
    const struct rgb m = l->mirror;
    if ((m.r == 0 && m.g == 0 && m.b == 0) || !path_counts(l->t->job, l->level, weight))
        return;
    emit_back(l, 1, weight, rgb_mul(m, l->from->through));
}

// What passes the surface; returns false where all is reflected.
static bool emit_passing(struct lane *l, const struct crossing_sides *sides,
                         struct rgb fade, struct rgb filter, float trans)
{
    const struct simple_bounce *b = l->b;
    const float weight = l->from->weight * most_abs(filter);
    const bool straight = fabs(b->eta[l->i] - 1) < zero;
    const bool total = !straight && (b->total >> l->i & 1);
    if (!path_counts(l->t->job, l->level, weight))
        return !total;
    const struct rgb factor = rgb_mul(l->from->through, fade);
    if (total) {
        emit_back(l, 0, weight, factor);
        return false;
    }
    struct path *p =
        emit(l, (const double(*)[8])b->bent_o, (const double(*)[8])b->bent_d, 0);
    p->inside = sides->inside;
    p->weight = weight;
    p->through_t = l->from->through_t * (rgb_grey(fade) * trans);
    if (straight)
        p->flags |= PATH_CONTINUED;
    p->through = straight ? rgb_mul(l->from->through, rgb_mul(fade, filter))
                          : rgb_mul(factor, filter);
    return true;
}

static struct rgb lane_fade(const struct lane *l, const struct surface *s, double way)
{
    const struct simple_bounce *b = l->b;
    const int i = l->i;
    if (!(b->fading >> i & 1))
        return way_fade(s->interior, l->from->inside, way);
    return rgb_mul(rgb_gray(s->interior->old_refraction),
                   rgb(b->fade[0][i], b->fade[1][i], b->fade[2][i]));
}

// Asks for the fading of the way through the interior, where exp tells it.
static void ask_fade(struct simple_bounce *b, int i, const struct interior *x,
                     const struct inside *inside, double way)
{
    if (!(fabs(x->fade_distance) > zero) || !interior_fades_exponentially(x) ||
        !inside_find(inside, x))
        return;
    b->fading |= 1u << i;
    b->exponent[0][i] = interior_fade_exponent(x, way, x->fade_color.r);
    b->exponent[1][i] = interior_fade_exponent(x, way, x->fade_color.g);
    b->exponent[2][i] = interior_fade_exponent(x, way, x->fade_color.b);
}

static bool pass(struct lane *l, const struct surface *s, struct rgb pass, double way,
                 const struct crossing_sides *sides)
{
    const struct job *job = l->t->job;
    if (l->c->finish->conserve_energy) {
        const struct rgb m = l->mirror;
        pass = rgb_mul(pass,
                       rgb(at_most_1(1 - m.r), at_most_1(1 - m.g), at_most_1(1 - m.b)));
    }
    const float trans = at_most_1(fabsf(rgb_grey(pass)));
    if (!(trans > job->adc_bailout) || !job->refraction)
        return true;
    const struct rgb fade = lane_fade(l, s, way);
    return emit_passing(l, sides, fade, pass, trans);
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

void simple_bounce(struct tracer *t, const struct simple_class *c,
                   const struct simple_group *g)
{
    const struct world *w = t->job->world;
    const struct wavefront *wave = &t->wave;
    struct simple_bounce b;
    struct crossing_sides sides[8];
    const struct surface *surface[8];
    const struct path *from[8];
    struct path camera[8];
    struct sides_known known = {.interior = NULL};
    b.fading = 0;
    for (int i = 0; i < 8; i++) {
        b.eta[i] = b.index[i] = 1;
        b.exponent[0][i] = b.exponent[1][i] = b.exponent[2][i] = 0;
        if (!(g->live >> i & 1))
            continue;
        if (wave->path && !t->job->has_air) {
            from[i] = &wave->path[wave->order[g->slot[i]]];
        } else {
            camera[i] = wave_path(t, g->slot[i]);
            from[i] = &camera[i];
        }
        surface[i] = &w->surface[w->leaf[t->hit->leaf[g->ray[i]]].surface];
        const struct interior *x = surface[i]->interior;
        sides_find(t, c, from[i]->inside, x, &known);
        b.index[i] = known.index;
        b.eta[i] = known.eta;
        sides[i] = known.sides;
        if (c->clear)
            ask_fade(&b, i, x, from[i]->inside, t->hit->t[g->ray[i]]);
    }
    t->job->kernels->bounce(c, g, &b);
    path_queue_reserve(t->wave.next, 16);
    for (unsigned live = g->live; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        struct lane l = {.t = t,
                         .c = c,
                         .b = &b,
                         .i = i,
                         .from = from[i],
                         .level = from[i]->level,
                         .parent = g->slot[i],
                         .flags = from[i]->flags & (uint8_t)~PATH_OF_ONE_WAY,
                         .mirror = {b.mirror[0][i], b.mirror[1][i], b.mirror[2][i]}};
        if (!(from[i]->flags & PATH_CONTINUED))
            l.level++;
        if (c->clear) {
            if (fabs(b.eta[i] - 1) < zero)
                go_straight(g, &b, i);
            const struct simple_surface *x = &t->job->simple[surface[i] - w->surface];
            if (!pass(&l, surface[i], x->pass, t->hit->t[g->ray[i]], &sides[i]))
                continue;
        }
        if (c->mirror)
            emit_mirrored(&l);
    }
}
