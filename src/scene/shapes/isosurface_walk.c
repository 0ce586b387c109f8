// A ray through the cells of an isosurface (isosurface.h).
//
// f along the ray is followed from cell to cell. Where the bounds of the gradient say that
// it is monotone the signs at the two ends tell whether there is a root, and one at most;
// elsewhere the stretch is halved until bounds of f and of its derivative along the ray
// exclude a root, or prove it monotone (interval Newton without the step: Kearfott,
// Rigorous Global Search, 1996). What cannot be told down to the rounding of f itself is
// decided by the signs at its ends: a touching point that changes nothing is not reported.
// Opaque functions have no bounds; they are sampled as densely as the largest slope asks
// for (Kalra and Barr, Guaranteed Ray Intersections with Implicit Surfaces, 1989).
#include "math/gamma.h"
#include "scene/shapes/isosurface.h"

enum {
    STRETCHES_MAX = 64, // open at a time
    CHEAP_STEPS = 3,
};

struct walk {
    const struct isosurface *s;
    struct vec3 o, d;    // o nearest to the middle of the container
    double slack;        // o is rounded by no more
    double shift, chord; // t of o; length of the stretch in the container
    double scale;        // length of d
    double t_min, t_max; // first_only: a crossing between them ends the walk
    double enter;        // t of the container
    bool first_only, done, started, inside;
    double last_t, last_f;
    uint32_t evaluations;
    struct boundary_list *out;
};

static double value(struct walk *w, double t)
{
    w->evaluations++;
    return iso_value(w->s, vec3_mad(w->o, t, w->d));
}

static double value_at(struct walk *w, double t)
{
    if (t != w->last_t) {
        w->last_t = t;
        w->last_f = value(w, t);
    }
    return w->last_f;
}

// The largest |f| at one point of the ray, with the rounding of its origin's place.
static double size_at(struct walk *w, double t)
{
    struct interval in[3];
    for (int i = 0; i < 3; i++) {
        const double o = vec3_axis(w->o, i), d = vec3_axis(w->d, i);
        in[i] = interval_add(interval(o - w->slack, o + w->slack),
                             interval_multiply(interval_point(t), interval_point(d)));
    }
    w->evaluations++;
    return interval_size(
        interval_subtract(tape_bounds(w->s->f, in), interval_point(w->s->threshold)));
}

// f and its derivative over a..b of the ray.
static struct tape_slope over(struct walk *w, double a, double b, int directions)
{
    struct tape_slope in[3];
    const struct interval t = interval(a, b);
    for (int i = 0; i < 3; i++) {
        const struct interval d = interval_point(vec3_axis(w->d, i));
        in[i].v =
            interval_add(interval_point(vec3_axis(w->o, i)), interval_multiply(t, d));
        in[i].d[0] = d;
    }
    w->evaluations++;
    struct tape_slope r = tape_bounds_slope(w->s->f, in, directions);
    r.v = interval_subtract(r.v, interval_point(w->s->threshold));
    return r;
}

static double least_size(struct interval d)
{
    return d.lo > 0 ? d.lo : d.hi < 0 ? -d.hi : 0;
}

// ---- crossings ----------------------------------------------------------------------

static void add(struct walk *w, double t, double dt)
{
    w->inside = !w->inside;
    dt += GAMMA(4) * (fabs(w->shift) + fabs(t));
    boundary_list_add(w->out, t + w->shift, dt, w->inside ? CROSS_ENTER : CROSS_EXIT,
                      ISO_SURFACE);
    if (w->first_only && t + w->shift > w->t_min)
        w->done = true;
}

// How far the root is from t, found between a and b: |f| there with its rounding, over
// the least slope on the way, which is looked at closer where that of the cell is small.
static double error_of(struct walk *w, double t, double a, double b, double slope)
{
    const double bracket = b - a + 8 * ROUNDOFF * fabs(t);
    double r = bracket;
    const double f = tape_is_opaque(w->s->f) ? 0 : size_at(w, t);
    if (!(f > 0 && f < INFINITY)) // unknown, or a jump at a pole
        return r;
    if (r + f / slope < ISO_ERROR_GOOD * w->chord)
        return r + f / slope;
    for (int i = 0; i < ISO_ERROR_TRIES; i++) {
        slope = least_size(over(w, t - r, t + r, 1).d[0]);
        if (slope > 0 && f / slope <= r)
            return r;
        r = slope > 0 ? 2 * (f / slope) : 16 * r;
    }
    return r < INFINITY ? r : bracket;
}

