// Ellipsoids, by their axes: u around the third, v from pole to pole as on the unit sphere,
// where areas are in proportion. The other quadrics have no end.
#include "scene/shapes/quadric.h"

#include "math/eigen.h"
#include "math/elementary.h"
#include "math/pi.h"
#include "tess/map.h"

struct ellipsoid {
    struct vec3 axis[3]; // with their lengths
    bool inverse;        // the inside of the quadric is the outside of the ellipsoid
};

static bool ellipsoid_of(const struct quadric *q, struct ellipsoid *out)
{
    const double a[3][3] = {{q->xx, q->xy / 2, q->xz / 2},
                            {q->xy / 2, q->yy, q->yz / 2},
                            {q->xz / 2, q->yz / 2, q->zz}};
    const struct eigen e = eigen_of(a);
    out->inverse = q->constant > 0;
    if (vec3_max_abs(q->linear) > 0)
        return false;
    for (int k = 0; k < 3; k++) {
        const double square = -q->constant / e.value[k];
        if (!(square > 0) || !(square < INFINITY))
            return false;
        out->axis[k] = vec3_scale(sqrt(square), e.vector[k]);
    }
    return true;
}

static uint32_t count(const void *shape)
{
    struct ellipsoid e;
    return ellipsoid_of(shape, &e);
}

static struct vec3 combine(const struct ellipsoid *e, double x, double y, double z)
{
    return vec3_mad(vec3_mad(vec3_scale(x, e->axis[0]), y, e->axis[1]), z, e->axis[2]);
}

static void at(const void *shape, uint32_t piece, double u, double v,
               struct map_point *out)
{
    (void)piece;
    const struct quadric *s = shape;
    struct ellipsoid e;
    ellipsoid_of(s, &e);
    const double c = det_cos(2 * PI * u), d = det_sin(2 * PI * u);
    const double z = 1 - 2 * v, r = sqrt(fmax(0, 1 - z * z));
    const double dr = r > 0 ? 2 * z / r : 0;
    out->p = vec3_add(s->centre, combine(&e, r * c, r * d, z));
    out->du = combine(&e, -2 * PI * r * d, 2 * PI * r * c, 0);
    out->dv = combine(&e, dr * c, dr * d, -2);
    struct vec3 n = {0, 0, 0};
    const double q[3] = {r * c, r * d, z};
    for (int k = 0; k < 3; k++)
        n = vec3_mad(n, q[k] / vec3_dot(e.axis[k], e.axis[k]), e.axis[k]);
    out->n = vec3_scale(e.inverse ? -1 : 1, vec3_normalize(n));
}

static uint32_t locate(const void *shape, const struct boundary *b, struct vec3 p,
                       double *u, double *v)
{
    (void)b;
    const struct quadric *s = shape;
    struct ellipsoid e;
    ellipsoid_of(s, &e);
    double x[3];
    for (int k = 0; k < 3; k++)
        x[k] =
            vec3_dot(vec3_sub(p, s->centre), e.axis[k]) / vec3_dot(e.axis[k], e.axis[k]);
    *u = map_turn(x[0], x[1]);
    *v = (1 - fmin(fmax(x[2], -1), 1)) / 2;
    return 0;
}

const struct tess_map quadric_map = {.ops = &quadric_ops,
                                     .count = count,
                                     .wraps = MAP_WRAPS_U,
                                     .at = at,
                                     .locate = locate};
