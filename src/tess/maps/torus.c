// u around the axis, v around the tube.
#include "scene/shapes/torus.h"

#include "math/elementary.h"
#include "math/pi.h"
#include "tess/map.h"

// Of a spindle only the outer part is surface: it has no map.
static uint32_t count(const void *shape)
{
    const struct torus *s = shape;
    return s->minor > 0 && s->minor <= s->major;
}

static void at(const void *shape, uint32_t piece, double u, double v,
               struct map_point *out)
{
    (void)piece;
    const struct torus *s = shape;
    const double ca = det_cos(2 * PI * u), sa = det_sin(2 * PI * u);
    const double cb = det_cos(2 * PI * v), sb = det_sin(2 * PI * v);
    const double rho = s->major + s->minor * cb, round = 2 * PI * s->minor;
    out->p = vec3(rho * ca, s->minor * sb, rho * sa);
    out->du = vec3(-2 * PI * rho * sa, 0, 2 * PI * rho * ca);
    out->dv = vec3(-round * sb * ca, round * cb, -round * sb * sa);
    out->n = vec3(cb * ca, sb, cb * sa);
}

static uint32_t locate(const void *shape, const struct boundary *b, struct vec3 p,
                       double *u, double *v)
{
    (void)b;
    const struct torus *s = shape;
    *u = map_turn(p.x, p.z);
    *v = map_turn(sqrt(p.x * p.x + p.z * p.z) - s->major, p.y);
    return 0;
}

const struct tess_map torus_map = {.ops = &torus_ops,
                                   .count = count,
                                   .wraps = MAP_WRAPS_U | MAP_WRAPS_V,
                                   .at = at,
                                   .locate = locate};
