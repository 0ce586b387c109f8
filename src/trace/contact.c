#include "trace/contact.h"

#include "base/arena.h"
#include "trace/coincident.h"
#include "trace/inside.h"
#include "trace/shadow_walk.h"

// Crosses one more face.
static void cross(const struct shading *s, const struct ray *ray, const struct hit *hit,
                  struct contact *c)
{
    struct interaction at;
    trace_interaction(s->t->job->world, ray, hit, &at);
    const struct interior *x = at.surface->interior;
    const struct rgb fade = way_fade(x, s->path->inside, s->s);
    c->pass = rgb_mul(c->pass, rgb_mul(fade, surface_filter(s->t, &at, ray->d, 0)));
    c->sides.inside = interior_cross(s->t, c->sides.inside, x).inside;
}

struct crossing_sides shading_crosses(const struct shading *s)
{
    return s->contact ? s->contact->sides
                      : interior_cross(s->t, s->path->inside, s->at.surface->interior);
}

const struct contact *contact_at(const struct shading *s)
{
    const struct job *job = s->t->job;
    struct hit other[CONTACTS_MOST];
    if (!s->at.surface->in_contact)
        return NULL;
    const struct inside *before = s->path->inside;
    const struct ray_query q = {
        .ray = {s->path->o, s->path->d, 0, INFINITY},
        .hidden_by = s->dark ? OBJECT_NO_IMAGE | OBJECT_NO_SHADOW
                             : job->hidden_by[(s->path->flags & PATH_REFLECTED) != 0]};
    const struct hit hit = {s->at.b};
    const uint32_t count =
        coincident_contacts(job->world, s->t->scratch, &q, &hit, other);
    if (!count)
        return NULL;
    struct contact *c = arena_new_struct(s->t->arena, struct contact);
    *c = (struct contact){interior_cross(s->t, before, s->at.surface->interior),
                          {1, 1, 1}};
    for (uint32_t i = 0; i < count; i++)
        cross(s, &q.ray, &other[i], c);
    c->sides.from = before ? before->interior : NULL;
    c->sides.to = c->sides.inside ? c->sides.inside->interior : NULL;
    c->sides.straight = c->sides.from == c->sides.to;
    return c;
}
