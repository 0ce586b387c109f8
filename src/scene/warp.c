// From a point outside to the pattern's own space (spec/textures 3.4, 4).

#include <string.h>

#include "base/arena.h"
#include "math/pi.h"
#include "scene/pattern.h"
#include "scene/pattern_math.h"
#include "scene/warp.h"

static struct vec3 turbulence_move(const struct turbulence *t, struct vec3 p)
{
    struct vec3 d = noise_dturbulence(p, t->lambda, t->omega, t->octaves);
    return vec3_add(p, vec3_mul(d, t->amount));
}

static struct vec3 repeat(const struct warp *w, struct vec3 p)
{
    const int axis = w->repeat.x != 0 ? 0 : w->repeat.y != 0 ? 1 : 2;
    const float width = (float)vec3_axis(w->repeat, axis);
    if (width == 0)
        return p;
    double c[3] = {p.x, p.y, p.z};
    const double flip[3] = {w->flip.x != 0 ? -1 : 1, w->flip.y != 0 ? -1 : 1,
                            w->flip.z != 0 ? -1 : 1};
    // The number of the block and its start are single precision.
    const float n = (float)floor(c[axis] / width);
    c[axis] -= n * width;
    if (fmod(n, 2) != 0) {
        for (int i = 0; i < 3; i++)
            c[i] *= flip[i];
        if (flip[axis] < 0)
            c[axis] += width;
    }
    return vec3_mad(vec3(c[0], c[1], c[2]), n, w->offset);
}

static double block_of(double v, double width)
{
    return width >= PATTERN_EDGE ? floor(v / width) : 0;
}

static struct vec3 black_hole(const struct warp *w, struct vec3 p)
{
    struct vec3 c = w->centre;
    const struct vec3 v = w->repeat, u = w->uncertainty;
    if (v.x != 0 || v.y != 0 || v.z != 0) {
        struct vec3 b = vec3(block_of(p.x, v.x), block_of(p.y, v.y), block_of(p.z, v.z));
        if (u.x != 0 || u.y != 0 || u.z != 0) {
            unsigned n = noise_cell_hash(b.x, b.y, b.z);
            c = vec3_add(c, vec3_mul(vec3(noise_random(n), noise_random(n + 1),
                                          noise_random(n + 2)),
                                     u));
        }
        c = vec3_add(c, vec3_mul(v, b));
    }
    const struct vec3 d = vec3_sub(p, c);
    const double length = vec3_length(d);
    if (length >= w->radius || w->type != 0)
        return p;
    double k = det_pow((w->radius - length) / w->radius, w->falloff) * w->strength;
    if (k > 1)
        k = 1;
    return vec3_mad(p, w->inverse ? -k : k, d);
}

// Not a rotation: a sum of components (spec/textures 4.3).
static struct vec3 orient(const struct warp *w, double x, double y, double z)
{
    const struct vec3 o = w->orientation;
    if (o.x == 0 && o.y == 0 && o.z == 1)
        return vec3(x, y, z);
    return vec3(o.x * z + o.y * x + o.z * x, o.x * y + o.y * -z + o.z * y,
                o.x * -x + o.y * y + o.z * z);
}

static double distance_factor(const struct warp *w, double r)
{
    return w->dist_exp == 0 ? 1 : w->dist_exp == 1 ? r : det_pow(r, w->dist_exp);
}

static struct vec3 cylindrical(const struct warp *w, struct vec3 p)
{
    const double length = sqrt(p.x * p.x + p.z * p.z);
    if (length == 0)
        return p;
    double a = azimuth(p.x, p.z) / (2 * PI);
    return orient(w, a * distance_factor(w, length), p.y, length);
}

static struct vec3 spherical(const struct warp *w, struct vec3 p)
{
    const double rho = vec3_length(p);
    if (rho == 0)
        return p;
    const struct vec3 n = vec3(p.x / rho, p.y / rho, p.z / rho);
    const double length = sqrt(n.x * n.x + n.z * n.z), f = distance_factor(w, rho);
    double a = length == 0 ? 0 : azimuth(n.x, n.z) / (2 * PI);
    double b = 0.5 + quick_atan2(n.y, length) / PI;
    return orient(w, a * f, b * f, rho);
}

static struct vec3 toroidal(const struct warp *w, struct vec3 p)
{
    const double length = sqrt(p.x * p.x + p.z * p.z);
    if (length == 0)
        return p;
    double a = azimuth(p.x, p.z) / (2 * PI);
    double x = length - w->major_radius, r = sqrt(x * x + p.y * p.y);
    double phi = quick_atan2(fabs(p.y), -x);
    if (p.y > 0)
        phi = 2 * PI - phi;
    double f = distance_factor(w, r);
    return orient(w, a * f, phi / (2 * PI) * f, r);
}

