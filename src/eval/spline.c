// Splines (spec/language 4.15).

#include "eval/spline.h"

#include <string.h>

#include "base/arena.h"
#include "eval/expr.h"

bool spline_kind_of(enum word w, enum spline_kind *out)
{
    switch (w) {
    case WORD_linear_spline: *out = SPLINE_LINEAR; return true;
    case WORD_quadratic_spline: *out = SPLINE_QUADRATIC; return true;
    case WORD_cubic_spline: *out = SPLINE_CUBIC; return true;
    case WORD_natural_spline: *out = SPLINE_NATURAL; return true;
    default: return false;
    }
}

static void insert(struct spline *s, const struct spline_point *p)
{
    uint32_t i = s->count;
    while (i > 0 && s->point[i - 1].at > p->at)
        i--;
    if (i > 0 && s->point[i - 1].at == p->at) {
        if (i < s->count) // a repeat of the largest parameter is ignored
            s->point[i - 1] = *p;
        return;
    }
    memmove(&s->point[i + 1], &s->point[i], (s->count - i) * sizeof *s->point);
    s->point[i] = *p;
    s->count++;
}

// Second derivatives of the natural spline, component c: the tridiagonal system by
// elimination (Thomas); p[0..count) ascending, ends 0.
static void solve_natural(struct spline *s, double *upper, double *right, int c)
{
    struct spline_point *p = s->point;
    uint32_t m = s->count - 1;
    upper[0] = right[0] = 0;
    for (uint32_t i = 1; i < m; i++) {
        double before = p[i].at - p[i - 1].at, after = p[i + 1].at - p[i].at;
        double slope =
            (p[i + 1].p[c] - p[i].p[c]) / after - (p[i].p[c] - p[i - 1].p[c]) / before;
        double pivot = 2 * (before + after) - before * upper[i - 1];
        upper[i] = after / pivot;
        right[i] = (6 * slope - before * right[i - 1]) / pivot;
    }
    p[m].second[c] = 0;
    for (uint32_t i = m; i-- > 0;)
        p[i].second[c] = i ? right[i] - upper[i] * p[i + 1].second[c] : 0;
}

static bool read_items(struct eval *e, const struct ast *n, struct spline *s)
{
    while (n) {
        struct spline_point p = {0};
        int width;
        if (n->kind == AST_WORD && spline_kind_of(n->word, &s->kind)) {
            n = n->next;
            continue;
        }
        if (!n->next) {
            diag_at(e->diags, DIAG_EXPECTED_NUMBER, n->where, "no point after it");
            return false;
        }
        if (!eval_float(e, n, &p.at) || !eval_full(e, n->next, 2, p.p, &width))
            return false;
        if (width > s->width)
            s->width = width;
        insert(s, &p);
        n = n->next->next;
    }
    return true;
}

const struct value *spline_value(struct eval *e, const struct ast *block)
{
    const struct ast *n = block->list;
    struct spline *s = arena_new_struct(e->arena, struct spline);
    const struct spline *start = NULL;
    if (n && n->kind == AST_VALUE && n->value && n->value->kind == VALUE_SPLINE) {
        start = n->value->data;
        *s = *start;
        n = n->next;
    }
    size_t items = s->count;
    for (const struct ast *i = n; i; i = i->next)
        items++;
    s->point = arena_new_array(e->arena, struct spline_point, items + 1);
    if (start)
        memcpy(s->point, start->point, s->count * sizeof *s->point);
    if (s->width < 2)
        s->width = 2;
    if (!read_items(e, n, s))
        return NULL;
    if (!s->count) {
        diag_at(e->diags, DIAG_EMPTY_SPLINE, block->where, "");
        return NULL;
    }
    double *work = arena_new_array(e->parse, double, 2 * (size_t)s->count);
    for (int c = 0; c < 5 && s->count > 1; c++)
        solve_natural(s, work, work + s->count, c);
    return value_new_data(e->arena, VALUE_SPLINE, s);
}

