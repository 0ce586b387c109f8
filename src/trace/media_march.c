#include "trace/media_march.h"

#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "math/elementary.h"
#include "scene/effects.h"
#include "trace/photons.h"
#include "trace/shade_kernel.h"

static struct media_walker *walker_of(const struct media_march *m, uint32_t interval)
{
    return &m->walker[m->interval[interval].walker];
}

static double drawn(struct media_walker *w)
{
    return hash_unit(hash_mix(w->way->hash, ++w->drawn));
}

// What passes ends in colours: single precision will do. Most media are grey, or dim nothing.
static struct vec3 exp_minus(struct vec3 depth)
{
    struct vec3 e;
    e.x = depth.x == 0 ? 1 : det_exp_single(-depth.x);
    e.y = depth.y == depth.x ? e.x : det_exp_single(-depth.y);
    e.z = depth.z == depth.y ? e.y : det_exp_single(-depth.z);
    return e;
}

// ---- samples -----------------------------------------------------------------------

static uint32_t sample_add(struct media_march *m, uint32_t interval, double t)
{
    struct media_scratch *s = m->scratch;
    if (s->sample_count == s->sample_capacity) {
        s->sample_capacity = s->sample_capacity ? 2 * s->sample_capacity : 256;
        s->sample = must_realloc(s->sample, s->sample_capacity, sizeof *s->sample);
    }
    s->sample[s->sample_count] = (struct media_sample){
        .t = t, .interval = interval, .number = walker_of(m, interval)->asked++};
    return s->sample_count++;
}

// What is lost and given at a few samples, and what is scattered.
static void samples_points(struct media_march *m, struct media_sample *sample,
                           uint32_t count, struct vec3 *scattering)
{
    enum { BLOCKS = 8 };
    struct media_places place[BLOCKS];
    struct media_eight at[BLOCKS];
    for (uint32_t first = 0; first < count; first += 8 * BLOCKS) {
        const uint32_t n = count - first < 8 * BLOCKS ? count - first : 8 * BLOCKS;
        for (uint32_t i = 0; i < n; i++) {
            const struct media_sample *s = &sample[first + i];
            const struct media_way *way = walker_of(m, s->interval)->way;
            media_place(&place[i / 8], i % 8, vec3_mad(way->o, s->t, way->d), way->d);
        }
        media_points(m->t->job, m->mix, place, n, at);
        for (uint32_t i = 0; i < n; i++) {
            struct media_sample *s = &sample[first + i];
            const struct media_eight *a = &at[i / 8];
            const uint32_t k = i % 8;
            const double l = m->interval[s->interval].length;
            s->depth = vec3(l * a->extinction[0][k], l * a->extinction[1][k],
                            l * a->extinction[2][k]);
            s->light = vec3(a->emission[0][k], a->emission[1][k], a->emission[2][k]);
            scattering[first + i] =
                vec3(a->scattering[0][k], a->scattering[1][k], a->scattering[2][k]);
        }
    }
}

static void samples_even(struct media_march *m, struct media_sample *sample,
                         uint32_t count, struct vec3 *scattering)
{
    const struct media_point *p = &m->mix->everywhere;
    for (uint32_t i = 0; i < count; i++) {
        sample[i].depth =
            vec3_scale(m->interval[sample[i].interval].length, p->extinction);
        sample[i].light = p->emission;
        scattering[i] = p->scattering;
    }
}

static void samples_eval_few(struct media_march *m, struct media_sample *sample,
                             uint32_t count)
{
    struct vec3 scattering[MEDIA_SAMPLES];
    if (tracer_gives_up(m->t)) {
        for (uint32_t i = 0; i < count; i++)
            sample[i].light = sample[i].depth = (struct vec3){0, 0, 0};
        return;
    }
    (m->mix->even ? samples_even : samples_points)(m, sample, count, scattering);
    if (m->depth_only)
        return;
    if (m->mix->scatters) {
        media_samples_lit(m, sample, scattering, count);
        media_open_lit(m, sample, scattering, count);
    }
    if (m->t->job->photons && m->t->job->photons->media.count)
        photon_media_lit(m, sample, scattering, count);
    for (uint32_t i = 0; i < count; i++)
        sample[i].light =
            vec3_scale(m->interval[sample[i].interval].length, sample[i].light);
}