// The state from t on, where no root was looked for: a change is a root lost in rounding.
static void settle(struct walk *w, double t, bool inside)
{
    if (!w->started) {
        w->started = true;
        w->inside = inside;
        w->done = inside && w->first_only && !w->s->open && w->enter > w->t_min;
    } else if (w->inside != inside) {
        add(w, t, ISO_SHORTEST * w->chord);
    }
}

// Chandrupatla's method (1997): inverse quadratic steps kept in the bracket a..b, halving
// where they do not pay. f(a) and f(b) have different signs; the bracket is left in a, b.
static double refine(struct walk *w, double *a, double fa, double *b, double fb)
{
    double x1 = *a, f1 = fa, x0 = *b, f0 = fb, x2 = x0, f2 = f0, u = 0.5;
    for (int i = 0; i < ISO_REFINE_MAX; i++) {
        const double x = x0 + u * (x1 - x0);
        const double f = value(w, x);
        if ((f <= 0) == (f0 <= 0)) {
            x2 = x0;
            f2 = f0;
        } else {
            x2 = x1;
            f2 = f1;
            x1 = x0;
            f1 = f0;
        }
        x0 = x;
        f0 = f;
        const double best = fabs(f1) < fabs(f0) ? x1 : x0;
        const double near = 2 * ROUNDOFF * fabs(best) + 0x1p-56 * w->chord;
        const double left = near / fabs(x1 - x0);
        *a = fmin(x0, x1);
        *b = fmax(x0, x1);
        if (f0 == 0)
            return *a = *b = x0;
        if (left > 0.5 || f1 == 0)
            return best;
        const double xi = (x0 - x1) / (x2 - x1), phi = (f0 - f1) / (f2 - f1);
        u = 0.5;
        if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
            u = f0 / (f1 - f0) * (f2 / (f1 - f2)) +
                (x2 - x0) / (x1 - x0) * (f0 / (f2 - f0)) * (f1 / (f2 - f1));
        u = u > left ? u < 1 - left ? u : 1 - left : left;
    }
    return 0.5 * (*a + *b);
}

// A stretch with at most one root worth telling: by its ends.
static void decide(struct walk *w, double a, double fa, double b, double fb, double slope)
{
    if ((fa <= 0) == (fb <= 0) || w->done)
        return;
    const double t = refine(w, &a, fa, &b, fb);
    add(w, t, error_of(w, t, a, b, slope));
}

// ---- stretches ----------------------------------------------------------------------

struct stretch {
    double a, fa, b, fb;
    struct interval d; // holds the derivative everywhere on it
    int cheap;         // steps left that evaluate single points
};

// Nothing is gained by halving: f over the stretch is within its own rounding.
static bool is_rounding(struct walk *w, const struct stretch *s, struct interval v)
{
    const double m = 0.5 * (s->a + s->b);
    return interval_width(v) <= 4 * interval_width(over(w, m, m, 0).v);
}

// Whether f keeps its sign: from both ends it cannot fall to zero before it has to rise
// again. The slack covers the rounding of this test and of f, which is checked below
// where it matters.
static bool is_excluded(const struct stretch *s)
{
    const double up = fmax(s->fa > 0 ? s->d.hi : -s->d.lo, 0);
    const double down = fmax(s->fa > 0 ? -s->d.lo : s->d.hi, 0);
    const double room = fabs(s->fa) * up + fabs(s->fb) * down;
    return room > up * down * (s->b - s->a) * (1 + GAMMA(16)) && up + down < INFINITY;
}

// Leaves out what the ends alone show to be free of roots, if that is much.
static bool trim(struct walk *w, struct stretch *s)
{
    const double length = s->b - s->a;
    const double from_a = fabs(s->fa) / (s->fa > 0 ? -s->d.lo : s->d.hi);
    const double from_b = fabs(s->fb) / (s->fb > 0 ? s->d.hi : -s->d.lo);
    if (!(from_a >= 0 && from_b >= 0 && from_a + from_b > 0.25 * length &&
          from_a + from_b < length))
        return false;
    const double a = s->a + 0.999 * from_a, b = s->b - 0.999 * from_b;
    const double fa = value(w, a), fb = value(w, b);
    if ((fa <= 0) != (s->fa <= 0) || (fb <= 0) != (s->fb <= 0) || !(a < b))
        return false;
    s->a = a;
    s->b = b;
    s->fa = fa;
    s->fb = fb;
    return true;
}

