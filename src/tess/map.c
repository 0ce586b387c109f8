#include "tess/map.h"

#include "math/elementary.h"
#include "math/pi.h"

double map_turn(double x, double y)
{
    const double t = det_atan2(y, x) / (2 * PI);
    return t < 0 ? t + 1 : t;
}

const struct tess_map *tess_map_find(const struct shape_ops *ops)
{
    static const struct tess_map *const table[] = {
#define MAP(name) &name##_map,
#include "tess/maps.def"
#undef MAP
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (table[i]->ops == ops)
            return table[i];
    return NULL;
}

// ---- integrals -----------------------------------------------------------------------

// Gauss-Legendre, 6 points on (0, 1): the roots of the sixth Legendre polynomial.
enum { GAUSS = 6 };
static const double gauss_at[GAUSS] = {0.03376524289842398609, 0.16939530676686774317,
                                       0.38069040695840154568, 0.61930959304159845432,
                                       0.83060469323313225683, 0.96623475710157601391};
static const double gauss_weight[GAUSS] = {
    0.08566224618958517252, 0.18038078652406930378, 0.23395696728634552369,
    0.23395696728634552369, 0.18038078652406930378, 0.08566224618958517252};

struct integral {
    double area, volume;
};

static void add_point(const struct map_point *at, const struct transform *t,
                      double weight, struct integral *sum)
{
    const struct vec3 p = transform_point(t, at->p);
    struct vec3 area =
        vec3_cross(transform_vector(t, at->du), transform_vector(t, at->dv));
    if (vec3_dot(area, transform_normal(t, at->n)) < 0)
        area = vec3_neg(area);
    sum->area += weight * vec3_length(area);
    sum->volume += weight * vec3_dot(p, area) / 3;
}

static struct integral integrate(const struct tess_map *map, const void *shape,
                                 const struct transform *t, const struct map_part *part,
                                 int panels)
{
    struct integral sum = {0, 0};
    const double du = (part->u1 - part->u0) / panels, dv = (part->v1 - part->v0) / panels;
    for (int i = 0; i < panels * GAUSS; i++) {
        const double u = part->u0 + du * (i / GAUSS + gauss_at[i % GAUSS]);
        for (int j = 0; j < panels * GAUSS; j++) {
            const double v = part->v0 + dv * (j / GAUSS + gauss_at[j % GAUSS]);
            struct map_point at;
            map->at(shape, part->piece, u, v, &at);
            add_point(&at, t, du * dv * gauss_weight[i % GAUSS] * gauss_weight[j % GAUSS],
                      &sum);
        }
    }
    return sum;
}

double tess_map_area(const struct tess_map *map, const void *shape,
                     const struct transform *t, const struct map_part *part, int panels)
{
    return integrate(map, shape, t, part, panels).area;
}

double tess_map_volume(const struct tess_map *map, const void *shape,
                       const struct transform *t, const struct map_part *part, int panels)
{
    return integrate(map, shape, t, part, panels).volume;
}
