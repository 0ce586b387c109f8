#include "math/transform.h"

#include "math/elementary.h"
#include "math/gamma.h"
#include "math/pi.h"

const struct transform transform_identity = {
    .linear = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    .inverse = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    .identity = true,
};

static struct vec3 row_times(struct vec3 p, const struct mat3 *m)
{
    return vec3(p.x * m->m[0][0] + p.y * m->m[1][0] + p.z * m->m[2][0],
                p.x * m->m[0][1] + p.y * m->m[1][1] + p.z * m->m[2][1],
                p.x * m->m[0][2] + p.y * m->m[1][2] + p.z * m->m[2][2]);
}

static struct vec3 times_column(const struct mat3 *m, struct vec3 n)
{
    return vec3(m->m[0][0] * n.x + m->m[0][1] * n.y + m->m[0][2] * n.z,
                m->m[1][0] * n.x + m->m[1][1] * n.y + m->m[1][2] * n.z,
                m->m[2][0] * n.x + m->m[2][1] * n.y + m->m[2][2] * n.z);
}

static struct mat3 mat3_times(const struct mat3 *a, const struct mat3 *b)
{
    struct mat3 c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] +
                        a->m[i][2] * b->m[2][j];
    return c;
}

static struct mat3 mat3_transpose(const struct mat3 *a)
{
    struct mat3 c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c.m[i][j] = a->m[j][i];
    return c;
}

struct transform transform_translate(struct vec3 by)
{
    struct transform t = transform_identity;
    t.offset = by;
    t.identity = by.x == 0 && by.y == 0 && by.z == 0;
    return t;
}

struct transform transform_scale(struct vec3 by)
{
    struct transform t = transform_identity;
    const double s[3] = {by.x, by.y, by.z};
    for (int i = 0; i < 3; i++) {
        t.linear.m[i][i] = s[i];
        t.inverse.m[i][i] = 1 / s[i];
    }
    t.identity = by.x == 1 && by.y == 1 && by.z == 1;
    return t;
}

// Quarter turns come out exact, so that what is turned by 90 degrees stays aligned
// with the axes to the last bit.
static void sin_cos_degrees(double degrees, double *s, double *c)
{
    double r = fmod(degrees, 360);
    if (fmod(r, 90) == 0) {
        static const double sines[] = {0, 1, 0, -1};
        int quarter = ((int)(r / 90) + 4) % 4;
        *s = sines[quarter];
        *c = sines[(quarter + 1) % 4];
        return;
    }
    double radians = r * DEGREE;
    *s = det_sin(radians);
    *c = det_cos(radians);
}

static struct transform orthogonal(struct mat3 m)
{
    struct transform t = {.linear = m, .inverse = mat3_transpose(&m)};
    return t;
}

struct transform transform_rotate(struct vec3 degrees)
{
    const double angle[3] = {degrees.x, degrees.y, degrees.z};
    struct transform t = transform_identity;
    for (int axis = 0; axis < 3; axis++) {
        if (angle[axis] == 0)
            continue;
        double s, c;
        sin_cos_degrees(angle[axis], &s, &c);
        int i = (axis + 1) % 3, j = (axis + 2) % 3;
        struct mat3 m = {{{0}}};
        m.m[axis][axis] = 1;
        m.m[i][i] = m.m[j][j] = c;
        m.m[i][j] = s;
        m.m[j][i] = -s;
        struct transform turn = orthogonal(m);
        t = transform_then(&t, &turn);
    }
    return t;
}

// Rodrigues' formula in row-vector form.
struct transform transform_rotate_axis(struct vec3 axis, double radians)
{
    struct vec3 a = vec3_normalize(axis);
    double s = det_sin(radians), c = det_cos(radians), k = 1 - c;
    struct mat3 m = {{
        {a.x * a.x * k + c, a.x * a.y * k + a.z * s, a.x * a.z * k - a.y * s},
        {a.x * a.y * k - a.z * s, a.y * a.y * k + c, a.y * a.z * k + a.x * s},
        {a.x * a.z * k + a.y * s, a.y * a.z * k - a.x * s, a.z * a.z * k + c},
    }};
    return orthogonal(m);
}