// Whether the stretch is done with; else it is to be halved.
static bool is_settled(struct walk *w, struct stretch *s)
{
    const bool changes = (s->fa <= 0) != (s->fb <= 0);
    if (!changes && is_excluded(s))
        return true;
    if (s->cheap > 0 && s->d.hi - s->d.lo < INFINITY) {
        s->cheap--;
        trim(w, s);
        if (!changes)
            return is_excluded(s);
    }
    const double length = s->b - s->a;
    const bool bounded = s->d.hi - s->d.lo < INFINITY;
    const double least = fmax((bounded ? ISO_SHORTEST : ISO_SHORTEST_JUMP) * w->chord,
                              8 * ROUNDOFF * fabs(s->b));
    const struct tape_slope r = over(w, s->a, s->b, 1);
    if (r.v.lo > 0 || r.v.hi < 0)
        return true;
    s->d = interval(fmax(s->d.lo, r.d[0].lo), fmin(s->d.hi, r.d[0].hi));
    const double slope = least_size(s->d);
    if (slope > 0 || length <= least || w->evaluations > ISO_EVALUATIONS_MAX ||
        (length < 0x1p-12 * w->chord && is_rounding(w, s, r.v))) {
        decide(w, s->a, s->fa, s->b, s->fb, slope);
        return true;
    }
    return !changes && is_excluded(s);
}

static void isolate(struct walk *w, struct stretch all)
{
    struct stretch open[STRETCHES_MAX];
    int n = 1;
    open[0] = all;
    while (n && !w->done) {
        struct stretch s = open[--n];
        w->done = boundary_list_gives_up(w->out);
        if (n + 2 > STRETCHES_MAX) {
            decide(w, s.a, s.fa, s.b, s.fb, 0);
            continue;
        }
        if (is_settled(w, &s))
            continue;
        const double m = 0.5 * (s.a + s.b), f = value(w, m);
        open[n++] = (struct stretch){m, f, s.b, s.fb, s.d, s.cheap};
        open[n++] = (struct stretch){s.a, s.fa, m, f, s.d, s.cheap};
    }
}

// Where the largest slope leaves room for a root, as POV-Ray decides it: the nearer half
// first, down to the accuracy (spec/shapes 4.24).
static void sampled(struct walk *w, struct stretch all, double steepest)
{
    struct stretch open[STRETCHES_MAX];
    int n = 1;
    open[0] = all;
    while (n && !w->done) {
        const struct stretch s = open[--n];
        w->done = boundary_list_gives_up(w->out);
        const double length = s.b - s.a;
        const bool changes = (s.fa <= 0) != (s.fb <= 0);
        if (!changes && fabs(s.fa) + fabs(s.fb) >= steepest * w->scale * length)
            continue;
        if (length < w->s->accuracy || n + 2 > STRETCHES_MAX ||
            w->evaluations > ISO_EVALUATIONS_MAX) {
            decide(w, s.a, s.fa, s.b, s.fb, 0);
            continue;
        }
        const double m = 0.5 * (s.a + s.b), f = value(w, m);
        open[n++] = (struct stretch){.a = m, .fa = f, .b = s.b, .fb = s.fb};
        open[n++] = (struct stretch){.a = s.a, .fa = s.fa, .b = m, .fb = f};
    }
}

// The derivative along the ray by the bounds of the gradient.
static struct interval slope_in(const struct walk *w, const struct iso_cell *c)
{
    double lo = 0, hi = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        const double d = vec3_axis(w->d, i);
        const double p = d == 0 ? 0 : c->slope[i][d < 0] * d;
        const double q = d == 0 ? 0 : c->slope[i][d > 0] * d;
        lo += p;
        hi += q;
        size += fabs(p) + fabs(q);
    }
    const double slack = GAMMA(8) * size;
    return interval_widened(lo - slack, hi + slack, 0);
}

static void leaf(struct walk *w, const struct iso_cell *c, double a, double b)
{
    struct stretch s = {.a = a, .b = b, .cheap = CHEAP_STEPS};
    s.fa = value_at(w, a);
    settle(w, a, s.fa <= 0);
    if (w->done)
        return;
    s.fb = value_at(w, b);
    if (tape_is_opaque(w->s->f)) {
        sampled(w, s, c->steepest);
        return;
    }
    s.d = slope_in(w, c);
    const double slope = least_size(s.d);
    if (slope > 0)
        decide(w, s.a, s.fa, s.b, s.fb, slope);
    else
        isolate(w, s);
}

// ---- cells --------------------------------------------------------------------------

static void visit(struct walk *w, struct iso_cell *c, const struct aabb *box, int depth,
                  double a, double b);

