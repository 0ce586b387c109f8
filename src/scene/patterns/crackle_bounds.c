// Bounds of crackle over a box. In one cell of the lattice the points that count are always
// the same, so that the distance to the i-th nearest is continuous and at most as steep as
// the metric: it lies between the i-th smallest of the least and of the largest distances of
// all points, and has the slopes of those points that may be the i-th. The mean value form
// makes bounds of small boxes tight. Boxes in several cells are looked at cell by cell.
#include <string.h>

#include "scene/patterns/cellular.h"
#include "scene/patterns/crackle.h"

enum { BASES_MAX = 27 };

// Distances are rounded by less.
#define DISTANCE_SLACK 0x1p-48

// A point: its place as seen from the box, and the sums of its powers.
struct candidate {
    struct interval e[3];
    double least, most, middle;
    struct vec3 p;
};

struct search {
    struct crackle_power power;
    struct interval box[3]; // the part in the base cell
    double base[3], slack;
    int wanted, count;
    double least[3], most[3], middle[3]; // the smallest of all points, ascending
    struct candidate found[CRACKLE_CELLS];
};

static double raised(struct crackle_power p, double x)
{
    return p.twice == 4 ? x * x : p.twice == 2 ? x : crackle_raised(p, x);
}

static void keep(double d[3], double v)
{
    const double second = fmax(d[0], v), third = fmax(d[1], second);
    d[0] = fmin(d[0], v);
    d[1] = fmin(d[1], second);
    d[2] = fmin(d[2], third);
}

static void look_at(struct search *s, struct vec3 q)
{
    struct candidate c = {.p = q};
    for (int k = 0; k < 3; k++) {
        const double v = vec3_axis(q, k);
        const struct interval e =
            interval(v - s->box[k].hi - s->slack, v - s->box[k].lo + s->slack);
        const double near = e.lo > 0 ? e.lo : e.hi < 0 ? -e.hi : 0;
        c.e[k] = e;
        c.least += raised(s->power, near);
        c.most += raised(s->power, interval_size(e));
        c.middle += raised(s->power, fabs(interval_middle(e)));
    }
    if (c.least > s->most[s->wanted - 1])
        return;
    keep(s->least, c.least);
    keep(s->most, c.most);
    keep(s->middle, c.middle);
    s->found[s->count++] = c;
}

// All points that may be among the wanted nearest to any place of the part.
static void find(struct search *s)
{
    double far[3][5];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 5; i++) {
            const double low = s->base[k] + i - 2;
            const double d =
                fmax(low - s->box[k].hi, s->box[k].lo - (low + 1)) - s->slack;
            far[k][i] = d > 0 ? raised(s->power, d) : 0;
        }
    for (int i = 0; i < 3; i++)
        s->least[i] = s->most[i] = s->middle[i] = DBL_MAX;
    s->count = 0;
    for (int i = 0; i < CRACKLE_CELLS; i++) {
        const struct crackle_cell o = crackle_cells[i];
        if (far[0][o.x + 2] + far[1][o.y + 2] + far[2][o.z + 2] > s->most[s->wanted - 1])
            continue;
        look_at(s,
                noise_cell_point(s->base[0] + o.x, s->base[1] + o.y, s->base[2] + o.z));
    }
}

static struct interval distances(const struct pattern *p, double least, double most)
{
    const double slack = (interval_size(interval(p->offset, 1)) + 4) * DISTANCE_SLACK;
    const double a = crackle_distance(least, p->metric, p->offset),
                 b = least == most ? a : crackle_distance(most, p->metric, p->offset);
    return interval_widened(a - slack, b + slack, DISTANCE_SLACK);
}

