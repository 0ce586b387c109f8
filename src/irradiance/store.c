#include "irradiance/store_kernel.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "math/isa.h"

void store_init(struct store *s, const char *isa)
{
    *s = (struct store){.kernels = ISA_NAMED(isa, store_kernels)};
    for (int i = 0; i < STORE_DEPTHS; i++) {
        s->size_low[i] = INT16_MAX;
        s->size_high[i] = INT16_MIN;
    }
}

void store_free(struct store *s)
{
    free(s->sample);
    free(s->spot);
    free(s->filed);
    free(s->cell);
    free(s->filter);
}

// ---- weights ----------------------------------------------------------------------------

static double falloff(double error, const struct cache_point *at)
{
    const double x = error * (1 / at->error_bound);
    if (!at->smooth)
        return 1 - x;
    const double y = x < 0.5 ? 2 * x : 2 * (1 - x);
    return x < 0.5 ? 1 - y * y / 2 : y * y / 2;
}

bool cache_may_count(struct vec3 p, struct vec3 n, double radius,
                     const struct cache_point *at)
{
    // The part of the error that normals make is enough to tell for most.
    const double turned = fabs(1 - vec3_dot(at->n, n));
    return !(4 * turned >= at->error_bound * at->error_bound) &&
           !(vec3_length(vec3_sub(at->p, p)) >= radius * at->error_bound);
}

double cache_weight(const struct cache_sample *s, const struct cache_point *at)
{
    if (!cache_may_count(s->p, s->n, s->radius, at))
        return 0;
    const struct vec3 d = vec3_sub(at->p, s->p);
    const double turned = fabs(1 - vec3_dot(at->n, s->n)), distance = vec3_length(d);
    double radius = s->radius;
    if (distance > cache_same_place) {
        const double nearing = vec3_dot(s->to, d) * (1 / distance);
        if (nearing > 0)
            radius = nearing * s->nearest + (1 - nearing) * radius;
    }
    if (distance >= radius * at->error_bound)
        return 0;
    const double error = distance / radius + 2 * sqrt(turned);
    if (!(error < at->error_bound))
        return 0;
    const struct vec3 middle = vec3_add(at->n, s->n);
    const double ahead = vec3_dot(d, middle);
    double weight = falloff(error, at);
    // Behind the sample: how far, as a cosine, need not be known elsewhere.
    if (distance > cache_same_place && ahead < 0) {
        const double front = ahead / (distance * vec3_length(middle));
        if (!(front > cache_behind))
            return 0;
        weight *= 1 - front / cache_behind;
    }
    return weight <= cache_least_weight ? 0 : weight * s->quality;
}

// ---- cells ------------------------------------------------------------------------------

static uint32_t place_hash(const struct cache_place *p)
{
    return cache_cell_hash(p->at, p->size, p->depth);
}

// Where a cell with that hash is looked for first.
static uint32_t cell_home(const struct store *s, uint32_t hash)
{
    return hash >> 7 & (s->cell_capacity - 1);
}

// The slot of the cell, or the free one where it belongs.
static struct cache_cell *cell_find(const struct store *s, uint32_t hash, int size,
                                    uint32_t depth)
{
    for (uint32_t i = cell_home(s, hash);; i++) {
        struct cache_cell *c = &s->cell[i & (s->cell_capacity - 1)];
        if (!c->count || (c->hash == hash && c->size == size && c->depth == depth))
            return c;
    }
}

static void cell_place(struct store *s, const struct cache_cell *c)
{
    const uint32_t bit = filter_bit(s, c->hash);
    *cell_find(s, c->hash, c->size, c->depth) = *c;
    s->filter[bit / 8] |= (uint8_t)(1u << bit % 8);
}

static void cells_grow(struct store *s)
{
    enum { FEWEST = 256 };
    const struct store old = *s;
    s->cell_capacity = old.cell_capacity ? 2 * old.cell_capacity : FEWEST;
    s->cell = must_calloc(s->cell_capacity, sizeof *s->cell);
    s->filter = must_calloc(s->cell_capacity, FILTER_BITS / 8);
    for (uint32_t i = 0; i < old.cell_capacity; i++)
        if (old.cell[i].count)
            cell_place(s, &old.cell[i]);
    free(old.cell);
    free(old.filter);
}

