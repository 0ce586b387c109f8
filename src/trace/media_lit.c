#include "trace/media_lit.h"

#include <stdlib.h>

#include "base/arena.h"
#include "scene/effects.h"
#include "trace/shade_kernel.h"

// ---- cones and cylinders ---------------------------------------------------------------

// Where the ray may enter or leave what a lamp lights: roots of a quadratic and ends.
struct cuts {
    double at[6];
    int count;
};

static void cut_add(struct cuts *c, double t, double s)
{
    if (t > 0 && t < s)
        c->at[c->count++] = t;
}

// a t^2 + 2 b t + c = 0
static void cut_roots(struct cuts *cuts, double a, double b, double c, double s)
{
    const double q = b * b - a * c;
    if (q < 0)
        return;
    const double root = -(b + copysign(sqrt(q), b));
    if (root != 0)
        cut_add(cuts, c / root, s);
    if (a != 0)
        cut_add(cuts, root / a, s);
}

static void cuts_sort(struct cuts *c)
{
    for (int i = 1; i < c->count; i++) {
        const double v = c->at[i];
        int k = i;
        for (; k > 0 && c->at[k - 1] > v; k--)
            c->at[k] = c->at[k - 1];
        c->at[k] = v;
    }
}

typedef bool lit_at(const struct lamp *lamp, struct vec3 from);

static bool in_cone(const struct lamp *lamp, struct vec3 from)
{
    return vec3_dot(from, lamp->light->axis) >= lamp->cos_falloff * vec3_length(from);
}

static bool in_cylinder(const struct lamp *lamp, struct vec3 from)
{
    const double along = vec3_dot(from, lamp->light->axis);
    const struct vec3 off = vec3_mad(from, -along, lamp->light->axis);
    return along > 0 && vec3_length(off) < lamp->light->falloff;
}

// What lies between the cuts is wholly inside or wholly outside; inside is one piece, since
// both bodies are convex.
static bool between_cuts(struct cuts *c, lit_at *lit, struct vec3 from, struct vec3 d,
                         double s, struct media_lamp *out)
{
    bool any = false;
    c->at[c->count++] = 0;
    c->at[c->count++] = s;
    cuts_sort(c);
    for (int i = 0; i + 1 < c->count; i++) {
        const double middle = (c->at[i] + c->at[i + 1]) / 2;
        if (!(c->at[i] < c->at[i + 1]) || !lit(out->lamp, vec3_mad(from, middle, d)))
            continue;
        if (!any)
            out->begin = c->at[i];
        out->end = c->at[i + 1];
        any = true;
    }
    return any;
}

static bool lamp_reaches(const struct lamp *lamp, struct vec3 o, struct vec3 d, double s,
                         struct media_lamp *out)
{
    const struct light *light = lamp->light;
    const struct vec3 from = vec3_sub(o, light->location);
    const double e = vec3_dot(from, light->axis), f = vec3_dot(d, light->axis);
    const double b = vec3_dot(from, d), c = vec3_dot(from, from);
    struct cuts cuts = {.count = 0};
    *out = (struct media_lamp){lamp, 0, s};
    if (light->kind == LIGHT_SPOT && lamp->cos_falloff > 0) {
        const double k = lamp->cos_falloff * lamp->cos_falloff;
        cut_roots(&cuts, f * f - k, f * e - k * b, e * e - k * c, s);
        return between_cuts(&cuts, in_cone, from, d, s, out);
    }
    if (light->kind == LIGHT_CYLINDER) {
        cut_roots(&cuts, 1 - f * f, b - f * e,
                  c - e * e - light->falloff * light->falloff, s);
        if (f != 0)
            cut_add(&cuts, -e / f, s);
        return between_cuts(&cuts, in_cylinder, from, d, s, out);
    }
    return true;
}

uint32_t media_lamps(const struct job *job, const struct media_way *way,
                     const uint8_t *missed, uint8_t lane, struct media_lamp *out)
{
    const struct lamp_list *list = &job->lamps[way->group];
    uint32_t n = 0;
    for (uint32_t i = 0; i < list->count; i++) {
        const struct lamp *l = list->lamp[i];
        if (!(missed && missed[i] & lane) && !l->inert && !l->light->shadowless &&
            l->light->media_interaction)
            n += lamp_reaches(l, way->o, way->d, way->s, &out[n]);
    }
    return n;
}

