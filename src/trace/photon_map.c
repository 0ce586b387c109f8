#include "trace/photon_map.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "math/elementary.h"
#include "math/pi.h"

// Makes room for `more` photons; returns for how many there is.
static uint32_t room_for(struct photon_map *m, uint32_t more)
{
    if (more > PHOTONS_MOST - m->count) {
        more = PHOTONS_MOST - m->count;
        m->full = true;
    }
    if (m->capacity - m->count >= more)
        return more;
    const uint32_t least = m->count + more;
    m->capacity = m->capacity < 32 ? 64 : 2 * m->capacity;
    if (m->capacity < least)
        m->capacity = least;
    m->photon = must_realloc(m->photon, m->capacity, sizeof *m->photon);
    return more;
}

void photon_add(struct photon_map *m, const struct photon *p)
{
    if (room_for(m, 1))
        m->photon[m->count++] = *p;
}

void photon_map_append(struct photon_map *m, const struct photon_map *from)
{
    const uint32_t n = room_for(m, from->count);
    if (n)
        memcpy(m->photon + m->count, from->photon, n * sizeof *m->photon);
    m->count += n;
    m->full |= from->full;
}

void photon_map_end(struct photon_map *m)
{
    free(m->photon);
    free(m->tree.leaf);
    for (int i = 0; i < PHOTON_USES; i++)
        photon_grid_end(&m->range[i].grid);
    for (uint32_t i = 0; i < m->tree.levels; i++)
        free(m->tree.level[i]);
}

// ---- the tree ------------------------------------------------------------------------

struct range {
    uint32_t begin, end;
};

enum { WIDE = 8 }; // photons of a leaf, children of a node

static int widest(const struct photon_map *m, struct range r)
{
    float low[3], high[3];
    int axis = 0;
    for (int a = 0; a < 3; a++) {
        low[a] = high[a] = m->photon[r.begin].p[a];
        for (uint32_t i = r.begin + 1; i < r.end; i++) {
            const float v = m->photon[i].p[a];
            low[a] = v < low[a] ? v : low[a];
            high[a] = v > high[a] ? v : high[a];
        }
        if (high[a] - low[a] > high[axis] - low[axis])
            axis = a;
    }
    return axis;
}

static void swap(struct photon *a, struct photon *b)
{
    const struct photon c = *a;
    *a = *b;
    *b = c;
}

// Brings what belongs at k there, less before it and more after it (Hoare's find).
static void select_at(struct photon *p, int axis, uint32_t begin, uint32_t end,
                      uint32_t k)
{
    while (end - begin > 1) {
        const float pivot = p[begin + (end - begin) / 2].p[axis];
        uint32_t i = begin, j = end - 1;
        for (;;) {
            while (p[i].p[axis] < pivot)
                i++;
            while (pivot < p[j].p[axis])
                j--;
            if (i >= j)
                break;
            swap(&p[i++], &p[j--]);
        }
        // [begin, j] is not above the pivot, the rest not below it.
        const uint32_t split = i == j ? i : j + 1;
        if (i == j && k == i)
            return;
        if (k < split)
            end = split;
        else
            begin = i == j ? i + 1 : split;
    }
}

// Where a range is divided: as near to its middle as its first part can be leaves of full
// nodes.
static uint32_t middle_of(struct range r)
{
    uint32_t part = WIDE;
    while (2 * part < r.end - r.begin)
        part *= 2;
    return r.begin + part;
}

static void sort(struct photon_map *m)
{
    struct range stack[64];
    int top = 0;
    stack[top++] = (struct range){0, m->count};
    while (top) {
        const struct range r = stack[--top];
        if (r.end - r.begin <= WIDE)
            continue;
        const uint32_t middle = middle_of(r);
        select_at(m->photon, widest(m, r), r.begin, r.end, middle);
        stack[top++] = (struct range){r.begin, middle};
        stack[top++] = (struct range){middle, r.end};
    }
}

static uint32_t groups(uint32_t n) { return n / WIDE + (n % WIDE != 0); }

static void make_leaves(struct photon_map *m)
{
    const uint32_t count = groups(m->count);
    m->tree.leaf = must_calloc(count, sizeof *m->tree.leaf);
    for (uint32_t i = 0; i < WIDE * count; i++)
        for (int a = 0; a < 3; a++)
            m->tree.leaf[i / WIDE].p[a][i % WIDE] =
                i < m->count ? m->photon[i].p[a] : NAN;
}

