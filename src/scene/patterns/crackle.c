// crackle: distances to the nearest random points (Worley, A Cellular Texture Basis
// Function, 1996), spec/textures 5.3

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

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const struct vec3 cell = vec3(floor(at.x - PATTERN_EDGE), floor(at.y - PATTERN_EDGE),
                                  floor(at.z - PATTERN_EDGE));
    double d[3] = {DBL_MAX, DBL_MAX, DBL_MAX};
    struct vec3 nearest = cell;
    const int r = CELLULAR_REACH;
    for (int i = -r; i <= r; i++)
        for (int j = -r; j <= r; j++)
            for (int k = -r; k <= r; k++) {
                if (!cellular_counts(i, j, k))
                    continue;
                struct vec3 q = noise_cell_point(cell.x + i, cell.y + j, cell.z + k);
                double sum = distance_sum(vec3_sub(q, at), p->metric);
                if (sum < d[0])
                    nearest = q;
                keep_smallest(d, sum);
            }
    if (p->solid)
        return clamp01(pattern_noise(p, nearest));
    for (int i = 0; i < 3; i++)
        d[i] = distance_of(d[i], p->metric, p->offset);
    return clamp01(p->vector.x * d[0] + p->vector.y * d[1] + p->vector.z * d[2]);
}

const struct pattern_ops crackle_pattern_ops = {
    .keyword = "crackle", .frequency = 1, .init = init, .value = value};
