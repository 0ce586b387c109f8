// crackle: distances to the nearest random points (Worley, A Cellular Texture Basis
// Function, 1996), spec/textures 5.3
//
// Cells are visited from the middle outwards and left out where none of their points can
// be among the nearest. Distances of a metric p other than 1 and 2 need powers: the
// Euclidean length, which differs from them by a factor 3^|1/p - 1/2| at the most, tells
// which few points they are worth while for.

#include "scene/patterns/crackle.h"
#include "scene/patterns/cellular.h"

static void init(struct pattern *p)
{
    p->vector = vec3(-1, 1, 0); // form
    p->metric = 2;
}

// ---- distances ------------------------------------------------------------------------

static double distance_sum(struct vec3 e, struct crackle_power p)
{
    return crackle_raised(p, fabs(e.x)) + crackle_raised(p, fabs(e.y)) +
           crackle_raised(p, fabs(e.z));
}

// ---- the nearest points --------------------------------------------------------------

enum { CELLS_NEAR = 27 }; // NEAR: without those two cells off

// The three smallest sums in ascending order, and the point of the smallest: of equal ones
// that of the cell which is first in lexical order.
struct nearest {
    double d[CRACKLE_NEAREST];
    struct vec3 p;
    int rank;
};

static void keep(struct nearest *n, double sum, struct vec3 p, int rank)
{
    double *d = n->d;
    if (sum < d[0] || (sum == d[0] && rank < n->rank)) {
        n->p = p;
        n->rank = rank;
    }
    if (sum < d[0]) {
        d[2] = d[1];
        d[1] = d[0];
        d[0] = sum;
    } else if (sum < d[1]) {
        d[2] = d[1];
        d[1] = sum;
    } else if (sum < d[2]) {
        d[2] = sum;
    }
}

static struct nearest nothing(struct vec3 cell)
{
    return (struct nearest){.d = {DBL_MAX, DBL_MAX, DBL_MAX}, .p = cell, .rank = -1};
}

static int rank_of(struct crackle_cell o)
{
    return ((o.x + 2) * 5 + o.y + 2) * 5 + o.z + 2;
}

// The least distance along an axis of the cells -2..2 from a point `f` behind the corner of
// cell 0, less what rounding can make of it.
static void least_distances(double f, double corner, double least[5])
{
    const double slack = 8 * DBL_EPSILON * (fabs(corner) + 4);
    for (int i = -2; i <= 2; i++) {
        const double d = i < 0 ? f - (i + 1) : i > 0 ? i - f : 0;
        least[i + 2] = d > slack ? d - slack : 0;
    }
}

// A point and the sum that it was found by.
struct candidate {
    struct vec3 e, p; // from the place to the point; the point
    double sum;
    int rank;
};

// By metric 2, or by 1. Points up to sqrt(stretch) times as far as the wanted-th, if not
// NULL, are candidates; their number.
static inline __attribute__((always_inline)) int search(struct vec3 at, bool squares,
                                                        int wanted, double stretch,
                                                        struct candidate *out,
                                                        struct nearest *n)
{
    const struct vec3 cell = vec3(floor(at.x - PATTERN_EDGE), floor(at.y - PATTERN_EDGE),
                                  floor(at.z - PATTERN_EDGE));
    double x[5], y[5], z[5];
    least_distances(at.x - cell.x, cell.x, x);
    least_distances(at.y - cell.y, cell.y, y);
    least_distances(at.z - cell.z, cell.z, z);
    for (int i = 0; i < 5 && squares; i++) {
        x[i] *= x[i];
        y[i] *= y[i];
        z[i] *= z[i];
    }
    const double far = fmin(fmin(fmin(x[0], x[4]), fmin(y[0], y[4])), fmin(z[0], z[4]));
    *n = nothing(cell);
    int count = 0;
    for (int i = 0; i < CRACKLE_CELLS; i++) {
        if (i == CELLS_NEAR && far > stretch * n->d[wanted - 1])
            break;
        const struct crackle_cell o = crackle_cells[i];
        if (x[o.x + 2] + y[o.y + 2] + z[o.z + 2] > stretch * n->d[wanted - 1])
            continue;
        const struct vec3 q = noise_cell_point(cell.x + o.x, cell.y + o.y, cell.z + o.z);
        const struct vec3 e = vec3_sub(q, at);
        const double sum = squares ? e.x * e.x + e.y * e.y + e.z * e.z
                                   : fabs(e.x) + fabs(e.y) + fabs(e.z);
        if (out && !(sum > stretch * n->d[wanted - 1]))
            out[count++] = (struct candidate){e, q, sum, rank_of(o)};
        keep(n, sum, q, rank_of(o));
    }
    return count;
}