// The slope of a point's distance d along an axis: -e / |e| (|e| / d)^(metric - 1).
static struct interval slope_of(const struct pattern *p, struct interval e,
                                struct interval d)
{
    if (p->metric == 1)
        return interval(e.hi > 0 ? -1 : 1, e.lo < 0 ? 1 : -1);
    const struct interval size = interval_abs(e);
    struct interval r =
        interval(d.hi > 0 ? size.lo / d.hi : 0, d.lo > 0 ? size.hi / d.lo : INFINITY);
    if (p->offset >= 0)
        r = interval(fmin(r.lo, 1), fmin(r.hi, 1));
    if (p->metric != 2) {
        const double power = p->metric - 1.0;
        const double a = r.lo > 0 ? det_pow(r.lo, power) : power > 0 ? 0 : INFINITY;
        const double b = r.hi < INFINITY ? det_pow(r.hi, power)
                         : power > 0     ? INFINITY
                                         : 0;
        r = interval(fmin(a, b), fmax(a, b));
    }
    r = interval_widened(r.lo, r.hi, DISTANCE_SLACK);
    return interval(e.hi > 0 ? -r.hi : r.lo, e.lo < 0 ? r.hi : -r.lo);
}

// Of the i-th nearest.
static void slopes_of(const struct search *s, const struct pattern *p, int i,
                      struct interval d[3])
{
    bool any = false;
    for (int j = 0; j < s->count; j++) {
        const struct candidate *c = &s->found[j];
        if (c->least > s->most[i] || c->most < s->least[i])
            continue;
        const struct interval length = distances(p, c->least, c->most);
        for (int k = 0; k < 3; k++) {
            const struct interval one = slope_of(p, c->e[k], length);
            d[k] = any ? interval_hull(d[k], one) : one;
        }
        any = true;
    }
}

static struct interval clamped(struct interval v, struct interval by[3], bool slopes)
{
    for (int k = 0; slopes && k < 3; k++) {
        if (v.hi < 0 || v.lo > 1)
            by[k] = interval_point(0);
        else if (v.lo < 0 || v.hi > 1)
            by[k] = interval_hull(by[k], interval_point(0));
    }
    return interval(clamp01(v.lo), clamp01(v.hi));
}

// The value, and its slopes if wanted, in the part of the box.
static struct interval form_bounds(const struct search *s, const struct pattern *p,
                                   struct interval by[3], bool slopes)
{
    const double form[3] = {p->vector.x, p->vector.y, p->vector.z};
    struct interval v = interval_point(0), mean = v;
    for (int k = 0; k < 3; k++)
        by[k] = interval_point(0);
    for (int i = 0; i < 3; i++) {
        if (form[i] == 0)
            continue;
        const struct interval f = interval_point(form[i]);
        v = interval_add(v, interval_multiply(f, distances(p, s->least[i], s->most[i])));
        if (!slopes)
            continue;
        mean = interval_add(
            mean, interval_multiply(f, distances(p, s->middle[i], s->middle[i])));
        struct interval d[3];
        slopes_of(s, p, i, d);
        for (int k = 0; k < 3; k++)
            by[k] = interval_add(by[k], interval_multiply(f, d[k]));
    }
    if (slopes) {
        for (int k = 0; k < 3; k++) {
            const double half = 0.5 * interval_width(s->box[k]) + s->slack;
            mean = interval_add(mean, interval_multiply(by[k], interval(-half, half)));
        }
        v = interval(fmax(v.lo, mean.lo), fmin(v.hi, mean.hi));
    }
    return clamped(v, by, slopes);
}

// Solid: the noise of the nearest points.
static struct interval solid_bounds(const struct search *s, const struct pattern *p,
                                    struct interval by[3])
{
    struct interval v = interval(1, 0);
    int count = 0;
    for (int i = 0; i < s->count; i++) {
        if (s->found[i].least > s->most[0])
            continue;
        const double n = clamp01(noise_value(s->found[i].p, pattern_noise_generator(p)));
        v = interval(fmin(v.lo, n), fmax(v.hi, n));
        count++;
    }
    for (int k = 0; k < 3; k++)
        by[k] = count == 1 ? interval_point(0) : interval_whole();
    return v;
}

static bool is_known(const struct interval *in, double first[3], double last[3])
{
    double count = 1;
    for (int k = 0; k < 3; k++) {
        if (!(interval_size(in[k]) < 0x1p40))
            return false;
        first[k] = floor(in[k].lo - PATTERN_EDGE);
        last[k] = floor(in[k].hi - PATTERN_EDGE);
        count *= last[k] - first[k] + 1;
    }
    return count <= BASES_MAX;
}

