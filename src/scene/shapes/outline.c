#include "scene/shapes/outline.h"

#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "math/gamma.h"

void outline_init(struct outline *o, struct arena *arena)
{
    *o = (struct outline){
        .arena = arena, .min = {HUGE_VAL, HUGE_VAL}, .max = {-HUGE_VAL, -HUGE_VAL}};
}

static void widen(struct outline *o, struct vec2 p)
{
    o->min.u = fmin(o->min.u, p.u);
    o->min.v = fmin(o->min.v, p.v);
    o->max.u = fmax(o->max.u, p.u);
    o->max.v = fmax(o->max.v, p.v);
}

static struct outline_segment *add(struct outline *o, struct vec2 a, struct vec2 b)
{
    if (o->count == o->capacity) {
        uint32_t capacity = o->capacity ? 2 * o->capacity : 32;
        struct outline_segment *s =
            arena_new_array(o->arena, struct outline_segment, capacity);
        if (o->count)
            memcpy(s, o->segment, o->count * sizeof *s);
        o->segment = s;
        o->capacity = capacity;
    }
    struct outline_segment *s = &o->segment[o->count++];
    s->a = a;
    s->b = b;
    widen(o, a);
    widen(o, b);
    return s;
}

// The circle around control points.
static void enclose(struct outline_segment *s, const struct vec2 *p, int n)
{
    struct vec2 lo = p[0], hi = p[0];
    for (int i = 1; i < n; i++) {
        lo.u = fmin(lo.u, p[i].u);
        lo.v = fmin(lo.v, p[i].v);
        hi.u = fmax(hi.u, p[i].u);
        hi.v = fmax(hi.v, p[i].v);
    }
    s->middle = (struct vec2){0.5 * (lo.u + hi.u), 0.5 * (lo.v + hi.v)};
    s->radius = 0;
    for (int i = 0; i < n; i++) {
        const double u = p[i].u - s->middle.u, v = p[i].v - s->middle.v;
        s->radius = fmax(s->radius, sqrt(u * u + v * v));
    }
}

void outline_line(struct outline *o, struct vec2 a, struct vec2 b)
{
    if (a.u == b.u && a.v == b.v)
        return;
    struct outline_segment *s = add(o, a, b);
    s->degree = 1;
    s->c1 = (struct vec2){b.u - a.u, b.v - a.v};
    enclose(s, (const struct vec2[]){a, b}, 2);
}

void outline_parabola(struct outline *o, struct vec2 a, struct vec2 control,
                      struct vec2 b)
{
    struct outline_segment *s = add(o, a, b);
    widen(o, control);
    s->degree = 2;
    s->c1 = (struct vec2){2 * (control.u - a.u), 2 * (control.v - a.v)};
    s->c2 = (struct vec2){a.u - 2 * control.u + b.u, a.v - 2 * control.v + b.v};
    enclose(s, (const struct vec2[]){a, control, b}, 3);
}

void outline_cubic(struct outline *o, struct vec2 a, struct vec2 c1, struct vec2 c2,
                   struct vec2 b)
{
    struct outline_segment *s = add(o, a, b);
    widen(o, c1);
    widen(o, c2);
    s->degree = 3;
    s->c1 = (struct vec2){3 * (c1.u - a.u), 3 * (c1.v - a.v)};
    s->c2 = (struct vec2){3 * (a.u - 2 * c1.u + c2.u), 3 * (a.v - 2 * c1.v + c2.v)};
    s->c3 = (struct vec2){b.u - a.u + 3 * (c1.u - c2.u), b.v - a.v + 3 * (c1.v - c2.v)};
    enclose(s, (const struct vec2[]){a, c1, c2, b}, 4);
}

struct vec2 outline_point(const struct outline_segment *s, double w)
{
    return (struct vec2){((s->c3.u * w + s->c2.u) * w + s->c1.u) * w + s->a.u,
                         ((s->c3.v * w + s->c2.v) * w + s->c1.v) * w + s->a.v};
}

struct vec2 outline_tangent(const struct outline_segment *s, double w)
{
    return (struct vec2){(3 * s->c3.u * w + 2 * s->c2.u) * w + s->c1.u,
                         (3 * s->c3.v * w + 2 * s->c2.v) * w + s->c1.v};
}

static double side(const double k[3], struct vec2 p)
{
    return k[0] * p.u + k[1] * p.v + k[2];
}

struct cubic {
    double c[4]; // ascending powers
};

static double value(const struct cubic *f, double w)
{
    return ((f->c[3] * w + f->c[2]) * w + f->c[1]) * w + f->c[0];
}

static double slope(const struct cubic *f, double w)
{
    return (3 * f->c[3] * w + 2 * f->c[2]) * w + f->c[1];
}