// Candidates that may be among the wanted nearest: their sums, wrong by less than `slack`
// of them, are no larger than the wanted-th.
static int thinned(struct candidate *c, int count, double most, double slack)
{
    int left = 0;
    for (int i = 0; i < count; i++)
        if (!(c[i].sum > most * (1 + slack)))
            c[left++] = c[i];
    return left;
}

// At least (3^|1/metric - 1/2|)^2: a chord above that convex function of the exponent.
static double stretch_of(double metric)
{
    if (!(metric >= 1))
        return INFINITY;
    const double t = fabs(2 / metric - 1); // 0..1
    return fmax(1 + 1.46411 * t, 0.46396 + 2.53607 * t) * (1 + 0x1p-30);
}

// The sums of candidates, exact or of single precision; k may be NULL.
static void raise_all(const struct noise_kernels *k, struct crackle_power p, bool single,
                      struct candidate *c, int count)
{
    if (p.twice) {
        for (int i = 0; i < count; i++)
            c[i].sum = distance_sum(c[i].e, p);
        return;
    }
    double x[3 * CRACKLE_CELLS + 7];
    size_t n = 0;
    for (int i = 0; i < count; i++) {
        x[n++] = fabs(c[i].e.x);
        x[n++] = fabs(c[i].e.y);
        x[n++] = fabs(c[i].e.z);
    }
    if (k) {
        while (n % 8)
            x[n++] = 1;
        k->powers(x, n, p.metric, single, x);
    } else {
        for (size_t i = 0; i < n; i++)
            x[i] = single ? det_pow_single(x[i], p.metric) : det_pow(x[i], p.metric);
    }
    for (int i = 0; i < count; i++)
        c[i].sum = x[3 * i] + x[3 * i + 1] + x[3 * i + 2];
}

static void keep_all(struct nearest *n, const struct candidate *c, int count)
{
    *n = nothing(n->p);
    for (int i = 0; i < count; i++)
        keep(n, c[i].sum, c[i].p, c[i].rank);
}

// By any other metric.
static void search_general(struct vec3 at, double metric, int wanted,
                           const struct noise_kernels *k, struct nearest *n)
{
    struct candidate c[CRACKLE_CELLS];
    const struct crackle_power p = crackle_power(metric);
    const double stretch = stretch_of(metric);
    int count = search(at, true, wanted, stretch, c, n);
    count = thinned(c, count, n->d[wanted - 1], stretch - 1);
    if (!p.twice && metric > 0) {
        raise_all(k, p, true, c, count);
        keep_all(n, c, count);
        count = thinned(c, count, n->d[wanted - 1], 0x1p-30);
    }
    raise_all(k, p, false, c, count);
    keep_all(n, c, count);
}

static double form_value(const struct pattern *p, const double d[CRACKLE_NEAREST])
{
    const double form[CRACKLE_NEAREST] = {p->vector.x, p->vector.y, p->vector.z};
    double sum = 0;
    for (int i = 0; i < CRACKLE_NEAREST; i++)
        if (form[i] != 0)
            sum += form[i] * crackle_distance(d[i], p->metric, p->offset);
    return clamp01(sum);
}

