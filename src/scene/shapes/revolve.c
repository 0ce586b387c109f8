#include "scene/shapes/revolve.h"

#include <math.h>

#include "base/arena.h"
#include "math/elementary.h"
#include "math/gamma.h"
#include "math/pi.h"
#include "math/polynomial.h"
#include "scene/shapes/extrude.h"

// A ray this flat (sine of its slope) is taken as horizontal: the two crossings of a
// height then lie closer in w than the polynomial can tell, and the error made is below
// the slope times the radius.
static const double FLAT = 0x1p-24; // a few square roots of the roundoff

// Up to this slope, segments whose ends are not near the line's heights within the shape
// are met as by a horizontal line, and the crossings sharpened.
static const double NEARLY_FLAT = REVOLVE_NEARLY_FLAT;

// Of a segment: so little can the crossings of a height be apart on it that are sharpened.
static const double NARROW = 0x1p-11;

// Bernstein coefficients on [0, 1] of a polynomial taken as one of degree n; its values are
// between the least and the greatest.
static void bernstein(const double *c, int degree, int n, double *b)
{
    double scale = 1;
    for (int i = 0; i <= n; i++) { // over the binomials
        b[i] = i <= degree ? c[i] * scale : 0;
        scale *= (i + 1.) / fmax(1, n - i);
    }
    for (int i = 0; i < n; i++)
        for (int k = n; k > i; k--)
            b[k] += b[k - 1];
}

static void hull(const double *c, int degree, double *low, double *high)
{
    double b[POLYNOMIAL_DEGREE_MAX + 1];
    bernstein(c, degree, degree, b);
    *low = *high = b[0];
    for (int i = 1; i <= degree; i++) {
        *low = fmin(*low, b[i]);
        *high = fmax(*high, b[i]);
    }
}

// Of all that is_outside asks for.
static void bound_together(struct revolve_segment *s)
{
    double h2[7] = {0};
    for (int i = 0; i <= s->h_degree; i++)
        for (int k = 0; k <= s->h_degree; k++)
            h2[i + k] += s->h[i] * s->h[k];
    const double *const c[3] = {s->h, h2, s->r2};
    const int degree[3] = {s->h_degree, 2 * s->h_degree, s->r2_degree};
    s->degree = degree[1] > degree[2] ? degree[1] : degree[2];
    for (int i = 0; i < 3; i++) {
        bernstein(c[i], degree[i], s->degree, s->hull[i]);
        s->most[i] = 0;
        for (int k = 0; k <= degree[i]; k++)
            s->most[i] += fabs(c[i][k]);
    }
}

static double polynomial_slope(const double *c, int degree, double w)
{
    double v = 0;
    for (int k = degree; k > 0; k--)
        v = v * w + k * c[k];
    return v;
}

// Whether h' keeps its sign, but for zeros: at the ends and, of a cubic, where h' itself
// turns.
static bool is_climbing(const struct revolve_segment *s)
{
    const double a = polynomial_slope(s->h, s->h_degree, 0);
    const double b = polynomial_slope(s->h, s->h_degree, 1);
    double turn = s->h_degree == 3 ? -s->h[2] / (3 * s->h[3]) : 0;
    turn = turn > 0 && turn < 1 ? turn : 0;
    const double c = polynomial_slope(s->h, s->h_degree, turn);
    double noise = 0;
    for (int k = 1; k <= s->h_degree; k++)
        noise += GAMMA(16) * fabs(s->h[k]);
    return fmin(a, fmin(b, c)) >= -noise || fmax(a, fmax(b, c)) <= noise;
}

static void bound_segment(struct revolve_segment *s)
{
    double least2;
    hull(s->h, s->h_degree, &s->low, &s->high);
    hull(s->r2, s->r2_degree, &least2, &s->most2);
    bound_together(s);
    s->climbs = is_climbing(s);
    s->low = fmin(s->low, fmin(s->h_end[0], s->h_end[1]));
    s->high = fmax(s->high, fmax(s->h_end[0], s->h_end[1]));
    s->most2 = fmax(s->most2, fmax(s->r2_end[0], s->r2_end[1]));
}