// The box around eight leaves or nodes in a node.
static void make_box(struct photon_node *to, uint32_t i, float (*low)[WIDE],
                     float (*high)[WIDE])
{
    for (int a = 0; a < 3; a++) {
        float from = INFINITY, end = -INFINITY;
        for (int k = 0; k < WIDE; k++) {
            from = low[a][k] < from ? low[a][k] : from; // not of NaN
            end = high[a][k] > end ? high[a][k] : end;
        }
        to->low[a][i] = from;
        to->high[a][i] = end;
    }
}

static struct photon_node *nodes_new(uint32_t count)
{
    struct photon_node *n = must_calloc(count, sizeof *n);
    for (uint32_t i = 0; i < WIDE * count; i++) {
        for (int a = 0; a < 3; a++) {
            n[i / WIDE].low[a][i % WIDE] = INFINITY;
            n[i / WIDE].high[a][i % WIDE] = -INFINITY;
        }
    }
    return n;
}

static void make_nodes(struct photon_tree *t, uint32_t leaves)
{
    uint32_t below = leaves;
    do {
        const uint32_t count = groups(below);
        struct photon_node *n = nodes_new(count);
        for (uint32_t i = 0; i < below; i++) {
            struct photon_node *from = t->levels ? &t->level[t->levels - 1][i] : NULL;
            make_box(&n[i / WIDE], i % WIDE, from ? from->low : t->leaf[i].p,
                     from ? from->high : t->leaf[i].p);
        }
        t->level[t->levels++] = n;
        below = count;
    } while (below > 1);
}

void photon_map_build(struct photon_map *m, photon_search_fn *search)
{
    m->search = search;
    if (!m->count)
        return;
    sort(m);
    make_leaves(m);
    make_nodes(&m->tree, groups(m->count));
}

// ---- searching -----------------------------------------------------------------------

struct photon_near *photon_near_new(uint32_t most, enum photon_use use)
{
    const size_t room = 2 * (size_t)most + 2 * WIDE; // photon_search.h
    struct photon_near *n = must_calloc(1, sizeof *n);
    n->use = use;
    n->most = most;
    n->photon = must_calloc(room, sizeof *n->photon);
    n->distance2 = must_calloc(room, sizeof *n->distance2);
    return n;
}

void photon_near_free(struct photon_near *near)
{
    if (!near)
        return;
    free(near->photon);
    free(near->distance2);
    free(near);
}

uint32_t photons_near(const struct photon_map *m, struct vec3 p, struct vec3 normal,
                      double radius, struct photon_near *near, double *reach)
{
    struct photon_search s = {.tree = &m->tree,
                              .p = {p.x, p.y, p.z},
                              .n = {normal.x, normal.y, normal.z},
                              .flat = normal.x != 0 || normal.y != 0 || normal.z != 0,
                              .limit2 = fmin(radius * radius, DBL_MAX),
                              .most = near->most,
                              .distance2 = near->distance2,
                              .photon = near->photon};
    static const double more = 1.3; // than where the last place had enough
    const double limit2 = s.limit2;
    *reach = radius;
    if (!near->most)
        return 0;
    if (near->likely2 > 0 && near->likely2 < limit2)
        s.limit2 = near->likely2;
    m->search(&s);
    if (s.count < near->most && s.limit2 < limit2) {
        s.limit2 = limit2;
        m->search(&s);
    }
    near->likely2 = s.count == near->most ? more * s.limit2 : 0;
    if (s.count == near->most)
        *reach = sqrt(s.limit2);
    return s.count;
}

// What lies within a radius of what was found in a larger one: the nearest come in the same
// order whatever the radius, so that it is what a search within the smaller one finds.
static uint32_t count_within(const struct photon_near *near, uint32_t count,
                             double radius)
{
    const double limit2 = fmin(radius * radius, DBL_MAX);
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++)
        n += near->distance2[i] <= limit2;
    return n;
}

static void keep_within(struct photon_near *near, uint32_t count, double radius)
{
    const double limit2 = fmin(radius * radius, DBL_MAX);
    for (uint32_t i = 0, n = 0; i < count; i++)
        if (near->distance2[i] <= limit2)
            near->photon[n++] = near->photon[i];
}

void photon_map_ready(struct photon_map *m, enum photon_use use)
{
    struct photon_range *r = &m->range[use];
    if (m->count)
        photon_grid_build(&r->grid, m->photon->p, m->count, sizeof *m->photon, r->radius,
                          r->radius + r->step);
}

// How many photons a sample's ray gathers where the picture gathers `max`.
static uint32_t sample_most(uint32_t max)
{
    enum { FEWER = 4, LEAST = 8 };
    return max / FEWER > LEAST ? max / FEWER : max < LEAST ? max : LEAST;
}

