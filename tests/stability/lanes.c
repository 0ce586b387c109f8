#include "test.h"

#include <string.h>

#include "lanes.h"
#include "trace/packet.h"

double lanes_unit(uint64_t *s)
{
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*s >> 33) + .5) / 2147483648.;
}

static double coordinate(uint64_t *s, bool grid)
{
    const double v = 2 * lanes_unit(s) - 1;
    return grid && lanes_unit(s) < .2 ? round(4 * v) / 4 : v;
}

void lanes_random_rays(uint64_t *s, bool grid, struct shape_rays *r)
{
    double p[3] = {0}, d[3] = {0};
    const bool together = lanes_unit(s) < .6, inside = lanes_unit(s) < .3,
               axis = lanes_unit(s) < .15;
    const int along = (int)(3 * lanes_unit(s));
    for (int l = 0; l < 8; l++) {
        for (int k = 0; k < 3; k++)
            if (l == 0 || !together) {
                p[k] = lanes_unit(s) < .05 ? 0 : coordinate(s, grid);
                d[k] = axis ? k == along : coordinate(s, grid);
            } else {
                p[k] += .02 * lanes_unit(s);
                d[k] += axis ? 0 : .02 * lanes_unit(s);
            }
        if (d[0] == 0 && d[1] == 0 && d[2] == 0)
            d[along] = -1;
        for (int k = 0; k < 3; k++) {
            r->o[k][l] = p[k] - (inside ? 0 : 3 * d[k]);
            r->d[k][l] = d[k];
        }
        r->t_min[l] = lanes_unit(s) < .5 ? 0 : 3 * lanes_unit(s);
        r->t_max[l] = lanes_unit(s) < .5 ? HUGE_VAL : r->t_min[l] + 3 * lanes_unit(s);
    }
}

struct ray lanes_ray(const struct shape_rays *r, int l)
{
    return (struct ray){vec3(r->o[0][l], r->o[1][l], r->o[2][l]),
                        vec3(r->d[0][l], r->d[1][l], r->d[2][l]), r->t_min[l],
                        r->t_max[l]};
}

// What the lane may have met: a crossing as near as the first that is wanted, unless that
// or what comes before is a graze or at the very ends of the range.
static bool is_right(const struct boundary_list *all, const struct ray *r, bool met,
                     double t, double dt, unsigned crossing, uint32_t part, bool any,
                     double slack)
{
    const double close = 1e-7;
    for (uint32_t i = 0; i < all->count; i++) {
        const struct boundary *b = &all->at[i];
        const bool unsure = (i + 1 < all->count && all->at[i + 1].t - b->t < close) ||
                            (i > 0 && b->t - all->at[i - 1].t < close) ||
                            fabs(b->t - r->t_min) < close ||
                            fabs(b->t - r->t_max) < close;
        const bool wanted = b->drawn && b->t > r->t_min && b->t < r->t_max;
        // Where the surface leaves the container either may be told.
        const bool same = met && crossing == b->crossing &&
                          fabs(t - b->t) <= dt + b->dt + slack &&
                          (part == b->part || (part == 0) != (b->part == 0));
        if (same || (any && met && wanted))
            return true;
        if (wanted && !unsure)
            return false;
    }
    if (!met)
        return true;
    // A graze that the one line did not report.
    for (uint32_t i = 0; i < all->count; i++)
        if (fabs(t - all->at[i].t) < close)
            return true;
    return false;
}

