#include "trace/indirect_lanes.h"

#include "trace/shade.h"

static void add(struct tracer *t, const struct simple_group *g, int i, struct rgb light)
{
    t->slot = g->slot[i];
    tracer_add(t,
               rgb_mul(rgb(g->through[0][i], g->through[1][i], g->through[2][i]), light));
}

// With the interaction of the hit.
static void ask(struct tracer *t, uint32_t k, const struct indirect_hit *hit,
                struct rgb matt, bool back)
{
    const struct wavefront *w = &t->wave;
    const uint32_t slot = w->slot[k];
    struct path path = wave_path(t, slot);
    if (!(path.flags & PATH_CONTINUED))
        path.level++;
    struct indirect_hit whole = *hit;
    whole.path = &path;
    const struct rgb light = indirect_light(t, &whole, back);
    t->slot = slot;
    tracer_add(t,
               rgb_mul(rgb(w->through[0][slot], w->through[1][slot], w->through[2][slot]),
                       rgb_mul(matt, light)));
}

static struct interaction interaction_of(const struct tracer *t, const struct ray *ray,
                                         const struct hit *met)
{
    struct interaction at;
    trace_interaction(t->job->world, ray, met, &at);
    return at;
}

static struct vec3 towards(struct vec3 n, struct vec3 d)
{
    return vec3_dot(n, d) > 0 ? vec3_neg(n) : n;
}

struct vec3 bare_normal(const struct tracer *t, uint32_t k)
{
    const struct ray ray = ray_batch_line(t->rays, k);
    const struct hit met = hit_batch_at(t->hit, k);
    return towards(interaction_of(t, &ray, &met).ns, ray.d);
}

void indirect_ask(struct tracer *t, uint32_t k, struct rgb matt, const struct vec3 *n,
                  bool back)
{
    const struct ray ray = ray_batch_line(t->rays, k);
    const struct hit met = hit_batch_at(t->hit, k);
    const struct interaction at = interaction_of(t, &ray, &met);
    const struct indirect_hit hit = {&ray, &met, &at, n ? *n : towards(at.ns, ray.d),
                                     NULL};
    ask(t, k, &hit, matt, back);
}

static struct vec3 lane_vec(const double v[3][8], int i)
{
    return vec3(v[0][i], v[1][i], v[2][i]);
}

static void keep_place(const struct simple_group *g, int i, struct indirect_kept *out)
{
    out->p = lane_vec((const double(*)[8])g->p, i);
    out->ng = lane_vec((const double(*)[8])g->ng, i);
    out->ns = lane_vec((const double(*)[8])g->n, i);
    out->error = g->error[i];
}

// One side of what ray k asks.
static void ask_side(struct tracer *t, uint32_t k, const struct indirect_kept *x,
                     bool back)
{
    const struct world *w = t->job->world;
    const struct ray ray = ray_batch_line(t->rays, k);
    const struct hit met = hit_batch_at(t->hit, k);
    const struct leaf *l = &w->leaf[met.b.leaf];
    // As trace_interaction; what only textures look at is left out.
    const struct interaction at = {.p = x->p,
                                   .error = x->error,
                                   .ng = x->ng,
                                   .ns = x->ns,
                                   .leaf = l,
                                   .surface = &w->surface[l->surface]};
    const struct indirect_hit hit = {&ray, &met, &at, x->n[back], NULL};
    ask(t, k, &hit, x->matt[back], back);
}

void indirect_keep(const struct simple_group *g, const struct indirect_side *side,
                   struct indirect_kept *kept)
{
    for (unsigned lanes = side->lanes; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        struct indirect_kept *x = &kept[g->ray[i]];
        if (!x->any) {
            keep_place(g, i, x);
            x->matt[!side->back] = rgb(0, 0, 0);
        }
        x->any = true;
        x->matt[side->back] = side->matt[i];
        x->n[side->back] = lane_vec((const double(*)[8])side->n, i);
    }
}

void indirect_ask_kept(struct tracer *t, uint32_t k, const struct indirect_kept *kept)
{
    for (int back = 0; back < 2; back++)
        if (rgb_max(kept->matt[back]) > 0)
            ask_side(t, k, kept, back);
}

// What the lanes of a group ask, with the normals n.
static struct indirect_eight question(const struct tracer *t,
                                      const struct simple_group *g, unsigned lanes,
                                      const double n[3][8], bool back)
{
    const struct wavefront *w = &t->wave;
    struct indirect_eight q = {.lanes = lanes};
    for (int i = 0; i < 8; i++) {
        q.weight[i] = w->path ? w->path[w->order[g->slot[i]]].weight : 1;
        for (int k = 0; k < 3; k++) {
            q.p[k][i] = g->p[k][i];
            q.n[k][i] = back ? -n[k][i] : n[k][i];
        }
    }
    return q;
}

// Asks for the light of `lanes` that is known; returns those for which it is.
static unsigned known_light(struct tracer *t, const struct simple_group *g,
                            unsigned lanes, const double n[3][8], bool back,
                            struct rgb light[8])
{
    const struct indirect *indirect = &t->job->settings.indirect;
    if (!lanes)
        return 0;
    const struct indirect_eight q = question(t, g, lanes, n, back);
    return indirect->known(indirect->data, t->indirect, &q, light);
}

unsigned indirect_settled(struct tracer *t, const struct simple_group *g)
{
    const struct indirect *indirect = &t->job->settings.indirect;
    const struct indirect_eight q =
        question(t, g, g->live, (const double(*)[8])g->n, false);
    return indirect->settled(indirect->data, t->indirect, &q);
}

unsigned indirect_known(struct tracer *t, const struct simple_group *g,
                        struct rgb light[8])
{
    const struct job *job = t->job;
    const struct indirect *indirect = &job->settings.indirect;
    if (!indirect->data || !indirect->known || indirect->layer_normals || !job->lights ||
        job->settings.purpose != RENDER_PICTURE || job->has_media || job->has_air_media)
        return 0;
    return known_light(t, g, g->live, (const double(*)[8])g->n, false, light);
}

// Adds the light of the lanes for which it is known; returns all others.
static unsigned add_known(struct tracer *t, const struct simple_group *g,
                          const struct indirect_side *side)
{
    struct rgb light[8];
    const bool layers = t->job->settings.indirect.layer_normals;
    const unsigned known =
        known_light(t, g, side->lanes & ~(layers ? 0 : side->perturbed),
                    (const double(*)[8])(layers ? side->n : g->n), side->back, light);
    for (unsigned bits = known; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        add(t, g, i, rgb_mul(side->matt[i], light[i]));
    }
    return side->lanes & ~known;
}

void indirect_side_light(struct tracer *t, const struct simple_group *g,
                         const struct indirect_side *side)
{
    unsigned lanes = side->lanes;
    if (lanes && t->job->settings.indirect.known)
        lanes = add_known(t, g, side);
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        const struct vec3 n = lane_vec((const double(*)[8])side->n, i);
        if ((side->perturbed >> i) & 1) {
            indirect_ask(t, g->ray[i], side->matt[i], &n, side->back);
        } else {
            struct indirect_kept x;
            keep_place(g, i, &x);
            x.matt[side->back] = side->matt[i];
            x.n[side->back] = n;
            ask_side(t, g->ray[i], &x, side->back);
        }
    }
}
