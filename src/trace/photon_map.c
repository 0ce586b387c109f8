#include "trace/photon_map.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "math/elementary.h"

static const double pi = 3.14159265358979323846;

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
    m->photon = realloc(m->photon, m->capacity * sizeof *m->photon);
    if (!m->photon)
        abort();
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
    free(m->axis);
    free(m->box);
}

// ---- the tree ------------------------------------------------------------------------

// A range of the tree; its middle is the node.
struct range {
    uint32_t begin, end;
};

// Ranges of this many photons or more have a box. Their middles lie at least half as far
// apart, so that a quarter of the middle's number is free for it.
enum { BOXED = 8, BOX_SHARE = BOXED / 2 };

struct photon_box {
    float low[3], high[3];
};

static uint32_t size_of(struct range r) { return r.end - r.begin; }

static struct photon_box *box_of(const struct photon_map *m, struct range r)
{
    return &m->box[(r.begin + size_of(r) / 2) / BOX_SHARE];
}

static struct photon_box box_around(const struct photon_map *m, struct range r)
{
    struct photon_box b;
    for (int a = 0; a < 3; a++)
        b.low[a] = b.high[a] = m->photon[r.begin].p[a];
    for (uint32_t i = r.begin + 1; i < r.end; i++) {
        for (int a = 0; a < 3; a++) {
            const float v = m->photon[i].p[a];
            b.low[a] = v < b.low[a] ? v : b.low[a];
            b.high[a] = v > b.high[a] ? v : b.high[a];
        }
    }
    return b;
}

