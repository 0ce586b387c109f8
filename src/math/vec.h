#ifndef MATH_VEC_H
#define MATH_VEC_H

#include <math.h>

struct vec2 {
    double u, v;
};

struct vec3 {
    double x, y, z;
};

// Points are o + t*d; d need not be unit length, so that t means the same in
// world and object space. Hits count for t_min < t < t_max.
struct ray {
    struct vec3 o, d;
    double t_min, t_max;
};

static inline struct vec3 vec3(double x, double y, double z)
{
    return (struct vec3){x, y, z};
}
static inline struct vec3 vec3_add(struct vec3 a, struct vec3 b)
{
    return vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline struct vec3 vec3_sub(struct vec3 a, struct vec3 b)
{
    return vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}
static inline struct vec3 vec3_neg(struct vec3 a) { return vec3(-a.x, -a.y, -a.z); }
static inline struct vec3 vec3_scale(double s, struct vec3 a)
{
    return vec3(s * a.x, s * a.y, s * a.z);
}
// a + s*b
static inline struct vec3 vec3_mad(struct vec3 a, double s, struct vec3 b)
{
    return vec3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}
static inline struct vec3 vec3_mul(struct vec3 a, struct vec3 b)
{
    return vec3(a.x * b.x, a.y * b.y, a.z * b.z);
}
static inline double vec3_dot(struct vec3 a, struct vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline struct vec3 vec3_cross(struct vec3 a, struct vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double vec3_length(struct vec3 a) { return sqrt(vec3_dot(a, a)); }
// The zero vector stays zero.
static inline struct vec3 vec3_normalize(struct vec3 a)
{
    double l = vec3_length(a);
    return l > 0 ? vec3(a.x / l, a.y / l, a.z / l) : a;
}
// Not fmax, which is a call: its care for NaN is not wanted here.
static inline double vec3_max_abs(struct vec3 a)
{
    const double x = fabs(a.x), y = fabs(a.y), z = fabs(a.z);
    const double xy = x > y ? x : y;
    return xy > z ? xy : z;
}
static inline double vec3_axis(struct vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}
static inline struct vec3 ray_at(const struct ray *r, double t)
{
    return vec3_mad(r->o, t, r->d);
}

#endif