// The root of f in (lo, hi), where `rising` says which way its sign changes: Newton from where
// the chord has it, kept inside the bracket, which shrinks to neighbouring numbers at worst. It
// ends with a step whose square, by the curvature, is below rounding, or too small to change w: w is
// an end of the bracket by then, whose other end may be far.
static double root_between(const struct cubic *f, double lo, double hi, bool rising)
{
    const double from = value(f, lo), to = value(f, hi);
    double w = lo + (hi - lo) * (from / (from - to));
    if (!(w > lo && w < hi))
        w = 0.5 * (lo + hi);
    for (int i = 0; i < 80; i++) {
        const double v = value(f, w), along = slope(f, w);
        if (v == 0)
            return w;
        if ((v > 0) == rising)
            hi = w;
        else
            lo = w;
        double next = w - v / along, step = next - w;
        if (next == w)
            return w;
        if (!(next > lo && next < hi)) {
            next = 0.5 * (lo + hi);
            step = HUGE_VAL;
        }
        if (next <= lo || next >= hi)
            return next;
        const double bend =
            fabs(6 * f->c[3] * w + 2 * f->c[2]) + fabs(6 * f->c[3] * step);
        w = next;
        if (step * step * bend < 0x1p-54 * (w * fabs(along)))
            return w;
    }
    return w;
}

// The same of a parabola, by the formula that does not cancel.
static double parabola_root(const struct cubic *f, double lo, double hi, bool rising)
{
    const double a = f->c[2], b = f->c[1], c = f->c[0];
    const double square = b * b - 4 * (a * c), root = sqrt(square < 0 ? 0 : square);
    const double q = -0.5 * (b < 0 ? b - root : b + root);
    double w = rising == (b < 0) ? q / a : c / q;
    w = w > lo ? w : lo;
    return w < hi ? w : hi;
}

// The extrema of f inside (0, 1), ascending.
static int extrema(const struct cubic *f, double w[2])
{
    double a = 3 * f->c[3], b = f->c[2], c = f->c[1]; // a w^2 + 2 b w + c
    double found[2];
    int n = 0;
    double d = b * b - a * c;
    if (!(d > 0))
        return 0;
    double q = -(b + copysign(sqrt(d), b));
    if (a != 0)
        found[n++] = q / a;
    if (q != 0)
        found[n++] = c / q;
    if (n == 2 && found[0] > found[1]) {
        double swap = found[0];
        found[0] = found[1];
        found[1] = swap;
    }
    int kept = 0;
    for (int i = 0; i < n; i++)
        if (found[i] > 0 && found[i] < 1)
            w[kept++] = found[i];
    return kept;
}

// Whether all Bernstein coefficients have one sign, clear of rounding: then there is no
// root (Farouki & Rajan 1987). `end` is f(1).
static bool beside(const struct cubic *f, double end)
{
    const double a = f->c[0], b = a + f->c[1] / 3, c = b + (f->c[1] + f->c[2]) / 3;
    const double noise =
        GAMMA(16) * (fabs(a) + fabs(f->c[1]) + fabs(f->c[2]) + fabs(end));
    return (a > noise && b > noise && c > noise && end > noise) ||
           (a < -noise && b < -noise && c < -noise && end < -noise);
}

int outline_roots(const struct outline_segment *s, const double k[3],
                  double w[OUTLINE_ROOTS])
{
    const bool above_a = side(k, s->a) >= 0, above_b = side(k, s->b) >= 0;
    if (s->degree == 1) {
        if (above_a == above_b)
            return 0;
        double fa = side(k, s->a), d = fa - side(k, s->b);
        w[0] = d != 0 ? fmax(0, fmin(1, fa / d)) : 0;
        return 1;
    }
    const struct cubic f = {{side(k, s->a), k[0] * s->c1.u + k[1] * s->c1.v,
                             k[0] * s->c2.u + k[1] * s->c2.v,
                             k[0] * s->c3.u + k[1] * s->c3.v}};
    if (above_a == above_b && beside(&f, side(k, s->b)))
        return 0;
    double stop[3] = {0};
    int n = 1 + extrema(&f, stop + 1), roots = 0;
    bool above = above_a;
    for (int i = 1; i <= n; i++) {
        double end = i < n ? stop[i] : 1;
        bool above_end = i < n ? value(&f, end) >= 0 : above_b;
        if (above_end != above)
            w[roots++] = s->degree == 2 ? parabola_root(&f, stop[i - 1], end, above_end)
                                        : root_between(&f, stop[i - 1], end, above_end);
        above = above_end;
    }
    return roots;
}

bool outline_inside(const struct outline *o, struct vec2 p)
{
    if (!(p.u >= o->min.u && p.u <= o->max.u && p.v >= o->min.v && p.v <= o->max.v))
        return false;
    const double k[3] = {0, 1, -p.v}; // the line v = p.v
    bool in = false;
    for (uint32_t i = 0; i < o->count; i++) {
        double w[OUTLINE_ROOTS];
        const struct outline_segment *s = &o->segment[i];
        if (fabs(s->middle.v - p.v) >
            s->radius + GAMMA(32) * (fabs(s->middle.v) + fabs(p.v)))
            continue;
        for (int n = outline_roots(s, k, w); n > 0; n--)
            in ^= outline_point(s, w[n - 1]).u > p.u;
    }
    return in;
}
