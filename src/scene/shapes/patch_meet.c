// A line against a sub-patch: across the line's direction the patch is a map of the plane,
// and its zeros are wanted.
//
// Three cases. The control points lie on one side of the line: none. The map, multiplied by
// the inverse of its mean derivative, is nearer to the identity than 1/2: one zero at most,
// and Newton's method finds it from the middle. Else the net is halved and both halves are
// looked at. Zeros on the common edge of two pieces are found by both and kept once.
#include <float.h>
#include <math.h>

#include "math/gamma.h"
#include "math/larger.h"
#include "scene/shapes/patch.h"

enum { AXES = 3, STEPS_MAX = 12, DEPTH_MAX = 110, SPLITS_MAX = 4000 };
static const double IDENTITY = 0.5;

struct net {
    double p[4][4][AXES]; // across, across, along the line
    double u[2], v[2];
};

struct search {
    struct patch_hit *hit;
    int count, splits;
    double noise; // bound on the rounding of a control point across the line
};

static void halve(const double *p[4], double *low[4], double *high[4])
{
    for (int k = 0; k < AXES; k++) {
        const double a = 0.5 * (p[0][k] + p[1][k]), b = 0.5 * (p[1][k] + p[2][k]);
        const double c = 0.5 * (p[2][k] + p[3][k]), d = 0.5 * (a + b), e = 0.5 * (b + c);
        const double p0 = p[0][k], p3 = p[3][k], f = 0.5 * (d + e);
        low[0][k] = p0;
        low[1][k] = a;
        low[2][k] = d;
        low[3][k] = high[0][k] = f;
        high[1][k] = e;
        high[2][k] = c;
        high[3][k] = p3;
    }
}

static void split(const struct net *n, bool along_u, struct net *low, struct net *high)
{
    *low = *high = *n;
    for (int k = 0; k < 4; k++) {
        const double *p[4];
        double *a[4], *b[4];
        for (int i = 0; i < 4; i++) {
            p[i] = along_u ? n->p[i][k] : n->p[k][i];
            a[i] = along_u ? low->p[i][k] : low->p[k][i];
            b[i] = along_u ? high->p[i][k] : high->p[k][i];
        }
        halve(p, a, b);
    }
    if (along_u)
        low->u[1] = high->u[0] = 0.5 * (n->u[0] + n->u[1]);
    else
        low->v[1] = high->v[0] = 0.5 * (n->v[0] + n->v[1]);
}

// Whether the net lies on one side of the line; *extent is its size across the line.
static bool excludes(const struct net *n, double noise, double *extent)
{
    *extent = 0;
    for (int k = 0; k < 2; k++) {
        double lo = n->p[0][0][k], hi = lo;
        for (int i = 0; i < 16; i++) {
            const double v = n->p[i / 4][i % 4][k];
            lo = v < lo ? v : lo;
            hi = v > hi ? v : hi;
        }
        if (lo > noise || hi < -noise)
            return true;
        *extent = larger(*extent, hi - lo);
    }
    return false;
}

struct frame {
    double du[2], dv[2];  // mean derivatives across the line
    double inverse[2][2]; // of the map (s, t) -> s du + t dv, rows
    double norm;          // of the inverse: largest row sum
    double off;           // how far from the identity
};

static void apply(const struct frame *f, double x, double y, double out[2])
{
    out[0] = f->inverse[0][0] * x + f->inverse[0][1] * y;
    out[1] = f->inverse[1][0] * x + f->inverse[1][1] * y;
}

static bool invert(struct frame *f)
{
    const double det = f->du[0] * f->dv[1] - f->du[1] * f->dv[0];
    if (!(fabs(det) > DBL_MIN))
        return false;
    f->inverse[0][0] = f->dv[1] / det;
    f->inverse[0][1] = -f->dv[0] / det;
    f->inverse[1][0] = -f->du[1] / det;
    f->inverse[1][1] = f->du[0] / det;
    f->norm = larger(fabs(f->inverse[0][0]) + fabs(f->inverse[0][1]),
                     fabs(f->inverse[1][0]) + fabs(f->inverse[1][1]));
    return true;
}

static void mean(const struct net *n, struct frame *f)
{
    for (int k = 0; k < 2; k++) {
        double u = 0, v = 0;
        for (int i = 0; i < 4; i++) {
            u += n->p[3][i][k] - n->p[0][i][k];
            v += n->p[i][3][k] - n->p[i][0][k];
        }
        f->du[k] = 0.25 * u;
        f->dv[k] = 0.25 * v;
    }
}