static void make_blocks(struct revolve *r, struct arena *a)
{
    r->blocks = (r->count + REVOLVE_BLOCK - 1) / REVOLVE_BLOCK;
    r->block = arena_new_array(a, struct revolve_block, r->blocks);
    for (uint32_t i = 0; i < r->blocks; i++)
        r->block[i] = (struct revolve_block){HUGE_VAL, -HUGE_VAL, 0};
    for (uint32_t i = 0; i < r->count; i++) {
        struct revolve_block *b = &r->block[i / REVOLVE_BLOCK];
        b->low = fmin(b->low, r->segment[i].low);
        b->high = fmax(b->high, r->segment[i].high);
        b->most2 = fmax(b->most2, r->segment[i].most2);
    }
}

void revolve_prepare(struct revolve *r, struct arena *a)
{
    double r2 = 0;
    r->h_min = HUGE_VAL;
    r->h_max = -HUGE_VAL;
    for (uint32_t i = 0; i < r->count; i++) {
        struct revolve_segment *s = &r->segment[i];
        bound_segment(s);
        enum { STEPS = 64 };
        for (int k = 0; k <= STEPS; k++) {
            const double w = k / (double)STEPS;
            const double h = polynomial_value(s->h, s->h_degree, w);
            r->h_min = fmin(r->h_min, h);
            r->h_max = fmax(r->h_max, h);
            r2 = fmax(r2, polynomial_value(s->r2, s->r2_degree, w));
        }
    }
    // Between samples a cubic rises by less than this share of its range.
    const double slack = (r->h_max - r->h_min) / 256;
    const bool straight = r->count && r->segment[0].h_degree == 1;
    r->h_min -= straight ? 0 : slack;
    r->h_max += straight ? 0 : slack;
    r->r_max = sqrt(r2) * (1 + 1. / 256);
    make_blocks(r, a);
}

struct aabb revolve_bounds(const struct revolve *r)
{
    return (struct aabb){vec3(-r->r_max, r->h_min, -r->r_max),
                         vec3(r->r_max, r->h_max, r->r_max)};
}

// Whether f before its first root at t is below zero by more than its rounding.
static bool is_below_before(const double *f, int degree, double t)
{
    double size = 0;
    for (int k = degree; k >= 0; k--)
        size = size * 0.5 * t + fabs(f[k]);
    return polynomial_value(f, degree, 0.5 * t) < -GAMMA(32) * size;
}

// The sign changes of f on (0, 1), the signs at the ends given.
static int crossings(const double *f, int degree, bool above[2], double *w)
{
    struct polynomial_root root[POLYNOMIAL_DEGREE_MAX];
    int n = polynomial_sign_changes(f, degree, 0, 1, root);
    // The ends decide: drop or add a root at the end where rounding disagrees.
    bool state = above[0];
    int kept = 0;
    // A line through an apex: f touches zero at the start and is below from there.
    if (n > 0 && state && root[0].rising && is_below_before(f, degree, root[0].t)) {
        w[kept++] = 0;
        state = false;
    }
    for (int i = 0; i < n; i++)
        if (root[i].rising == !state) {
            w[kept++] = root[i].t;
            state = !state;
        }
    if (state != above[1]) {
        // A lost root lies where f is within its rounding of zero: at the end nearer to it.
        const bool at_start =
            kept == 0 && fabs(f[0]) < fabs(polynomial_value(f, degree, 1));
        w[kept++] = at_start ? 0 : 1;
    }
    return kept;
}

bool revolve_inside(const struct revolve *r, struct vec3 p)
{
    const double rho2 = p.x * p.x + p.z * p.z;
    bool in = false;
    for (uint32_t i = 0; i < r->count; i++) {
        const struct revolve_segment *s = &r->segment[i];
        double f[4], w[8];
        if (p.y < s->low || p.y > s->high || rho2 > s->most2 * (1 + 0x1p-40))
            continue;
        for (int k = 0; k <= s->h_degree; k++)
            f[k] = s->h[k];
        f[0] -= p.y;
        bool above[2] = {s->h_end[0] >= p.y, s->h_end[1] >= p.y};
        for (int n = crossings(f, s->h_degree, above, w); n > 0; n--)
            in ^= polynomial_value(s->r2, s->r2_degree, w[n - 1]) >= rho2;
    }
    return in;
}

