// Hierarchical radiosity (Hanrahan, Salzman, Aupperle 1991) on a tree of groups of
// elements: two groups exchange light over one link where the kernel between them varies
// little for the light they have, else their parts do.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"
#include "radiosity/solver.h"

enum { JUDGE_SAMPLES = 8, LINK_SAMPLES = 16 };

#define GROUP_NONE UINT32_MAX

struct group {
    uint32_t first, count; // in `order`
    uint32_t child[2];     // GROUP_NONE: a single element
    double area, radius;
    struct vec3 centre;
};

struct link {
    uint32_t a, b;
    double exchange; // A_a F_ab
    bool final;
};

struct hierarchy {
    const struct radiosity_system *s;
    const struct solver_settings *settings;
    uint32_t *order;
    struct group *group;
    uint32_t group_count;
    struct link *link; // final ones first, then the ones at hand
    size_t link_count, link_capacity;
    size_t pending; // first of the links at hand
    double (*b)[3], (*h)[3];
    double *scale;    // of elements
    double *bright;   // radiosity expected of a group, greatest channel
    double reference; // irradiance that counts as 1
    uint64_t *rays;   // of links at hand
};

// ---- groups ------------------------------------------------------------------------
struct sort_key {
    double value;
    uint32_t element;
};

static int by_value(const void *a, const void *b)
{
    const struct sort_key *x = a, *y = b;
    if (x->value != y->value)
        return x->value < y->value ? -1 : 1;
    return x->element < y->element ? -1 : 1;
}

static void group_measure(struct hierarchy *t, struct group *g)
{
    const struct element *e = t->s->e->element;
    struct vec3 sum = {0, 0, 0};
    g->area = g->radius = 0;
    for (uint32_t i = g->first; i < g->first + g->count; i++) {
        g->area += e[t->order[i]].area;
        sum = vec3_add(sum, vec3_scale(e[t->order[i]].area, e[t->order[i]].centre));
    }
    g->centre = g->area > 0 ? vec3_scale(1 / g->area, sum) : sum;
    for (uint32_t i = g->first; i < g->first + g->count; i++) {
        const struct element *x = &e[t->order[i]];
        for (uint32_t k = 0; k < x->corner_count; k++)
            g->radius = fmax(g->radius, vec3_length(vec3_sub(x->corner[k], g->centre)));
    }
}

// Sorts a range so that halves are apart: by surface first, then along the widest axis.
static void group_sort(struct hierarchy *t, const struct group *g, struct sort_key *key)
{
    const struct element *e = t->s->e->element;
    struct vec3 low = {INFINITY, INFINITY, INFINITY}, high = vec3_neg(low);
    bool mixed = false;
    for (uint32_t i = g->first; i < g->first + g->count; i++) {
        const struct element *x = &e[t->order[i]];
        mixed |= x->surface != e[t->order[g->first]].surface;
        low = vec3(fmin(low.x, x->centre.x), fmin(low.y, x->centre.y),
                   fmin(low.z, x->centre.z));
        high = vec3(fmax(high.x, x->centre.x), fmax(high.y, x->centre.y),
                    fmax(high.z, x->centre.z));
    }
    const struct vec3 size = vec3_sub(high, low);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    for (uint32_t i = 0; i < g->count; i++) {
        const uint32_t x = t->order[g->first + i];
        key[i] =
            (struct sort_key){mixed ? e[x].surface : vec3_axis(e[x].centre, axis), x};
    }
    qsort(key, g->count, sizeof *key, by_value);
    for (uint32_t i = 0; i < g->count; i++)
        t->order[g->first + i] = key[i].element;
}

// Where to cut: between surfaces where there are several, else in the middle.
static uint32_t group_cut(const struct hierarchy *t, const struct group *g)
{
    const struct element *e = t->s->e->element;
    const uint32_t middle = g->first + g->count / 2, end = g->first + g->count;
    const uint32_t surface = e[t->order[middle]].surface;
    uint32_t low = middle, high = middle;
    while (low > g->first && e[t->order[low - 1]].surface == surface)
        low--;
    while (high < end && e[t->order[high]].surface == surface)
        high++;
    if (low == g->first && high == end)
        return g->count / 2;
    return (low > g->first && (high == end || middle - low < high - middle) ? low
                                                                            : high) -
           g->first;
}

