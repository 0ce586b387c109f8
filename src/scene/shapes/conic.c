// An outline swept towards the origin: the cross-section at height h is h times the outline
// (mirrored below 0), between two heights.
//
// Divided by its height a line is again a line in the plane of the outline, so walls are
// met where that line crosses the outline. At height 0 the divided line runs through
// infinity, outside of everything: the state alternates from there both ways.
#include <math.h>

#include "math/gamma.h"
#include "scene/shapes/extrude.h"

// The ray as the line k.(u, v, 1) = 0 of the outline's plane.
static void divided_line(const struct extrude_ray *r, double k[3])
{
    k[0] = r->o[1] * r->d[2] - r->o[2] * r->d[1];
    k[1] = r->o[2] * r->d[0] - r->o[0] * r->d[2];
    k[2] = r->o[0] * r->d[1] - r->o[1] * r->d[0];
}

static double length3(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

struct conic_line {
    const struct extrude_ray *r;
    double length, size; // of the direction; of origin and outline
};

static struct conic_line line_of(const struct outline *o, double low, double high,
                                 const struct extrude_ray *r)
{
    return (struct conic_line){r, length3(r->d),
                               length3(r->o) +
                                   (1 + outline_size(o)) * fmax(fabs(low), fabs(high))};
}

static bool wall(const struct conic_line *l, const struct outline *o, uint32_t i,
                 double w, struct boundary *out)
{
    const struct outline_segment *s = &o->segment[i];
    const struct extrude_ray *r = l->r;
    const struct vec2 p = outline_point(s, w), c = outline_tangent(s, w);
    const double du = r->d[0] - p.u * r->d[2], dv = r->d[1] - p.v * r->d[2];
    const double t = fabs(du) > fabs(dv) ? (p.u * r->o[2] - r->o[0]) / du
                                         : (p.v * r->o[2] - r->o[1]) / dv;
    if (!isfinite(t))
        return false;
    const double n[3] = {c.v, -c.u, c.u * p.v - c.v * p.u};
    const double across = n[0] * r->d[0] + n[1] * r->d[1] + n[2] * r->d[2];
    const double size = l->size + fabs(t) * l->length;
    const double cosine = fabs(across) / (length3(n) * l->length);
    *out = (struct boundary){
        .t = t,
        .dt = GAMMA(32) * size / l->length / fmax(cosine, sqrt(GAMMA(32))),
        .u = across < 0 ? 1 : -1, // faces the ray
        .v = w,
        .part = EXTRUDE_WALL + i,
        .crossing = CROSS_ENTER,
        .drawn = 1,
    };
    return true;
}

bool conic_wall(const struct outline *o, double low, double high,
                const struct extrude_ray *r, uint32_t i, double w, struct boundary *out)
{
    const struct conic_line l = line_of(o, low, high, r);
    return wall(&l, o, i, w, out);
}

// Through the apex: one point of the outline's plane.
static void through_apex(const struct outline *o, const struct extrude_slab *slab,
                         bool open, const struct extrude_ray *r, double low, double high,
                         struct boundary_list *out)
{
    if (RUNS_ALONG(r->d[2], fmax(fabs(r->d[0]), fabs(r->d[1]))) ||
        !outline_inside(o, (struct vec2){r->d[0] / r->d[2], r->d[1] / r->d[2]}))
        return;
    extrude_add_cap(out, slab, 0, open);
    if (low < 0 && high > 0) { // the two cones meet in a point
        const double t = -r->o[2] / r->d[2];
        boundary_list_add(out, t, slab->dt, CROSS_EXIT, EXTRUDE_HIGH)->drawn = 0;
        boundary_list_add(out, t, slab->dt, CROSS_ENTER, EXTRUDE_LOW)->drawn = 0;
    }
    extrude_add_cap(out, slab, 1, open);
}

void conic_intersect(const struct outline *o, double low, double high, bool open,
                     const struct extrude_ray *ray, struct boundary_list *out)
{
    struct extrude_slab slab;
    if (o->count == 0 || !extrude_slab_of(ray, low, high, &slab))
        return;
    const struct conic_line l = line_of(o, low, high, ray);
    double k[3];
    divided_line(ray, k);
    if (length3(k) <= GAMMA(8) * length3(ray->o) * l.length) {
        through_apex(o, &slab, open, ray, low, high, out);
        return;
    }
    const double norm = sqrt(k[0] * k[0] + k[1] * k[1]);
    const uint32_t from = out->count;
    for (uint32_t i = 0; i < o->count; i++) {
        double w[OUTLINE_ROOTS];
        const struct outline_segment *s = &o->segment[i];
        if (outline_passes_by(s, k, norm, outline_size(o)))
            continue;
        struct boundary b;
        const int n = outline_roots(s, k, w);
        for (int j = 0; j < n; j++)
            if (wall(&l, o, i, w[j], &b))
                *boundary_list_add(out, b.t, b.dt, CROSS_ENTER, b.part) = b;
    }
    if (out->count == from)
        return;
    boundary_list_sort(out, from);
    bool in = false;
    if (!slab.always) {
        const double apex = -ray->o[2] / ray->d[2];
        for (uint32_t i = from; i < out->count; i++)
            in ^= out->at[i].t < apex;
    }
    extrude_clip(&slab, open, in, from, out);
}

bool conic_inside(const struct outline *o, double low, double high, const double p[3])
{
    return p[2] >= low && p[2] <= high && p[2] != 0 &&
           outline_inside(o, (struct vec2){p[0] / p[2], p[1] / p[2]});
}

struct vec3 conic_normal(const struct outline *o, const struct boundary *b)
{
    if (b->part < EXTRUDE_WALL)
        return extrude_normal(o, b);
    const struct outline_segment *s = &o->segment[b->part - EXTRUDE_WALL];
    const struct vec2 p = outline_point(s, b->v), c = outline_tangent(s, b->v);
    return vec3(b->u * c.v, -b->u * c.u, b->u * (c.u * p.v - c.v * p.u));
}