struct line {
    const struct revolve *r;
    const struct ray *ray;
    double q, m, p; // |D_xz|^2, D_xz . O_xz, |O_xz|^2
    // The same at t = `shift`, at the height y there: where the line is nearest to the axis,
    // or a nearly horizontal line's crossings are lost in the rounding of the cross term.
    double shift, y, shifted_m, shifted_p;
    double dt;                // the part of the error that all crossings share
    double nearest, nearest2; // where it is nearest to the axis, and how near, squared
    double reach;             // error of t at a height
    double size;              // of all coordinates
    bool flat;
    struct boundary_list *out;
};

static void add(const struct line *l, double t, double dt, uint32_t part, double w)
{
    struct boundary *b = boundary_list_add(l->out, t, dt, CROSS_ENTER, part);
    b->v = w;
}

// Brings a crossing closer by Newton's method on y(t) = h(w), rho^2(t) = r^2(w): on a
// nearly horizontal line both crossings of a height have nearly the same w, and a
// polynomial in w alone loses what tells them apart. *dt becomes what the rounding of both
// residuals makes of t. False where the Jacobian is too small for that (a graze, an apex
// on the line) or another crossing would be found: all stay.
static bool sharpen(const struct line *l, const struct revolve_segment *s, double *t,
                    double *dt, double *w)
{
    const double far = 2 * NARROW; // more than the errors of w
    double at = *t, u = *w;
    for (int i = 0; i < 8; i++) {
        const double off = at - l->nearest, rho2 = l->nearest2 + l->q * off * off;
        const double dy = l->ray->d.y, drho2 = 2 * l->q * off;
        const double dh = polynomial_slope(s->h, s->h_degree, u);
        const double dr2 = polynomial_slope(s->r2, s->r2_degree, u);
        const double g = l->ray->o.y + at * dy - polynomial_value(s->h, s->h_degree, u);
        const double f = rho2 - polynomial_value(s->r2, s->r2_degree, u);
        const double det = drho2 * dh - dy * dr2;
        const double by_t = (g * dr2 - f * dh) / det, by_u = (drho2 * g - dy * f) / det;
        const double noise = (GAMMA(16) * l->size * fabs(dr2) +
                              GAMMA(32) * (l->size * sqrt(rho2) + s->most2) * fabs(dh)) /
                             fabs(det);
        at += by_t;
        u += by_u;
        if (!(fabs(u - *w) <= far) || !isfinite(at) || !isfinite(noise))
            return false;
        if (fabs(by_t) <= noise) {
            *t = at;
            *dt =
                noise > 0x1p-40 * l->size ? 4 * noise : noise; // not of first order alone
            *w = u < 0 ? 0 : u > 1 ? 1 : u;
            return true;
        }
    }
    return false;
}

// Both points of a circle of squared radius r2 at the height of a horizontal ray.
static void add_circle(const struct line *l, uint32_t i, double w)
{
    const struct revolve_segment *s = &l->r->segment[i];
    const double r2 = polynomial_value(s->r2, s->r2_degree, w);
    const double shift = -l->m / l->q, rest = r2 - (l->p - l->m * l->m / l->q);
    if (!(rest > 0))
        return;
    const double reach = sqrt(rest / l->q);
    const double dt = l->dt * (1 + (r2 + l->p) / fmax(rest, 0x1p-50 * (r2 + l->p)));
    for (int side = -1; side <= 1; side += 2) {
        double t = shift + side * reach, e = dt, v = w;
        sharpen(l, s, &t, &e, &v);
        add(l, t, e, REVOLVE_SEGMENT + i, v);
    }
}

static void sloped_segment(const struct line *l, uint32_t i);

