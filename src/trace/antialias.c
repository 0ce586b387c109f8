#include "trace/antialias.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

void jitter_tables_init(struct jitter_tables *t)
{
    enum { N = 4096 };
    for (int i = 0; i < N; i++)
        t->shuffle[i] = (uint16_t)i;
    uint32_t s = 0;
    for (int i = N - 1; i >= 0; i--) {
        s = s * 1812433253u + 12345u;
        const int j = (int)((s >> 16) & 32767) % N;
        const uint16_t swap = t->shuffle[i];
        t->shuffle[i] = t->shuffle[j];
        t->shuffle[j] = swap;
    }
    memcpy(t->shuffle + N, t->shuffle, N * sizeof *t->shuffle);
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t crc = i; // the byte table of CRC-16, reflected polynomial A001h
        for (int k = 0; k < 8; k++)
            crc = crc & 1 ? (crc >> 1) ^ 0xa001u : crc >> 1;
        const double v = (double)((2 * crc) % 65536) / 65536 - 0.5;
        t->offset[i] = floor(v * 1e6 + 0.5) / 1e6;
    }
}

static double jitter_axis(const struct jitter_tables *t, double a, double b)
{
    const int64_t x = (int64_t)a, y = (int64_t)b; // towards zero
    const uint32_t inner = t->shuffle[x & 4095];
    return t->offset[t->shuffle[(inner ^ (uint32_t)y) & 4095] & 255];
}

struct vec2 jitter_at(const struct jitter_tables *t, double x, double y)
{
    return (struct vec2){jitter_axis(t, 1021 * x, 1019 * y),
                         jitter_axis(t, 1019 * x, 1021 * y)};
}

// A colour as differences are judged.
struct judged {
    float c[4];
};

static void judge(const struct antialias *a, const float (*color)[4], uint32_t count,
                  struct judged *out)
{
    a->judge(a->working, a->settings->aa_gamma, color, count, (float(*)[4])out);
}

static bool differ(const struct antialias *a, const struct judged *p,
                   const struct judged *q)
{
    float sum = 0;
    for (int k = 0; k < 4; k++)
        sum += fabsf(p->c[k] - q->c[k]);
    return (double)sum >= a->settings->aa_threshold;
}

static void sample_batch(const struct antialias *a, const struct vec2 *position,
                         uint32_t count, float (*out)[4])
{
    a->sample(a->user, position, count, out);
}

static void *need(size_t count, size_t size)
{
    void *p = calloc(count, size);
    if (!p)
        abort();
    return p;
}

// ---- method 1 ------------------------------------------------------------
// Whether a pixel is super-sampled depends on neighbours that may just have been.
// The scan is therefore repeated: values it lacks are traced together and it starts
// again. The first value lacking is always truly needed, so it ends, with the result
// of the scan that traces each value when it meets it.
struct scan {
    const struct antialias *a;
    int x0, y0, width, height; // of the block
    int stride;                // with the column on the left and the row above
    float (*centre)[4];
    float (*fine)[4];
    struct judged *centre_judged, *fine_judged;
    uint8_t *edges; // between centres: BY_LEFT, BY_TOP
    bool *known;    // fine is there
    bool *wanted;
    uint8_t *final; // of the current scan: stored is not the centre
};

static int scan_index(const struct scan *s, int x, int y)
{
    return (y + 1) * s->stride + x + 1;
}

static void scan_centres(struct scan *s)
{
    const int cells = s->stride * (s->height + 1);
    struct vec2 *position = need((size_t)cells, sizeof *position);
    float(*value)[4] = need((size_t)cells, sizeof *value);
    int *cell = need((size_t)cells, sizeof *cell);
    uint32_t n = 0;
    // Two rows at once: packets are near squares.
    for (int y = 0; y <= s->height; y += 2) {
        for (int x = 0; x < s->stride; x++) {
            for (int k = y; k <= y + 1 && k <= s->height; k++) {
                cell[n] = k * s->stride + x;
                position[n] = (struct vec2){s->x0 + x - 0.5, s->y0 + k - 0.5};
                n += cell[n] > 0; // the corner is no neighbour
            }
        }
    }
    sample_batch(s->a, position, n, value);
    for (uint32_t i = 0; i < n; i++)
        memcpy(s->centre[cell[i]], value[i], sizeof value[i]);
    judge(s->a, (const float(*)[4])s->centre, (uint32_t)cells, s->centre_judged);
    free(position);
    free(cell);
    free(value);
}

enum { FINAL = 1, FINE = 2 };
enum { BY_LEFT = 1, BY_TOP = 2 };