static double quadratic(const struct spline_point *p, double t, int c)
{
    double a = t - p[0].at, b = t - p[1].at, d = t - p[2].at;
    double ab = p[0].at - p[1].at, ad = p[0].at - p[2].at, bd = p[1].at - p[2].at;
    return p[0].p[c] * (b * d) / (ab * ad) - p[1].p[c] * (a * d) / (ab * bd) +
           p[2].p[c] * (a * b) / (ad * bd);
}

static double natural(const struct spline_point *p, double t, int c)
{
    double h = p[1].at - p[0].at, s = t - p[0].at;
    double m0 = p[0].second[c], m1 = p[1].second[c];
    return p[0].p[c] + s * (-(h / 6) * (m1 + 2 * m0) + (p[1].p[c] - p[0].p[c]) / h +
                            s * (m0 / 2 + s * (m1 - m0) / (6 * h)));
}

// Hermite with Catmull-Rom slopes over p[1]..p[2].
static double catmull_rom(const struct spline_point *p, double t, int c)
{
    double s[3];
    for (int i = 0; i < 3; i++)
        s[i] = (p[i + 1].p[c] - p[i].p[c]) / (p[i + 1].at - p[i].at);
    double h = p[2].at - p[1].at, u = (t - p[1].at) / h;
    double d1 = h / 2 * (s[0] + s[1]), d2 = h / 2 * (s[1] + s[2]);
    return p[1].p[c] * ((2 * u - 3) * u * u + 1) + d1 * (((u - 2) * u + 1) * u) +
           p[2].p[c] * ((3 - 2 * u) * u * u) + d2 * ((u - 1) * u * u);
}

static double component(const struct spline *s, enum spline_kind kind, double t,
                        uint32_t i, int c)
{
    const struct spline_point *p = s->point + i;
    uint32_t m = s->count - 1;
    if (kind == SPLINE_CUBIC) {
        if (m == 1)
            return (p[0].p[c] + p[1].p[c]) / 2;
        if (i == 0)
            return s->point[1].p[c];
        return i + 1 >= m ? s->point[m - 1].p[c] : catmull_rom(p - 1, t, c);
    }
    if (kind == SPLINE_NATURAL)
        return natural(p, t, c);
    if (kind == SPLINE_QUADRATIC && m > 1)
        return quadratic(i ? p - 1 : p, t, c);
    return p[0].p[c] + (p[1].p[c] - p[0].p[c]) * (t - p[0].at) / (p[1].at - p[0].at);
}

void spline_at(const struct spline *s, enum spline_kind kind, double at, double out[5])
{
    uint32_t m = s->count - 1, i = 0;
    const struct spline_point *end = !m || at <= s->point[0].at ? &s->point[0]
                                     : at >= s->point[m].at     ? &s->point[m]
                                                                : NULL;
    if (end && (kind != SPLINE_CUBIC || !m)) {
        memcpy(out, end->p, 5 * sizeof *out);
        return;
    }
    uint32_t high = m; // point[i].at < at <= point[high].at
    while (high - i > 1) {
        uint32_t middle = (i + high) / 2;
        if (s->point[middle].at < at)
            i = middle;
        else
            high = middle;
    }
    for (int c = 0; c < 5; c++)
        out[c] = component(s, kind, at, i, c);
}

// ---- in functions -------------------------------------------------------------------

static void spline_value_at(const void *data, const double *in, double *out)
{
    const struct spline *s = data;
    double v[5];
    spline_at(s, s->kind, in[0], v);
    memcpy(out, v, (size_t)s->width * sizeof *out);
}

