// The walk along a line of a pinched superellipsoid, from sample to sample of F, for the brackets
// in which it crosses nought.
#include <math.h>

#include "scene/shapes/superellipsoid_walk.h"

static bool is_concave(const struct superellipsoid *s)
{
    return s->p.p <= 1 && s->q.p <= 1;
}

// Where the line meets the planes x = 0, y = 0, z = 0, and, if F is not concave between them,
// x = y, x = -y and so on, sorted, ends included.

static int kinks(const struct superellipsoid_line *l, double a, double b,
                 double stop[STOPS])
{
    static const struct vec3 plane[9] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                         {1, 1, 0},  {1, -1, 0}, {1, 0, 1},
                                         {1, 0, -1}, {0, 1, 1},  {0, 1, -1}};
    const int planes = is_concave(l->s) ? 3 : 9;
    int n = 0;
    stop[n++] = a;
    for (int i = 0; i < planes; i++) {
        const double d = vec3_dot(plane[i], l->u), t = -vec3_dot(plane[i], l->o) / d;
        if (d != 0 && t > a && t < b)
            stop[n++] = t;
    }
    stop[n++] = b;
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && stop[j - 1] > stop[j]; j--) {
            const double swap = stop[j];
            stop[j] = stop[j - 1];
            stop[j - 1] = swap;
        }
    return n;
}

// The secant's root is nearer than the ends.
double superellipsoid_first_guess(const struct superellipsoid_bracket *x)
{
    const double t = x->a.t + (x->b.t - x->a.t) * (x->a.f / (x->a.f - x->b.f));
    // The line may leave the cube where F is below zero.
    return t > x->a.t && t < x->b.t ? t : 0.5 * (x->a.t + x->b.t);
}

static void samples_place(struct superellipsoid_stops *s, double a, double b)
{
    double stop[STOPS];
    const int n = kinks(&s->line, a, b, stop),
              pieces = is_concave(s->line.s) ? 1 : PIECES;
    s->count = 0;
    s->t[s->count++] = a;
    for (int i = 1; i < n; i++)
        for (int k = 1; k <= pieces; k++)
            s->t[s->count++] = stop[i - 1] + (stop[i] - stop[i - 1]) * k / pieces;
    for (int i = s->count; i % 8; i++)
        s->t[i] = b;
}

static struct superellipsoid_sample sample_of(struct superellipsoid_stops *s, int i)
{
    if (!s->kernels)
        return superellipsoid_at(&s->line, s->t[i]);
    if (i % 8 == 0)
        s->kernels->superellipsoid_samples(s->line.s, s->line.o, s->line.u, s->t + i,
                                           s->f + i, s->slope + i);
    return (struct superellipsoid_sample){s->f[i], s->slope[i]};
}

// F and its slope at eight places of the line.
static void eight_samples(const struct superellipsoid_line *l,
                          const struct shape_kernels *k, const double t[8], double f[8],
                          double slope[8])
{
    if (k) {
        k->superellipsoid_samples(l->s, l->o, l->u, t, f, slope);
        return;
    }
    for (int i = 0; i < 8; i++) {
        const struct superellipsoid_sample v = superellipsoid_at(l, t[i]);
        f[i] = v.f;
        slope[i] = v.slope;
    }
}

// A point between a and b on the other side of F than both, where the slopes at the ends
// say there may be one: F turns between them, in one eighth of the stretch.
static bool find_turn(const struct superellipsoid_line *l, const struct shape_kernels *k,
                      double a, double b, bool in, struct superellipsoid_place *turn)
{
    for (int step = 0; step < 8; step++) {
        double t[8], f[8], slope[8];
        for (int i = 0; i < 8; i++)
            t[i] = a + (b - a) * (i + 1) / 8; // the last is not looked at
        eight_samples(l, k, t, f, slope);
        int i = 0;
        while (i < 7 && (f[i] < 0) == in && (slope[i] > 0) == in)
            i++;
        if (i < 7 && (f[i] < 0) != in) {
            *turn = (struct superellipsoid_place){t[i], f[i]};
            return true;
        }
        a = i ? t[i - 1] : a;
        b = i < 7 ? t[i] : b;
    }
    return false;
}