// Whether the heights of the line within the shape are a small part of the segment at w.
static bool is_narrow(const struct line *l, const struct revolve_segment *s, double w)
{
    const double band = 2 * fabs(l->ray->d.y) * l->r->r_max / sqrt(l->q);
    return band < NARROW * fabs(polynomial_slope(s->h, s->h_degree, w));
}

static void flat_segment(const struct line *l, uint32_t i, bool flat)
{
    const struct revolve_segment *s = &l->r->segment[i];
    const double y = l->ray->o.y - l->ray->d.y * l->m / l->q; // where it passes the axis
    double f[4], w[8];
    for (int k = 0; k <= s->h_degree; k++)
        f[k] = s->h[k];
    f[0] -= y;
    bool above[2] = {s->h_end[0] >= y, s->h_end[1] >= y};
    const int n = crossings(f, s->h_degree, above, w);
    for (int k = 0; k < n && !flat; k++)
        if (!is_narrow(l, s, w[k])) {
            sloped_segment(l, i);
            return;
        }
    for (int k = 0; k < n; k++)
        add_circle(l, i, w[k]);
}

// Whether a nearly horizontal line passes all heights that it has within the shape between
// the segment's ends, or beside the segment.
static bool is_clear(const struct line *l, const struct revolve_segment *s)
{
    const double y = l->ray->o.y + l->nearest * l->ray->d.y;
    const double band = 2 * fabs(l->ray->d.y) * l->r->r_max / sqrt(l->q);
    return s->climbs && fabs(s->h_end[0] - y) > band && fabs(s->h_end[1] - y) > band;
}

// The sign of q s^2 + 2 Dy m s + Dy^2 (p - r^2), s = h - y: outside of the circle. A point
// on the axis has nothing inside.
static bool is_outside(const struct line *l, double h, double r2)
{
    const double s = h - l->y, dy = l->ray->d.y;
    const double rest = dy * dy * (l->shifted_p - r2);
    return r2 == 0 || l->q * s * s + 2 * dy * l->shifted_m * s + rest >= 0;
}

// Whether the line stays away from the cylinder around a segment, or around several.
static bool passes_by(const struct line *l, double low, double high, double most2)
{
    const double a = (low - l->ray->o.y) / l->ray->d.y;
    const double b = (high - l->ray->o.y) / l->ray->d.y;
    const double t0 = (a < b ? a : b) - l->reach, t1 = (a < b ? b : a) + l->reach;
    double t = l->nearest < t0 ? t0 : l->nearest > t1 ? t1 : l->nearest;
    t -= l->nearest;
    const double rho2 = l->nearest2 + l->q * t * t;
    return rho2 > most2 + GAMMA(64) * (l->p + rho2 + most2);
}

// The polynomial whose sign says on which side of the segment the line passes, and the heights
// above the line's. Inlined with constant degrees (lathes and sors have these), so that the
// loops unroll.
static inline __attribute__((always_inline)) void meeting(const struct line *l,
                                                          const struct revolve_segment *s,
                                                          int h_degree, int r2_degree,
                                                          double h[4], double f[7])
{
    const double dy = l->ray->d.y;
    for (int k = 0; k <= h_degree; k++)
        h[k] = s->h[k];
    h[0] -= l->y;
    for (int j = 0; j <= h_degree; j++) {
        for (int k = 0; k <= h_degree; k++)
            f[j + k] += l->q * h[j] * h[k];
        f[j] += 2 * dy * l->shifted_m * h[j];
    }
    f[0] += dy * dy * l->shifted_p;
    for (int k = 0; k <= r2_degree; k++)
        f[k] -= dy * dy * s->r2[k];
}

// How far two roots that rounding may have parted, or put at a joint, are off: q s^2 is then
// within the rounding of the polynomial, and all lies within the cylinder around the segment.
static double unsharpened(const struct line *l, const struct revolve_segment *s, double t,
                          double speed)
{
    const double h = fmax(fabs(s->low), fabs(s->high)) + fabs(l->y),
                 dy = fabs(l->ray->d.y);
    const double noise = GAMMA(64) * (l->q * h * h + dy * dy * (l->shifted_p + s->most2));
    const double least = 2 * FLAT * l->size / speed;
    if (dy > sqrt(l->q)) // steep: the square root is of the roundoff alone
        return least;
    const double within = fabs(t - l->nearest) + sqrt(s->most2 / l->q);
    return fmax(least, fmin(sqrt(noise / l->q) / dy, within));
}