// A cell's part of `filed`, with its ends, has room for a power of two.
static bool is_used_up(uint32_t count)
{
    const uint32_t used = CACHE_SIDES + count;
    return count == 0 || (used & (used - 1)) == 0;
}

// To a room twice as large behind all others.
static void cell_move(struct store *s, struct cache_cell *c)
{
    enum { FEWEST = 8 };
    const uint32_t used = c->count ? CACHE_SIDES + c->count : 0,
                   room = used ? 2 * used : FEWEST;
    while (s->filed_capacity - s->filed_count < room)
        s->filed = memory_double(s->filed, &s->filed_capacity, sizeof *s->filed);
    uint32_t *to = s->filed + s->filed_count;
    if (used)
        memcpy(to, cell_ends(s, c), used * sizeof *to);
    else
        memset(to, 0, CACHE_SIDES * sizeof *to);
    c->first = s->filed_count + CACHE_SIDES;
    s->filed_count += room;
}

// Each side behind that of the sample gives its first place to the one before, and takes one
// at its own end.
static void cell_add(const struct store *s, struct cache_cell *c, int side,
                     uint32_t sample)
{
    uint32_t *end = cell_ends(s, c), *filed = s->filed + c->first;
    for (int i = CACHE_SIDES - 1; i > side; i--) {
        filed[end[i]] = filed[end[i - 1]];
        end[i]++;
    }
    filed[end[side]++] = sample;
    c->count++;
}

static void cell_put(struct store *s, const struct cache_place *at, int side,
                     uint32_t sample)
{
    const uint32_t hash = place_hash(at);
    if (!s->cell_capacity)
        cells_grow(s);
    struct cache_cell *c = cell_find(s, hash, at->size, at->depth);
    if (!c->count) {
        // Never without a new cell: a memo would not see that cells have moved.
        if (2 * (s->cell_count + 1) > s->cell_capacity)
            cells_grow(s);
        const struct cache_cell fresh = {hash, at->size, at->depth, 0, 0};
        cell_place(s, &fresh);
        c = cell_find(s, hash, at->size, at->depth);
        s->cell_count++;
    }
    if (is_used_up(c->count))
        cell_move(s, c);
    cell_add(s, c, side, sample);
}

// Far from the origin, places of small cells leave the range of integers: such cells all
// lie at its end, which costs time only.
enum { LAST_PLACE = 2000000000 };

static int32_t place_of(double x, double cells_per_unit)
{
    const double p = x * cells_per_unit;
    if (!(fabs(p) < LAST_PLACE))
        return p < 0 ? -LAST_PLACE : LAST_PLACE;
    const int32_t towards_nought = (int32_t)p;
    return towards_nought - (p < towards_nought);
}

// The place of the same point in cells of twice the size.
static int32_t place_doubled(int32_t place, double x, double cells_per_unit)
{
    if (abs(place) == LAST_PLACE)
        return place_of(x, cells_per_unit);
    return place < 0 ? -1 - (-1 - place) / 2 : place / 2;
}

static bool holds(float f) { return fabsf(f) <= FLT_MAX; }

static struct cache_spot spot_of(const struct cache_sample *s)
{
    struct cache_spot spot = {.p = {(float)s->p.x, (float)s->p.y, (float)s->p.z},
                              .radius = (float)s->radius,
                              .n = {(float)s->n.x, (float)s->n.y, (float)s->n.z}};
    if (!holds(spot.p[0]) || !holds(spot.p[1]) || !holds(spot.p[2])) {
        spot.p[0] = spot.p[1] = spot.p[2] = 0;
        spot.radius = INFINITY;
    }
    return spot;
}

