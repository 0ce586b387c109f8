// A ring: u around, v outwards, areas in proportion.
#include "scene/shapes/disc.h"

#include "math/elementary.h"
#include "math/pi.h"
#include "scene/shapes/frame.h"
#include "tess/map.h"

static uint32_t count(const void *shape)
{
    const struct disc *s = shape;
    return s->radius > s->hole;
}

static void at(const void *shape, uint32_t piece, double u, double v,
               struct map_point *out)
{
    (void)piece;
    const struct disc *s = shape;
    const struct frame f = frame_around(s->centre, s->normal);
    const double ring = s->radius * s->radius - s->hole * s->hole;
    const double r = sqrt(s->hole * s->hole + v * ring);
    const double c = det_cos(2 * PI * u), d = det_sin(2 * PI * u);
    const struct vec3 outward = frame_vector(&f, c, d, 0);
    out->p = vec3_mad(s->centre, r, outward);
    out->du = frame_vector(&f, -2 * PI * r * d, 2 * PI * r * c, 0);
    out->dv = vec3_scale(ring / (2 * r), outward);
    out->n = s->normal;
}

static uint32_t locate(const void *shape, const struct boundary *b, struct vec3 p,
                       double *u, double *v)
{
    (void)b;
    const struct disc *s = shape;
    const struct frame f = frame_around(s->centre, s->normal);
    const struct vec3 q = frame_coordinates(&f, vec3_sub(p, s->centre));
    const double hole = s->hole * s->hole;
    *u = map_turn(q.x, q.y);
    *v = (q.x * q.x + q.y * q.y - hole) / (s->radius * s->radius - hole);
    return 0;
}

const struct tess_map disc_map = {
    .ops = &disc_ops, .count = count, .wraps = MAP_WRAPS_U, .at = at, .locate = locate};