// Where the centres of neighbours differ.
static void scan_edges(struct scan *s)
{
    for (int y = 0; y < s->height; y++) {
        for (int x = 0; x < s->width; x++) {
            const int i = scan_index(s, x, y);
            const struct judged *j = s->centre_judged + i;
            s->edges[i] = (uint8_t)((differ(s->a, j - 1, j) ? BY_LEFT : 0) |
                                    (differ(s->a, j - s->stride, j) ? BY_TOP : 0));
        }
    }
}

// Whether what is stored of a neighbour differs from a centre.
static bool edge(const struct scan *s, int neighbour, int i, int bit)
{
    return s->final[neighbour] & FINE
               ? differ(s->a, &s->fine_judged[neighbour], &s->centre_judged[i])
               : s->edges[i] & bit;
}

static void refine(struct scan *s, int i)
{
    s->final[i] |= FINAL;
    if (s->known[i])
        s->final[i] |= FINE;
    else
        s->wanted[i] = true;
}

// One pass over the block; returns whether values were lacking.
static bool scan_pass(struct scan *s)
{
    memset(s->final, 0, (size_t)(s->stride * (s->height + 1)));
    for (int x = 0; x < s->width; x++)
        s->final[scan_index(s, x, -1)] = FINAL;
    for (int y = 0; y < s->height; y++)
        s->final[scan_index(s, -1, y)] = FINAL;
    for (int y = 0; y < s->height; y++) {
        for (int x = 0; x < s->width; x++) {
            const int i = scan_index(s, x, y), left = i - 1, top = i - s->stride;
            const bool by_left = edge(s, left, i, BY_LEFT);
            const bool by_top = edge(s, top, i, BY_TOP);
            if (by_left && !(s->final[left] & FINAL))
                refine(s, left);
            if (by_top && !(s->final[top] & FINAL))
                refine(s, top);
            if (by_left || by_top)
                refine(s, i);
        }
    }
    bool lacking = false;
    for (int i = 0; i < s->stride * (s->height + 1); i++)
        lacking |= s->wanted[i];
    return lacking;
}

static void fine_positions(const struct scan *s, int i, struct vec2 *out)
{
    const struct render_settings *set = s->a->settings;
    const int n = set->aa_depth, px = s->x0 + i % s->stride - 1,
              py = s->y0 + i / s->stride - 1;
    const double reach = set->aa_jitter ? set->aa_jitter_amount / n : 0;
    for (int k = 0; k < n * n; k++) {
        const double x = px - 0.5 + (k % n + 0.5) / n, y = py - 0.5 + (k / n + 0.5) / n;
        struct vec2 j = {0, 0};
        if (reach > 0)
            j = jitter_at(s->a->jitter, x, y);
        out[k] = (struct vec2){x + reach * j.u + 0.5, y + reach * j.v + 0.5};
    }
}

// The mean of the centre and the samples of a pixel.
static void fine_mean(const float centre[4], float (*value)[4], int count, float mean[4])
{
    for (int k = 0; k < 4; k++) {
        float sum = centre[k];
        for (int v = 0; v < count; v++)
            sum += value[v][k];
        mean[k] = sum / (float)(count + 1);
    }
}

static void fine_store(struct scan *s, int i, const float mean[4], struct judged judged)
{
    memcpy(s->fine[i], mean, sizeof s->fine[i]);
    s->fine_judged[i] = judged;
    s->known[i] = true;
    s->wanted[i] = false;
}

static void scan_refine(struct scan *s)
{
    const int cells = s->stride * (s->height + 1);
    const int per = s->a->settings->aa_depth * s->a->settings->aa_depth;
    size_t count = 0, at = 0;
    for (int i = 0; i < cells; i++)
        count += s->wanted[i];
    struct vec2 *position = need(count * (size_t)per, sizeof *position);
    float(*value)[4] = need(count * (size_t)per, sizeof *value);
    for (int i = 0; i < cells; i++)
        if (s->wanted[i])
            fine_positions(s, i, position + (size_t)per * at++);
    sample_batch(s->a, position, (uint32_t)(count * (size_t)per), value);
    struct judged *judged = need(count, sizeof *judged);
    at = 0;
    for (int i = 0; i < cells; i++) {
        if (s->wanted[i]) {
            float mean[4];
            fine_mean(s->centre[i], value + (size_t)per * at, per, mean);
            memcpy(value[at++], mean, sizeof mean);
        }
    }
    judge(s->a, (const float(*)[4])value, (uint32_t)count, judged);
    at = 0;
    for (int i = 0; i < cells; i++) {
        if (s->wanted[i]) {
            fine_store(s, i, value[at], judged[at]);
            at++;
        }
    }
    free(judged);
    free(position);
    free(value);
}

