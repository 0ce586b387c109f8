#include "trace/scout.h"

#include <string.h>

#include "base/arena.h"
#include "scene/texture.h"
#include "trace/indirect_lanes.h"
#include "trace/shade.h"
#include "trace/shade_kernel.h"
#include "trace/simple.h"

// Whether nothing is mirrored, and only the side that is seen asks.
static bool is_quiet(const struct job *job, const struct texture *x)
{
    bool quiet = true;
    if (x->kind == TEXTURE_PLAIN)
        for (uint32_t i = 0; i < x->layer_count; i++) {
            const struct finish *f = x->layer[i].finish;
            quiet &= !(job->mirrors && finish_has_mirror(f)) && !(f->matt_back > 0);
        }
    else
        for (uint32_t i = 0; i < x->map->count && quiet; i++)
            quiet = is_quiet(job, x->map->entry[i]);
    return quiet;
}

void scout_compile(struct job *job, struct arena *a)
{
    const struct world *w = job->world;
    const struct indirect *indirect = &job->settings.indirect;
    if (job->general || !indirect->settled || indirect->layer_normals || !job->lights ||
        job->has_media || job->has_air_media)
        return;
    bool *quiet = arena_new_array(a, bool, w->surface_count + 1);
    for (uint32_t i = 0; i < w->surface_count; i++) {
        const struct surface *s = &w->surface[i];
        quiet[i] = s->opaque && !s->parts && !s->cutaway && is_quiet(job, s->texture) &&
                   (!s->interior_texture || is_quiet(job, s->interior_texture));
    }
    job->quiet = quiet;
}

static void settle(struct tracer *t, const uint16_t *ray, uint32_t count)
{
    struct simple_group g;
    t->job->kernels->points(t, ray, count, false, &g);
    for (unsigned known = indirect_settled(t, &g); known; known &= known - 1)
        t->settled[ray[__builtin_ctz(known)]] = true;
}

void scout_settle(struct tracer *t)
{
    const struct world *w = t->job->world;
    uint16_t ray[8];
    uint32_t count = 0;
    memset(t->settled, 0, t->wave.count * sizeof *t->settled);
    for (uint32_t k = 0; k < t->wave.count; k++) {
        if (!(t->hit->t[k] < INFINITY) ||
            !t->job->quiet[w->leaf[t->hit->leaf[k]].surface])
            continue;
        ray[count++] = (uint16_t)k;
        if (count < 8)
            continue;
        settle(t, ray, count);
        count = 0;
    }
    if (count)
        settle(t, ray, count);
}