void media_lamps_missed(const struct job *job, const struct media_way *way,
                        uint32_t count, uint8_t *missed)
{
    const struct lamp_list *list = &job->lamps[way->group];
    double o[3][8], d[3][8], s[8];
    for (uint32_t i = 0; i < 8; i++) {
        const struct media_way *w = &way[i < count ? i : 0];
        o[0][i] = w->o.x, o[1][i] = w->o.y, o[2][i] = w->o.z;
        d[0][i] = w->d.x, d[1][i] = w->d.y, d[2][i] = w->d.z;
        s[i] = w->s;
    }
    for (uint32_t i = 0; i < list->count; i++) {
        const struct lamp *l = list->lamp[i];
        missed[i] = 0;
        if (l->light->kind == LIGHT_SPOT && l->cos_falloff > 0)
            missed[i] = (uint8_t)job->kernels->misses_cone(l, (const double(*)[8])o,
                                                           (const double(*)[8])d, s);
    }
}

// ---- intervals -----------------------------------------------------------------------

static int by_begin(const void *a, const void *b)
{
    const struct media_interval *p = a, *q = b;
    return (p->begin > q->begin) - (p->begin < q->begin);
}

// Mostly they are: most lamps reach everything.
static bool is_sorted(const struct media_interval *v, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++)
        if (v[i - 1].begin > v[i].begin)
            return false;
    return true;
}

// Lit and unlit pieces in turn, from 0 to s.
static uint32_t pieces_of(struct arena *a, const struct media_lamp *lamp, uint32_t count,
                          double s, struct media_interval **out)
{
    struct media_interval *lit = arena_new_array(a, struct media_interval, count + 1);
    struct media_interval *piece =
        arena_new_array(a, struct media_interval, 2 * (size_t)count + 1);
    for (uint32_t i = 0; i < count; i++)
        lit[i] =
            (struct media_interval){lamp[i].begin, lamp[i].end - lamp[i].begin, true, 0};
    if (!is_sorted(lit, count))
        qsort(lit, count, sizeof *lit, by_begin);
    uint32_t n = 0;
    double done = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double begin = lit[i].begin, end = begin + lit[i].length;
        if (begin > done)
            piece[n++] = (struct media_interval){done, begin - done, false, 0};
        if (n && piece[n - 1].lit && begin <= done) {
            if (end > done)
                piece[n - 1].length = end - piece[n - 1].begin;
        } else {
            piece[n++] = (struct media_interval){begin, end - begin, true, 0};
        }
        done = end > done ? end : done;
    }
    if (done < s || !n)
        piece[n++] = (struct media_interval){done, s - done, false, 0};
    *out = piece;
    return n;
}

static uint32_t least(double a, uint32_t b) { return a < b ? (uint32_t)a : b; }

static void divide(struct media_interval *to, const struct media_interval *piece,
                   uint32_t n)
{
    const double length = piece->length / n;
    for (uint32_t i = 0; i < n; i++)
        to[i] = (struct media_interval){piece->begin + i * length, length, piece->lit, 0};
}

struct media_interval *media_intervals(struct arena *a, const struct media_mix *mix,
                                       double s, const struct media_lamp *lamp,
                                       uint32_t lamp_count, uint32_t *count)
{
    struct media_interval *piece;
    const uint32_t pieces = pieces_of(a, lamp, lamp_count, s, &piece);
    const uint32_t wish = (uint32_t)mix->rules->intervals;
    if (pieces == 1) {
        *count = !piece->lit && mix->even ? 1 : wish;
        struct media_interval *all = arena_new_array(a, struct media_interval, *count);
        divide(all, piece, *count);
        return all;
    }
    const uint32_t most = wish > pieces ? wish : pieces;
    const double ratio = (double)mix->rules->ratio;
    struct media_interval *all = arena_new_array(a, struct media_interval, most);
    double sum = 0;
    for (uint32_t i = 0; i < pieces; i++)
        sum += piece[i].lit ? ratio : 1 - ratio;
    uint32_t n = 0;
    for (uint32_t i = 0; i < pieces; i++) {
        const double weight = piece[i].lit ? ratio : 1 - ratio;
        const double share = sum > 0 ? floor(weight / sum * most) + 1 : 1;
        const uint32_t k =
            least(share < 1 ? 1 : share, most - n - pieces + i + 1); // one each is left
        divide(all + n, &piece[i], k);
        n += k;
    }
    *count = n;
    return all;
}
