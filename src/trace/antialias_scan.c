// Method 1: pixels that differ from their neighbours are super-sampled.
#include "trace/antialias_methods.h"

#include <stdlib.h>
#include <string.h>

// Whether a pixel is super-sampled depends on neighbours that may just have been.
// The scan is therefore repeated: values it lacks are traced together and it starts
// again. The first value lacking is always truly needed, so it ends, with the result
// of the scan that traces each value when it meets it.
struct scan {
    const struct antialias *a;
    int x0, y0, width, height; // of the block
    int stride;                // with the column on the left and the row above
    int groups;                // of eight pixels a row
    float (*centre)[4];
    float (*fine)[4];
    struct judged centre_judged, fine_judged;
    uint8_t *by_left, *by_top; // bits of a group: whose centres differ from those there
    uint8_t *known;            // fine is there, or wanted
    int *wanted;
    int wanted_count;
    uint8_t *final; // of the current scan: stored is not the centre; room for eight more
    // What is traced at once.
    struct vec2 *position;
    float (*value)[4];
    size_t capacity;
};

static int scan_index(const struct scan *s, int x, int y)
{
    return (y + 1) * s->stride + x + 1;
}

static void scan_room(struct scan *s, size_t count)
{
    if (count <= s->capacity)
        return;
    s->capacity = count;
    s->position = must_realloc(s->position, count, sizeof *s->position);
    s->value = must_realloc(s->value, count, sizeof *s->value);
}

// The block on one side, whose centres along the seam are asked for.
struct scan_side {
    bool there, known;
};

// The one that is `back` blocks before this one.
static struct scan_side side_of(const struct scan *s, bool there, uint32_t back)
{
    const struct antialias_seams *seams = s->a->seams;
    return (struct scan_side){
        there, there && atomic_load_explicit(&seams->known[s->a->block - back],
                                             memory_order_acquire)};
}

// Takes the centres on the left and above that other blocks know.
static void seams_take(const struct scan *s, struct scan_side *left,
                       struct scan_side *top)
{
    const struct antialias_seams *seams = s->a->seams;
    const uint32_t block = s->a->block;
    *left = *top = (struct scan_side){false, false};
    if (!seams)
        return;
    *left = side_of(s, block % seams->across > 0, 1);
    *top = side_of(s, block >= seams->across, seams->across);
    for (int y = 0; left->known && y < s->height; y++)
        memcpy(s->centre[scan_index(s, -1, y)],
               seams->column[(block - 1) * seams->size + (uint32_t)y], sizeof *s->centre);
    if (top->known)
        memcpy(s->centre[scan_index(s, 0, -1)],
               seams->row[(block - seams->across) * seams->size],
               (size_t)s->width * sizeof *s->centre);
}

static void seams_give(const struct scan *s)
{
    const struct antialias_seams *seams = s->a->seams;
    if (!seams)
        return;
    const uint32_t first = s->a->block * seams->size;
    for (int y = 0; y < s->height; y++)
        memcpy(seams->column[first + (uint32_t)y],
               s->centre[scan_index(s, s->width - 1, y)], sizeof *s->centre);
    memcpy(seams->row[first], s->centre[scan_index(s, 0, s->height - 1)],
           (size_t)s->width * sizeof *s->centre);
}

// Traces centres of cells in the rectangle [x0, x1) x [y0, y1) of the block and its border.
static void centres_trace(struct scan *s, sample_function *sample, int x0, int y0, int x1,
                          int y1)
{
    int *cell = s->wanted; // nothing is yet
    uint32_t n = 0;
    // Two rows at once: packets are near squares.
    for (int y = y0; y < y1; y += 2) {
        for (int x = x0; x < x1; x++) {
            for (int k = y; k <= y + 1 && k < y1; k++) {
                cell[n] = k * s->stride + x;
                s->position[n] = (struct vec2){s->x0 + x - 0.5, s->y0 + k - 0.5};
                n += cell[n] > 0; // the corner is no neighbour
            }
        }
    }
    sample(s->a->user, s->position, n, s->value);
    for (uint32_t i = 0; i < n; i++)
        memcpy(s->centre[cell[i]], s->value[i], sizeof s->value[i]);
}

// What belongs to other blocks is traced apart and not counted, so that the counts do not
// depend on which block comes first.
static void scan_centres(struct scan *s)
{
    const struct antialias *a = s->a;
    const int cells = s->stride * (s->height + 1);
    struct scan_side left, top;
    scan_room(s, (size_t)cells);
    seams_take(s, &left, &top);
    centres_trace(s, a->sample, left.there, top.there, s->stride, s->height + 1);
    if (left.there && !left.known)
        centres_trace(s, a->borrow, 0, 1, 1, s->height + 1);
    if (top.there && !top.known)
        centres_trace(s, a->borrow, 1, 0, s->stride, 1);
    seams_give(s);
    judge(s->a, (const float(*)[4])s->centre, (uint32_t)cells, &s->centre_judged);
}

enum { FINAL = 1, FINE = 2 };

// Where the centres of neighbours differ.
static void scan_edges(struct scan *s)
{
    for (int y = 0; y < s->height; y++) {
        for (int g = 0; g < s->groups; g++) {
            const int i = scan_index(s, 8 * g, y), k = y * s->groups + g;
            const unsigned in =
                s->width - 8 * g < 8 ? (1u << (s->width - 8 * g)) - 1 : 255;
            s->by_left[k] = (uint8_t)(in & differ8(s->a, &s->centre_judged, i - 1, i));
            s->by_top[k] =
                (uint8_t)(in & differ8(s->a, &s->centre_judged, i - s->stride, i));
        }
    }
}