// The inverse through cofactors. The determinant counts as zero when it is within
// the rounding of its own six products.
static bool mat3_invert(const struct mat3 *a, struct mat3 *out)
{
    double det = 0, size = 0;
    struct mat3 cof;
    for (int i = 0; i < 3; i++) {
        int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (int j = 0; j < 3; j++) {
            int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            double p = a->m[i1][j1] * a->m[i2][j2], q = a->m[i1][j2] * a->m[i2][j1];
            cof.m[i][j] = p - q;
            if (i == 0) {
                det += a->m[i][j] * cof.m[i][j];
                size += fabs(a->m[i][j]) * (fabs(p) + fabs(q));
            }
        }
    }
    if (!(fabs(det) > GAMMA(4) * size) || !isfinite(det))
        return false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            out->m[i][j] = cof.m[j][i] / det;
            if (!isfinite(out->m[i][j]))
                return false;
        }
    return true;
}

bool transform_matrix(const double rows[4][3], struct transform *out)
{
    struct transform t = {.offset = vec3(rows[3][0], rows[3][1], rows[3][2])};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            t.linear.m[i][j] = rows[i][j];
    // Scaled by a power of two, so that the determinant neither over- nor underflows.
    double largest = 0;
    for (int i = 0; i < 9; i++)
        largest = fmax(largest, fabs(t.linear.m[i / 3][i % 3]));
    if (!(largest > 0) || !isfinite(largest))
        return false;
    int exponent;
    frexp(largest, &exponent);
    struct mat3 scaled;
    for (int i = 0; i < 9; i++)
        scaled.m[i / 3][i % 3] = ldexp(t.linear.m[i / 3][i % 3], -exponent);
    if (!mat3_invert(&scaled, &t.inverse))
        return false;
    bool identity = t.offset.x == 0 && t.offset.y == 0 && t.offset.z == 0;
    for (int i = 0; i < 9; i++) {
        t.inverse.m[i / 3][i % 3] = ldexp(t.inverse.m[i / 3][i % 3], -exponent);
        identity &= t.linear.m[i / 3][i % 3] == (i % 4 == 0);
    }
    t.identity = identity;
    *out = t;
    return true;
}

struct transform transform_then(const struct transform *first,
                                const struct transform *second)
{
    if (first->identity)
        return *second;
    if (second->identity)
        return *first;
    struct transform t = {
        .linear = mat3_times(&first->linear, &second->linear),
        .inverse = mat3_times(&second->inverse, &first->inverse),
        .offset = vec3_add(row_times(first->offset, &second->linear), second->offset),
    };
    return t;
}

struct transform transform_invert(const struct transform *t)
{
    struct transform r = {
        .linear = t->inverse,
        .inverse = t->linear,
        .offset = vec3_neg(row_times(t->offset, &t->inverse)),
        .identity = t->identity,
    };
    return r;
}

bool transform_is_similarity(const struct transform *t, double *scale)
{
    // Rotations written one after the other each add about four roundings.
    const double tolerance = GAMMA(64);
    struct vec3 r[3];
    double size[3];
    for (int i = 0; i < 3; i++) {
        r[i] = vec3(t->linear.m[i][0], t->linear.m[i][1], t->linear.m[i][2]);
        size[i] = vec3_dot(r[i], r[i]);
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        if (!(fabs(size[j] - size[i]) <= tolerance * size[i]) ||
            !(fabs(vec3_dot(r[i], r[j])) <= tolerance * size[i]))
            return false;
    }
    *scale = fabs(size[0] - 1) <= tolerance ? 1 : sqrt(size[0]);
    return true;
}

bool transform_is_diagonal(const struct transform *t)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (i != j && t->linear.m[i][j] != 0)
                return false;
    return true;
}

struct vec3 transform_point(const struct transform *t, struct vec3 p)
{
    return t->identity ? p : vec3_add(row_times(p, &t->linear), t->offset);
}

struct vec3 transform_vector(const struct transform *t, struct vec3 v)
{
    return t->identity ? v : row_times(v, &t->linear);
}

struct vec3 transform_normal(const struct transform *t, struct vec3 n)
{
    return t->identity ? n : times_column(&t->inverse, n);
}

struct vec3 transform_inverse_point(const struct transform *t, struct vec3 p)
{
    return t->identity ? p : row_times(vec3_sub(p, t->offset), &t->inverse);
}

struct vec3 transform_inverse_vector(const struct transform *t, struct vec3 v)
{
    return t->identity ? v : row_times(v, &t->inverse);
}

struct vec3 transform_inverse_normal(const struct transform *t, struct vec3 n)
{
    return t->identity ? n : times_column(&t->linear, n);
}

struct ray transform_inverse_ray(const struct transform *t, const struct ray *r)
{
    return (struct ray){transform_inverse_point(t, r->o),
                        transform_inverse_vector(t, r->d), r->t_min, r->t_max};
}