static void method_1(const struct antialias *a, int x0, int y0, int x1, int y1,
                     float (*out)[4])
{
    struct scan s = {.a = a,
                     .x0 = x0,
                     .y0 = y0,
                     .width = x1 - x0,
                     .height = y1 - y0,
                     .stride = x1 - x0 + 1};
    const size_t cells = (size_t)(s.stride * (s.height + 1));
    s.centre = need(cells, sizeof *s.centre);
    s.fine = need(cells, sizeof *s.fine);
    s.centre_judged = need(cells, sizeof *s.centre_judged);
    s.fine_judged = need(cells, sizeof *s.fine_judged);
    s.known = need(cells, sizeof *s.known);
    s.wanted = need(cells, sizeof *s.wanted);
    s.final = need(cells, sizeof *s.final);
    s.edges = need(cells, sizeof *s.edges);
    scan_centres(&s);
    scan_edges(&s);
    while (scan_pass(&s))
        scan_refine(&s);
    for (int y = 0; y < s.height; y++) {
        for (int x = 0; x < s.width; x++) {
            const int i = scan_index(&s, x, y);
            memcpy(out[y * s.width + x], s.final[i] & FINE ? s.fine[i] : s.centre[i],
                   sizeof s.fine[i]);
        }
    }
    free(s.centre);
    free(s.fine);
    free(s.centre_judged);
    free(s.fine_judged);
    free(s.known);
    free(s.wanted);
    free(s.final);
    free(s.edges);
}

// ---- method 2 ------------------------------------------------------------
// All pixels that are not done ask for the samples they lack; these are traced together,
// and the pixels are looked at again.
enum point_state { POINT_UNKNOWN, POINT_ASKED, POINT_KNOWN };

struct point {
    float color[4];
    struct judged judged;
    enum point_state state;
};

struct quarters {
    const struct antialias *a;
    int side;   // units per pixel side; the grid has side + 1 points a row
    int points; // of the grid
    int px, py; // of the pixel at hand, and its grid:
    struct point *point;
    // What is asked for in this round.
    struct vec2 *position;
    uint32_t *at; // index into values of all pixels
    uint32_t count, capacity, base;
};

static int grid_index(const struct quarters *q, int i, int j)
{
    return j * (q->side + 1) + i;
}

static struct vec2 grid_position(const struct antialias *a, double x, double y)
{
    const struct render_settings *set = a->settings;
    struct vec2 j = {0, 0};
    const double reach =
        set->aa_jitter ? set->aa_jitter_amount / ((1 << set->aa_depth) + 1) : 0;
    if (reach > 0)
        j = jitter_at(a->jitter, x, y);
    return (struct vec2){x + reach * j.u + 0.5, y + reach * j.v + 0.5};
}

// Whether all five are known; asks for those that are not.
static bool grid_ask(struct quarters *q, const int at[5][2])
{
    bool known = true;
    for (int k = 0; k < 5; k++) {
        const int i = grid_index(q, at[k][0], at[k][1]);
        known &= q->point[i].state == POINT_KNOWN;
        if (q->point[i].state != POINT_UNKNOWN)
            continue;
        q->point[i].state = POINT_ASKED;
        if (q->count == q->capacity) {
            q->capacity = q->capacity ? 2 * q->capacity : 1024;
            q->position = must_realloc(q->position, q->capacity, sizeof *q->position);
            q->at = must_realloc(q->at, q->capacity, sizeof *q->at);
        }
        q->at[q->count] = q->base + (uint32_t)i;
        q->position[q->count++] =
            grid_position(q->a, q->px - 0.5 + (double)at[k][0] / q->side,
                          q->py - 0.5 + (double)at[k][1] / q->side);
    }
    return known;
}