// Looks at the net through the inverse of its mean derivative: whether it then lies beside
// the line, else how far its derivative is from the identity. The derivatives' control
// vectors are three times the differences of the net.
static bool measure(const struct net *n, struct frame *f, double noise)
{
    double q[4][4][2], lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < 16; i++) {
        double *to = q[i / 4][i % 4];
        apply(f, n->p[i / 4][i % 4][0], n->p[i / 4][i % 4][1], to);
        for (int k = 0; k < 2; k++) {
            lo[k] = to[k] < lo[k] ? to[k] : lo[k];
            hi[k] = larger(to[k], hi[k]);
        }
    }
    const double slack = 2 * f->norm * noise;
    if (lo[0] > slack || lo[1] > slack || hi[0] < -slack || hi[1] < -slack)
        return false;
    double worst[2][2] = {{0, 0}, {0, 0}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 2; k++) {
                const double a = 3 * (q[i + 1][j][k] - q[i][j][k]) - (k == 0);
                const double b = 3 * (q[j][i + 1][k] - q[j][i][k]) - (k == 1);
                worst[k][0] = larger(worst[k][0], fabs(a));
                worst[k][1] = larger(worst[k][1], fabs(b));
            }
    f->off = larger(worst[0][0] + worst[0][1], worst[1][0] + worst[1][1]);
    return true;
}

// The axes from `from` to before `to`.
static inline void evaluate(const struct net *n, const double st[2], int from, int to,
                            double at[AXES], double du[AXES], double dv[AXES])
{
    double bu[4], bv[4], cu[4], cv[4];
    basis(st[0], bu, cu);
    basis(st[1], bv, cv);
    for (int k = from; k < to; k++) {
        at[k] = du[k] = dv[k] = 0;
        for (int i = 0; i < 4; i++) {
            double row = 0, slope = 0;
            for (int j = 0; j < 4; j++) {
                row += bv[j] * n->p[i][j][k];
                slope += cv[j] * n->p[i][j][k];
            }
            at[k] += bu[i] * row;
            du[k] += cu[i] * row;
            dv[k] += bu[i] * slope;
        }
    }
}

// Keeps a zero unless a neighbouring piece has found it.
static void keep(struct search *s, double t, double dt, double u, double v,
                 double reach_u, double reach_v)
{
    for (int i = 0; i < s->count; i++)
        if (fabs(s->hit[i].u - u) <= reach_u && fabs(s->hit[i].v - v) <= reach_v)
            return;
    if (s->count < PATCH_HITS)
        s->hit[s->count++] = (struct patch_hit){t, dt, u, v};
}

static double within(double w) { return w < 0 ? 0 : w > 1 ? 1 : w; }

static void keep_at(struct search *s, const struct net *n, const double st[2],
                    double slack, double dt, double along)
{
    const double wu = n->u[1] - n->u[0], wv = n->v[1] - n->v[0];
    keep(s, along, dt, within(n->u[0] + wu * st[0]), within(n->v[0] + wv * st[1]),
         4 * slack * wu, 4 * slack * wv);
}

// False: Newton's method did not settle.
static bool newton(struct search *s, const struct net *n, const struct frame *f)
{
    double st[2] = {0.5, 0.5}, at[AXES], du[AXES], dv[AXES], step[2], last = HUGE_VAL;
    struct frame here = *f;
    for (int i = 0; i < STEPS_MAX; i++) {
        evaluate(n, st, 0, 2, at, du, dv);
        if (i == 0) {
            apply(f, at[0], at[1], step);
            if (larger(fabs(step[0]), fabs(step[1])) >
                0.5 * (1 + f->off) + f->norm * s->noise + 0x1p-40)
                return true; // outside
        }
        for (int k = 0; k < 2; k++) {
            here.du[k] = du[k];
            here.dv[k] = dv[k];
        }
        if (!invert(&here))
            return false;
        apply(&here, at[0], at[1], step);
        const double size = larger(fabs(step[0]), fabs(step[1]));
        const double slack = 2 * here.norm * s->noise + 0x1p-44;
        const double here_st[2] = {st[0], st[1]};
        st[0] -= step[0];
        st[1] -= step[1];
        if (size <= slack || (size >= last && size < 0x1p-20)) {
            if (st[0] < -slack || st[0] > 1 + slack || st[1] < -slack ||
                st[1] > 1 + slack)
                return true;
            evaluate(n, here_st, 2, 3, at, du, dv);
            const double along = at[2] - step[0] * du[2] - step[1] * dv[2];
            const double slant =
                here.norm * (fabs(du[2]) + fabs(dv[2])); // along per across
            keep_at(s, n, st, slack, s->noise * (2 + 2 * slant), along);
            return true;
        }
        if (!(size < 4))
            return false;
        last = size;
    }
    return false;
}

// Whether the whole net is a line as seen along the ray: the ray runs in the surface.
static bool edge_on(const struct net *n, double noise, double extent)
{
    const double *o = n->p[0][0];
    double far[2] = {0, 0};
    for (int i = 1; i < 16; i++) {
        const double *p = n->p[i / 4][i % 4], x = p[0] - o[0], y = p[1] - o[1];
        if (x * x + y * y > far[0] * far[0] + far[1] * far[1]) {
            far[0] = x;
            far[1] = y;
        }
    }
    for (int i = 1; i < 16; i++) {
        const double *p = n->p[i / 4][i % 4];
        if (fabs((p[0] - o[0]) * far[1] - (p[1] - o[1]) * far[0]) > 4 * noise * extent)
            return false;
    }
    return true;
}

