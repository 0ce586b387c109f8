// Form factors by rays, and what hides one element from another.

#include "math/elementary.h"
#include "math/pi.h"
#include "radiosity/form_factor.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"
#include "trace/intersect.h"

struct vec3 cosine_direction(struct vec3 n, double u, double v)
{
    const double r = sqrt(u), angle = 2 * PI * v;
    const double x = r * det_cos(angle), y = r * det_sin(angle), z = sqrt(1 - u);
    // Duff et al. 2017: a frame about n without a branch on its direction.
    const double sign = n.z < 0 ? -1 : 1, a = -1 / (sign + n.z), b = n.x * n.y * a;
    const struct vec3 t = vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    const struct vec3 w = vec3(b, sign + n.y * n.y * a, -n.y);
    return vec3_mad(vec3_mad(vec3_scale(x, t), y, w), z, n);
}

struct seen {
    double all, visible;
};

static void look_batch(struct factor_state *s, const double *weight, struct seen *seen)
{
    s->enclosure->occluded(s->of_enclosure, s->rays, s->hidden);
    s->ray_count += s->rays->count;
    for (uint32_t i = 0; i < s->rays->count; i++) {
        seen->all += weight[i];
        if (!s->hidden[i])
            seen->visible += weight[i];
    }
    s->rays->count = 0;
}

// Shadow rays [begin, end) of a pair's sequence.
static void look(struct factor_state *s, uint32_t a, uint32_t b, uint32_t begin,
                 uint32_t end, struct seen *seen)
{
    enum { BATCH = 256 };
    double weight[BATCH];
    const uint32_t seed = sequence_seed(sequence_seed(a, b), s->settings->seed);
    s->rays->count = 0;
    for (uint32_t i = begin; i < end; i++) {
        struct element_point from, to;
        double x[4];
        sobol_point(i, seed, x);
        if (!element_at(s, a, x[0], x[1], &from) || !element_at(s, b, x[2], x[3], &to))
            continue;
        const double w = point_kernel(&from, &to);
        if (w <= 0)
            continue;
        weight[s->rays->count] = w;
        ray_put_between(s->rays, &from, &to);
        if (s->rays->count == BATCH)
            look_batch(s, weight, seen);
    }
    if (s->rays->count)
        look_batch(s, weight, seen);
}

// Rays that keep the error of the factor below `visibility`: scrambled Sobol points err
// about as their number to the power -.8. What rays meet has no part in it: to stop where
// the first few agree would make rare gaps and rare obstacles vanish.
static uint32_t shadow_rays(const struct form_factor_settings *s, double factor)
{
    enum { MOST = 4096 };
    const double ratio = factor / (2 * s->visibility);
    const double wanted = ratio * sqrt(sqrt(ratio)), least = s->shadow_rays;
    uint32_t count = 1; // powers of 2 fill the square evenly
    while (count < wanted && count < MOST)
        count *= 2;
    return count > least ? count : (uint32_t)least;
}

double pair_visibility(struct factor_state *s, uint32_t a, uint32_t b, double factor)
{
    enum { TIMES = 5 }; // more for slivers, of which few points exist
    if (!s->enclosure->occluded)
        return 1;
    if (s->enclosure->may_hide && !s->enclosure->may_hide(s->of_enclosure, a, b))
        return 1;
    const uint32_t count = shadow_rays(s->settings, factor);
    struct seen seen = {0, 0};
    look(s, a, b, 0, count, &seen);
    if (seen.all <= 0)
        look(s, a, b, count, TIMES * count, &seen);
    return seen.all > 0 ? seen.visible / seen.all : 0;
}

static void cast_row(struct factor_state *s, uint32_t i, float *row,
                     void (*sequence)(uint32_t, uint32_t, double[4]))
{
    const uint32_t count = (uint32_t)s->settings->rays;
    const uint32_t seed = sequence_seed(i, s->settings->seed);
    uint32_t cast = 0;
    for (uint32_t j = 0; j < s->enclosure->count; j++)
        row[j] = 0;
    for (uint32_t k = 0; k < count;) {
        s->rays->count = 0;
        for (; k < count && s->rays->count < s->rays->capacity; k++) {
            struct element_point from;
            double x[4];
            sequence(k, seed, x);
            if (!element_at(s, i, x[0], x[1], &from))
                continue;
            ray_put(s->rays, &from, cosine_direction(from.normal, x[2], x[3]), INFINITY);
        }
        s->enclosure->closest(s->of_enclosure, s->rays, s->met);
        cast += s->rays->count;
        for (uint32_t r = 0; r < s->rays->count; r++)
            if (s->met[r] != ELEMENT_NONE)
                row[s->met[r]] += 1;
    }
    s->ray_count += cast;
    for (uint32_t j = 0; j < s->enclosure->count && cast; j++)
        row[j] /= (float)cast;
}

void row_rays(struct factor_state *s, uint32_t i, float *row)
{
    cast_row(s, i, row, random_point);
}

void row_sobol(struct factor_state *s, uint32_t i, float *row)
{
    cast_row(s, i, row, sobol_point);
}