// Finds what is at the samples from `first` on.
static void samples_eval(struct media_march *m, uint32_t first)
{
    const uint32_t count = m->scratch->sample_count;
    for (uint32_t i = first; i < count; i += MEDIA_SAMPLES)
        samples_eval_few(m, m->scratch->sample + i,
                         count - i < MEDIA_SAMPLES ? count - i : MEDIA_SAMPLES);
    for (uint32_t i = 0; i < m->walker_count; i++)
        m->walker[i].asked = 0;
}

// ---- method 3 --------------------------------------------------------------------------

// Samples of an interval, the last of which lies before its end: as POV-Ray places them.
static uint32_t parts_of(const struct media *rules)
{
    const int half = rules->samples_min / 2 + 1;
    return (uint32_t)(half < 2 ? 2 : half);
}

static uint32_t span_add(struct media_march *m, uint32_t first, uint32_t last)
{
    struct media_scratch *s = m->scratch;
    const double from = s->sample[first].t, to = s->sample[last].t;
    const uint32_t interval = s->sample[first].interval;
    const double jitter = (double)m->mix->rules->jitter;
    double t = (from + to) / 2;
    if (jitter != 0)
        t += jitter * (to - from) * (drawn(walker_of(m, interval)) - 0.5);
    if (s->span_count == s->span_capacity) {
        s->span_capacity = s->span_capacity ? 2 * s->span_capacity : 256;
        s->span = must_realloc(s->span, s->span_capacity, sizeof *s->span);
    }
    const uint32_t middle = sample_add(m, interval, t);
    s->span[s->span_count] = (struct media_span){first, middle, last, {0, 0}};
    return s->span_count++;
}

static bool differ(const struct media_march *m, uint32_t a, uint32_t b)
{
    const struct vec3 d =
        vec3_sub(m->scratch->sample[a].light, m->scratch->sample[b].light);
    return fabs(d.x) + fabs(d.y) + fabs(d.z) > m->mix->aa_threshold;
}

// Halves the spans from `first` on whose samples differ too much, level by level, so that
// the samples of a level are found together.
static void spans_refine(struct media_march *m, uint32_t first)
{
    enum { DEEPEST = 20 }; // a millionth of a span
    struct media_scratch *s = m->scratch;
    int depth = m->mix->rules->aa_level - 1;
    if (m->depth_only && !m->mix->emits && m->mix->aa_threshold >= 0)
        return; // all samples have the same light: none
    if (depth > DEEPEST)
        depth = DEEPEST;
    for (; depth > 0; depth--) {
        const uint32_t begin = first, end = s->span_count, sample = s->sample_count;
        first = end;
        for (uint32_t i = begin; i < end; i++) {
            const struct media_span p = s->span[i];
            if (differ(m, p.first, p.middle)) {
                const uint32_t half = span_add(m, p.first, p.middle);
                s->span[i].half[0] = half;
            }
            if (differ(m, p.middle, p.last)) {
                const uint32_t half = span_add(m, p.middle, p.last);
                s->span[i].half[1] = half;
            }
        }
        if (s->span_count == end)
            return;
        samples_eval(m, sample);
    }
}

static struct media_value value_of(const struct media_sample *a, double ka,
                                   const struct media_sample *b, double kb)
{
    return (struct media_value){vec3_mad(vec3_scale(ka, a->light), kb, b->light),
                                vec3_mad(vec3_scale(ka, a->depth), kb, b->depth)};
}

static struct media_value value_add(struct media_value a, struct media_value b, double k)
{
    return (struct media_value){vec3_mad(a.light, k, b.light),
                                vec3_mad(a.depth, k, b.depth)};
}

// The mean over a span (spec/lighting.md 10.6).
static struct media_value span_value(const struct media_march *m, uint32_t i, int depth)
{
    const struct media_scratch *s = m->scratch;
    const struct media_span *p = &s->span[i];
    const struct media_sample *a = &s->sample[p->first], *b = &s->sample[p->middle],
                              *c = &s->sample[p->last];
    struct media_value v = {{0, 0, 0}, {0, 0, 0}};
    v = p->half[0] ? value_add(v, span_value(m, p->half[0], depth - 1), 0.5)
                   : value_of(a, 1.0 / 3, b, 1.0 / 6);
    return p->half[1] ? value_add(v, span_value(m, p->half[1], depth - 1), 0.5)
                      : value_add(v, value_of(b, 1.0 / 6, c, 1.0 / 3), 1);
}