// The six faces of a cube unfolded to a cross.
static struct vec3 cubic(struct vec3 p)
{
    const double x = p.x, y = p.y, z = p.z;
    const double ax = fabs(x), ay = fabs(y), az = fabs(z);
#define QUARTER(v) (0.25 * (((v) + 1) / 2))
#define THIRD(v)   ((1.0 / 3) * (((v) + 1) / 2))
    if (x >= 0 && x >= ay && x >= az)
        return vec3(0.75 - QUARTER(z / x), 1.0 / 3 + THIRD(y / x), x);
    if (y >= 0 && y >= ax && y >= az)
        return vec3(0.25 + QUARTER(x / y), 1.0 - THIRD(z / y), y);
    if (z >= 0 && z >= ax && z >= ay)
        return vec3(0.25 + QUARTER(x / z), 1.0 / 3 + THIRD(y / z), z);
    if (x < 0 && x <= -ay && x <= -az)
        return vec3(QUARTER(z / -x), 1.0 / 3 + THIRD(y / -x), -x);
    if (y < 0 && y <= -ax && y <= -az)
        return vec3(0.25 + QUARTER(x / -y), THIRD(z / -y), -y);
    return vec3(1.0 - QUARTER(x / -z), 1.0 / 3 + THIRD(y / -z), -z);
#undef QUARTER
#undef THIRD
}

struct vec3 warp_point(const struct warp *w, struct vec3 p)
{
    switch (w->kind) {
    case WARP_TRANSFORM: return transform_inverse_point(&w->transform, p);
    case WARP_TURBULENCE: return turbulence_move(&w->turbulence, p);
    case WARP_REPEAT: return repeat(w, p);
    case WARP_BLACK_HOLE: return black_hole(w, p);
    case WARP_PLANAR: return orient(w, p.x, p.y, w->distance);
    case WARP_CYLINDRICAL: return cylindrical(w, p);
    case WARP_SPHERICAL: return spherical(w, p);
    case WARP_TOROIDAL: return toroidal(w, p);
    case WARP_CUBIC: return cubic(p);
    }
    return p;
}

static inline double clamp_far(double v)
{
    return v > WARP_FAR ? WARP_FAR : v < -WARP_FAR ? -WARP_FAR : v;
}

bool turbulence_is_warp(const struct pattern *p)
{
    const struct turbulence *t = p->turbulence;
    return t && !(p->ops && p->ops->own_turbulence) &&
           (t->amount.x != 0 || t->amount.y != 0 || t->amount.z != 0);
}

struct vec3 pattern_warp(const struct pattern *p, struct vec3 at)
{
    for (const struct warp *w = p->warps; w; w = w->next)
        at = warp_point(w, at);
    if (turbulence_is_warp(p))
        at = turbulence_move(p->turbulence, at);
    return vec3(clamp_far(at.x), clamp_far(at.y), clamp_far(at.z));
}

struct vec3 pattern_normal_in(const struct pattern *p, struct vec3 n, bool keep_length)
{
    if (!keep_length)
        n = vec3_normalize(n);
    bool moved = false;
    for (const struct warp *w = p->warps; w; w = w->next)
        if (w->kind == WARP_TRANSFORM) {
            n = transform_inverse_normal(&w->transform, n);
            moved = true;
        }
    return moved && !keep_length ? vec3_normalize(n) : n;
}

static struct vec3 normal_back(const struct warp *w, struct vec3 n)
{
    if (!w)
        return n;
    n = normal_back(w->next, n);
    return w->kind == WARP_TRANSFORM ? transform_normal(&w->transform, n) : n;
}

struct vec3 pattern_normal_out(const struct pattern *p, struct vec3 n, bool keep_length)
{
    return keep_length ? normal_back(p->warps, n)
                       : vec3_normalize(normal_back(p->warps, vec3_normalize(n)));
}

void pattern_add_transform(struct arena *a, struct pattern *p, const struct transform *t)
{
    struct warp *w = arena_new_struct(a, struct warp);
    const struct warp *front = p->warps;
    w->kind = WARP_TRANSFORM;
    if (front && front->kind == WARP_TRANSFORM) {
        w->transform = transform_then(&front->transform, t);
        w->next = front->next;
    } else {
        w->transform = *t;
        w->next = front;
    }
    p->warps = w;
}

const struct pattern pattern_none;

const struct pattern *pattern_keep(struct arena *a, const struct pattern *p,
                                   const struct pattern *known)
{
    if (!memcmp(p, known, sizeof *p))
        return known;
    struct pattern *kept = arena_new_struct(a, struct pattern);
    *kept = *p;
    return kept;
}

const struct pattern *pattern_moved(struct arena *a, const struct pattern *p,
                                    const struct transform *t)
{
    struct pattern *moved = arena_new_struct(a, struct pattern);
    *moved = p ? *p : pattern_none;
    pattern_add_transform(a, moved, t);
    return moved;
}

void pattern_add_warp(struct arena *a, struct pattern *p, const struct warp *w)
{
    struct warp *copy = arena_new_struct(a, struct warp);
    *copy = *w;
    copy->next = p->warps;
    p->warps = copy;
}
