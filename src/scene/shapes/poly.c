// poly { n, <c...> }, cubic { <20> }, quartic { <35> }, polynomial { n, xyz(i,j,k): c, ... }
//
// The set where a polynomial in x, y, z is negative. Coefficients come by falling power
// of x, then of y, then of z (spec/shapes.md 4.8).
#include <math.h>

#include "base/arena.h"
#include "math/gamma.h"
#include "math/polynomial.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shape_kernels.h"
#include "scene/shapes/poly.h"

static size_t term_count(int n) { return (size_t)((n + 1) * (n + 2) * (n + 3) / 6); }

// p = p * (o + d t)
static void times_line(struct line_poly *p, double o, double d)
{
    if (p->degree < 0)
        return;
    p->degree++;
    p->c[p->degree] = d * p->c[p->degree - 1];
    for (int i = p->degree - 1; i > 0; i--)
        p->c[i] = o * p->c[i] + d * p->c[i - 1];
    p->c[0] *= o;
}

static void add_poly(struct line_poly *p, const struct line_poly *q)
{
    for (int i = p->degree + 1; i <= q->degree; i++)
        p->c[i] = 0;
    for (int i = 0; i <= q->degree; i++)
        p->c[i] += q->c[i];
    p->degree = q->degree > p->degree ? q->degree : p->degree;
}

static void add_constant(struct line_poly *p, double c)
{
    if (c == 0)
        return;
    p->c[0] = p->degree < 0 ? c : p->c[0] + c;
    p->degree = p->degree < 0 ? 0 : p->degree;
}

// Moves a Horner scheme on by a number of powers.
static void times_power(struct line_poly *p, double o, double d, int power)
{
    while (power-- > 0)
        times_line(p, o, d);
}

// As nested Horner schemes in x, y and z.
void poly_along(const struct poly *s, struct vec3 o, struct vec3 d, struct line_poly *out)
{
    struct line_poly in_y, in_z;
    int x = s->order;
    out->degree = -1;
    for (uint32_t i = 0; i < s->rows;) {
        const int at = s->row[i].x;
        int y = s->row[i].y;
        in_y.degree = -1;
        for (; i < s->rows && s->row[i].x == at; i++) {
            const struct poly_row *r = &s->row[i];
            times_power(&in_y, o.y, d.y, y - r->y);
            y = r->y;
            in_z.degree = -1;
            for (int k = r->top; k >= 0; k--) {
                times_line(&in_z, o.z, d.z);
                add_constant(&in_z, r->c[r->top - k]);
            }
            add_poly(&in_y, &in_z);
        }
        times_power(&in_y, o.y, d.y, y);
        times_power(out, o.x, d.x, x - at);
        x = at;
        add_poly(out, &in_y);
    }
    times_power(out, o.x, d.x, x);
    if (out->degree < 0)
        *out = (struct line_poly){.degree = 0, .c = {0}};
}

static double power(double x, int n)
{
    double v = 1;
    for (; n > 0; n /= 2, x *= x)
        v *= n % 2 ? x : 1;
    return v;
}

static double value_at(const struct poly *s, struct vec3 p)
{
    double sum = 0;
    for (uint32_t i = 0; i < s->rows; i++) {
        const struct poly_row *r = &s->row[i];
        double z = 0;
        for (int k = 0; k <= r->top; k++)
            z = z * p.z + r->c[k];
        sum += power(p.x, r->x) * power(p.y, r->y) * z;
    }
    return sum;
}

double poly_magnitude(const struct poly *s, struct vec3 size)
{
    double sum = 0;
    for (uint32_t i = 0; i < s->rows; i++) {
        const struct poly_row *r = &s->row[i];
        double z = 0;
        for (int k = 0; k <= r->top; k++)
            z = z * size.z + fabs(r->c[k]);
        sum += power(size.x, r->x) * power(size.y, r->y) * z;
    }
    return sum;
}

// What the value at o + t u may be off by because the coefficients along the line are sums in
// which terms cancel.
static double lost_at(const struct poly *s, struct vec3 o, struct vec3 u, double t)
{
    const double a = fabs(t);
    return 4 * s->order * ROUNDOFF *
           poly_magnitude(s, vec3(fabs(o.x) + a * fabs(u.x), fabs(o.y) + a * fabs(u.y),
                                  fabs(o.z) + a * fabs(u.z)));
}

static struct aabb bounds(const void *shape) { return ((const struct poly *)shape)->box; }

static bool inside(const void *shape, struct vec3 p) { return value_at(shape, p) <= 0; }

// Where the line is in the box of the set.
static bool in_box(const struct aabb *box, struct vec3 o, struct vec3 u, double *lo,
                   double *hi)
{
    for (int i = 0; i < 3; i++) {
        const double at = vec3_axis(o, i), d = vec3_axis(u, i);
        const double min = vec3_axis(box->min, i), max = vec3_axis(box->max, i);
        if (d == 0) {
            if (at < min || at > max)
                return false;
            continue;
        }
        *lo = fmax(*lo, ((d > 0 ? min : max) - at) / d);
        *hi = fmin(*hi, ((d > 0 ? max : min) - at) / d);
    }
    return *lo < *hi;
}