// The same of the depth alone.
static struct vec3 span_depth(const struct media_march *m, uint32_t i)
{
    const struct media_scratch *s = m->scratch;
    const struct media_span *p = &s->span[i];
    const struct vec3 a = s->sample[p->first].depth, b = s->sample[p->middle].depth,
                      c = s->sample[p->last].depth;
    const struct vec3 v = p->half[0] ? vec3_scale(0.5, span_depth(m, p->half[0]))
                                     : vec3_mad(vec3_scale(1.0 / 3, a), 1.0 / 6, b);
    return p->half[1] ? vec3_mad(v, 0.5, span_depth(m, p->half[1]))
                      : vec3_add(v, vec3_mad(vec3_scale(1.0 / 6, b), 1.0 / 3, c));
}

// The first samples of an interval and the spans between them.
static void interval_begin(struct media_march *m, uint32_t k, uint32_t parts)
{
    const struct media_interval *v = &m->interval[k];
    const double step = 1.0 / (parts + 1), jitter = (double)m->mix->rules->jitter;
    uint32_t before = 0;
    for (uint32_t j = 0; j <= parts; j++) {
        double q = j * step;
        if (jitter != 0)
            q += step * jitter * (drawn(&m->walker[v->walker]) - 0.5);
        const uint32_t sample = sample_add(m, k, v->begin + q * v->length);
        if (j)
            span_add(m, before, sample);
        before = sample;
    }
}

struct total {
    struct vec3 light, depth;
};

// What an interval adds behind the total so far (spec/lighting.md 10.5): its light and
// depth are the means of n parts.
static void total_add(struct total *all, struct vec3 light, struct vec3 depth, double n)
{
    all->light =
        vec3_add(all->light, vec3_mul(vec3_scale(1 / n, light), exp_minus(all->depth)));
    all->depth = vec3_mad(all->depth, 1 / n, depth);
}

// det_exp_single of what exps_put has put there.
static const double *exps(const struct media_march *m)
{
    struct media_scratch *s = m->scratch;
    for (uint32_t i = s->exp_count; i % 8; i++)
        s->exp[i] = 0;
    m->t->job->kernels->exp_single(s->exp, s->exp_count);
    return s->exp;
}

static void exps_begin(struct media_scratch *s, uint32_t vectors)
{
    s->exp_count = 0;
    if (s->exp_capacity >= 3 * vectors + 8)
        return;
    s->exp_capacity = 6 * vectors + 8;
    s->exp = must_realloc(s->exp, s->exp_capacity, sizeof *s->exp);
}

static void exps_put(struct media_scratch *s, struct vec3 depth)
{
    double *x = s->exp + s->exp_count;
    x[0] = -depth.x, x[1] = -depth.y, x[2] = -depth.z;
    s->exp_count += 3;
}

// Walker i's intervals from first[i] to before first[i + 1], whose samples are there: leaves
// the depth before each part in its interval and that before each interval for exps.
static void depths_end(struct media_march *m, const uint32_t *first, uint32_t parts,
                       struct total *all)
{
    struct media_scratch *s = m->scratch;
    for (uint32_t i = 0; i < m->walker_count; i++)
        for (uint32_t k = first[i]; k < first[i + 1]; k++) {
            struct vec3 depth = {0, 0, 0};
            for (uint32_t j = k * parts; j < (k + 1) * parts; j++) {
                s->value[j] = span_value(m, j, 0);
                exps_put(s, vec3_scale(1.0 / parts, depth));
                depth = vec3_add(depth, s->value[j].depth);
            }
            exps_put(s, all[i].depth);
            all[i].depth = vec3_mad(all[i].depth, 1.0 / parts, depth);
        }
}

// The same where light is not asked for.
static void depths_alone(const struct media_march *m, const uint32_t *first,
                         uint32_t parts, struct total *all)
{
    for (uint32_t i = 0; i < m->walker_count; i++)
        for (uint32_t k = first[i]; k < first[i + 1]; k++) {
            struct vec3 depth = {0, 0, 0};
            for (uint32_t j = k * parts; j < (k + 1) * parts; j++)
                depth = vec3_add(depth, span_depth(m, j));
            all[i].depth = vec3_mad(all[i].depth, 1.0 / parts, depth);
        }
}

static struct vec3 next_exp(const double **e)
{
    *e += 3;
    return vec3((*e)[-3], (*e)[-2], (*e)[-1]);
}