static double length_along(const struct net *n, bool along_u)
{
    double most = 0;
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 3; i++) {
            const double *a = along_u ? n->p[i][j] : n->p[j][i];
            const double *b = along_u ? n->p[i + 1][j] : n->p[j][i + 1];
            double sum = 0;
            for (int k = 0; k < AXES; k++)
                sum += (b[k] - a[k]) * (b[k] - a[k]);
            most = larger(most, sum);
        }
    return most;
}

static void solve(struct search *s, const struct net *n, int depth)
{
    struct frame f;
    double extent;
    if (excludes(n, s->noise, &extent) || s->splits > SPLITS_MAX)
        return;
    mean(n, &f);
    if (invert(&f)) {
        if (!measure(n, &f, s->noise) || (f.off < IDENTITY && newton(s, n, &f)))
            return;
    }
    if (extent <= 4 * s->noise || depth == DEPTH_MAX) {
        // A fold or a collapsed edge, right on the line.
        const double st[2] = {0.5, 0.5}, near = n->p[0][0][2], far = n->p[3][3][2];
        keep_at(s, n, st, 1, s->noise + fabs(far - near), 0.5 * (near + far));
        return;
    }
    if (depth == 0 && edge_on(n, s->noise, extent))
        return;
    struct net low, high;
    s->splits++;
    split(n, length_along(n, true) >= length_along(n, false), &low, &high);
    solve(s, &low, depth + 1);
    solve(s, &high, depth + 1);
}

struct patch_ray patch_ray_of(const struct ray *ray)
{
    struct patch_ray r = {.o = ray->o, .length = vec3_length(ray->d)};
    const struct vec3 d = r.d = vec3_scale(1 / r.length, ray->d);
    // Across d: Frisvad's frame, improved by Duff et al. 2017.
    const double sign = copysign(1, d.z), a = -1 / (sign + d.z), b = d.x * d.y * a;
    r.e1 = vec3(1 + sign * d.x * d.x * a, sign * b, -sign * d.x);
    r.e2 = vec3(b, sign + d.y * d.y * a, -d.y);
    r.size = vec3_max_abs(ray->o);
    return r;
}

// How far a leaf's derivative, seen along the ray and multiplied by the inverse of its mean,
// is from the identity.
static double off_of(const struct patch_leaf *l, const struct patch_ray *r, double facing)
{
    const double tilt_u = fabs(vec3_dot(l->n_dv, r->d) / facing);
    const double tilt_v = fabs(vec3_dot(l->du_n, r->d) / facing);
    return larger(l->bend[0] + l->bend[2] * tilt_u, l->bend[1] + l->bend[2] * tilt_v);
}

// Where the ray meets the plane of a leaf's mean derivatives. False: that far from the
// middle that the leaf is not met.
static bool meets_plane(const struct patch_leaf *l, const struct patch_ray *r,
                        double facing, double off, double noise)
{
    const struct vec3 q = vec3_sub(l->middle, r->o);
    const double s = vec3_dot(q, vec3_cross(l->dv, r->d)) / facing;
    const double t = vec3_dot(q, vec3_cross(r->d, l->du)) / facing;
    const double longer = larger(vec3_max_abs(l->du), vec3_max_abs(l->dv));
    const double reach = 0.5 * (1 + off) + 8 * noise * longer / fabs(facing) + 0x1p-40;
    return fabs(s) <= reach && fabs(t) <= reach;
}

int patch_meet_leaf(const struct patch_leaf *leaf, const struct patch_ray *r,
                    struct patch_hit hit[PATCH_HITS])
{
    const double noise = GAMMA(16) * larger(r->size, leaf->size);
    const double facing = vec3_dot(leaf->n, r->d);
    const double off = off_of(leaf, r, facing);
    const bool plain = off < IDENTITY;
    if (plain && !meets_plane(leaf, r, facing, off, noise))
        return 0;
    struct net n = {.u = {leaf->u[0], leaf->u[1]}, .v = {leaf->v[0], leaf->v[1]}};
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            const struct vec3 q = vec3_sub(leaf->p[i][j], r->o);
            n.p[i][j][0] = vec3_dot(q, r->e1);
            n.p[i][j][1] = vec3_dot(q, r->e2);
            n.p[i][j][2] = vec3_dot(q, r->d);
        }
    struct search s;
    s.hit = hit;
    s.count = s.splits = 0;
    s.noise = noise;
    struct frame f = {.off = off};
    if (plain)
        mean(&n, &f);
    if (!plain || !invert(&f) || !newton(&s, &n, &f))
        solve(&s, &n, 0);
    for (int i = 0; i < s.count; i++) {
        hit[i].t /= r->length;
        hit[i].dt = hit[i].dt / r->length + GAMMA(4) * fabs(hit[i].t);
    }
    return s.count;
}
