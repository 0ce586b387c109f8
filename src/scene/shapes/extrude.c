#include "scene/shapes/extrude.h"

#include <string.h>

#include "math/gamma.h"

void boundary_list_sort(struct boundary_list *l, uint32_t from)
{
    for (uint32_t i = from + 1; i < l->count; i++) {
        struct boundary b = l->at[i];
        uint32_t j = i;
        for (; j > from && l->at[j - 1].t > b.t; j--)
            l->at[j] = l->at[j - 1];
        l->at[j] = b;
    }
}

void boundary_list_merge(struct boundary_list *l, uint32_t from)
{
    int depth = 0;
    uint32_t kept = from;
    for (uint32_t i = from; i < l->count; i++) {
        const int before = depth;
        depth += l->at[i].crossing == CROSS_ENTER ? 1 : -1;
        if (before == 0 || depth == 0)
            l->at[kept++] = l->at[i];
    }
    l->count = kept;
}

// The line in the plane as k.(u, v, 1) = 0, or all zero for a ray along the axis.
static void plane_line(const struct extrude_ray *r, double k[3])
{
    k[0] = r->d[1];
    k[1] = -r->d[0];
    k[2] = r->d[0] * r->o[1] - r->d[1] * r->o[0];
}

struct plane_size {
    double dd, norm, size; // |d|^2 and |d| in the plane; of all coordinates there
};

static struct plane_size plane_size(const struct outline *o, const struct extrude_ray *r)
{
    const double dd = r->d[0] * r->d[0] + r->d[1] * r->d[1];
    return (struct plane_size){dd, sqrt(dd),
                               outline_size(o) + fmax(fabs(r->o[0]), fabs(r->o[1]))};
}

static struct boundary wall(const struct outline *o, const struct extrude_ray *r,
                            const struct plane_size *z, uint32_t i, double w)
{
    const struct outline_segment *s = &o->segment[i];
    const struct vec2 p = outline_point(s, w), c = outline_tangent(s, w);
    // Along a grazed curve an error across the line becomes one along it.
    const double across = fabs(c.u * r->d[1] - c.v * r->d[0]);
    const double along = fabs(c.u * r->d[0] + c.v * r->d[1]);
    const double error = GAMMA(16) * z->size / z->norm;
    return (struct boundary){
        .t = ((p.u - r->o[0]) * r->d[0] + (p.v - r->o[1]) * r->d[1]) / z->dd,
        .dt = across > 0 ? error * (1 + along / across) : error,
        .u = c.v * r->d[0] - c.u * r->d[1] < 0 ? 1 : -1, // faces the ray
        .v = w,
        .part = EXTRUDE_WALL + i,
        .crossing = CROSS_ENTER,
        .drawn = 1,
    };
}

struct boundary extrude_wall(const struct outline *o, const struct extrude_ray *r,
                             uint32_t i, double w)
{
    const struct plane_size z = plane_size(o, r);
    return wall(o, r, &z, i, w);
}

static void add_walls(const struct outline *o, const struct extrude_ray *r,
                      struct boundary_list *out)
{
    double k[3];
    plane_line(r, k);
    const struct plane_size z = plane_size(o, r);
    for (uint32_t i = 0; i < o->count; i++) {
        const struct outline_segment *s = &o->segment[i];
        double w[OUTLINE_ROOTS];
        if (outline_passes_by(s, k, z.norm, z.size))
            continue;
        const int n = outline_roots(s, k, w);
        for (int j = 0; j < n; j++) {
            const struct boundary b = wall(o, r, &z, i, w[j]);
            *boundary_list_add(out, b.t, b.dt, CROSS_ENTER, b.part) = b;
        }
    }
}

bool extrude_slab_of(const struct extrude_ray *r, double low, double high,
                     struct extrude_slab *s)
{
    *s = (struct extrude_slab){
        {-HUGE_VAL, HUGE_VAL}, 0, {EXTRUDE_LOW, EXTRUDE_HIGH}, true};
    if (RUNS_ALONG(r->d[2], fmax(fabs(r->d[0]), fabs(r->d[1]))))
        return r->o[2] >= low && r->o[2] <= high;
    const bool up = r->d[2] > 0;
    s->always = false;
    s->t[0] = ((up ? low : high) - r->o[2]) / r->d[2];
    s->t[1] = ((up ? high : low) - r->o[2]) / r->d[2];
    s->dt = GAMMA(12) * (fabs(r->o[2]) + fmax(fabs(low), fabs(high))) / fabs(r->d[2]);
    s->part[0] = up ? EXTRUDE_LOW : EXTRUDE_HIGH;
    s->part[1] = up ? EXTRUDE_HIGH : EXTRUDE_LOW;
    return true;
}

void extrude_add_cap(struct boundary_list *out, const struct extrude_slab *s, int which,
                     bool open)
{
    struct boundary *b = boundary_list_add(
        out, s->t[which], s->dt, which ? CROSS_EXIT : CROSS_ENTER, s->part[which]);
    b->drawn = !open;
}

// Appends the product behind the walls, then moves it down over them.
void extrude_clip(const struct extrude_slab *s, bool open, bool in, uint32_t from,
                  struct boundary_list *out)
{
    const uint32_t walls = out->count;
    bool in_slab = s->always;
    for (uint32_t i = from; i <= walls; i++) {
        const double t = i < walls ? out->at[i].t : HUGE_VAL;
        for (int which = 0; which < 2 && !s->always; which++) {
            if (in_slab != (which == 1) || s->t[which] > t)
                continue;
            in_slab = which == 0;
            if (in)
                extrude_add_cap(out, s, which, open);
            if (which == 1)
                i = walls; // nothing follows the slab
        }
        if (i >= walls)
            break;
        if (in_slab) {
            struct boundary b = out->at[i];
            b.crossing = in ? CROSS_EXIT : CROSS_ENTER;
            b.u = in ? -b.u : b.u;
            *boundary_list_add(out, b.t, b.dt, CROSS_ENTER, b.part) = b;
        }
        in = !in;
    }
    const uint32_t n = out->count - walls;
    memmove(out->at + from, out->at + walls, n * sizeof *out->at);
    out->count = from + n;
}

static void along_the_axis(const struct outline *o, const struct extrude_slab *s,
                           bool open, const struct extrude_ray *r,
                           struct boundary_list *out)
{
    if (!outline_inside(o, (struct vec2){r->o[0], r->o[1]}))
        return;
    extrude_add_cap(out, s, 0, open);
    extrude_add_cap(out, s, 1, open);
}

void extrude_intersect(const struct outline *o, double low, double high, bool open,
                       const struct extrude_ray *ray, struct boundary_list *out)
{
    struct extrude_slab slab;
    if (o->count == 0 || !extrude_slab_of(ray, low, high, &slab))
        return;
    if (RUNS_ALONG(fmax(fabs(ray->d[0]), fabs(ray->d[1])), fabs(ray->d[2]))) {
        along_the_axis(o, &slab, open, ray, out);
        return;
    }
    const uint32_t from = out->count;
    add_walls(o, ray, out);
    if (out->count == from)
        return;
    boundary_list_sort(out, from);
    extrude_clip(&slab, open, false, from, out);
}

struct vec3 extrude_normal(const struct outline *o, const struct boundary *b)
{
    if (b->part < EXTRUDE_WALL)
        return vec3(0, 0, b->part == EXTRUDE_HIGH ? 1 : -1);
    const struct vec2 c = outline_tangent(&o->segment[b->part - EXTRUDE_WALL], b->v);
    return vec3(b->u * c.v, -b->u * c.u, 0);
}