// Adds intervals to the totals of their walkers.
static void intervals_end(struct media_march *m, const uint32_t *first, struct total *all)
{
    const uint32_t parts = parts_of(m->mix->rules), count = first[m->walker_count];
    struct media_scratch *s = m->scratch;
    if (m->depth_only) {
        depths_alone(m, first, parts, all);
        return;
    }
    if (s->value_capacity < count * parts) {
        s->value_capacity = 2 * count * parts;
        s->value = must_realloc(s->value, s->value_capacity, sizeof *s->value);
    }
    exps_begin(s, count * (parts + 1));
    depths_end(m, first, parts, all);
    const double *e = exps(m);
    for (uint32_t i = 0; i < m->walker_count; i++)
        for (uint32_t k = first[i]; k < first[i + 1]; k++) {
            struct vec3 light = {0, 0, 0};
            for (uint32_t j = k * parts; j < (k + 1) * parts; j++)
                light = vec3_add(light, vec3_mul(s->value[j].light, next_exp(&e)));
            all[i].light = vec3_add(
                all[i].light, vec3_mul(vec3_scale(1.0 / parts, light), next_exp(&e)));
        }
}

// The samples of the intervals [begin, end) together.
static void adaptive_samples(struct media_march *m, uint32_t begin, uint32_t end)
{
    const uint32_t parts = parts_of(m->mix->rules);
    m->scratch->sample_count = m->scratch->span_count = 0;
    for (uint32_t k = begin; k < end; k++)
        interval_begin(m, k, parts);
    samples_eval(m, 0);
    spans_refine(m, 0);
}

static void adaptive(struct media_march *m, uint32_t begin, uint32_t end,
                     struct total *all)
{
    const uint32_t first[] = {0, end - begin};
    adaptive_samples(m, begin, end);
    intervals_end(m, first, all);
}

// ---- methods 1 and 2 -------------------------------------------------------------------

// The samples of an interval so far: light as it leaves the interval, and its square.
struct spread {
    struct vec3 light, square, depth;
    uint32_t count;
};

static void spread_add(const struct media_march *m, const struct media_sample *s,
                       struct spread *sum)
{
    const struct media_interval *v = &m->interval[s->interval];
    const double q = v->length > 0 ? (s->t - v->begin) / v->length : 0;
    const struct vec3 light = vec3_mul(s->light, exp_minus(vec3_scale(q, s->depth)));
    sum->light = vec3_add(sum->light, light);
    sum->square = vec3_add(sum->square, vec3_mul(light, light));
    sum->depth = vec3_add(sum->depth, s->depth);
    sum->count++;
}

static bool is_enough(const struct spread *sum, double enough)
{
    const double n = sum->count;
    const struct vec3 mean = vec3_scale(1 / n, sum->light);
    const struct vec3 v = vec3_sub(vec3_scale(1 / n, sum->square), vec3_mul(mean, mean));
    return v.x / n < enough && v.y / n < enough && v.z / n < enough;
}

static const struct media_threshold *threshold_of(const struct job *job,
                                                  const struct media *rules)
{
    for (uint32_t i = 0; i < job->media_threshold_count; i++)
        if (job->media_threshold[i].media == rules)
            return &job->media_threshold[i];
    return NULL;
}

static double random_place(struct media_march *m, const struct media_interval *v)
{
    return v->begin + drawn(&m->walker[v->walker]) * v->length;
}

static void more_samples(struct media_march *m, uint32_t k, struct spread *sum)
{
    const struct media_threshold *h = threshold_of(m->t->job, m->mix->rules);
    while (h && sum->count <= h->most && !is_enough(sum, h->enough[sum->count])) {
        const uint32_t i = sample_add(m, k, random_place(m, &m->interval[k]));
        samples_eval(m, i);
        spread_add(m, &m->scratch->sample[i], sum);
    }
}