static void bounds(const void *data, const struct interval *in, struct interval *out,
                   struct interval *partial)
{
    const struct pattern *p = data;
    const double metric = p->metric;
    // Else there may be no such distance.
    const bool good = metric > 0 && (p->offset >= 0 || metric == 1 || metric == 2);
    double first[3], last[3], c[3];
    out[0] = good || p->solid ? interval(0, 1) : interval_whole();
    for (int k = 0; partial && k < 3; k++)
        partial[k] = interval_whole();
    if (!good || !is_known(in, first, last))
        return;
    struct search s; // most of it is not used: nothing is cleared
    s.power = crackle_power(metric);
    s.wanted = crackle_wanted(p);
    // No point that another cell does not know is nearer; beyond, its distance may jump.
    const double shared = fmin(2, det_pow(2, metric)) - 1e-6;
    bool any = false, jumps = false;
    struct interval by[3];
    for (c[0] = first[0]; c[0] <= last[0]; c[0]++)
        for (c[1] = first[1]; c[1] <= last[1]; c[1]++)
            for (c[2] = first[2]; c[2] <= last[2]; c[2]++) {
                double far = 4;
                for (int k = 0; k < 3; k++) {
                    s.base[k] = c[k];
                    s.box[k] = interval(fmax(in[k].lo, c[k]),
                                        fmin(in[k].hi, c[k] + 1 + 2 * PATTERN_EDGE));
                    far = fmax(far, 4 + fabs(c[k]));
                }
                s.slack = 4 * DBL_EPSILON * far;
                find(&s);
                const struct interval v = p->solid
                                              ? solid_bounds(&s, p, by)
                                              : form_bounds(&s, p, by, partial != NULL);
                jumps |= s.most[s.wanted - 1] >= shared;
                for (int k = 0; partial && k < 3; k++)
                    partial[k] = any ? interval_hull(partial[k], by[k]) : by[k];
                out[0] = any ? interval_hull(out[0], v) : v;
                any = true;
            }
    const bool several = first[0] < last[0] || first[1] < last[1] || first[2] < last[2];
    for (int k = 0; partial && k < 3; k++)
        if (several && (jumps || (p->solid && !interval_is_point(out[0]))))
            partial[k] = interval_whole();
}

enum { METRIC_MOST = 16 }; // of the powers in lanes

static bool bounds8(const struct noise_kernels *k, const void *data,
                    const struct tape_range8 *in, struct tape_range8 *out,
                    struct tape_range8 *partial)
{
    const struct pattern *p = data;
    if (p->solid || !(p->metric >= 1 && p->metric <= METRIC_MOST) ||
        !(p->offset >= 0 || p->metric == 1 || p->metric == 2))
        return false;
    const struct noise_cells_form f = {.metric = p->metric,
                                       .offset = p->offset,
                                       .form = {p->vector.x, p->vector.y, p->vector.z},
                                       .twice = crackle_power(p->metric).twice,
                                       .wanted = crackle_wanted(p)};
    double lo[3][TAPE_LANES], hi[3][TAPE_LANES];
    struct noise_bounds8 b;
    for (int a = 0; a < 3; a++) {
        memcpy(lo[a], in[a].lo, sizeof lo[a]);
        memcpy(hi[a], in[a].hi, sizeof hi[a]);
    }
    k->cells_bounds(&f, (const double(*)[TAPE_LANES])lo, (const double(*)[TAPE_LANES])hi,
                    partial != NULL, &b);
    memcpy(out->lo, b.lo, sizeof b.lo);
    memcpy(out->hi, b.hi, sizeof b.hi);
    for (int a = 0; partial && a < 3; a++) {
        memcpy(partial[a].lo, b.slope_lo[a], sizeof b.slope_lo[a]);
        memcpy(partial[a].hi, b.slope_hi[a], sizeof b.slope_hi[a]);
    }
    return true;
}

const struct tape_extern crackle_bounds = {
    .name = "crackle", .arguments = 3, .width = 1, .bounds = bounds, .bounds8 = bounds8};