static uint32_t group_build(struct hierarchy *t, uint32_t first, uint32_t count,
                            struct sort_key *key)
{
    const uint32_t at = t->group_count++;
    struct group *g = &t->group[at];
    *g =
        (struct group){.first = first, .count = count, .child = {GROUP_NONE, GROUP_NONE}};
    group_measure(t, g);
    if (count == 1)
        return at;
    group_sort(t, g, key);
    const uint32_t cut = group_cut(t, g);
    g->child[0] = group_build(t, first, cut, key);
    g->child[1] = group_build(t, first + cut, count - cut, key);
    return at;
}

// Radiosity of groups from that of their elements.
static void pull(struct hierarchy *t)
{
    for (uint32_t k = t->group_count; k-- > 0;) {
        const struct group *g = &t->group[k];
        if (g->child[0] == GROUP_NONE)
            continue;
        const struct group *x = &t->group[g->child[0]], *y = &t->group[g->child[1]];
        for (int c = 0; c < 3; c++)
            t->b[k][c] =
                g->area > 0
                    ? (x->area * t->b[g->child[0]][c] + y->area * t->b[g->child[1]][c]) /
                          g->area
                    : 0;
    }
}

// ---- links -------------------------------------------------------------------------
static void link_add(struct hierarchy *t, uint32_t a, uint32_t b)
{
    if (t->link_count == t->link_capacity) {
        t->link_capacity = t->link_capacity ? 2 * t->link_capacity : 1024;
        t->link = must_realloc(t->link, t->link_capacity, sizeof *t->link);
    }
    t->link[t->link_count++] = (struct link){a, b, 0, false};
}

// An element of the group, with probability by its number; weight corrects to area.
static uint32_t element_in(const struct hierarchy *t, const struct group *g, double u,
                           double *inside)
{
    const double x = u * g->count;
    const uint32_t k = x < g->count ? (uint32_t)x : g->count - 1;
    *inside = x - floor(x);
    return t->order[g->first + k];
}

// A point of the group, uniform in area but for the number of its elements; share
// corrects that. False: a sliver without points.
static bool group_point(const struct hierarchy *t, struct factor_state *s,
                        const struct group *g, uint32_t k, uint32_t seed, double u,
                        double v, double *share, struct element_point *out)
{
    enum { TRIES = 64 };
    const uint32_t i = element_in(t, g, u, &u);
    *share = t->s->e->element[i].area * g->count / g->area;
    double x[4] = {u, v, 0, 0};
    // Where an element does not exist another point is drawn.
    for (uint32_t n = 0; n < TRIES; n++) {
        if (element_at(s, i, x[0], x[1], out))
            return true;
        random_point(k, sequence_seed(seed, n + 1), x);
    }
    return false;
}

// Samples [first, first + count) of the kernel between two groups, visibility included:
// mean and spread.
static double link_sample(const struct hierarchy *t, struct factor_state *s,
                          const struct link *l, uint32_t first, uint32_t count,
                          double *spread)
{
    const struct group *a = &t->group[l->a], *b = &t->group[l->b];
    const uint32_t seed = sequence_seed(sequence_seed(l->a, l->b), t->settings->seed);
    double value[LINK_SAMPLES], most = 0, least = INFINITY, sum = 0;
    uint32_t ray[LINK_SAMPLES];
    s->rays->count = 0;
    for (uint32_t k = 0; k < count; k++) {
        struct element_point from, to;
        double x[4], share_a, share_b;
        sobol_point(first + k, seed, x);
        value[k] = 0;
        ray[k] = UINT32_MAX;
        if (!group_point(t, s, a, first + k, seed, x[0], x[1], &share_a, &from) ||
            !group_point(t, s, b, first + k, ~seed, x[2], x[3], &share_b, &to))
            continue;
        value[k] = share_a * share_b * point_kernel(&from, &to);
        if (value[k] <= 0)
            continue;
        ray[k] = s->rays->count;
        ray_put_between(s->rays, &from, &to);
    }
    if (t->s->e->occluded && s->rays->count) {
        t->s->e->occluded(s->of_enclosure, s->rays, s->hidden);
        s->ray_count += s->rays->count;
        for (uint32_t k = 0; k < count; k++)
            if (ray[k] != UINT32_MAX && s->hidden[ray[k]])
                value[k] = 0;
    }
    for (uint32_t k = 0; k < count; k++) {
        sum += value[k];
        most = fmax(most, value[k]);
        least = fmin(least, value[k]);
    }
    *spread = most - least;
    return sum / count;
}