void store_add(struct store *s, const struct cache_sample *sample)
{
    enum { SIZE_LEAST = -1000 }; // its inverse is a number, too
    const double reach = sample->reach;
    s->sample = must_grow(s->sample, s->count, &s->capacity, sizeof *s->sample);
    s->spot = must_grow(s->spot, s->count, &s->spot_capacity, sizeof *s->spot);
    s->sample[s->count] = *sample;
    s->spot[s->count] = spot_of(sample);
    int size;
    frexp(reach, &size);
    if (size < SIZE_LEAST)
        size = SIZE_LEAST;
    const uint32_t depth = sample->depth;
    const int side = cache_side(sample->n);
    if (size < s->size_low[depth])
        s->size_low[depth] = (int16_t)size;
    if (size > s->size_high[depth])
        s->size_high[depth] = (int16_t)size;
    const double scale = ldexp(1, -size);
    const struct vec3 r = vec3(reach, reach, reach);
    const struct vec3 a = vec3_sub(sample->p, r), b = vec3_add(sample->p, r);
    for (int32_t z = place_of(a.z, scale); z <= place_of(b.z, scale); z++)
        for (int32_t y = place_of(a.y, scale); y <= place_of(b.y, scale); y++)
            for (int32_t x = place_of(a.x, scale); x <= place_of(b.x, scale); x++)
                cell_put(s,
                         &(struct cache_place){{x, y, z}, (int16_t)size, (uint16_t)depth},
                         side, s->count);
    s->count++;
}

enum { SIZES = sizeof((struct store_memo *)0)->cell / sizeof(struct cache_cell *) };

static bool same_place(const struct cache_place *a, const struct cache_place *b)
{
    return memcmp(a->at, b->at, sizeof a->at) == 0 && a->size == b->size &&
           a->depth == b->depth;
}

static const struct cache_cell *
cell_asked(const struct store *s, const struct cache_place *p, struct store_memo *memo)
{
    const unsigned i = (unsigned)p->size % SIZES;
    if (memo && memo->cell[i] && same_place(&memo->place[i], p))
        return memo->cell[i];
    const struct cache_cell *c = cell_find(s, place_hash(p), p->size, p->depth);
    if (memo) {
        memo->place[i] = *p;
        memo->cell[i] = c;
    }
    return c;
}

static void memo_update(const struct store *s, struct store_memo *memo)
{
    if (memo->cell_count == s->cell_count)
        return;
    memset(memo->cell, 0, sizeof memo->cell);
    memo->cell_count = s->cell_count;
}

static bool is_within(const int32_t place[3])
{
    return abs(place[0]) < LAST_PLACE && abs(place[1]) < LAST_PLACE &&
           abs(place[2]) < LAST_PLACE;
}

static struct cache_place place_at(struct vec3 p, int size, uint32_t depth)
{
    const double scale = ldexp(1, -size);
    return (struct cache_place){
        {place_of(p.x, scale), place_of(p.y, scale), place_of(p.z, scale)},
        (int16_t)size,
        (uint16_t)depth};
}

// Of the cells of a point that are `count` sizes from `size` on: those that there are. What
// lies in memory is asked for before it is looked at.
static uint32_t cells_find(const struct store *s, const struct cache_point *at, int size,
                           uint32_t count, const struct cache_cell *cell[STORE_SIZES])
{
    const struct cache_place first = place_at(at->p, size, at->depth);
    const bool within = is_within(first.at);
    uint32_t hash[STORE_SIZES], found = 0;
    unsigned pass = (1u << count) - 1;
    if (within)
        pass = s->kernels->hashes(s, first.at, size, at->depth, count, hash);
    for (uint32_t i = 0; !within && i < count; i++) {
        const struct cache_place p = place_at(at->p, size + (int)i, at->depth);
        hash[i] = place_hash(&p);
    }
    for (unsigned left = pass; left; left &= left - 1)
        __builtin_prefetch(&s->cell[cell_home(s, hash[__builtin_ctz(left)])]);
    for (unsigned left = pass; left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        const struct cache_cell *c = cell_find(s, hash[i], size + i, at->depth);
        if (!c->count)
            continue;
        __builtin_prefetch(cell_ends(s, c));
        cell[found++] = c;
    }
    return found;
}