// The first crossing that is wanted, bit by bit; with `any`, the t of one that is.
static void assert_same_bits(const struct boundary_list *all, const struct ray *r,
                             bool met, bool any, const struct shape_hits *h, int l,
                             const char *text)
{
    const struct boundary *b = NULL;
    for (uint32_t i = 0; i < all->count; i++)
        if (all->at[i].drawn && all->at[i].t > r->t_min && all->at[i].t <= r->t_max &&
            (!b || (any && met && all->at[i].t == h->t[l])))
            b = &all->at[i];
    if (met != (b != NULL) || (b && h->t[l] != b->t) ||
        (b && !any &&
         (h->t[l] != b->t || h->dt[l] != b->dt || h->u[l] != b->u || h->v[l] != b->v ||
          h->part[l] != b->part || h->crossing[l] != b->crossing)))
        fail_msg("%s: %d at %.17g +- %g part %u, not %d at %.17g +- %g part %u; from "
                 "<%.17g, %.17g, %.17g> along <%.17g, %.17g, %.17g>",
                 text, met, met ? h->t[l] : 0, met ? h->dt[l] : 0, met ? h->part[l] : 0,
                 b != NULL, b ? b->t : 0, b ? b->dt : 0, b ? b->part : 0, r->o.x, r->o.y,
                 r->o.z, r->d.x, r->d.y, r->d.z);
}

void lanes_compare(const struct loaded *l, const char *text, bool any, int packets,
                   bool grid, bool bits)
{
    // Noise jumps by some 1e-10 where its lattice has planes.
    const double slack = strstr(text, "internal") ? 1e-7 : 0;
    static const struct shape_kernels *kernels[3] = {&shape_kernels_base};
    const struct leaf *leaf = &l->world->leaf[0];
    const struct packet_kernels *best = packet_kernels_choose();
    kernels[1] = kernels[2] = best->shapes;
    struct boundary_list all = {0};
    uint64_t s = 3 + (uint64_t)any;
    int hits = 0;
    for (int n = 0; n < packets; n++) {
        struct shape_rays rays;
        struct shape_hits first, other, alone;
        lanes_random_rays(&s, grid, &rays);
        memset(&first, 0, sizeof first);
        memset(&other, 0, sizeof other);
        memset(&alone, 0, sizeof alone);
        const unsigned met =
            leaf->ops->closest8(kernels[0], leaf->shape, &rays, 255, any, &first);
        assert_int_equal(
            met, leaf->ops->closest8(kernels[1], leaf->shape, &rays, 255, any, &other));
        unsigned one_by_one = 0;
        for (int i = 0; i < 8; i++)
            one_by_one |=
                leaf->ops->closest8(kernels[1], leaf->shape, &rays, 1u << i, any, &alone);
        assert_int_equal(met, one_by_one);
        for (int i = 0; i < 8; i++) {
            const struct ray r = lanes_ray(&rays, i);
            const bool in = met >> i & 1;
            all.count = 0;
            leaf->ops->intersect(leaf->shape, &r, &all);
            if (bits)
                assert_same_bits(&all, &r, in, any, &first, i, text);
            else if (!is_right(&all, &r, in, first.t[i], first.dt[i], first.crossing[i],
                               first.part[i], any, slack))
                fail_msg(
                    "%s: packet %d lane %d any %d: %d at %.17g +- %g, %u crossings from "
                    "%.17g in %.17g .. %.17g",
                    text, n, i, any, in, first.t[i], first.dt[i], all.count,
                    all.count ? all.at[0].t : 0, r.t_min, r.t_max);
            if (!in)
                continue;
            hits++;
            assert_memory_equal(&first.t[i], &other.t[i], sizeof *first.t);
            assert_memory_equal(&first.dt[i], &other.dt[i], sizeof *first.dt);
            assert_memory_equal(&first.u[i], &other.u[i], sizeof *first.u);
            assert_memory_equal(&first.v[i], &other.v[i], sizeof *first.v);
            assert_int_equal(first.part[i], other.part[i]);
            assert_int_equal(first.crossing[i], other.crossing[i]);
            if (any) // of several crossings, the one that is come to first
                continue;
            assert_memory_equal(&first.t[i], &alone.t[i], sizeof *first.t);
            assert_memory_equal(&first.dt[i], &alone.dt[i], sizeof *first.dt);
        }
    }
    // A touch is no crossing.
    assert_true(hits > packets / 4 || strcmp(text, TOUCHED) == 0);
    boundary_list_free(&all);
}
