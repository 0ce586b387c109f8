// The order in which the rays of a wave stand in the batch that is traced: those that go the
// same way lie together.
#include "trace/wave.h"

#include <math.h>

enum { PARTS = 64, FINE_KEYS = PATH_KEYS_WITHIN * PARTS };

// Of an eighth's number; a direction that is none has some.
static unsigned spread(double eighth)
{
    static const unsigned char bits[8] = {0, 1, 4, 5, 16, 17, 20, 21};
    return eighth < 8 ? bits[(int)eighth] : 0;
}

// A part of the ray's octant: eight by eight of them, along a curve without far leaps.
static unsigned fine_key(const struct path *p)
{
    const double x = fabs(p->d.x), y = fabs(p->d.y), z = fabs(p->d.z);
    const double scale = 7.999 / (x + y + z);
    return path_key_direction(p) * PARTS + spread(x * scale) + 2u * spread(y * scale);
}

// Where each of the rays stands that have these keys, below PATH_KEYS; equal ones keep their order.
static void places_by_key(const uint16_t *key, uint32_t count, uint16_t *place)
{
    uint16_t begin[PATH_KEYS + 1] = {0};
    for (uint32_t i = 0; i < count; i++)
        begin[key[i] + 1]++;
    for (unsigned i = 1; i < PATH_KEYS; i++)
        begin[i] = (uint16_t)(begin[i] + begin[i - 1]);
    for (uint32_t i = 0; i < count; i++)
        place[i] = begin[key[i]]++;
}

// The same of keys below FINE_KEYS, by their lower digit and then by the upper: a sample may have
// few rays.
static void places_by_digits(const uint16_t *key, uint32_t count, uint16_t *place)
{
    enum { DIGIT = 32 };
    _Static_assert(FINE_KEYS <= DIGIT * DIGIT, "two digits");
    uint16_t low[DIGIT + 1] = {0}, high[DIGIT + 1] = {0}, order[BATCH_SIZE];
    for (uint32_t i = 0; i < count; i++) {
        low[key[i] % DIGIT + 1]++;
        high[key[i] / DIGIT + 1]++;
    }
    for (int i = 1; i < DIGIT; i++) {
        low[i] = (uint16_t)(low[i] + low[i - 1]);
        high[i] = (uint16_t)(high[i] + high[i - 1]);
    }
    for (uint32_t i = 0; i < count; i++)
        order[low[key[i] % DIGIT]++] = (uint16_t)i;
    for (uint32_t i = 0; i < count; i++)
        place[order[i]] = high[key[order[i]] / DIGIT]++;
}

// Where each ray of the wave stands in the batch.
static void wave_sort(const struct tracer *t, uint16_t place[BATCH_SIZE])
{
    const struct wavefront *w = &t->wave;
    const struct job *job = t->job;
    // Elsewhere the order of hits counts (then it is that of the general rule), or rays come together.
    const bool fine =
        job->settings.purpose == RENDER_GATHER && !job->settings.indirect.data;
    uint16_t key[BATCH_SIZE];
    for (uint32_t i = 0; i < w->count; i++) {
        const struct path *p = &w->path[w->order[i]];
        key[i] = (uint16_t)(fine                       ? fine_key(p)
                            : p->key && !job->collects ? p->key
                                                       : path_key_direction(p));
    }
    if (fine)
        places_by_digits(key, w->count, place);
    else
        places_by_key(key, w->count, place);
}

void wave_put(struct tracer *t)
{
    struct wavefront *w = &t->wave;
    struct ray_batch *b = t->rays;
    uint16_t place[BATCH_SIZE];
    wave_sort(t, place);
    for (uint32_t i = 0; i < w->count; i++) {
        const struct path *p = &w->path[w->order[i]];
        const uint32_t k = place[i];
        b->o[0][k] = p->o.x;
        b->o[1][k] = p->o.y;
        b->o[2][k] = p->o.z;
        b->d[0][k] = p->d.x;
        b->d[1][k] = p->d.y;
        b->d[2][k] = p->d.z;
        b->hidden_by[k] = t->job->hidden_by[(p->flags & PATH_REFLECTED) != 0];
        w->slot[k] = (uint16_t)i;
        w->through[0][i] = p->through.r;
        w->through[1][i] = p->through.g;
        w->through[2][i] = p->through.b;
        w->through_t[i] = p->through_t;
        w->sample[i] = p->sample;
    }
    b->count = w->count;
    for (uint32_t k = 0; k < w->count && t->job->reach > 0; k++)
        b->t_max[k] =
            w->path[w->order[w->slot[k]]].flags & PATH_SHORT ? t->job->reach : INFINITY;
}