void store_mean(const struct store *s, const struct cache_point *at,
                struct cache_mean *mean)
{
    const int high = s->size_high[at->depth];
    for (int size = s->size_low[at->depth]; size <= high; size += STORE_SIZES) {
        const struct cache_cell *cell[STORE_SIZES];
        const uint32_t left = (uint32_t)(high - size) + 1,
                       count = left < STORE_SIZES ? left : STORE_SIZES,
                       found = cells_find(s, at, size, count, cell);
        if (found && !s->kernels->mean(s, cell, found, at, mean))
            return;
    }
}

// One of eight points; false: that is enough.
static bool mean_alone(const struct store *s, const struct cache_cell *c,
                       const struct cache_points *at, int i, struct cache_means *mean)
{
    const struct cache_point point = {vec3(at->p[0][i], at->p[1][i], at->p[2][i]),
                                      vec3(at->n[0][i], at->n[1][i], at->n[2][i]),
                                      at->error_bound[i],
                                      at->depth,
                                      at->smooth,
                                      at->enough};
    struct cache_mean m = {mean->weight[i],
                           {mean->light[0][i], mean->light[1][i], mean->light[2][i]}};
    const bool more = s->kernels->mean(s, &c, 1, &point, &m);
    mean->weight[i] = m.weight;
    for (int k = 0; k < 3; k++)
        mean->light[k][i] = m.light[k];
    return more;
}

// The lanes among `left` whose points are in the cell of lane i.
static unsigned lanes_in(int32_t (*place)[3], unsigned left, int i)
{
    unsigned same = 0;
    for (; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        if (memcmp(place[k], place[i], sizeof *place) == 0)
            same |= 1u << k;
    }
    return same;
}

// The places of the lanes in cells of the given size, or of twice the size they have.
static void places_of(const struct cache_points *at, unsigned lanes, double scale,
                      bool doubled, int32_t place[8][3])
{
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        for (int k = 0; k < 3; k++)
            place[i][k] = doubled ? place_doubled(place[i][k], at->p[k][i], scale)
                                  : place_of(at->p[k][i], scale);
    }
}

// What the lanes hear in the cell; returns those that have not enough.
static unsigned means_in(const struct store *s, const struct cache_cell *c,
                         const struct cache_points *at, unsigned lanes,
                         struct cache_means *mean)
{
    enum { FEW = 2 }; // points that are better off alone
    unsigned more = lanes;
    if (!c->count)
        return lanes;
    if (__builtin_popcount(lanes) > FEW)
        return s->kernels->means(s, c, at, lanes, mean);
    for (; lanes; lanes &= lanes - 1)
        if (!mean_alone(s, c, at, __builtin_ctz(lanes), mean))
            more &= ~(lanes & -lanes);
    return more;
}

void store_means(const struct store *s, const struct cache_points *at,
                 struct store_memo *memo, struct cache_means *mean)
{
    const int low = s->size_low[at->depth], high = s->size_high[at->depth];
    double scale = ldexp(1, -low);
    int32_t place[8][3];
    unsigned lanes = at->lanes;
    unsigned guide =
        0; // the lane that stands for all, which are in one cell, and so in larger ones
    if (memo)
        memo_update(s, memo);
    for (int size = low; lanes && size <= high; size++, scale /= 2) {
        places_of(at, guide ? guide : lanes, scale, size > low, place);
        for (unsigned left = lanes, same; left; left &= ~same) {
            const int i = __builtin_ctz(guide ? guide : left);
            same = guide ? left : lanes_in(place, left, i);
            if (same == lanes && is_within(place[i]))
                guide = 1u << i;
            const struct cache_place p = {{place[i][0], place[i][1], place[i][2]},
                                          (int16_t)size,
                                          (uint16_t)at->depth};
            lanes &= ~same | means_in(s, cell_asked(s, &p, memo), at, same, mean);
        }
    }
}