// A root whose error is dt, by one step of Newton's method from the value of the terms at its
// point: along the line terms cancel that are small there. A thin set's far side is less than
// 1e-5 away, and a ray that starts on it must not find its own root in front.
static double sharpened(const struct poly *s, const struct line_poly *p, struct vec3 o,
                        struct vec3 u, double shift, double t, double dt)
{
    if (!(POLY_ROUGH * 0x1p-51 * (fabs(shift) + fabs(t)) < dt))
        return t;
    double slope = 0, v = 0;
    for (int i = p->degree; i >= 0; i--) {
        slope = slope * t + v;
        v = v * t + p->c[i];
    }
    const double step = value_at(s, vec3_mad(o, t, u)) / slope;
    return fabs(step) <= dt ? t - step : t;
}

static int roots_on(const struct poly *s, struct vec3 o, struct vec3 u, double shift,
                    double lo, double hi, struct polynomial_root *root)
{
    struct line_poly p;
    poly_along(s, o, u, &p);
    const double far = polynomial_root_bound(p.c, p.degree);
    lo = fmax(lo, -far);
    hi = fmin(hi, far);
    if (s->order > POLY_LOW_ORDER)
        return lo < hi ? poly_line_roots(s, o, u, lo, hi, root) : 0;
    const int n = polynomial_roots(p.c, p.degree, lo, hi, 4 * s->order, root);
    double limit = -HUGE_VAL; // half way between roots, so that they stay in order
    for (int i = 0; i < n; i++) {
        const double t = root[i].t, from = limit;
        limit = i + 1 < n ? .5 * (t + root[i + 1].t) : HUGE_VAL;
        root[i].dt += polynomial_root_error(p.c, p.degree, t, lost_at(s, o, u, t));
        const double sharp = sharpened(s, &p, o, u, shift, t, root[i].dt);
        if (from < sharp && sharp < limit)
            root[i].t = sharp;
    }
    return n;
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct poly *s = shape;
    // From the point of the line nearest to the origin, with a unit direction: the
    // coefficients are then of the size of the surface, not of the ray's distance.
    const double length = vec3_length(ray->d);
    const struct vec3 u = vec3_scale(1 / length, ray->d);
    const double to_nearest = -vec3_dot(ray->o, u);
    const struct vec3 o = vec3_mad(ray->o, to_nearest, u);
    double lo = -HUGE_VAL, hi = HUGE_VAL;
    if ((s->compact && !in_box(&s->box, o, u, &lo, &hi)) || boundary_list_gives_up(out))
        return;
    struct polynomial_root root[POLYNOMIAL_DEGREE_MAX];
    const int n = roots_on(s, o, u, to_nearest, lo, hi, root);
    for (int i = 0; i < n; i++) {
        const double dt = root[i].dt + 0x1p-51 * (fabs(to_nearest) + fabs(root[i].t));
        boundary_list_add(out, (root[i].t + to_nearest) / length, dt / length,
                          root[i].rising ? CROSS_EXIT : CROSS_ENTER, 0);
    }
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    return k->poly(shape, rays, lanes, any, out);
}

static unsigned lines8(const struct shape_kernels *k, const void *shape,
                       const struct shape_rays *rays, unsigned lanes,
                       struct shape_lines *out)
{
    return k->poly_lines(shape, rays, lanes, out);
}

// A value and its gradient, on their way through the nested schemes.
struct jet {
    double v;
    struct vec3 g;
};

// j = j * x, of the coordinate along `axis`.
static void times_coordinate(struct jet *j, double x, struct vec3 axis)
{
    j->g = vec3_mad(vec3_scale(x, j->g), j->v, axis);
    j->v *= x;
}

static void times_coordinates(struct jet *j, double x, struct vec3 axis, int power)
{
    while (power-- > 0)
        times_coordinate(j, x, axis);
}

// The gradient by the schemes of poly_along, differentiated along each axis.
static struct vec3 gradient(const struct poly *s, struct vec3 p)
{
    const struct vec3 ex = {1, 0, 0}, ey = {0, 1, 0};
    struct jet sum = {0};
    int x = s->order;
    for (uint32_t i = 0; i < s->rows;) {
        const int at = s->row[i].x;
        int y = s->row[i].y;
        struct jet in_y = {0};
        for (; i < s->rows && s->row[i].x == at; i++) {
            const struct poly_row *r = &s->row[i];
            double v = 0, slope = 0; // in z
            times_coordinates(&in_y, p.y, ey, y - r->y);
            y = r->y;
            for (int k = 0; k <= r->top; k++) {
                slope = slope * p.z + v;
                v = v * p.z + r->c[k];
            }
            in_y.v += v;
            in_y.g.z += slope;
        }
        times_coordinates(&in_y, p.y, ey, y);
        times_coordinates(&sum, p.x, ex, x - at);
        x = at;
        sum.v += in_y.v;
        sum.g = vec3_add(sum.g, in_y.g);
    }
    times_coordinates(&sum, p.x, ex, x);
    return sum.g;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    struct vec3 n = vec3_normalize(gradient(shape, p));
    if (vec3_dot(n, n) == 0)
        n = vec3(1, 0, 0); // a singular point has no normal; POV-Ray's choice
    out->p = p;
    out->ng = out->ns = n;
    out->uv = (struct vec2){p.x, p.y};
}

