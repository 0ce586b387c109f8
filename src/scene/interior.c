#include "base/arena.h"
#include "scene/effects.h"
#include "scene/texture.h"

static const struct media *media_moved(struct arena *a, const struct media *m,
                                       const struct transform *t)
{
    struct media *out = arena_new_struct(a, struct media);
    const struct pigment **density =
        arena_new_array(a, const struct pigment *, m->density_count + 1);
    *out = *m;
    for (uint32_t i = 0; i < m->density_count; i++)
        density[i] = pigment_transform(a, m->density[i], t);
    out->density = density;
    return out;
}

const struct interior *interior_moved(struct arena *a, const struct interior *i,
                                      const struct transform *t)
{
    if (i->media_count == 0 || t->identity)
        return i;
    struct interior *out = arena_new_struct(a, struct interior);
    const struct media **media = arena_new_array(a, const struct media *, i->media_count);
    *out = *i;
    for (uint32_t k = 0; k < i->media_count; k++)
        media[k] = media_moved(a, i->media[k], t);
    out->media = media;
    return out;
}
