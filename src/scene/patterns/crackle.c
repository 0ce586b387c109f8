// crackle: distances to the nearest random points (Worley, A Cellular Texture Basis
// Function, 1996), spec/textures 5.3

#include <limits.h>

#include "scene/patterns/cellular.h"

static void init(struct pattern *p)
{
    p->vector = vec3(-1, 1, 0); // form
    p->metric = 2;
}

static double distance_sum(struct vec3 e, double metric)
{
    if (metric == 2)
        return e.x * e.x + e.y * e.y + e.z * e.z;
    if (metric == 1)
        return fabs(e.x) + fabs(e.y) + fabs(e.z);
    return det_pow(fabs(e.x), metric) + det_pow(fabs(e.y), metric) +
           det_pow(fabs(e.z), metric);
}

static double distance_of(double sum, double metric, double offset)
{
    if (metric == 2)
        return sqrt(sum + offset * offset);
    if (metric == 1)
        return sum + offset;
    if (offset != 0)
        sum += det_pow(offset, metric);
    return det_pow(sum, 1 / metric);
}

// The three smallest sums in ascending order.
static void keep_smallest(double d[3], double sum)
{
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

// The search for the nearest points.
struct search {
    const struct pattern *p;
    struct vec3 at, cell;
    double d[3];         // the smallest sums
    struct vec3 nearest; // of these the first point,
    int order;           // and its place in the order of the language
    // Per axis and offset: what the sum is at least in that axis.
    double least[3][2 * CELLULAR_REACH + 1];
};

static void visit(struct search *s, int i, int j, int k)
{
    const struct vec3 q = noise_cell_point(s->cell.x + i, s->cell.y + j, s->cell.z + k);
    const double sum = distance_sum(vec3_sub(q, s->at), s->p->metric);
    const int order = ((i + CELLULAR_REACH) * 8 + j + CELLULAR_REACH) * 8 + k;
    if (sum < s->d[0] || (sum == s->d[0] && order < s->order)) {
        s->nearest = q;
        s->order = order;
    }
    keep_smallest(s->d, sum);
}

static void visit_all(struct search *s)
{
    const int r = CELLULAR_REACH;
    for (int i = -r; i <= r; i++)
        for (int j = -r; j <= r; j++)
            for (int k = -r; k <= r; k++)
                if (cellular_counts(i, j, k))
                    visit(s, i, j, k);
}

// Distances along an axis to the slabs of cells, as distance_sum counts them: rounding
// keeps order, so no point of a cell has a smaller sum than its bounds have.
static void bound_axis(double at, double cell, double metric,
                       double least[2 * CELLULAR_REACH + 1])
{
    for (int i = 0; i <= 2 * CELLULAR_REACH; i++) {
        const double low = cell + (i - CELLULAR_REACH), over = low - at,
                     under = at - (low + 1);
        const double e = over > 0 ? over : under > 0 ? under : 0;
        least[i] = metric == 2 ? e * e : e;
    }
}

static void visit_if_near(struct search *s, int which, int i, int j, int k)
{
    const int r = CELLULAR_REACH;
    if (s->least[0][i + r] + s->least[1][j + r] + s->least[2][k + r] <= s->d[which])
        visit(s, i, j, k);
}

// Only cells that may hold one of the `which` + 1 nearest; nearer ones first.
static void visit_near(struct search *s, int which)
{
    const double metric = s->p->metric;
    bound_axis(s->at.x, s->cell.x, metric, s->least[0]);
    bound_axis(s->at.y, s->cell.y, metric, s->least[1]);
    bound_axis(s->at.z, s->cell.z, metric, s->least[2]);
    const int r = CELLULAR_REACH;
    int side[3][3];
    for (int a = 0; a < 3; a++) {
        const int near = s->least[a][r - 1] < s->least[a][r + 1] ? -1 : 1;
        side[a][0] = 0;
        side[a][1] = near;
        side[a][2] = -near;
    }
    for (int turn = 0; turn < 3; turn++)
        for (int i = 0; i <= turn; i++)
            for (int j = 0; j <= turn; j++)
                for (int k = 0; k <= turn; k++)
                    if (i == turn || j == turn || k == turn)
                        visit_if_near(s, which, side[0][i], side[1][j], side[2][k]);
    for (int a = 0; a < 3; a++)
        for (int far = -r; far <= r; far += 2 * r)
            for (int u = -1; u <= 1 && s->least[a][far + r] <= s->d[which]; u++)
                for (int v = -1; v <= 1; v++)
                    visit_if_near(s, which, a == 0 ? far : u,
                                  a == 1   ? far
                                  : a == 0 ? u
                                           : v,
                                  a == 2 ? far : v);
}

// How many of the smallest sums count.
static int wanted(const struct pattern *p)
{
    return p->vector.z != 0 ? 3 : p->vector.y != 0 ? 2 : 1;
}

static double form_value(const struct pattern *p, const double sum[3])
{
    double d[3];
    for (int i = 0; i < 3; i++)
        d[i] = distance_of(sum[i], p->metric, p->offset);
    return clamp01(p->vector.x * d[0] + p->vector.y * d[1] + p->vector.z * d[2]);
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    struct search s = {.p = p, .at = at, .d = {DBL_MAX, DBL_MAX, DBL_MAX}};
    s.cell = vec3(floor(at.x - PATTERN_EDGE), floor(at.y - PATTERN_EDGE),
                  floor(at.z - PATTERN_EDGE));
    s.nearest = s.cell;
    s.order = INT_MAX;
    const bool bounded = p->metric == 2 || p->metric == 1;
    if (!bounded)
        visit_all(&s);
    else
        visit_near(&s, p->solid ? 0 : wanted(p) - 1);
    return p->solid ? clamp01(pattern_noise(p, s.nearest)) : form_value(p, s.d);
}

// Whether lane i is in the cell.
static bool lane_in(const double at[3][8], int i, const double cell[3])
{
    return floor(at[0][i] - PATTERN_EDGE) == cell[0] &&
           floor(at[1][i] - PATTERN_EDGE) == cell[1] &&
           floor(at[2][i] - PATTERN_EDGE) == cell[2];
}

// Points that share a cell look at its surroundings together.
static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    const bool together = !p->solid && (p->metric == 2 || p->metric == 1);
    for (unsigned left = 255; left;) {
        const int first = __builtin_ctz(left);
        const double cell[3] = {floor(at[0][first] - PATTERN_EDGE),
                                floor(at[1][first] - PATTERN_EDGE),
                                floor(at[2][first] - PATTERN_EDGE)};
        unsigned lanes = 1u << first;
        for (int i = first + 1; i < 8; i++)
            lanes |= (left >> i & 1 && lane_in(at, i, cell) ? 1u : 0u) << i;
        left &= ~lanes;
        double sum[3][8];
        if (!together || !(lanes & (lanes - 1))) {
            for (; lanes; lanes &= lanes - 1) {
                const int i = __builtin_ctz(lanes);
                out[i] = value(p, vec3(at[0][i], at[1][i], at[2][i]), NULL);
            }
            continue;
        }
        k->nearest(at, cell, lanes, (int)p->metric, wanted(p), sum);
        for (; lanes; lanes &= lanes - 1) {
            const int i = __builtin_ctz(lanes);
            out[i] = form_value(p, (double[3]){sum[0][i], sum[1][i], sum[2][i]});
        }
    }
}

const struct pattern_ops crackle_pattern_ops = {
    .keyword = "crackle", .frequency = 1, .init = init, .value = value, .values = values};
