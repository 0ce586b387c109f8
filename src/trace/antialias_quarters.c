// Method 2: squares are quartered while their corners differ.
#include "trace/antialias_methods.h"

#include <stdlib.h>
#include <string.h>

// All pixels that are not done ask for the samples they lack; these are traced together,
// and the pixels are looked at again.
enum point_state { POINT_UNKNOWN, POINT_ASKED, POINT_KNOWN };

struct point {
    float color[4], judged[4];
    enum point_state state;
};

static bool points_differ(const struct antialias *a, const struct point *p,
                          const struct point *q)
{
    float sum = 0;
    for (int k = 0; k < 4; k++)
        sum += fabsf(p->judged[k] - q->judged[k]);
    return (double)sum >= a->settings->aa_threshold;
}

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
                split |= points_differ(q->a, &q->point[corner[k]], &q->point[corner[l]]);
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
    int groups;                // of eight pixels a row
    struct point *point;
    uint8_t *even; // bits of a group: pixels no two of whose corners differ
};

// Most pixels: what square() would say of them.
static void corners_mean(const struct corners *c, int pixel, float out[4])
{
    const int x = pixel % c->width, y = pixel / c->width;
    const struct point *above = &c->point[y * c->stride + x], *below = above + c->stride;
    for (int k = 0; k < 4; k++)
        out[k] = (above[0].color[k] + below[0].color[k] + above[1].color[k] +
                  below[1].color[k]) /
                 4;
}

static void corners_compare(const struct antialias *a, const struct judged *j,
                            const struct corners *c, int height)
{
    for (int y = 0; y < height; y++) {
        for (int g = 0; g < c->groups; g++) {
            const int i = y * c->stride + 8 * g, below = i + c->stride;
            const unsigned split =
                differ8(a, j, i, i + 1) | differ8(a, j, below, below + 1) |
                differ8(a, j, i, below) | differ8(a, j, i + 1, below + 1) |
                differ8(a, j, i, below + 1) | differ8(a, j, i + 1, below);
            c->even[y * c->groups + g] = (uint8_t)~split;
        }
    }
}

static bool is_even(const struct corners *c, int pixel)
{
    const int x = pixel % c->width, y = pixel / c->width;
    return c->even[y * c->groups + x / 8] >> (x & 7) & 1;
}

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
                         const uint32_t *at, uint32_t count, struct point *point,
                         const struct judged *judged)
{
    float(*color)[4] = must_calloc(count, sizeof *color);
    sample_batch(a, position, count, color);
    judge(a, (const float(*)[4])color, count, judged);
    for (uint32_t i = 0; i < count; i++) {
        struct point *p = &point[at ? at[i] : i];
        memcpy(p->color, color[i], sizeof color[i]);
        for (int k = 0; k < 4; k++)
            p->judged[k] = judged->c[k][i];
        p->state = POINT_KNOWN;
    }
    free(color);
}

// Pixels first to first + n - 1 of the block, with room for their grids.
static void quarters_run(struct quarters *q, const struct corners *c, int first, int n,
                         struct point *point, float (*out)[4])
{
    bool *done = must_calloc((size_t)n, sizeof *done);
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
            if (begin && is_even(c, first + i)) {
                corners_mean(c, first + i, out[first + i]);
                done[i] = true;
                continue;
            }
            if (begin)
                grid_begin(q, c, first + i);
            done[i] = square(q, 0, 0, q->side, out[first + i]);
        }
        if (q->count) {
            struct judged judged;
            judged_begin(&judged, q->count);
            points_trace(q->a, q->position, q->at, q->count, point, &judged);
            free(judged.c[0]);
        }
    }
    free(done);
}

void antialias_method_2(const struct antialias *a, int x0, int y0, int x1, int y1,
                        float (*out)[4])
{
    enum { POINTS_MAX = 1 << 18 }; // of the grids at hand, if one pixel has not more
    const int width = x1 - x0, height = y1 - y0, stride = width + 1;
    const size_t corners = (size_t)(stride * (height + 1));
    struct vec2 *position = must_calloc(corners, sizeof *position);
    struct corners c = {.x0 = x0,
                        .y0 = y0,
                        .width = width,
                        .stride = stride,
                        .groups = (width + 7) / 8,
                        .point = must_calloc(corners, sizeof *c.point)};
    struct judged judged;
    judged_begin(&judged, corners);
    c.even = must_calloc((size_t)(c.groups * height), sizeof *c.even);
    for (int i = 0; i < (int)corners; i++)
        position[i] = (struct vec2){x0 + i % stride, y0 + i / stride};
    points_trace(a, position, NULL, (uint32_t)corners, c.point, &judged);
    corners_compare(a, &judged, &c, height);
    free(judged.c[0]);
    struct quarters q = {.a = a, .side = 1 << (a->settings->aa_depth - 1)};
    q.points = (q.side + 1) * (q.side + 1);
    int group = POINTS_MAX / q.points;
    group = group < 1 ? 1 : group > width * height ? width * height : group;
    const size_t points = (size_t)group * (size_t)q.points;
    struct point *point = must_calloc(points, sizeof *point);
    for (int i = 0; i < width * height; i += group) {
        const int left = width * height - i;
        quarters_run(&q, &c, i, left < group ? left : group, point, out);
    }
    free(position);
    free(c.point);
    free(c.even);
    free(point);
    free(q.position);
    free(q.at);
}
