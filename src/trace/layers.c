#include "trace/layers.h"

#include "base/arena.h"
#include "trace/cutaway.h"
#include "trace/paint.h"

void surface_view_init(struct surface_view *v, const struct interaction *at,
                       struct vec3 d)
{
    const struct surface *s = at->surface;
    const bool turned = vec3_dot(at->ns, d) > 0;
    *v = (struct surface_view){
        at,   d,   turned ? vec3_neg(at->ns) : at->ns, s->texture, &s->texture_transform,
        NULL, NULL};
    if (turned && s->interior_texture) {
        v->texture = s->interior_texture;
        v->transform = &s->interior_texture_transform;
    }
}

// A normal of an entry on its way back to the world.
static struct vec3 chain_up(const struct texture_chain *c, struct vec3 n)
{
    for (; c; c = c->outer) {
        if (c->map)
            n = texture_entry_normal(c->map, n);
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

static void walk(const struct walk *w, const struct texture *x,
                 const struct texture_point *place, const struct texture_chain *chain,
                 double weight)
{
    if (x->kind == TEXTURE_PLAIN) {
        w->plain(w->user, w->v, x, place, chain, weight);
        return;
    }
    struct texture_point here = *place;
    const struct texture_point *at = &here;
    here.normal_seen = *w->v->seen;
    enum { FEW = 8 };
    const struct texture *few[FEW];
    double few_weight[FEW];
    const struct texture **entry = few;
    double *share = few_weight;
    int most = FEW;
    if (x->map && x->map->count > FEW) {
        most = (int)x->map->count;
        entry = arena_new_array(w->t->arena, const struct texture *, x->map->count);
        share = arena_new_array(w->t->arena, double, x->map->count);
    }
    const int count = texture_select(x, at, entry, share, most);
    const struct texture_chain link = {chain, NULL, x};
    const struct texture_point inner = texture_entry_point(x, at);
    for (int i = 0; i < count; i++)
        if (share[i] != 0)
            walk(w, entry[i], &inner, &link, weight * share[i]);
}

static void walk_from(const struct walk *w, const struct texture *x,
                      const struct transform *transform, double weight)
{
    const struct interaction *at = w->v->at;
    // Textures of a uv mapped object are not moved with it.
    const bool uv = at->surface->flags & OBJECT_UV_MAPPING;
    const struct texture_chain root = {NULL, uv ? NULL : transform, NULL};
    struct texture_point point = {
        .p = at->p, .uv = at->uv, .normal = w->v->n, .ray_d = w->v->d, .p_world = at->p};
    if (uv) {
        point.p = vec3(at->uv.u, at->uv.v, 0);
    } else if (!transform->identity) {
        point.p = transform_inverse_point(transform, at->p);
        point.normal = transform_inverse_normal(transform, w->v->n);
    }
    walk(w, x, &point, &root, weight);
}

// Textures of parts stand in the shape's own space.
static void walk_part(void *user, const struct texture *x, double weight)
{
    const struct walk *w = user;
    if (x)
        walk_from(w, x, w->v->at->leaf->transform, weight);
    else
        walk_from(w, w->v->texture, w->v->transform, weight);
}

static void walk_cut(void *user, const struct texture *x, const struct transform *place,
                     double weight)
{
    walk_from(user, x, place, weight);
}

void texture_walk(struct tracer *t, const struct surface_view *v, plain_function *plain,
                  void *user)
{
    struct surface_view view = *v;
    struct vec3 seen = v->n;
    struct walk w = {t, &view, plain, user};
    view.seen = &seen;
    const struct leaf *l = v->at->leaf;
    const struct surface *s = v->at->surface;
    if (s->cutaway && v->texture == s->texture)
        cutaway_textures(s->cutaway, v->at->p, walk_cut, &w);
    else if (s->parts && v->texture == v->at->surface->texture)
        l->ops->textures_at(l->shape, &v->at->b,
                            transform_inverse_point(l->transform, v->at->p), walk_part,
                            &w);
    else
        walk_from(&w, v->texture, v->transform, 1);
}

static void layer_color(const struct tracer *t, const struct texture_layer *layer,
                        struct rgbft c, struct layer *out)
{
    if (layer->covers && t->job->old_layers) { // what it filters is just let through
        c.transmit += c.filter;
        c.filter = 0;
    }
    out->color = rgbft_rgb(c);
    out->pass = rgbft_pass(c);
    out->att = t->job->old_opacity ? 1 - (c.filter * rgb_max(out->color) + c.transmit)
                                   : rgbft_opacity(c);
}

// What slope sees of a normal that was perturbed to n, in the world `up`: maps around the
// texture have not undone their scaling yet, and no_bump_scale leaves its length.
static struct vec3 normal_seen(const struct normal *normal, const struct texture_chain *c,
                               struct vec3 n, struct vec3 up)
{
    if (c && c->map)
        return n;
    if (!normal->no_bump_scale)
        return up;
    return c && c->transform ? transform_normal(c->transform, n) : n;
}

void layer_eval(const struct tracer *t, const struct surface_view *v,
                const struct texture_layer *layer, const struct texture_point *at,
                const struct texture_chain *chain, bool want_normal, struct layer *out)
{
    out->finish = layer->finish;
    struct texture_point here = *at;
    out->n = v->n;
    here.normal_seen = *v->seen;
    if (layer->normal && want_normal && t->job->normals) {
        const struct vec3 n = normal_perturb(layer->normal, &here);
        out->n = chain_up(chain, n);
        here.normal_seen = *v->seen = normal_seen(layer->normal, chain, n, out->n);
    }
    const struct pigment *pigment = layer->pigment;
    struct rgbft c = pigment->color;
    out->found = true;
    if (!t->job->pigments && pigment->has_quick_color)
        c = pigment->quick_color;
    else if (pigment->kind != PIGMENT_SOLID)
        out->found = pigment_color(pigment, &here, &c);
    layer_color(t, layer, c, out);
}

void layer_painted(const struct tracer *t, const struct texture_layer *layer,
                   const struct painted *painted, struct layer *out)
{
    out->finish = layer->finish;
    out->n = painted->n;
    out->found = painted->found;
    layer_color(t, layer, painted->color, out);
}
