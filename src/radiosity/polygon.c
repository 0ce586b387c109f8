#include "radiosity/polygon.h"

#include <stddef.h>

#include "math/pi.h"
#include "math/quick.h"

uint32_t polygon_risen(struct vec3 p, struct vec3 n, const struct vec3 *corner,
                       uint32_t count, struct vec3 out[HORIZON_CORNERS])
{
    struct vec3 r[4];
    double height[4];
    uint32_t used = 0;
    for (uint32_t i = 0; i < count; i++) {
        r[i] = vec3_sub(corner[i], p);
        height[i] = vec3_dot(r[i], n);
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t j = i + 1 == count ? 0 : i + 1;
        if (height[i] >= 0)
            out[used++] = r[i];
        if ((height[i] < 0) == (height[j] < 0) || used == HORIZON_CORNERS)
            continue;
        const double t = height[i] / (height[i] - height[j]);
        out[used++] = vec3_mad(r[i], t, vec3_sub(r[j], r[i]));
        if (used == HORIZON_CORNERS)
            break;
    }
    return used;
}

// Seen from the front, corners that are counter-clockwise about the polygon's normal, which
// faces us, go clockwise about ours.
static double factor_of_sum(double sum)
{
    sum /= -2 * PI;
    return sum > 0 ? (sum < 1 ? sum : 1) : 0;
}

double lambert_polygon(struct vec3 p, struct vec3 n, const struct vec3 *corner,
                       uint32_t count)
{
    struct vec3 r[HORIZON_CORNERS];
    const uint32_t used = polygon_risen(p, n, corner, count, r);
    double sum = 0;
    for (uint32_t i = 0; i < used; i++) {
        const struct vec3 a = r[i], b = r[i + 1 == used ? 0 : i + 1];
        const struct vec3 c = vec3_cross(a, b);
        const double sine = vec3_length(c);
        if (sine > 0)
            sum += quick_atan2(sine, vec3_dot(a, b)) * (vec3_dot(c, n) / sine);
    }
    return factor_of_sum(sum);
}

double lambert_of_edges(struct vec3 p, struct vec3 n, const struct vec3 *corner,
                        uint32_t count, const double *term, const double *height)
{
    double sum = 0;
    uint32_t risen = 0;
    for (uint32_t i = 0; i < count; i++) {
        sum += term[i];
        risen += height[i] >= 0;
    }
    return risen == count ? factor_of_sum(sum)
           : risen        ? lambert_polygon(p, n, corner, count)
                          : 0;
}

// Zeros of the Legendre polynomials and their weights, moved to [0, 1].
static const struct gauss rules[GAUSS_MAX] = {
    {{0.5}, {1}},
    {{0.21132486540518713, 0.78867513459481287},
     {0.50000000000000011, 0.50000000000000011}},
    {{0.1127016653792583, 0.5, 0.8872983346207417},
     {0.27777777777777762, 0.44444444444444442, 0.27777777777777762}},
    {{0.069431844202973714, 0.33000947820757187, 0.66999052179242813,
      0.93056815579702623},
     {0.17392742256872687, 0.32607257743127305, 0.32607257743127305,
      0.17392742256872687}},
    {{0.046910077030668018, 0.23076534494715845, 0.5, 0.7692346550528415,
      0.95308992296933193},
     {0.1184634425280945, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
      0.1184634425280945}},
    {{0.033765242898423975, 0.1693953067668677, 0.38069040695840151, 0.61930959304159849,
      0.83060469323313235, 0.96623475710157603},
     {0.085662246189585248, 0.1803807865240693, 0.23395696728634563, 0.23395696728634563,
      0.1803807865240693, 0.085662246189585248}},
    {{0.025446043828620757, 0.12923440720030277, 0.29707742431130141, 0.5,
      0.70292257568869854, 0.87076559279969723, 0.97455395617137919},
     {0.064742483084434838, 0.13985269574463835, 0.19091502525255952, 0.2089795918367347,
      0.19091502525255952, 0.13985269574463835, 0.064742483084434838}},
    {{0.019855071751231856, 0.10166676129318658, 0.2372337950418355, 0.40828267875217511,
      0.59171732124782495, 0.7627662049581645, 0.89833323870681348, 0.9801449282487682},
     {0.050614268145188088, 0.11119051722668723, 0.15685332293894369, 0.181341891689181,
      0.181341891689181, 0.15685332293894369, 0.11119051722668723, 0.050614268145188088}},
};

const struct gauss *gauss_rule(int k)
{
    return &rules[k < 1 ? 0 : k > GAUSS_MAX ? GAUSS_MAX - 1 : k - 1];
}

struct vec3 polygon_point(const struct element *e, double u, double v, double *jacobian)
{
    const struct vec3 a = e->corner[0], b = e->corner[1], c = e->corner[2];
    const struct vec3 d = e->corner_count == 4 ? e->corner[3] : a;
    const struct vec3 low = vec3_mad(a, u, vec3_sub(b, a));
    const struct vec3 high = vec3_mad(d, u, vec3_sub(c, d));
    const struct vec3 du =
        vec3_add(vec3_scale(1 - v, vec3_sub(b, a)), vec3_scale(v, vec3_sub(c, d)));
    const struct vec3 dv = vec3_sub(high, low);
    if (jacobian)
        *jacobian = vec3_length(vec3_cross(du, dv));
    return vec3_mad(low, v, dv);
}

struct vec3 polygon_uniform(const struct element *e, double u, double v)
{
    if (e->corner_count == 4)
        return polygon_point(e, u, v, NULL);
    // The triangle as a, b, c with weights 1 - s, s (1 - v), s v; s = sqrt(u).
    const double s = sqrt(u);
    const struct vec3 a = e->corner[0];
    return vec3_mad(vec3_mad(a, s * (1 - v), vec3_sub(e->corner[1], a)), s * v,
                    vec3_sub(e->corner[2], a));
}

void polygon_turn(struct element *e)
{
    const struct vec3 turn = vec3_cross(vec3_sub(e->corner[2], e->corner[0]),
                                        vec3_sub(e->corner[3], e->corner[1]));
    if (vec3_dot(turn, e->normal) < 0) {
        const struct vec3 swap = e->corner[1];
        e->corner[1] = e->corner[3];
        e->corner[3] = swap;
    }
}

static struct vec3 polygon_area_vector(const struct element *e)
{
    const struct vec3 a = e->corner[0], c = e->corner[2];
    const struct vec3 b = vec3_sub(e->corner[1], a);
    if (e->corner_count == 3)
        return vec3_scale(0.5, vec3_cross(b, vec3_sub(c, a)));
    return vec3_scale(0.5,
                      vec3_cross(vec3_sub(c, a), vec3_sub(e->corner[3], e->corner[1])));
}

double polygon_area(const struct element *e)
{
    return vec3_length(polygon_area_vector(e));
}

double polygon_radius(const struct element *e)
{
    double r = 0;
    for (uint32_t i = 0; i < e->corner_count; i++)
        r = fmax(r, vec3_length(vec3_sub(e->corner[i], e->centre)));
    return r;
}

void element_finish(struct element *e)
{
    const struct vec3 area = polygon_area_vector(e);
    struct vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < e->corner_count; i++)
        sum = vec3_add(sum, e->corner[i]);
    e->centre = vec3_scale(1.0 / e->corner_count, sum);
    e->normal = vec3_normalize(area);
    e->area = vec3_length(area);
    e->coverage = 1;
}