static void visit_children(struct walk *w, struct iso_cell *c, const struct aabb *box,
                           int depth, double a, double b)
{
    struct iso_cell *child = iso_children(w->s, c, box, depth, &w->evaluations);
    const struct vec3 m = vec3_scale(0.5, vec3_add(box->min, box->max));
    double cut[4], plane[3];
    int n = 0;
    for (int i = 0; i < 3; i++) {
        plane[i] = (vec3_axis(m, i) - vec3_axis(w->o, i)) / vec3_axis(w->d, i);
        if (!(plane[i] > a && plane[i] < b))
            continue;
        int k = n++;
        for (; k > 0 && cut[k - 1] > plane[i]; k--)
            cut[k] = cut[k - 1];
        cut[k] = plane[i];
    }
    cut[n++] = b;
    for (int k = 0; k < n && !w->done; k++) {
        if (!(cut[k] > a) && n > 1)
            continue;
        const double t = 0.5 * (a + cut[k]);
        int octant = 0;
        for (int i = 0; i < 3; i++) {
            const double d = vec3_axis(w->d, i);
            const bool above = d > 0   ? t >= plane[i]
                               : d < 0 ? t < plane[i]
                                       : vec3_axis(w->o, i) >= vec3_axis(m, i);
            octant |= (int)above << i;
        }
        const struct aabb part = iso_child_box(box, &m, octant);
        visit(w, &child[octant], &part, depth + 1, a, cut[k]);
        a = cut[k];
    }
}

static void visit(struct walk *w, struct iso_cell *c, const struct aabb *box, int depth,
                  double a, double b)
{
    if ((w->first_only && a + w->shift > w->t_max) || boundary_list_gives_up(w->out)) {
        w->done = true;
        return;
    }
    switch ((enum cell_kind)c->kind) {
    case CELL_OUTSIDE: settle(w, a, false); break;
    case CELL_INSIDE: settle(w, a, true); break;
    case CELL_LEAF: leaf(w, c, a, b); break;
    case CELL_BRANCH: visit_children(w, c, box, depth, a, b);
    }
}

// The container's own crossing, where the solid fills the container there.
static void add_face(const struct walk *w, const struct boundary *face)
{
    struct boundary *b =
        boundary_list_add(w->out, face->t, face->dt, (enum crossing)face->crossing,
                          ISO_CONTAINER + face->part);
    b->drawn = !w->s->open;
}

// The entry comes before what was found behind it.
static void add_entry(struct walk *w, uint32_t first, const struct boundary *face)
{
    add_face(w, face);
    const struct boundary b = w->out->at[w->out->count - 1];
    for (uint32_t i = w->out->count - 1; i > first; i--)
        w->out->at[i] = w->out->at[i - 1];
    w->out->at[first] = b;
}

void iso_walk(const struct isosurface *s, const struct ray *ray,
              struct boundary_list *out)
{
    const bool first_only = out->first_only;
    const uint32_t first = out->count;
    s->container.ops->intersect(&s->container.shape, ray, out);
    if (out->count < first + 2)
        return;
    const struct boundary enter = out->at[first], leave = out->at[first + 1];
    out->count = first;
    if (!(leave.t > enter.t) ||
        (first_only && (leave.t <= ray->t_min || enter.t >= ray->t_max)))
        return;
    const struct vec3 middle = vec3_scale(0.5, vec3_add(s->bounds.min, s->bounds.max));
    const double dd = vec3_dot(ray->d, ray->d);
    struct walk w = {.s = s, .d = ray->d, .out = out, .first_only = first_only};
    w.shift = vec3_dot(vec3_sub(middle, ray->o), ray->d) / dd;
    w.o = vec3_mad(ray->o, w.shift, ray->d);
    w.slack = GAMMA(6) * (vec3_max_abs(ray->o) + fabs(w.shift) * vec3_max_abs(ray->d));
    w.scale = sqrt(dd);
    w.chord = leave.t - enter.t;
    w.t_min = ray->t_min;
    w.t_max = ray->t_max;
    w.enter = enter.t;
    w.last_t = NAN;
    // What lies before t_min is of no interest to a ray that starts there.
    const bool late = first_only && ray->t_min > enter.t;
    visit(&w, s->root, &s->bounds, 0, (late ? ray->t_min : enter.t) - w.shift,
          leave.t - w.shift);
    const bool began =
        out->count > first ? out->at[first].crossing == CROSS_EXIT : w.inside;
    if (began && !late)
        add_entry(&w, first, &enter);
    if (w.inside && !w.done)
        add_face(&w, &leave);
    out->evaluations += w.evaluations;
}
