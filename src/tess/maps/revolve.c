// lathe and sor: a piece for each segment of the profile, u around, v the segment's own
// parameter; then the caps of a sor, v outwards with areas in proportion.
#include "scene/shapes/revolve.h"

#include "math/elementary.h"
#include "math/pi.h"
#include "math/polynomial.h"
#include "tess/map.h"

static uint32_t count(const void *shape)
{
    const struct revolve *s = shape;
    return s->count + (s->caps_drawn && !s->closed && s->count ? 2 : 0);
}

static double slope(const double *c, int degree, double w)
{
    double d = 0;
    for (int k = degree; k > 0; k--)
        d = d * w + k * c[k];
    return d;
}

// The even-odd rule decides which side of a profile is inside, and where it crosses
// itself the side changes: the solid is asked a little off the surface.
static struct vec3 outwards(const struct revolve *s, struct vec3 p, struct vec3 n)
{
    const double step = 1e-7 * fmax(s->r_max, s->h_max - s->h_min);
    return revolve_inside(s, vec3_mad(p, step, n)) ? vec3_neg(n) : n;
}

static void cap_at(const struct revolve *s, bool last, double u, double v,
                   struct map_point *out)
{
    const struct revolve_segment *g = &s->segment[last ? s->count - 1 : 0];
    const double h = g->h_end[last], r2 = g->r2_end[last], r = sqrt(r2 * v);
    const double c = det_cos(2 * PI * u), d = det_sin(2 * PI * u);
    out->p = vec3(r * c, h, r * d);
    out->du = vec3(-2 * PI * r * d, 0, 2 * PI * r * c);
    out->dv = r > 0 ? vec3_scale(r2 / (2 * r), vec3(c, 0, d)) : vec3(0, 0, 0);
    out->n = outwards(s, out->p, vec3(0, 1, 0));
}

static void at(const void *shape, uint32_t piece, double u, double v,
               struct map_point *out)
{
    const struct revolve *s = shape;
    if (piece >= s->count) {
        cap_at(s, piece > s->count, u, v, out);
        return;
    }
    const struct revolve_segment *g = &s->segment[piece];
    const double r2 = fmax(0, polynomial_value(g->r2, g->r2_degree, v)), r = sqrt(r2);
    const double dh = slope(g->h, g->h_degree, v), dr2 = slope(g->r2, g->r2_degree, v);
    const double dr = r > 0 ? dr2 / (2 * r) : 0;
    const double c = det_cos(2 * PI * u), d = det_sin(2 * PI * u);
    out->p = vec3(r * c, polynomial_value(g->h, g->h_degree, v), r * d);
    out->du = vec3(-2 * PI * r * d, 0, 2 * PI * r * c);
    out->dv = vec3(dr * c, dh, dr * d);
    const struct vec3 n = vec3_normalize(vec3(r * dh * c, -dr2 / 2, r * dh * d));
    out->n = outwards(s, out->p, vec3_dot(n, n) > 0 ? n : vec3(0, 1, 0));
}

static uint32_t locate(const void *shape, const struct boundary *b, struct vec3 p,
                       double *u, double *v)
{
    const struct revolve *s = shape;
    *u = map_turn(p.x, p.z);
    if (b->part >= REVOLVE_SEGMENT) {
        *v = b->v;
        return b->part - REVOLVE_SEGMENT;
    }
    const bool last = b->part == REVOLVE_LAST_CAP;
    *v = (p.x * p.x + p.z * p.z) / s->segment[last ? s->count - 1 : 0].r2_end[last];
    return s->count + last;
}

const struct tess_map lathe_map = {
    .ops = &lathe_ops, .count = count, .wraps = MAP_WRAPS_U, .at = at, .locate = locate};

const struct tess_map sor_map = {
    .ops = &sor_ops, .count = count, .wraps = MAP_WRAPS_U, .at = at, .locate = locate};