// Fills the rows from the coefficients.
static void finish(struct poly *s, struct arena *arena)
{
    const int n = s->order;
    const size_t most = (size_t)((n + 1) * (n + 2) / 2);
    struct poly_row *row = arena_new_array(arena, struct poly_row, most);
    const double *c = s->coefficient;
    for (int x = n; x >= 0; x--)
        for (int y = n - x; y >= 0; y--) {
            struct poly_row r = {x, y, n - x - y, c};
            c += r.top + 1;
            for (; r.top > 0 && *r.c == 0; r.top--)
                r.c++;
            if (*r.c != 0)
                row[s->rows++] = r;
        }
    s->row = row;
    s->box = poly_bounds(s);
    s->compact = aabb_is_finite(s->box);
}

static bool read_terms(struct poly *s, struct args *args)
{
    double *c = arena_new_array(args_arena(args), double, term_count(s->order));
    s->coefficient = c;
    if (!args_floats(args, "coefficients", c, term_count(s->order)))
        return false;
    finish(s, args_arena(args));
    return true;
}

static bool read_order(struct poly *s, struct args *args)
{
    long n;
    if (!args_int(args, "order", &n))
        return false;
    if (n < 2 || n > POLYNOMIAL_DEGREE_MAX) {
        args_reject(args, "the order must be from 2 to 35");
        return false;
    }
    s->order = (int)n;
    return true;
}

static bool build_poly(void *shape, struct args *args)
{
    return read_order(shape, args) && read_terms(shape, args);
}

// The place of x^i y^j z^k among the coefficients.
static size_t term_index(int order, const long power[3])
{
    const long a = order - power[0], b = a - power[1], c = b - power[2];
    return (size_t)((a + 2) * (a + 1) * a / 6 + (b + 1) * b / 2 + c);
}

static bool read_term(struct poly *s, struct args *term, double *c)
{
    static const char *const role[] = {"power of x", "power of y", "power of z"};
    long power[3];
    double value;
    for (int i = 0; i < 3; i++)
        if (!args_int(term, role[i], &power[i]))
            return false;
    if (!args_float(term, "coefficient", &value))
        return false;
    for (int i = 0; i < 3; i++)
        if (power[i] < 0 || power[i] > s->order ||
            power[0] + power[1] + power[2] > s->order) {
            args_reject(term, "the powers of a term must not be negative nor exceed the "
                              "order");
            return false;
        }
    c[term_index(s->order, power)] = value;
    return true;
}

static bool build_polynomial(void *shape, struct args *args)
{
    struct poly *s = shape;
    if (!read_order(s, args))
        return false;
    double *c = arena_new_array(args_arena(args), double, term_count(s->order));
    s->coefficient = c;
    for (struct args *term; (term = args_call(args, "xyz"));)
        if (!read_term(s, term, c))
            return false;
    finish(s, args_arena(args));
    return true;
}

static bool build_cubic(void *shape, struct args *args)
{
    struct poly *s = shape;
    s->order = 3;
    return read_terms(s, args);
}

static bool build_quartic(void *shape, struct args *args)
{
    struct poly *s = shape;
    s->order = 4;
    return read_terms(s, args);
}

static void print(const void *shape, FILE *out)
{
    const struct poly *s = shape;
    fprintf(out, "poly { %d, <", s->order);
    for (size_t i = 0; i < term_count(s->order); i++) {
        if (i)
            fputs(", ", out);
        shape_print_number(out, s->coefficient[i]);
    }
    fputs(">", out);
}

#define POLY_OPS(word)                                                                   \
    const struct shape_ops word##_ops = {                                                \
        .keyword = #word,                                                                \
        .size = sizeof(struct poly),                                                     \
        .flags = SHAPE_SOLID | SHAPE_STURM | SHAPE_BOUND_SHAPE,                          \
        .build = build_##word,                                                           \
        .bounds = bounds,                                                                \
        .inside = inside,                                                                \
        .intersect = intersect,                                                          \
        .closest8 = closest8,                                                            \
        .lines8 = lines8,                                                                \
        .surface = surface,                                                              \
        .print = print,                                                                  \
    }

POLY_OPS(poly);
POLY_OPS(cubic);
POLY_OPS(quartic);
POLY_OPS(polynomial);