// Whether groups may touch: samples then miss how steep the kernel is.
static bool close_by(const struct group *a, const struct group *b)
{
    return vec3_length(vec3_sub(a->centre, b->centre)) <
           1.5 * fmax(a->radius, b->radius) + fmin(a->radius, b->radius);
}

static void link_judge(struct hierarchy *t, struct factor_state *s, struct link *l)
{
    const struct group *a = &t->group[l->a], *b = &t->group[l->b];
    if (a->count == 1 && b->count == 1) {
        const uint32_t i = t->order[a->first], j = t->order[b->first];
        l->exchange = a->area * pair_factor(s, i, j);
        l->final = true;
        return;
    }
    if (l->a == l->b || close_by(a, b))
        return;
    double spread;
    link_sample(t, s, l, 0, JUDGE_SAMPLES, &spread);
    // The light that constant values put wrong on either side.
    const double off =
        spread * fmax(b->area * t->bright[l->b], a->area * t->bright[l->a]);
    if (off > t->settings->link_error * t->reference)
        return;
    // Others than those that spoke for it: links whose samples miss a peak are taken more
    // often than those that meet it.
    l->exchange =
        link_sample(t, s, l, JUDGE_SAMPLES, LINK_SAMPLES, &spread) * a->area * b->area;
    l->final = true;
}

static void *begin(void *user)
{
    const struct hierarchy *t = user;
    return factor_state_new(t->s->e, t->s->factors);
}

static void end(void *user, void *state)
{
    (void)user;
    factor_state_free(state);
}

static void judge(void *user, void *state, uint32_t from, uint32_t to)
{
    struct hierarchy *t = user;
    struct factor_state *s = state;
    for (uint32_t i = from; i < to; i++) {
        const uint64_t before = s->ray_count;
        link_judge(t, s, &t->link[t->pending + i]);
        t->rays[i] = s->ray_count - before;
    }
}

static void link_split(struct hierarchy *t, const struct link *l)
{
    const struct group *a = &t->group[l->a], *b = &t->group[l->b];
    if (l->a == l->b) {
        link_add(t, a->child[0], a->child[0]);
        link_add(t, a->child[0], a->child[1]);
        link_add(t, a->child[1], a->child[1]);
    } else if (b->count == 1 || (a->count > 1 && a->radius >= b->radius)) {
        link_add(t, a->child[0], l->b);
        link_add(t, a->child[1], l->b);
    } else {
        link_add(t, l->a, b->child[0]);
        link_add(t, l->a, b->child[1]);
    }
}