// Irradiance samples take the mean over many places, where blurring light gains nothing and
// what a place does not know the others do: as few photons as make a density, from as much
// nearer, and never more from farther, which would favour places that are dark by chance.
uint32_t photon_map_for_samples(struct photon_map *m, uint32_t max, bool in_space)
{
    const struct photon_range *picture = &m->range[PHOTON_PICTURE];
    struct photon_range *r = &m->range[PHOTON_SAMPLE];
    const uint32_t most = sample_most(max);
    const double fewer = max ? (double)most / max : 1;
    const double last = most > 1 ? most / (most - 1.0) : 1;
    r->radius = picture->radius * (in_space ? det_pow(fewer, 1.0 / 3) : sqrt(fewer));
    r->last = in_space ? det_pow(last, 1.0 / 3) : sqrt(last);
    photon_map_ready(m, PHOTON_SAMPLE);
    return most;
}

uint32_t photons_gather(const struct photon_map *m, const struct photon_gather *gather,
                        struct vec3 p, struct vec3 normal, struct photon_near *near,
                        double *reach)
{
    const struct photon_range *r = &m->range[near->use];
    const struct photon_gather *g = &gather[near->use];
    const int32_t place = photon_grid_place(&r->grid, p, normal);
    const struct photon_hint hint = photon_grid_recall(&r->grid, place);
    uint32_t count = 0;
    *reach = r->radius;
    if (place == PHOTON_PLACE_EMPTY)
        return 0;
    near->likely2 = hint.likely2;
    // Where the radius held too few last time the grown one is searched at once.
    if (!hint.sparse) {
        count = photons_near(m, p, normal, r->radius, near, reach);
        if (count >= g->min) {
            photon_grid_remember(&r->grid, place,
                                 (struct photon_hint){.likely2 = near->likely2});
            if (count == near->most)
                *reach *= r->last;
            return count;
        }
    }
    double wide;
    near->likely2 = 0;
    const uint32_t more = photons_near(m, p, normal, r->radius + r->step, near, &wide);
    if (hint.sparse) {
        count = count_within(near, more, r->radius);
        *reach = count == near->most ? wide : r->radius;
    }
    photon_grid_remember(&r->grid, place, (struct photon_hint){.sparse = count < g->min});
    if (count < g->min) {
        const double density = count / (*reach * *reach);
        const bool even = more / (wide * wide) <= (1 + g->expand_increase) * density;
        if (more && (even || more < g->expand_min)) {
            *reach = wide;
            return more;
        }
    }
    keep_within(near, more, r->radius);
    return count;
}

// ---- the radius ----------------------------------------------------------------------

static double density_of(uint32_t count, double r, bool in_space)
{
    return count / (in_space ? 4.0 / 3 * PI * r * r * r : PI * r * r);
}

static struct vec3 place_of(const struct photon *p)
{
    return vec3((double)p->p[0], (double)p->p[1], (double)p->p[2]);
}

// Every how many photons one is asked: a twentieth of them, 100 to 1,000.
static uint32_t stride_of(uint32_t count)
{
    uint32_t samples = count / 20;
    samples = samples < 100 ? 100 : samples > 1000 ? 1000 : samples;
    return count > samples ? count / samples : 1;
}

void photon_map_radius(struct photon_map *m, uint32_t max, bool in_space)
{
    static const double sparse = 0.05, thin = 0.7, growth = 20;
    const struct vec3 any = {0, 0, 0};
    const uint32_t stride = stride_of(m->count);
    struct photon_near *near = photon_near_new(max, PHOTON_PICTURE);
    double *radius = &m->range[PHOTON_PICTURE].radius, sum = 0;
    uint32_t samples = 0, few = 0;
    for (uint32_t i = 0; i < m->count; i += stride) {
        double r;
        const uint32_t n = photons_near(m, place_of(&m->photon[i]), any, 1e7, near, &r);
        if (n == max && r > 0) {
            sum += density_of(n, r, in_space);
            samples++;
        }
    }
    const double mean = samples ? sum / samples : 1;
    *radius = in_space ? det_pow(max / (4.0 / 3 * PI * mean), 1.0 / 3)
                       : sqrt(max / (PI * mean));
    samples = 0;
    for (uint32_t i = 0; i < m->count; i += stride) {
        double r;
        const uint32_t n =
            photons_near(m, place_of(&m->photon[i]), any, *radius, near, &r);
        const double density = density_of(n, r, in_space);
        few += density > sparse * mean && density < thin * mean;
        samples++;
    }
    if (samples)
        *radius *= 1 + growth * few / samples;
    photon_near_free(near);
}
