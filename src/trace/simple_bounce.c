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
    struct path from; // as it arrives at the surface
    struct rgb mirror;
};

static struct path *emit(struct lane *l, const double o[3][8], const double d[3][8],
                         uint32_t way)
{
    struct path *p = path_queue_add(l->t->wave.next);
    *p = l->from;
    p->o = vec3(o[0][l->i], o[1][l->i], o[2][l->i]);
    p->d = vec3(d[0][l->i], d[1][l->i], d[2][l->i]);
    p->hash = hash_mix(p->hash, way);
    return p;
}

static void emit_mirrored(struct lane *l)
{
    const struct simple_bounce *b = l->b;
    const float weight = l->from.weight * b->weight[l->i];
    const struct rgb m = l->mirror;
    if ((m.r == 0 && m.g == 0 && m.b == 0) ||
        !path_counts(l->t->job, l->from.level, weight))
        return;
    struct path *p =
        emit(l, (const double(*)[8])b->mirror_o, (const double(*)[8])b->mirror_d, 1);
    p->flags |= PATH_REFLECTED;
    p->through_t = 0;
    p->weight = weight;
    p->through = rgb_mul(m, p->through);
}

// What passes the surface; returns false where all is reflected.
static bool emit_passing(struct lane *l, const struct crossing_sides *sides,
                         struct rgb fade, struct rgb filter, float trans)
{
    const struct simple_bounce *b = l->b;
    const float weight =
        l->from.weight * fmaxf(fabsf(filter.r), fmaxf(fabsf(filter.g), fabsf(filter.b)));
    const bool straight = fabs(b->eta[l->i] - 1) < zero;
    const bool total = !straight && (b->total >> l->i & 1);
    if (!path_counts(l->t->job, l->from.level, weight))
        return !total;
    const struct rgb factor = rgb_mul(l->from.through, fade);
    if (total) {
        struct path *p =
            emit(l, (const double(*)[8])b->mirror_o, (const double(*)[8])b->mirror_d, 0);
        p->flags |= PATH_REFLECTED;
        p->weight = weight;
        p->through = factor;
        p->through_t = 0;
        return false;
    }
    struct path *p =
        emit(l, (const double(*)[8])b->bent_o, (const double(*)[8])b->bent_d, 0);
    p->inside = sides->inside;
    p->weight = weight;
    p->through_t *= rgb_grey(fade) * trans;
    if (straight)
        p->flags |= PATH_CONTINUED;
    p->through =
        straight ? rgb_mul(p->through, rgb_mul(fade, filter)) : rgb_mul(factor, filter);
    return true;
}

static struct rgb lane_fade(const struct lane *l, const struct surface *s, double way)
{
    const struct simple_bounce *b = l->b;
    const int i = l->i;
    if (!(b->fading >> i & 1))
        return way_fade(s->interior, l->from.inside, way);
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
        pass =
            rgb_mul(pass, rgb(fminf(1, 1 - m.r), fminf(1, 1 - m.g), fminf(1, 1 - m.b)));
    }
    const float trans = fminf(1, fabsf(rgb_grey(pass)));
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

void simple_bounce(struct tracer *t, const struct simple_class *c,
                   const struct simple_group *g)
{
    const struct world *w = t->job->world;
    struct simple_bounce b;
    struct crossing_sides sides[8];
    const struct surface *surface[8];
    unsigned live = 0;
    b.fading = 0;
    for (int i = 0; i < 8; i++) {
        b.eta[i] = b.index[i] = 1;
        b.exponent[0][i] = b.exponent[1][i] = b.exponent[2][i] = 0;
        if (!(g->live >> i & 1))
            continue;
        surface[i] = &w->surface[w->leaf[t->hit->leaf[g->ray[i]]].surface];
        const struct inside *inside = wave_inside(t, g->slot[i]);
        if (c->finish->fresnel)
            b.index[i] = fresnel_index(inside, surface[i]->interior);
        if (c->clear) {
            sides[i] = interior_cross(t, inside, surface[i]->interior);
            b.eta[i] = crossing_eta(&sides[i]);
            ask_fade(&b, i, surface[i]->interior, inside, t->hit->t[g->ray[i]]);
        }
        live |= 1u << i;
    }
    t->job->kernels->bounce(c, g, &b);
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        struct lane l = {.t = t,
                         .c = c,
                         .b = &b,
                         .i = i,
                         .from = wave_path(t, g->slot[i]),
                         .mirror = {b.mirror[0][i], b.mirror[1][i], b.mirror[2][i]}};
        if (!(l.from.flags & PATH_CONTINUED))
            l.from.level++;
        l.from.flags &= (uint8_t)~PATH_OF_ONE_WAY;
        l.from.parent = g->slot[i];
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