static void sloped_segment(const struct line *l, uint32_t i)
{
    const struct revolve_segment *s = &l->r->segment[i];
    const double dy = l->ray->d.y;
    if (s->most2 == 0 || passes_by(l, s->low, s->high, s->most2))
        return;
    double f[7] = {0}, h[4] = {0}, w[8];
    const int degree = 2 * s->h_degree > s->r2_degree ? 2 * s->h_degree : s->r2_degree;
    if (s->h_degree == 1 && s->r2_degree == 2)
        meeting(l, s, 1, 2, h, f);
    else if (s->h_degree == 1)
        meeting(l, s, 1, 3, h, f);
    else if (s->h_degree == 2)
        meeting(l, s, 2, 4, h, f);
    else
        meeting(l, s, 3, 6, h, f);
    bool above[2] = {is_outside(l, s->h_end[0], s->r2_end[0]),
                     is_outside(l, s->h_end[1], s->r2_end[1])};
    for (int n = crossings(f, degree, above, w); n > 0; n--) {
        double at = w[n - 1];
        double t = l->shift + polynomial_value(h, s->h_degree, at) / dy;
        const double speed = sqrt(l->q + dy * dy);
        double dt = l->dt / fabs(dy) * speed;
        if (!sharpen(l, s, &t, &dt, &at))
            dt += unsharpened(l, s, t, speed);
        add(l, t, dt, REVOLVE_SEGMENT + i, at);
    }
}

static void cap(const struct line *l, uint32_t part, double h, double r2)
{
    const double t = (h - l->ray->o.y) / l->ray->d.y;
    // The same function as the wall's, so that the rim is met once.
    if (!is_outside(l, h, r2))
        add(l, t, l->dt / fabs(l->ray->d.y), part, 0);
}

// What is entered or left; b->u turns the profile's normal outward.
static void orient(const struct line *l, struct boundary *b, bool in)
{
    b->crossing = in ? CROSS_EXIT : CROSS_ENTER;
    if (b->part < REVOLVE_SEGMENT) {
        b->drawn = l->r->caps_drawn;
        b->u = (l->ray->d.y < 0) == !in ? 1 : -1;
        return;
    }
    const struct vec3 p = ray_at(l->ray, b->t);
    struct surface_point s = {.want_uv = false};
    b->u = 1;
    revolve_surface(l->r, b, p, &s);
    if ((vec3_dot(s.ng, l->ray->d) < 0) == in)
        b->u = -1;
}

// Toggles along the sorted crossings.
static void alternate(const struct line *l, uint32_t from)
{
    bool in = false;
    for (uint32_t i = from; i < l->out->count; i++) {
        orient(l, &l->out->at[i], in);
        in = !in;
    }
    if (in) // an odd number: a crossing was lost to rounding at the very rim
        l->out->count--;
}

static struct line line_of(const struct revolve *r, const struct ray *ray,
                           struct boundary_list *out)
{
    struct line l = {.r = r, .ray = ray, .out = out};
    const struct vec3 o = ray->o, d = ray->d;
    l.q = d.x * d.x + d.z * d.z;
    l.m = d.x * o.x + d.z * o.z;
    l.p = o.x * o.x + o.z * o.z;
    const double size =
        fmax(vec3_max_abs(o), fmax(r->r_max, fmax(fabs(r->h_min), fabs(r->h_max))));
    l.size = size;
    l.dt = GAMMA(64) * size / sqrt(l.q + d.y * d.y);
    l.flat = fabs(d.y) <= FLAT * sqrt(l.q);
    if (l.flat)
        l.dt += fabs(d.y) * r->r_max / l.q;
    l.nearest = l.q > 0 ? -l.m / l.q : 0;
    const double x = o.x + l.nearest * d.x, z = o.z + l.nearest * d.z;
    l.nearest2 = x * x + z * z;
    const bool near = fabs(l.nearest * d.y) <= size;
    l.shift = near ? l.nearest : 0;
    l.y = o.y + l.shift * d.y;
    l.shifted_m = near ? 0 : l.m;
    l.shifted_p = near ? l.nearest2 : l.p;
    l.reach = GAMMA(16) * size / fabs(d.y);
    return l;
}

