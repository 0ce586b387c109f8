#include "math/aabb.h"

#include "math/gamma.h"
#include "math/larger.h"

struct aabb aabb_empty(void)
{
    return (struct aabb){vec3(INFINITY, INFINITY, INFINITY),
                         vec3(-INFINITY, -INFINITY, -INFINITY)};
}

struct aabb aabb_infinite(void)
{
    return (struct aabb){vec3(-INFINITY, -INFINITY, -INFINITY),
                         vec3(INFINITY, INFINITY, INFINITY)};
}

static struct vec3 lower(struct vec3 a, struct vec3 b)
{
    return vec3(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z);
}

static struct vec3 upper(struct vec3 a, struct vec3 b)
{
    return vec3(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}

struct aabb aabb_join(struct aabb a, struct aabb b)
{
    if (aabb_is_empty(a))
        return b;
    if (aabb_is_empty(b))
        return a;
    return (struct aabb){lower(a.min, b.min), upper(a.max, b.max)};
}

struct aabb aabb_meet(struct aabb a, struct aabb b)
{
    struct aabb c = {upper(a.min, b.min), lower(a.max, b.max)};
    return aabb_is_empty(c) ? aabb_empty() : c;
}

struct aabb aabb_add(struct aabb a, struct vec3 p)
{
    return (struct aabb){lower(a.min, p), upper(a.max, p)};
}

bool aabb_is_empty(struct aabb a)
{
    return !(a.min.x <= a.max.x && a.min.y <= a.max.y && a.min.z <= a.max.z);
}

bool aabb_is_finite(struct aabb a)
{
    return isfinite(a.min.x) && isfinite(a.min.y) && isfinite(a.min.z) &&
           isfinite(a.max.x) && isfinite(a.max.y) && isfinite(a.max.z);
}

bool aabb_overlap(struct aabb a, struct aabb b)
{
    return !aabb_is_empty(aabb_meet(a, b));
}

static double pad_down(double v) { return v - GAMMA(8) * fabs(v); }
static double pad_up(double v) { return v + GAMMA(8) * fabs(v); }

struct aabb aabb_pad(struct aabb a)
{
    return (struct aabb){vec3(pad_down(a.min.x), pad_down(a.min.y), pad_down(a.min.z)),
                         vec3(pad_up(a.max.x), pad_up(a.max.y), pad_up(a.max.z))};
}

struct aabb aabb_around(struct vec3 centre, const double half[3],
                        const struct transform *t)
{
    const double c[3] = {centre.x, centre.y, centre.z};
    const double offset[3] = {t->offset.x, t->offset.y, t->offset.z};
    double min[3], max[3];
    for (int j = 0; j < 3; j++) {
        double at = offset[j], size = fabs(offset[j]) + half[j];
        for (int i = 0; i < 3; i++) {
            at += t->linear.m[i][j] * c[i];
            size += fabs(t->linear.m[i][j] * c[i]);
        }
        min[j] = at - half[j] - GAMMA(16) * size;
        max[j] = at + half[j] + GAMMA(16) * size;
    }
    return (struct aabb){vec3(min[0], min[1], min[2]), vec3(max[0], max[1], max[2])};
}

// The box of the eight corners, one axis of the result at a time (Arvo, Graphics Gems
// 1990). A zero coefficient leaves an infinite side out.
struct aabb aabb_transform(struct aabb a, const struct transform *t)
{
    if (t->identity || aabb_is_empty(a))
        return a;
    const double lo[3] = {a.min.x, a.min.y, a.min.z};
    const double hi[3] = {a.max.x, a.max.y, a.max.z};
    const double offset[3] = {t->offset.x, t->offset.y, t->offset.z};
    double min[3], max[3];
    for (int j = 0; j < 3; j++) {
        double size = fabs(offset[j]);
        min[j] = max[j] = offset[j];
        for (int i = 0; i < 3; i++) {
            double m = t->linear.m[i][j];
            if (m == 0)
                continue;
            double p = m * lo[i], q = m * hi[i];
            min[j] += smaller(p, q);
            max[j] += larger(p, q);
            size += larger(fabs(p), fabs(q));
        }
        if (isfinite(size) && !transform_is_diagonal(t)) {
            min[j] -= GAMMA(6) * size;
            max[j] += GAMMA(6) * size;
        }
    }
    return (struct aabb){vec3(min[0], min[1], min[2]), vec3(max[0], max[1], max[2])};
}
