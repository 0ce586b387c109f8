// The passes that take samples before the picture (spec/lighting.md 12.6).
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "irradiance/fill.h"
#include "irradiance/store_kernel.h"
#include "scene/noise_tables.h"

enum { SQUARE = 32 }; // side of the squares that know nothing of each other in a pass

struct square {
    struct store fresh; // what a pass has found
    uint64_t rays;      // of its last pass
    bool settled;       // it gets no more passes but the last
};

struct scouts;

struct pass {
    struct irradiance_cache *cache;
    struct scouts *scouts;
    const struct render_settings *settings;
    uint32_t number;
    double size;     // distance of its points, in pixels
    bool final;      // by the picture's rules, at the middle of every pixel
    double from, to; // what part of the whole it is
    struct square *square;
    uint32_t *order; // of the squares
    uint32_t *turn;  // the same, those of a round that take longest first
    uint32_t done;   // of that order
};

static uint32_t squares_across(const struct render_settings *s)
{
    return (uint32_t)(s->col_end - s->col_begin + SQUARE - 1) / SQUARE;
}

static uint32_t squares_down(const struct render_settings *s)
{
    return (uint32_t)(s->row_end - s->row_begin + SQUARE - 1) / SQUARE;
}

struct scout {
    struct tracer *tracer;
    struct gatherer *gatherer;
    struct scout *next;
};

// Those that wait for a thread: a round of a pass may be shorter than the making of one.
struct scouts {
    pthread_mutex_t lock;
    struct scout *idle;
};

static struct scout *scout_new(const struct irradiance_cache *c)
{
    struct scout *s = must_calloc(1, sizeof *s);
    s->gatherer = gatherer_new(c);
    s->tracer = tracer_new(&c->scout);
    s->tracer->indirect = &s->gatherer->level[0];
    return s;
}

static void *begin(void *user)
{
    const struct pass *p = user;
    pthread_mutex_lock(&p->scouts->lock);
    struct scout *s = p->scouts->idle;
    if (s)
        p->scouts->idle = s->next;
    pthread_mutex_unlock(&p->scouts->lock);
    if (!s)
        s = scout_new(p->cache);
    s->gatherer->final = p->final;
    return s;
}

static void end(void *user, void *state)
{
    const struct pass *p = user;
    struct scout *s = state;
    pthread_mutex_lock(&p->scouts->lock);
    s->next = p->scouts->idle;
    p->scouts->idle = s;
    pthread_mutex_unlock(&p->scouts->lock);
}

static void scouts_free(struct scouts *all)
{
    for (struct scout *s = all->idle, *next; s; s = next) {
        next = s->next;
        tracer_free(s->tracer);
        gatherer_free(s->gatherer);
        free(s);
    }
}

// Where the points of a pass lie that belong to [from, to): multiples of the size.
static double first_point(int from, double size)
{
    return ceil((from - 0.5) / size) * size;
}

struct points {
    struct vec2 at[BATCH_SIZE];
    float out[BATCH_SIZE][4];
    uint32_t count;
};

static void points_trace(struct scout *s, struct points *p)
{
    if (p->count)
        tracer_samples(s->tracer, p->at, p->count, p->out);
    gatherer_flush(s->gatherer);
    p->count = 0;
}

// POV-Ray's random numbers, -1 to 1, so that samples lie where its samples do.
static double offset_next(uint32_t *place)
{
    enum { OFFSETS = 2047 };
    *place = (*place + 1) % OFFSETS;
    return ldexp(noise_random_table[*place], -31) - 1;
}

static void square_scout(const struct pass *p, uint32_t square, struct scout *s, int x0,
                         int y0, int x1, int y1)
{
    const double spread = fmin(1, p->size / 2), middle = (p->size - 1) / 2;
    struct points points = {.count = 0};
    uint32_t place = 17 * p->number + 13 * square;
    for (double y = first_point(y0, p->size); y < y1 - 0.5; y += p->size) {
        for (double x = first_point(x0, p->size); x < x1 - 0.5; x += p->size) {
            double dx = 0, dy = 0;
            if (!p->final) {
                dy = middle + spread * offset_next(&place);
                dx = middle + spread * offset_next(&place);
            }
            if (points.count == BATCH_SIZE)
                points_trace(s, &points);
            points.at[points.count++] = (struct vec2){x + dx + 0.5, y + dy + 0.5};
        }
    }
    points_trace(s, &points);
}

static int least(int a, int b) { return a < b ? a : b; }

static void work(void *user, void *state, uint32_t from, uint32_t to)
{
    static const uint32_t stride = 7919; // a prime, so that squares begin elsewhere
    struct pass *p = user;
    struct scout *s = state;
    const uint32_t across = squares_across(p->settings);
    for (uint32_t k = from; k < to; k++) {
        const uint32_t i = p->turn[p->done + k];
        struct square *square = &p->square[i];
        const int x0 = p->settings->col_begin + SQUARE * (int)(i % across),
                  y0 = p->settings->row_begin + SQUARE * (int)(i / across);
        store_init(&square->fresh, p->cache->store.kernels->name);
        s->gatherer->fresh = &square->fresh;
        gatherer_start(s->gatherer, stride * (i + 17 * (p->number - 1)));
        const uint64_t before = gatherer_rays(s->gatherer);
        if (!square->settled || p->final)
            square_scout(p, i, s, x0, y0, least(x0 + SQUARE, p->settings->col_end),
                         least(y0 + SQUARE, p->settings->row_end));
        square->settled |= gather_is_settled(s->gatherer);
        square->rays = gatherer_rays(s->gatherer) - before;
    }
}