// The nearest points to a place, by the pattern's metric; k may be NULL.
static void search_one(const struct pattern *p, struct vec3 at,
                       const struct noise_kernels *k, struct nearest *n)
{
    const int wanted = crackle_wanted(p);
    if (p->metric == 2)
        search(at, true, wanted, 1, NULL, n);
    else if (p->metric == 1)
        search(at, false, wanted, 1, NULL, n);
    else
        search_general(at, p->metric, wanted, k, n);
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    struct nearest n;
    search_one(p, at, NULL, &n);
    return p->solid ? clamp01(pattern_noise(p, n.p)) : form_value(p, n.d);
}

// ---- eight points --------------------------------------------------------------------

// What is found at each: by lanes.
struct nearest8 {
    double d[CRACKLE_NEAREST][8], p[3][8];
};

static void keep_lane(struct nearest8 *all, int i, const struct nearest *n)
{
    for (int k = 0; k < CRACKLE_NEAREST; k++)
        all->d[k][i] = n->d[k];
    all->p[0][i] = n->p.x, all->p[1][i] = n->p.y, all->p[2][i] = n->p.z;
}

// Points that share a cell look at its surroundings together.
static void search_all(const struct pattern *p, const struct noise_kernels *k,
                       const double at[3][8], struct nearest8 *all)
{
    const bool together = p->metric == 2 || p->metric == 1;
    const int wanted = crackle_wanted(p);
    for (unsigned left = 255, lanes; left; left &= ~lanes) {
        const int i = __builtin_ctz(left);
        lanes = together ? k->nearest(at, left, (int)p->metric, wanted, all->d,
                                      p->solid ? all->p : NULL)
                         : 1u << i;
        if (lanes != 1u << i)
            continue;
        struct nearest n;
        search_one(p, vec3(at[0][i], at[1][i], at[2][i]), k, &n);
        keep_lane(all, i, &n);
    }
}

// crackle_distance of eight sums.
static void distances(const struct pattern *p, const struct noise_kernels *k,
                      const double sum[8], double out[8])
{
    const double offset = p->offset;
    if (p->metric == 2 || p->metric == 1) { // loops that compilers put in lanes
        for (int i = 0; i < 8 && p->metric == 2; i++)
            out[i] = crackle_distance(sum[i], 2, offset);
        for (int i = 0; i < 8 && p->metric == 1; i++)
            out[i] = crackle_distance(sum[i], 1, offset);
        return;
    }
    const struct crackle_power power = crackle_power(p->metric);
    const double more = p->offset != 0 ? crackle_raised(power, p->offset) : 0;
    double s[8];
    for (int i = 0; i < 8; i++)
        s[i] = p->offset != 0 ? sum[i] + more : sum[i];
    k->powers(s, 8, 1 / power.metric, power.twice, out);
    for (int i = 0; i < 8 && power.twice; i++)
        out[i] = crackle_steps(power, s[i]) ? crackle_step(power, s[i], out[i])
                                            : crackle_lowered(power, s[i]);
}

static void form_values(const struct pattern *p, const struct noise_kernels *k,
                        const struct nearest8 *all, double out[8])
{
    const double form[CRACKLE_NEAREST] = {p->vector.x, p->vector.y, p->vector.z};
    double sum[8] = {0}, distance[8];
    for (int n = 0; n < CRACKLE_NEAREST; n++) {
        if (form[n] == 0)
            continue;
        distances(p, k, all->d[n], distance);
        for (int i = 0; i < 8; i++)
            sum[i] += form[n] * distance[i];
    }
    for (int i = 0; i < 8; i++)
        out[i] = clamp01(sum[i]);
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    struct nearest8 all; // of which what is used is set in all lanes
    search_all(p, k, at, &all);
    if (!p->solid) {
        form_values(p, k, &all, out);
        return;
    }
    k->value((const double(*)[8])all.p, 1, pattern_noise_generator(p), out);
    for (int i = 0; i < 8; i++)
        out[i] = clamp01(out[i]);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    return formula_extern(f, &crackle_bounds, p, at);
}

const struct pattern_ops crackle_pattern_ops = {.keyword = "crackle",
                                                .frequency = 1,
                                                .init = init,
                                                .value = value,
                                                .formula = formula,
                                                .values = values};