static void straight(struct media_march *m, uint32_t begin, uint32_t end,
                     struct total *all)
{
    const struct media *rules = m->mix->rules;
    const uint32_t n = (uint32_t)rules->samples_min;
    const double jitter = (double)rules->jitter;
    m->scratch->sample_count = 0;
    for (uint32_t k = begin; k < end; k++) {
        const struct media_interval *v = &m->interval[k];
        for (uint32_t j = 0; j < n; j++) {
            double t;
            if (rules->method == 1) {
                t = random_place(m, v);
            } else {
                double q = j + 0.5;
                if (jitter != 0)
                    q += jitter * drawn(&m->walker[v->walker]);
                t = v->begin + q / n * v->length;
            }
            sample_add(m, k, t);
        }
    }
    samples_eval(m, 0);
    for (uint32_t k = begin; k < end; k++) {
        struct spread sum = {.count = 0};
        for (uint32_t j = 0; j < n; j++)
            spread_add(m, &m->scratch->sample[(k - begin) * n + j], &sum);
        more_samples(m, k, &sum);
        total_add(all, sum.light, sum.depth, sum.count);
    }
}

// ---- without samples -------------------------------------------------------------------

// 1 + q + ... + q^(n-1)
static double powers(double q, uint32_t n)
{
    double sum = 0, term = 1;
    for (uint32_t i = 0; i < n; i++) {
        sum += term;
        term *= q;
    }
    return sum;
}

// What method 3 finds in media that are the same everywhere and are not lit: samples all
// alike, so that the light of the parts is a geometric series.
static void uniform(const struct media_march *m, struct total *all)
{
    const uint32_t parts = parts_of(m->mix->rules);
    if (m->depth_only || !m->mix->emits) {
        all->depth = vec3_scale(m->walker->way->s, m->mix->everywhere.extinction);
        return;
    }
    for (uint32_t k = 0; k < m->interval_count; k++) {
        const double l = m->interval[k].length;
        const struct vec3 depth = vec3_scale(l, m->mix->everywhere.extinction);
        const struct vec3 step = exp_minus(vec3_scale(1.0 / parts, depth));
        const struct vec3 light = vec3_mul(
            vec3_scale(l, m->mix->everywhere.emission),
            vec3(powers(step.x, parts), powers(step.y, parts), powers(step.z, parts)));
        total_add(all, light, vec3_scale(parts, depth), parts);
    }
}

struct vec3 media_even_pass(struct vec3 extinction, double s)
{
    if (extinction.x == 0 && extinction.y == 0 && extinction.z == 0)
        return vec3(1, 1, 1); // whatever s
    return exp_minus(vec3_scale(s, extinction));
}

// How many intervals are walked at once: enough for full batches of shadow rays.
uint32_t media_stride(const struct media_mix *mix)
{
    enum { SAMPLES = 512 };
    const uint32_t each = (uint32_t)mix->rules->samples_min + 2;
    return each >= SAMPLES ? 1 : SAMPLES / each;
}

// Media that need no samples (uniform).
static bool is_uniform(const struct media_mix *mix, bool depth_only)
{
    return mix->even && (depth_only || !mix->scatters) &&
           (depth_only || !mix->emits || mix->rules->method == 3);
}

bool media_goes_together(const struct media_mix *mix, bool depth_only)
{
    return !is_uniform(mix, depth_only) && mix->rules->method == 3;
}

void media_walk_together(struct media_march *m, const uint32_t *first,
                         struct media_result *out)
{
    struct total *all = arena_new_array(m->scratch->arena, struct total, m->walker_count);
    memset(all, 0, m->walker_count * sizeof *all);
    adaptive_samples(m, 0, m->interval_count);
    intervals_end(m, first, all);
    exps_begin(m->scratch, m->walker_count);
    for (uint32_t i = 0; i < m->walker_count; i++)
        exps_put(m->scratch, all[i].depth);
    const double *e = exps(m);
    for (uint32_t i = 0; i < m->walker_count; i++)
        out[i] = (struct media_result){all[i].light, next_exp(&e)};
}

struct media_result media_walk(struct media_march *m)
{
    // Deeper than this nothing behind is seen: exp(-100) is below any float next to light.
    static const double opaque = 100;
    struct total all = {{0, 0, 0}, {0, 0, 0}};
    const int method = m->mix->rules->method;
    if (is_uniform(m->mix, m->depth_only)) {
        uniform(m, &all);
    } else {
        const uint32_t stride = media_stride(m->mix);
        for (uint32_t k = 0; k < m->interval_count && !tracer_gives_up(m->t);
             k += stride) {
            const uint32_t end =
                m->interval_count - k < stride ? m->interval_count : k + stride;
            (method == 3 ? adaptive : straight)(m, k, end, &all);
            if (fmin(all.depth.x, fmin(all.depth.y, all.depth.z)) > opaque)
                break;
        }
    }
    return (struct media_result){all.light, exp_minus(all.depth)};
}