// All links of one depth are judged at once, then those that will not do are split.
static void links_build(struct hierarchy *t, struct radiosity_solution *out)
{
    const struct parallel run = {.threads = t->settings->threads,
                                 .piece = 64,
                                 .watch = t->settings->watch,
                                 .tells = true,
                                 .user = t,
                                 .begin = begin,
                                 .end = end,
                                 .work = judge};
    link_add(t, 0, 0);
    while (t->pending < t->link_count && !watch_cancelled(t->settings->watch)) {
        const size_t from = t->pending, to = t->link_count;
        t->rays = must_calloc(to - from, sizeof *t->rays);
        parallel_run(&run, (uint32_t)(to - from));
        for (size_t i = 0; i < to - from; i++)
            out->rays += t->rays[i];
        free(t->rays);
        if (watch_cancelled(t->settings->watch))
            break;
        for (size_t i = from; i < to; i++)
            if (!t->link[i].final) {
                const struct link l = t->link[i];
                link_split(t, &l);
            }
        // Final links that carry light move to the front.
        size_t kept = from;
        for (size_t i = from; i < to; i++)
            if (t->link[i].final && t->link[i].exchange > 0)
                t->link[kept++] = t->link[i];
        memmove(t->link + kept, t->link + to, (t->link_count - to) * sizeof *t->link);
        t->link_count -= to - kept;
        t->pending = kept;
    }
    out->links = t->link_count;
    out->bytes = (double)t->link_capacity * sizeof *t->link +
                 (double)t->group_count * (sizeof *t->group + 7 * sizeof(double));
}

// ---- solution ----------------------------------------------------------------------
static void gather(struct hierarchy *t)
{
    memset(t->h, 0, t->group_count * sizeof *t->h);
    for (size_t i = 0; i < t->link_count; i++) {
        const struct link *l = &t->link[i];
        const double to_a = l->exchange / t->group[l->a].area;
        const double to_b = l->exchange / t->group[l->b].area;
        for (int c = 0; c < 3; c++) {
            t->h[l->a][c] += to_a * t->b[l->b][c];
            if (l->a != l->b)
                t->h[l->b][c] += to_b * t->b[l->a][c];
        }
    }
    // Children come after their parents.
    for (uint32_t k = 0; k < t->group_count; k++)
        for (int x = 0; x < 2 && t->group[k].child[0] != GROUP_NONE; x++)
            for (int c = 0; c < 3; c++)
                t->h[t->group[k].child[x]][c] += t->h[k][c];
}

// Radiosities of the elements go into the groups that hold just one.
static void elements_set(struct hierarchy *t, double (*b)[3])
{
    for (uint32_t k = 0; k < t->group_count; k++)
        if (t->group[k].count == 1)
            memcpy(t->b[k], b[t->order[t->group[k].first]], sizeof *t->b);
    pull(t);
}

static void elements_get(const struct hierarchy *t, double (*h)[3])
{
    for (uint32_t k = 0; k < t->group_count; k++)
        if (t->group[k].count == 1)
            memcpy(h[t->order[t->group[k].first]], t->h[k], sizeof *h);
}