// Whether the fine value of a neighbour differs from a centre.
static bool fine_differs(const struct scan *s, int neighbour, int i)
{
    float sum = 0;
    for (int k = 0; k < 4; k++)
        sum += fabsf(s->fine_judged.c[k][neighbour] - s->centre_judged.c[k][i]);
    return (double)sum >= s->a->settings->aa_threshold;
}

enum { UNKNOWN, WANTED, KNOWN };

static void refine(struct scan *s, int i)
{
    s->final[i] |= FINAL;
    if (s->known[i] == KNOWN) {
        s->final[i] |= FINE;
    } else if (s->known[i] == UNKNOWN) {
        s->known[i] = WANTED;
        s->wanted[s->wanted_count++] = i;
    }
}

static void scan_pixel(struct scan *s, int i, bool by_left, bool by_top)
{
    const int left = i - 1, top = i - s->stride;
    if (s->final[left] & FINE)
        by_left = fine_differs(s, left, i);
    if (s->final[top] & FINE)
        by_top = fine_differs(s, top, i);
    if (by_left && !(s->final[left] & FINAL))
        refine(s, left);
    if (by_top && !(s->final[top] & FINAL))
        refine(s, top);
    if (by_left || by_top)
        refine(s, i);
}

// Whether one of eight pixels is fine.
static bool any_fine(const uint8_t final[8])
{
    uint64_t all;
    memcpy(&all, final, sizeof all);
    return all & FINE * 0x0101010101010101u;
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
        for (int g = 0; g < s->groups; g++) {
            const int i = scan_index(s, 8 * g, y), k = y * s->groups + g;
            const unsigned by_left = s->by_left[k], by_top = s->by_top[k];
            if (!(by_left | by_top) && !(s->final[i - 1] & FINE) &&
                !any_fine(s->final + i - s->stride))
                continue; // what is stored is the centre everywhere
            for (int x = 0; x < 8 && 8 * g + x < s->width; x++)
                scan_pixel(s, i + x, by_left >> x & 1, by_top >> x & 1);
        }
    }
    return s->wanted_count;
}

static void fine_positions(const struct scan *s, int i, const double *offset,
                           struct vec2 *out)
{
    const struct render_settings *set = s->a->settings;
    const int n = set->aa_depth;
    const double px = s->x0 + i % s->stride - 1 - 0.5,
                 py = s->y0 + i / s->stride - 1 - 0.5;
    const double reach = set->aa_jitter ? set->aa_jitter_amount / n : 0;
    for (int v = 0; v < n; v++) {
        for (int u = 0; u < n; u++) {
            const double x = px + offset[u], y = py + offset[v];
            struct vec2 j = {0, 0};
            if (reach > 0)
                j = jitter_at(s->a->jitter, x, y);
            *out++ = (struct vec2){x + reach * j.u + 0.5, y + reach * j.v + 0.5};
        }
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

// Traces what is wanted.
static void scan_refine(struct scan *s)
{
    const int depth = s->a->settings->aa_depth, per = depth * depth;
    const size_t count = (size_t)s->wanted_count;
    double *offset = must_calloc((size_t)depth, sizeof *offset);
    struct judged judged;
    judged_begin(&judged, count);
    scan_room(s, count * (size_t)per);
    for (int u = 0; u < depth; u++)
        offset[u] = (u + 0.5) / depth;
    for (size_t n = 0; n < count; n++)
        fine_positions(s, s->wanted[n], offset, s->position + (size_t)per * n);
    sample_batch(s->a, s->position, (uint32_t)(count * (size_t)per), s->value);
    for (size_t n = 0; n < count; n++) {
        float mean[4];
        fine_mean(s->centre[s->wanted[n]], s->value + (size_t)per * n, per, mean);
        memcpy(s->value[n], mean, sizeof mean);
    }
    judge(s->a, (const float(*)[4])s->value, (uint32_t)count, &judged);
    for (size_t n = 0; n < count; n++) {
        const int i = s->wanted[n];
        memcpy(s->fine[i], s->value[n], sizeof s->fine[i]);
        for (int k = 0; k < 4; k++)
            s->fine_judged.c[k][i] = judged.c[k][n];
        s->known[i] = KNOWN;
    }
    s->wanted_count = 0;
    free(judged.c[0]);
    free(offset);
}

void antialias_method_1(const struct antialias *a, int x0, int y0, int x1, int y1,
                        float (*out)[4])
{
    struct scan s = {.a = a,
                     .x0 = x0,
                     .y0 = y0,
                     .width = x1 - x0,
                     .height = y1 - y0,
                     .stride = x1 - x0 + 1,
                     .groups = (x1 - x0 + 7) / 8};
    const size_t cells = (size_t)(s.stride * (s.height + 1));
    s.centre = must_calloc(cells, sizeof *s.centre);
    s.fine = must_calloc(cells, sizeof *s.fine);
    judged_begin(&s.centre_judged, cells);
    judged_begin(&s.fine_judged, cells);
    s.known = must_calloc(cells, sizeof *s.known);
    s.wanted = must_calloc(cells + 1, sizeof *s.wanted);
    s.final = must_calloc(cells + 8, sizeof *s.final);
    s.by_left = must_calloc((size_t)(s.groups * s.height), sizeof *s.by_left);
    s.by_top = must_calloc((size_t)(s.groups * s.height), sizeof *s.by_top);
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
    free(s.centre_judged.c[0]);
    free(s.fine_judged.c[0]);
    free(s.known);
    free(s.wanted);
    free(s.final);
    free(s.by_left);
    free(s.by_top);
    free(s.position);
    free(s.value);
}