// A lower bound on F between two places of the line: F grows with |x|, |y| and |z|.
static double least_between(const struct superellipsoid_line *l, double t0, double t1)
{
    const struct vec3 p = vec3_mad(l->o, t0, l->u), q = vec3_mad(l->o, t1, l->u);
    double least[3], f;
    for (int i = 0; i < 3; i++) {
        const double x = vec3_axis(p, i), y = vec3_axis(q, i);
        least[i] = x * y > 0 ? fmin(fabs(x), fabs(y)) : 0;
    }
    superellipsoid_gradient(l->s, vec3(least[0], least[1], least[2]), &f);
    return f;
}

enum { PARTS = 8 };

// Narrows a stretch that begins and ends outside to one that does so too, by the eighths at its
// ends that the surface does not meet; those between that the ray does not want may go with
// what is behind them. False: nothing is left.
static bool narrow(const struct superellipsoid_line *l, const struct shape_kernels *k,
                   double lo, double hi, double *a, double *b)
{
    double t[PARTS + 1], least[PARTS];
    int first = 0, last = PARTS - 1;
    for (int i = 0; i <= PARTS; i++)
        t[i] = *a + (*b - *a) * i / PARTS;
    if (k)
        k->superellipsoid_least(l->s, l->o, l->u, t, least);
    for (int i = 0; i < PARTS && !k; i++)
        least[i] = least_between(l, t[i], t[i + 1]);
    for (int i = 0; i < PARTS; i++)
        if (least[i] > l->noise && (i == first || t[i + 1] <= lo))
            first = i + 1;
    for (int i = PARTS - 1; i >= 0; i--)
        if (least[i] > l->noise && (i == last || t[i] >= hi))
            last = i - 1;
    *a = t[first];
    *b = t[last + 1];
    return first <= last;
}

bool superellipsoid_walk_begin(struct superellipsoid_walk *w,
                               const struct shape_kernels *k,
                               const struct superellipsoid *s, const struct ray *ray)
{
    double a, b;
    w->s.line = superellipsoid_line(s, ray);
    w->s.kernels = k;
    const struct superellipsoid_line *l = &w->s.line;
    if (!superellipsoid_in_cube(l, &a, &b) ||
        !narrow(l, k, ray->t_min * l->length - l->shift,
                ray->t_max * l->length - l->shift, &a, &b))
        return false;
    samples_place(&w->s, a, b);
    w->i = 0;
    w->in = w->again = false;
    w->before = sample_of(&w->s, 0);
    w->last = (struct superellipsoid_place){a, w->before.f};
    return true;
}

bool superellipsoid_walk_next(struct superellipsoid_walk *w,
                              struct superellipsoid_bracket *out)
{
    bool found = w->again;
    if (found)
        *out = w->second;
    w->again = false;
    while (!found && ++w->i < w->s.count) {
        struct superellipsoid_place turn;
        const struct superellipsoid_sample here = sample_of(&w->s, w->i);
        const struct superellipsoid_place end = {w->s.t[w->i], here.f};
        const bool now = here.f < 0 && w->i + 1 < w->s.count, in = w->in;
        if (now != in) {
            *out = (struct superellipsoid_bracket){w->last, end, now};
            found = true;
        } else if ((w->before.slope > 0) == in && (here.slope > 0) != in &&
                   find_turn(&w->s.line, w->s.kernels, w->last.t, end.t, in, &turn)) {
            *out = (struct superellipsoid_bracket){w->last, turn, !in};
            w->second = (struct superellipsoid_bracket){turn, end, in};
            found = w->again = true;
        }
        w->in = now;
        w->last = end;
        w->before = here;
    }
    return found;
}
