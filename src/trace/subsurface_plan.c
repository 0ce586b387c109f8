#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "math/halton.h"
#include "math/isa.h"
#include "trace/accel.h"
#include "trace/packet.h"
#include "trace/subsurface.h"
#include "trace/subsurface_kernel.h"

struct direction {
    double u, v;
    uint32_t index, strip;
};

static int by_strip(const void *a, const void *b)
{
    const struct direction *p = a, *q = b;
    if (p->strip != q->strip)
        return (p->strip > q->strip) - (p->strip < q->strip);
    return (p->v > q->v) - (p->v < q->v);
}

const struct subsurface_plan *subsurface_plan_new(const struct job *job, struct arena *a)
{
    static const double eighth = 8; // a packet's rays are as wide as high, about
    const uint32_t count = (uint32_t)job->scene->settings.subsurface.samples_diffuse;
    const double strips = ceil(sqrt(count / eighth));
    struct subsurface_plan *p = arena_new_struct(a, struct subsurface_plan);
    double *u = arena_new_array(a, double, (size_t)count + 8),
           *v = arena_new_array(a, double, (size_t)count + 8);
    uint32_t *index = arena_new_array(a, uint32_t, count);
    struct direction *d = must_calloc(count, sizeof *d);
    for (uint32_t i = 0; i < count; i++) {
        d[i] = (struct direction){halton(i + 1, 2), halton(i + 1, 3), i, 0};
        d[i].strip = (uint32_t)(d[i].u * strips);
    }
    qsort(d, count, sizeof *d, by_strip);
    for (uint32_t i = 0; i < count + 8; i++) {
        u[i] = i < count ? d[i].u : 0;
        v[i] = i < count ? d[i].v : 0;
    }
    for (uint32_t i = 0; i < count; i++)
        index[i] = d[i].index;
    free(d);
    *p = (struct subsurface_plan){
        ISA_NAMED(job->world->accel->kernels->name, subsurface_kernels), u, v, index};
    return p;
}
