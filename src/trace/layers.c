#include "trace/layers.h"

#include "base/arena.h"

void surface_view_init(struct surface_view *v, const struct interaction *at,
                       struct vec3 d)
{
    const struct surface *s = at->surface;
    const bool turned = vec3_dot(at->ns, d) > 0;
    *v = (struct surface_view){at, d, turned ? vec3_neg(at->ns) : at->ns, s->texture,
                               &s->texture_transform};
    if (turned && s->interior_texture) {
        v->texture = s->interior_texture;
        v->transform = &s->interior_texture_transform;
    }
}

// The transforms of a pattern's warps act on normals too (spec/textures.md 11.1).
static struct vec3 pattern_down(const struct pattern *p, struct vec3 n, bool raw)
{
    for (const struct warp *w = p->warps; w; w = w->next) {
        if (w->kind != WARP_TRANSFORM)
            continue;
        n = transform_inverse_normal(&w->transform, n);
        if (!raw)
            n = vec3_normalize(n);
    }
    return n;
}

static struct vec3 warps_up(const struct warp *w, struct vec3 n)
{
    if (!w)
        return n;
    n = warps_up(w->next, n);
    return w->kind == WARP_TRANSFORM ? vec3_normalize(transform_normal(&w->transform, n))
                                     : n;
}

static struct vec3 chain_down(const struct texture_chain *c, struct vec3 n, bool raw)
{
    if (c->outer)
        n = chain_down(c->outer, n, raw);
    if (c->pattern)
        return pattern_down(c->pattern, n, raw);
    if (c->transform && !c->transform->identity) {
        n = transform_inverse_normal(c->transform, n);
        return raw ? n : vec3_normalize(n);
    }
    return n;
}

static struct vec3 chain_up(const struct texture_chain *c, struct vec3 n)
{
    for (; c; c = c->outer) {
        if (c->pattern)
            n = warps_up(c->pattern->warps, vec3_normalize(n));
        else if (c->transform && !c->transform->identity)
            n = transform_normal(c->transform, n);
    }
    return vec3_normalize(n);
}

struct walk {
    struct tracer *t;
    const struct surface_view *v;
    plain_function *plain;
    void *user;
};

static void walk(const struct walk *w, const struct texture *x, struct vec3 p,
                 const struct texture_chain *chain, double weight)
{
    if (x->kind == TEXTURE_PLAIN) {
        w->plain(w->user, w->v, x, p, chain, weight);
        return;
    }
    if (x->kind == TEXTURE_UV) {
        const struct vec2 uv = w->v->at->uv;
        walk(w, x->map->entry[0], vec3(uv.u, uv.v, 0), chain, weight);
        return;
    }
    enum { FEW = 8 };
    const struct texture *few[FEW];
    double few_weight[FEW];
    const struct texture **entry = few;
    double *share = few_weight;
    int most = FEW;
    if (x->map->count > FEW) {
        most = (int)x->map->count;
        entry = arena_new_array(w->t->arena, const struct texture *, x->map->count);
        share = arena_new_array(w->t->arena, double, x->map->count);
    }
    const struct texture_point at = {p, w->v->at->uv, w->v->n, w->v->d, false};
    const int count = texture_select(x, &at, entry, share, most);
    const struct texture_chain link = {chain, NULL, &x->pattern};
    const struct vec3 q =
        x->pattern.ops || x->pattern.warps ? pattern_warp(&x->pattern, p) : p;
    for (int i = 0; i < count; i++)
        if (share[i] != 0)
            walk(w, entry[i], q, &link, weight * share[i]);
}

void texture_walk(struct tracer *t, const struct surface_view *v, plain_function *plain,
                  void *user)
{
    const struct walk w = {t, v, plain, user};
    const struct interaction *at = v->at;
    const bool uv = at->surface->flags & OBJECT_UV_MAPPING;
    const struct texture_chain root = {NULL, uv ? NULL : v->transform, NULL};
    struct vec3 p = at->p;
    if (uv)
        p = vec3(at->uv.u, at->uv.v, 0);
    else if (!v->transform->identity)
        p = transform_inverse_point(v->transform, p);
    walk(&w, v->texture, p, &root, 1);
}

void layer_eval(const struct tracer *t, const struct surface_view *v,
                const struct texture_layer *layer, struct vec3 p,
                const struct texture_chain *chain, bool want_normal, struct layer *out)
{
    struct texture_point at = {p, v->at->uv, v->n, v->d, false};
    out->finish = layer->finish;
    out->n = v->n;
    if (layer->normal && want_normal && t->job->normals) {
        const bool raw = layer->normal->no_bump_scale;
        at.normal = chain_down(chain, v->n, raw);
        out->n = normal_perturb(layer->normal, &at);
        if (raw)
            out->n = vec3_normalize(out->n);
        at.normal = out->n;
        out->n = chain_up(chain, out->n);
    }
    const struct pigment *pigment = layer->pigment;
    struct rgbft c = pigment->color;
    out->found = true;
    if (!t->job->pigments && pigment->has_quick_color)
        c = pigment->quick_color;
    else if (pigment->kind != PIGMENT_SOLID)
        out->found = pigment_color(pigment, &at, &c);
    out->color = rgbft_rgb(c);
    out->pass = rgbft_pass(c);
    out->att = t->job->old_opacity ? 1 - (c.filter * rgb_max(out->color) + c.transmit)
                                   : rgbft_opacity(c);
}