// The mean over a square of the grid; false: samples are lacking.
static bool square(struct quarters *q, int x, int y, int size, float out[4])
{
    const int corner[4] = {grid_index(q, x, y), grid_index(q, x, y + size),
                           grid_index(q, x + size, y), grid_index(q, x + size, y + size)};
    bool split = false;
    if (size > 1) {
        for (int k = 0; k < 4 && !split; k++)
            for (int l = k + 1; l < 4; l++)
                split |= differ(q->a, &q->point[corner[k]].judged,
                                &q->point[corner[l]].judged);
    }
    float part[4][4];
    if (split) {
        const int h = size / 2;
        if (!grid_ask(q, (const int[5][2]){{x, y + h},
                                           {x + h, y},
                                           {x + size, y + h},
                                           {x + h, y + size},
                                           {x + h, y + h}}))
            return false;
        bool whole = square(q, x, y, h, part[0]);
        whole &= square(q, x, y + h, h, part[1]);
        whole &= square(q, x + h, y, h, part[2]);
        whole &= square(q, x + h, y + h, h, part[3]);
        if (!whole)
            return false;
    } else {
        for (int k = 0; k < 4; k++)
            memcpy(part[k], q->point[corner[k]].color, sizeof part[k]);
    }
    for (int k = 0; k < 4; k++)
        out[k] = (part[0][k] + part[1][k] + part[2][k] + part[3][k]) / 4;
    return true;
}

struct corners {
    int x0, y0, width, stride; // of the block
    struct point *point;
};

static void grid_begin(struct quarters *q, const struct corners *c, int pixel)
{
    const int x = pixel % c->width, y = pixel / c->width;
    for (int k = 0; k < 4; k++) {
        const int i = grid_index(q, k & 1 ? q->side : 0, k & 2 ? q->side : 0);
        q->point[i] = c->point[(y + (k >> 1)) * c->stride + x + (k & 1)];
    }
}

// Traces `count` samples into the points whose numbers are at[].
static void points_trace(const struct antialias *a, const struct vec2 *position,
                         const uint32_t *at, uint32_t count, struct point *point)
{
    float(*color)[4] = need(count, sizeof *color);
    struct judged *judged = need(count, sizeof *judged);
    sample_batch(a, position, count, color);
    judge(a, (const float(*)[4])color, count, judged);
    for (uint32_t k = 0; k < count; k++) {
        struct point *p = &point[at ? at[k] : k];
        memcpy(p->color, color[k], sizeof color[k]);
        p->judged = judged[k];
        p->state = POINT_KNOWN;
    }
    free(color);
    free(judged);
}

// Pixels first to first + n - 1 of the block, with room for their grids.
static void quarters_run(struct quarters *q, const struct corners *c, int first, int n,
                         struct point *point, float (*out)[4])
{
    bool *done = need((size_t)n, sizeof *done);
    for (int i = 0; i < n * q->points; i++)
        point[i].state = POINT_UNKNOWN;
    for (bool begin = true; begin || q->count; begin = false) {
        q->count = 0;
        for (int i = 0; i < n; i++) {
            if (done[i])
                continue;
            q->base = (uint32_t)(i * q->points);
            q->point = point + q->base;
            q->px = c->x0 + (first + i) % c->width;
            q->py = c->y0 + (first + i) / c->width;
            if (begin)
                grid_begin(q, c, first + i);
            done[i] = square(q, 0, 0, q->side, out[first + i]);
        }
        if (q->count)
            points_trace(q->a, q->position, q->at, q->count, point);
    }
    free(done);
}

static void method_2(const struct antialias *a, int x0, int y0, int x1, int y1,
                     float (*out)[4])
{
    enum { POINTS_MAX = 1 << 18 }; // of the grids at hand, if one pixel has not more
    const int width = x1 - x0, height = y1 - y0, stride = width + 1;
    const size_t corners = (size_t)(stride * (height + 1));
    struct vec2 *position = need(corners, sizeof *position);
    struct corners c = {x0, y0, width, stride, need(corners, sizeof *c.point)};
    for (int i = 0; i < (int)corners; i++)
        position[i] = (struct vec2){x0 + i % stride, y0 + i / stride};
    points_trace(a, position, NULL, (uint32_t)corners, c.point);
    struct quarters q = {.a = a, .side = 1 << (a->settings->aa_depth - 1)};
    q.points = (q.side + 1) * (q.side + 1);
    int group = POINTS_MAX / q.points;
    group = group < 1 ? 1 : group > width * height ? width * height : group;
    const size_t points = (size_t)group * (size_t)q.points;
    struct point *point = need(points, sizeof *point);
    for (int i = 0; i < width * height; i += group) {
        const int left = width * height - i;
        quarters_run(&q, &c, i, left < group ? left : group, point, out);
    }
    free(position);
    free(c.point);
    free(point);
    free(q.position);
    free(q.at);
}

void antialias_block(const struct antialias *a, int x0, int y0, int x1, int y1,
                     float (*out)[4])
{
    if (a->settings->antialias == 2)
        method_2(a, x0, y0, x1, y1, out);
    else
        method_1(a, x0, y0, x1, y1, out);
}