static int widest(const struct photon_box *b)
{
    int axis = 0;
    for (int a = 1; a < 3; a++)
        if (b->high[a] - b->low[a] > b->high[axis] - b->low[axis])
            axis = a;
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

void photon_map_build(struct photon_map *m)
{
    struct range stack[64];
    int top = 0;
    m->axis = must_calloc(m->count, 1);
    m->box = must_calloc(m->count / BOX_SHARE + 1, sizeof *m->box);
    if (m->count)
        stack[top++] = (struct range){0, m->count};
    while (top) {
        const struct range r = stack[--top];
        const uint32_t middle = r.begin + (r.end - r.begin) / 2;
        const struct photon_box box = box_around(m, r);
        const int axis = widest(&box);
        if (size_of(r) >= BOXED)
            *box_of(m, r) = box;
        select_at(m->photon, axis, r.begin, r.end, middle);
        m->axis[middle] = (uint8_t)axis;
        if (middle - r.begin > 0)
            stack[top++] = (struct range){r.begin, middle};
        if (r.end - middle > 1)
            stack[top++] = (struct range){middle + 1, r.end};
    }
}

// ---- searching -----------------------------------------------------------------------

// The nearest so far: a heap with the farthest on top once it is full.
struct search {
    const struct photon_map *m;
    double p[3], n[3];
    double limit2;
    uint32_t most, count;
    struct photon_near *near;
};

static bool is_nearer(struct photon_near a, struct photon_near b)
{
    return a.distance2 < b.distance2 ||
           (a.distance2 == b.distance2 && a.photon < b.photon);
}

static void heap_down(struct photon_near *h, uint32_t count, uint32_t i)
{
    const struct photon_near v = h[i];
    for (uint32_t child; (child = 2 * i + 1) < count; i = child) {
        if (child + 1 < count && is_nearer(h[child], h[child + 1]))
            child++;
        if (!is_nearer(v, h[child]))
            break;
        h[i] = h[child];
    }
    h[i] = v;
}

static void take(struct search *s, uint32_t i, double distance2)
{
    const struct photon_near v = {distance2, i};
    if (s->count < s->most) {
        s->near[s->count++] = v;
        if (s->count < s->most)
            return;
        for (uint32_t k = s->count / 2; k-- > 0;)
            heap_down(s->near, s->count, k);
    } else if (is_nearer(v, s->near[0])) {
        s->near[0] = v;
        heap_down(s->near, s->count, 0);
    }
    if (s->count == s->most)
        s->limit2 = s->near[0].distance2;
}

static const double flatness = 16;

// A disc rather than a ball: what lies off the plane is farther, the more the farther
// (spec/lighting.md 11.5).
static double measured(const struct search *s, const float *p)
{
    const double x = (double)p[0] - s->p[0], y = (double)p[1] - s->p[1],
                 z = (double)p[2] - s->p[2];
    const double off = fabs(x * s->n[0] + y * s->n[1] + z * s->n[2]);
    return (x * x + y * y + z * z) * (1 + flatness * off);
}

// Whether nothing in a range can be near enough: neither its box's nearest point nor, at
// that distance, what lies least off the plane.
static bool is_beyond(const struct search *s, struct range r)
{
    static const double rounding = 0x1p-40; // far more than the few operations here lose
    if (size_of(r) < BOXED)
        return false;
    const struct photon_box *b = box_of(s->m, r);
    double d2 = 0, middle = 0, half = 0, size = 0;
    for (int a = 0; a < 3; a++) {
        const double low = (double)b->low[a] - s->p[a],
                     high = (double)b->high[a] - s->p[a];
        const double out = low > 0 ? low : high < 0 ? high : 0;
        d2 += out * out;
        middle += s->n[a] * (low + high) / 2;
        half += fabs(s->n[a]) * (high - low) / 2;
        size += fabs(s->n[a]) * fmax(fabs(low), fabs(high));
    }
    const double off = fabs(middle) - half - rounding * size;
    const double least = off > 0 ? d2 * (1 + flatness * off) : d2;
    return least * (1 - rounding) > s->limit2;
}

static void search_tree(struct search *s)
{
    struct {
        struct range r;
        double gap2; // to the plane that divides it from p
    } stack[64];
    int top = 0;
    stack[top].r = (struct range){0, s->m->count};
    stack[top++].gap2 = 0;
    while (top) {
        struct range r = stack[--top].r;
        if (stack[top].gap2 > s->limit2)
            continue;
        while (r.begin < r.end && !is_beyond(s, r)) {
            const uint32_t middle = r.begin + (r.end - r.begin) / 2;
            const struct photon *p = &s->m->photon[middle];
            const double d = measured(s, p->p);
            if (d <= s->limit2)
                take(s, middle, d);
            const int axis = s->m->axis[middle];
            const double gap = s->p[axis] - (double)p->p[axis];
            const struct range low = {r.begin, middle}, high = {middle + 1, r.end};
            const struct range far = gap < 0 ? high : low;
            if (far.begin < far.end && gap * gap <= s->limit2) {
                stack[top].r = far;
                stack[top++].gap2 = gap * gap;
            }
            r = gap < 0 ? low : high;
        }
    }
}

uint32_t photons_near(const struct photon_map *m, struct vec3 p, struct vec3 normal,
                      double radius, uint32_t most, struct photon_near *near,
                      double *reach)
{
    struct search s = {.m = m,
                       .p = {p.x, p.y, p.z},
                       .n = {normal.x, normal.y, normal.z},
                       .limit2 = radius * radius,
                       .most = most,
                       .near = near};
    *reach = radius;
    if (!most)
        return 0;
    search_tree(&s);
    if (s.count == most)
        *reach = sqrt(s.limit2);
    return s.count;
}

uint32_t photons_gather(const struct photon_map *m, const struct photon_gather *g,
                        struct vec3 p, struct vec3 normal, struct photon_near *near,
                        double *reach)
{
    enum { FEW = 64 };
    struct photon_near kept[FEW];
    const uint32_t count = photons_near(m, p, normal, m->radius, g->max, near, reach);
    if (count >= g->min)
        return count;
    const double before = *reach;
    if (count <= FEW && count)
        memcpy(kept, near, count * sizeof *near);
    const uint32_t more =
        photons_near(m, p, normal, m->radius + m->step, g->max, near, reach);
    const double density = count / (before * before);
    const bool even = more / (*reach * *reach) <= (1 + g->expand_increase) * density;
    if (more && (even || more < g->expand_min))
        return more;
    if (count > FEW)
        return photons_near(m, p, normal, m->radius, g->max, near, reach);
    if (count)
        memcpy(near, kept, count * sizeof *near);
    *reach = before;
    return count;
}

// ---- the radius ----------------------------------------------------------------------

static double density_of(uint32_t count, double r, bool in_space)
{
    return count / (in_space ? 4.0 / 3 * pi * r * r * r : pi * r * r);
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
    struct photon_near *near = malloc((max ? max : 1) * sizeof *near);
    double sum = 0;
    uint32_t samples = 0, few = 0;
    if (!near)
        abort();
    for (uint32_t i = 0; i < m->count; i += stride) {
        double r;
        const uint32_t n =
            photons_near(m, place_of(&m->photon[i]), any, 1e7, max, near, &r);
        if (n == max && r > 0) {
            sum += density_of(n, r, in_space);
            samples++;
        }
    }
    const double mean = samples ? sum / samples : 1;
    m->radius = in_space ? det_pow(max / (4.0 / 3 * pi * mean), 1.0 / 3)
                         : sqrt(max / (pi * mean));
    samples = 0;
    for (uint32_t i = 0; i < m->count; i += stride) {
        double r;
        const uint32_t n =
            photons_near(m, place_of(&m->photon[i]), any, m->radius, max, near, &r);
        const double density = density_of(n, r, in_space);
        few += density > sparse * mean && density < thin * mean;
        samples++;
    }
    if (samples)
        m->radius *= 1 + growth * few / samples;
    free(near);
}