// Irradiance by radiosities, every exchange times the scales of both elements.
static void exchange(struct hierarchy *t, double (*b)[3], double (*h)[3],
                     double (*scaled)[3])
{
    const uint32_t n = t->s->e->count;
    for (uint32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            scaled[i][c] = b[i][c] * t->scale[i];
    elements_set(t, scaled);
    gather(t);
    elements_get(t, h);
    for (uint32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            h[i][c] *= t->scale[i];
}

// Scales both sides until what every element gets of a world of radiosity 1 is 1, as
// factors_balance does with a matrix.
static void balance(struct hierarchy *t)
{
    enum { ROUNDS = 100 };
    static const double exact = 1e-6;
    const uint32_t n = t->s->e->count;
    double(*one)[3] = must_calloc(n, sizeof *one);
    double(*h)[3] = must_calloc(n, sizeof *h);
    double(*scaled)[3] = must_calloc(n, sizeof *scaled), worst = INFINITY;
    for (uint32_t i = 0; i < n; i++)
        one[i][0] = 1;
    for (int k = 0; k < ROUNDS && worst > exact && !watch_cancelled(t->settings->watch);
         k++) {
        worst = 0;
        exchange(t, one, h, scaled);
        for (uint32_t i = 0; i < n; i++) {
            if (h[i][0] <= 0)
                continue;
            worst = fmax(worst, fabs(h[i][0] - 1));
            t->scale[i] /= sqrt(h[i][0]);
        }
    }
    free(one);
    free(h);
    free(scaled);
}

static void iterate(struct hierarchy *t, struct radiosity_solution *out,
                    double (*source)[3])
{
    const uint32_t n = out->count;
    const uint32_t most = t->settings->steps_max ? t->settings->steps_max : 10000;
    double previous = 0, (*scaled)[3] = must_calloc(n, sizeof *scaled);
    while (out->steps < most && !out->converged && !watch_cancelled(t->settings->watch)) {
        double change = 0, reflected = 0;
        exchange(t, out->b, out->h, scaled);
        for (uint32_t i = 0; i < n; i++) {
            double rho[3];
            element_reflectance(&t->s->e->element[i], rho);
            for (int c = 0; c < 3; c++) {
                const double b = source[i][c] + rho[c] * out->h[i][c];
                change += t->s->e->element[i].area * fabs(b - out->b[i][c]);
                reflected += t->s->e->element[i].area * rho[c] * out->h[i][c];
                out->b[i][c] = b;
            }
        }
        const double q = previous > 0 ? fmin(change / previous, .999) : .5;
        out->error = reflected > 0 ? change * q / (1 - q) / reflected : 0;
        out->converged = out->error <= t->settings->tolerance;
        previous = change;
        out->steps++;
    }
    for (uint32_t i = 0; i < n; i++)
        element_emission(&t->s->e->element[i], source[i]);
    exchange(t, source, out->h_emitted, scaled);
    free(scaled);
}

// What groups may be expected to radiate: their source, and the ambient reflected.
static void expect(struct hierarchy *t, double (*source)[3])
{
    const struct enclosure *e = t->s->e;
    double area = 0, power[3] = {0, 0, 0}, most = 0;
    for (uint32_t i = 0; i < e->count; i++) {
        area += e->element[i].area;
        for (int c = 0; c < 3; c++)
            power[c] += e->element[i].area * source[i][c];
    }
    for (int c = 0; c < 3; c++)
        most = fmax(most, power[c] / area / (1 - mean_reflectance(e, c)));
    t->reference = most;
    for (uint32_t k = 0; k < t->group_count; k++) {
        t->bright[k] = 0;
        for (uint32_t i = 0; i < t->group[k].count; i++) {
            const uint32_t x = t->order[t->group[k].first + i];
            const double b = fmax(source[x][0], fmax(source[x][1], source[x][2])) +
                             (double)rgb_max(e->element[x].reflectance) * most;
            t->bright[k] = fmax(t->bright[k], b);
        }
    }
}

void solve_hierarchical(struct radiosity_solution *out, const struct radiosity_system *s,
                        const struct solver_settings *settings)
{
    const uint32_t n = s->e->count;
    if (n == 0)
        return;
    struct hierarchy t = {.s = s, .settings = settings};
    double(*source)[3] = must_calloc(n, sizeof *source);
    struct sort_key *key = must_calloc(n, sizeof *key);
    t.order = must_calloc(n, sizeof *t.order);
    t.group = must_calloc(2 * (size_t)n, sizeof *t.group);
    for (uint32_t i = 0; i < n; i++)
        t.order[i] = i;
    group_build(&t, 0, n, key);
    free(key);
    t.b = must_calloc(t.group_count, sizeof *t.b);
    t.h = must_calloc(t.group_count, sizeof *t.h);
    t.bright = must_calloc(t.group_count, sizeof *t.bright);
    system_source(s, source);
    expect(&t, source);
    links_build(&t, out);
    // Links that were not judged carry nothing.
    if (watch_cancelled(settings->watch))
        t.link_count = 0;
    memcpy(out->b, source, n * sizeof *source);
    t.scale = must_calloc(n, sizeof *t.scale);
    for (uint32_t i = 0; i < n; i++)
        t.scale[i] = 1;
    if (s->closed)
        balance(&t);
    iterate(&t, out, source);
    free(source);
    free(t.scale);
    free(t.order);
    free(t.group);
    free(t.link);
    free(t.b);
    free(t.h);
    free(t.bright);
}