bool revolve_is_closed(const struct revolve *r)
{
    return r->closed || r->caps_drawn || !r->count ||
           (r->segment[0].r2_end[0] == 0 && r->segment[r->count - 1].r2_end[1] == 0);
}

static void meet_caps(const struct line *l)
{
    const struct revolve *r = l->r;
    if (l->flat || r->closed || !r->count)
        return;
    const struct revolve_segment *last = &r->segment[r->count - 1];
    cap(l, REVOLVE_FIRST_CAP, r->segment[0].h_end[0], r->segment[0].r2_end[0]);
    cap(l, REVOLVE_LAST_CAP, last->h_end[1], last->r2_end[1]);
}

void revolve_intersect(const struct revolve *r, const struct ray *ray,
                       struct boundary_list *out)
{
    const struct line l = line_of(r, ray, out);
    const uint32_t from = out->count;
    const bool nearly = fabs(ray->d.y) <= NEARLY_FLAT * sqrt(l.q);
    for (uint32_t i = 0; i < r->count; i++) {
        const struct revolve_block *b = &r->block[i / REVOLVE_BLOCK];
        if (!nearly && i % REVOLVE_BLOCK == 0 && passes_by(&l, b->low, b->high, b->most2))
            i += REVOLVE_BLOCK - 1;
        else if (l.flat || (nearly && is_clear(&l, &r->segment[i])))
            flat_segment(&l, i, l.flat);
        else
            sloped_segment(&l, i);
    }
    meet_caps(&l);
    boundary_list_sort(out, from);
    alternate(&l, from);
}

unsigned revolve_closest8(const struct shape_kernels *k, const struct shape_ops *ops,
                          const void *shape, const struct shape_rays *rays,
                          unsigned lanes, bool any, struct shape_hits *out)
{
    unsigned odd;
    const unsigned met = k->revolve(shape, rays, lanes, any, out, &odd);
    return met | shape_lanes_alone(ops, shape, rays, odd, out);
}

void revolve_surface(const struct revolve *r, const struct boundary *b, struct vec3 p,
                     struct surface_point *out)
{
    const double rho2 = p.x * p.x + p.z * p.z;
    out->p = p;
    if (out->want_uv) {
        const double turn = rho2 > 0 ? det_atan2(p.z, p.x) / (2 * PI) : 0;
        out->uv.u = turn < 0 ? turn + 1 : turn;
    }
    if (b->part < REVOLVE_SEGMENT) {
        out->ng = out->ns = vec3(0, b->u, 0);
        // From -1 at the axis to 0 at the first rim, from 1 at the last rim to 2.
        const bool last = b->part == REVOLVE_LAST_CAP;
        const double rim2 =
            last ? r->segment[r->count - 1].r2_end[1] : r->segment[0].r2_end[0];
        const double share = rim2 > 0 ? fmin(1, sqrt(rho2 / rim2)) : 1;
        out->uv.v = last ? 2 - share : share - 1;
        return;
    }
    const uint32_t i = b->part - REVOLVE_SEGMENT;
    const struct revolve_segment *s = &r->segment[i];
    double dh = 0, dr2 = 0;
    for (int k = s->h_degree; k > 0; k--)
        dh = dh * b->v + k * s->h[k];
    for (int k = s->r2_degree; k > 0; k--)
        dr2 = dr2 * b->v + k * s->r2[k];
    struct vec3 n = vec3(dh * p.x, -0.5 * dr2, dh * p.z);
    if (vec3_dot(n, n) == 0)
        n = vec3(0, 1, 0); // on the axis
    out->ng = out->ns = vec3_scale(b->u, vec3_normalize(n));
    out->uv.v = fmin(1, (i + b->v) / r->count);
}