// Takes over what a square has found, but for what others of its round have made needless.
static void square_join(struct pass *p, struct store *fresh)
{
    for (uint32_t k = 0; k < fresh->count; k++)
        if (p->final || gather_is_wanted(p->cache, &fresh->sample[k]))
            store_add(&p->cache->store, &fresh->sample[k]);
    store_free(fresh);
    *fresh = (struct store){.count = 0};
}

static uint32_t bits_mirrored(uint32_t x, uint32_t bits)
{
    uint32_t y = 0;
    for (uint32_t i = 0; i < bits; i++)
        y |= (x >> i & 1) << (bits - 1 - i);
    return y;
}

// Squares in an order in which each of the first ones is far from those before it.
static void squares_spread(uint32_t *order, uint32_t count)
{
    uint32_t bits = 0, n = 0;
    while ((uint64_t)1 << bits < count)
        bits++;
    for (uint32_t i = 0; n < count; i++) {
        const uint32_t x = bits_mirrored(i, bits);
        if (x < count)
            order[n++] = x;
    }
}

struct turn {
    uint64_t rays;
    uint32_t square;
};

static int by_rays(const void *a, const void *b)
{
    const struct turn *x = a, *y = b;
    return x->rays != y->rays ? (x->rays > y->rays ? -1 : 1)
                              : (x->square > y->square) - (x->square < y->square);
}

// No thread begins a long square when the others have nothing left to do.
static void longest_first(const struct pass *p, uint32_t begin, uint32_t end)
{
    const uint32_t count = end - begin;
    struct turn *turn = must_calloc(count, sizeof *turn);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t square = p->order[begin + i];
        turn[i] = (struct turn){p->square[square].rays, square};
    }
    qsort(turn, count, sizeof *turn, by_rays);
    for (uint32_t i = 0; i < count; i++)
        p->turn[begin + i] = turn[i].square;
    free(turn);
}

// Squares of a round do not see what the others find. The first pass begins with few:
// what they find at depth serves nearly all of the picture.
static void rounds_run(struct pass *p, struct parallel *parallel, uint32_t squares,
                       struct irradiance_report *report)
{
    for (uint32_t end; p->done < squares; p->done = end) {
        end = p->number > 1 ? squares : p->done ? 2 * p->done : 1;
        if (end > squares)
            end = squares;
        watch_part(parallel->watch, p->from + (p->to - p->from) * p->done / squares,
                   p->from + (p->to - p->from) * end / squares);
        longest_first(p, p->done, end);
        parallel_run(parallel, end - p->done);
        for (uint32_t i = p->done; i < end; i++) {
            struct square *square = &p->square[p->order[i]];
            square_join(p, &square->fresh);
            report->rays += square->rays;
        }
    }
}

static bool run(struct pass *p, struct watch *watch, struct irradiance_report *report)
{
    const uint32_t squares = squares_across(p->settings) * squares_down(p->settings);
    p->order = must_calloc(squares, sizeof *p->order);
    p->turn = must_calloc(squares, sizeof *p->turn);
    squares_spread(p->order, squares);
    struct parallel parallel = {.threads = p->settings->threads,
                                .piece = 1,
                                .watch = watch,
                                .tells = true,
                                .user = p,
                                .begin = begin,
                                .end = end,
                                .work = work};
    rounds_run(p, &parallel, squares, report);
    free(p->order);
    free(p->turn);
    report->passes++;
    return !watch_cancelled(watch);
}

// Number of passes before that at every pixel, and the size of the first.
static uint32_t pass_count(const struct irradiance_cache *c,
                           const struct render_settings *s, double *first, double *last)
{
    static const double slack = 1e-10;
    enum { MOST = 32 };
    const int side = s->width > s->height ? s->width : s->height;
    *first = side * c->settings->pretrace_start;
    *last = fmax(1, side * c->settings->pretrace_end);
    const double n = floor(log2(*first / *last) + 1 - slack) + 1;
    return n < 1 ? 1 : n > MOST ? MOST : (uint32_t)n;
}

static bool fill(struct irradiance_cache *c, struct scouts *scouts,
                 const struct render_settings *settings, struct square *square,
                 struct watch *watch, struct irradiance_report *report)
{
    double size, last;
    const uint32_t count = pass_count(c, settings, &size, &last);
    for (uint32_t i = 1; i <= count; i++, size /= 2) {
        struct pass p = {.cache = c,
                         .scouts = scouts,
                         .settings = settings,
                         .square = square,
                         .number = i,
                         .size = fmax(last, size)};
        watch_part(watch, (i - 1) / (count + 1.0), i / (count + 1.0));
        if (!run(&p, watch, report))
            return false;
    }
    struct pass p = {.cache = c,
                     .scouts = scouts,
                     .settings = settings,
                     .square = square,
                     .number = count + 1,
                     .size = 1,
                     .final = true,
                     .from = count / (count + 1.0),
                     .to = 1};
    return run(&p, watch, report);
}

bool irradiance_fill(struct irradiance_cache *c, const struct render_settings *settings,
                     struct watch *watch, struct irradiance_report *report)
{
    struct square *square =
        must_calloc(squares_across(settings) * squares_down(settings), sizeof *square);
    struct scouts scouts = {.lock = PTHREAD_MUTEX_INITIALIZER, .idle = NULL};
    const bool whole = fill(c, &scouts, settings, square, watch, report);
    scouts_free(&scouts);
    free(square);
    return whole;
}