// A cubic over lo..hi by its values at four equal steps: its Bernstein coefficients and
// their differences hold it and its derivative.
static void cubic_bounds(const double f[4], double length, struct interval *v,
                         struct interval *slope)
{
    const double b[4] = {f[0], (-5 * f[0] + 18 * f[1] - 9 * f[2] + 2 * f[3]) / 6,
                         (2 * f[0] - 9 * f[1] + 18 * f[2] - 5 * f[3]) / 6, f[3]};
    double size = 0;
    *v = interval_point(b[0]);
    *slope = length > 0 ? interval_point(3 * (b[1] - b[0]) / length) : interval_whole();
    for (int i = 0; i < 4; i++) {
        *v = interval_hull(*v, interval_point(b[i]));
        if (i && length > 0)
            *slope =
                interval_hull(*slope, interval_point(3 * (b[i] - b[i - 1]) / length));
        size = fmax(size, fabs(b[i]));
    }
    const double slack = 64 * INTERVAL_ROUNDING * size;
    *v = interval(v->lo - slack, v->hi + slack);
    if (length > 0)
        *slope = interval(slope->lo - 6 * slack / length, slope->hi + 6 * slack / length);
}

static void piece(const struct spline *s, int64_t i, double lo, double hi,
                  struct interval *out, struct interval *partial)
{
    double f[4][5];
    const int64_t m = (int64_t)s->count - 1;
    for (int k = 0; k < 4; k++) {
        const double t = k == 3 ? hi : lo + (hi - lo) * k / 3;
        if (i < 0 || i >= m)
            spline_at(s, s->kind, i < 0 ? -INFINITY : INFINITY, f[k]);
        else
            for (int c = 0; c < s->width; c++)
                f[k][c] = component(s, s->kind, t, (uint32_t)i, c);
    }
    for (int c = 0; c < s->width; c++) {
        const double v[4] = {f[0][c], f[1][c], f[2][c], f[3][c]};
        cubic_bounds(v, hi - lo, &out[c], &partial[c]);
    }
}

// Two pieces meet: a gap between them is a jump.
static void join(const struct spline *s, struct interval *out, struct interval *partial,
                 const struct interval *v, const struct interval *slope)
{
    for (int c = 0; c < s->width; c++) {
        out[c] = interval_hull(out[c], v[c]);
        partial[c] = interval_hull(partial[c], slope[c]);
    }
}

static bool jumps(const struct spline *s, int64_t i, double t)
{
    struct interval a[5], b[5], unused[5];
    piece(s, i - 1, t, t, a, unused);
    piece(s, i, t, t, b, unused);
    for (int c = 0; c < s->width; c++)
        if (a[c].lo > b[c].hi || b[c].lo > a[c].hi)
            return true;
    return false;
}

static void spline_bounds(const void *data, const struct interval *in,
                          struct interval *out, struct interval *partial)
{
    const struct spline *s = data;
    struct interval v[5], slope[5], unused[5];
    bool first = true, jump = false;
    if (!partial)
        partial = unused;
    if (s->count == 1) {
        piece(s, 0, in->lo, in->hi, out, partial);
        return;
    }
    for (int64_t i = -1; i < (int64_t)s->count; i++) {
        const double from = i < 0 ? -INFINITY : s->point[i].at;
        const double to = i + 1 < (int64_t)s->count ? s->point[i + 1].at : INFINITY;
        if (from > in->hi || to < in->lo)
            continue;
        jump |= i >= 0 && from >= in->lo && jumps(s, i, from);
        piece(s, i, fmax(from, in->lo), fmin(to, in->hi), first ? out : v,
              first ? partial : slope);
        if (!first)
            join(s, out, partial, v, slope);
        first = false;
    }
    for (int c = 0; c < s->width; c++)
        if (jump)
            partial[c] = interval_whole();
}

#define SPLINE_EXTERN(n)                                                                 \
    {                                                                                    \
        .name = "spline", .arguments = 1, .width = n, .value = spline_value_at,          \
        .bounds = spline_bounds                                                          \
    }
const struct tape_extern spline_extern[6] = {[2] = SPLINE_EXTERN(2),
                                             [3] = SPLINE_EXTERN(3),
                                             [4] = SPLINE_EXTERN(4),
                                             [5] = SPLINE_EXTERN(5)};
