// The hemicube (Cohen, Greenberg 1985): the other elements are drawn, with a depth
// buffer, on the upper half of a cube about the centre of an element; each pixel counts
// for a known form factor.
#include <stdlib.h>

#include "base/memory.h"
#include "math/elementary.h"
#include "math/pi.h"
#include "radiosity/form_factor.h"
#include "radiosity/hemicube.h"
#include "radiosity/sequence.h"

struct hemicube {
    int resolution;
    float *depth;
    uint32_t *item;
    double *delta; // of the pixels of the top, then of one side
};

struct hemicube *hemicube_new(int resolution)
{
    struct hemicube *h = must_calloc(1, sizeof *h);
    const size_t pixels = (size_t)resolution * (size_t)resolution;
    h->resolution = resolution;
    h->depth = must_malloc(pixels, sizeof *h->depth);
    h->item = must_malloc(pixels, sizeof *h->item);
    h->delta = must_malloc(2 * pixels, sizeof *h->delta);
    double sum = 0;
    for (size_t i = 0; i < 2 * pixels; i++) {
        const size_t at = i % pixels;
        const double x = (2.0 * (double)(at % (size_t)resolution) + 1) / resolution - 1;
        const double y = (2.0 * (double)(at / (size_t)resolution) + 1) / resolution - 1;
        const double r2 = x * x + y * y + 1;
        const bool side = i >= pixels;
        h->delta[i] = !side ? 1 / (r2 * r2) : y > 0 ? y / (r2 * r2) : 0;
        sum += side ? 4 * h->delta[i] : h->delta[i];
    }
    for (size_t i = 0; i < 2 * pixels; i++)
        h->delta[i] /= sum;
    return h;
}

void hemicube_free(struct hemicube *h)
{
    if (!h)
        return;
    free(h->depth);
    free(h->item);
    free(h->delta);
    free(h);
}

// A face: pixels lie at right * x + up * y + forward, -1 < x, y < 1.
struct face {
    struct vec3 right, up, forward;
};

// A polygon in the frame of a face.
struct drawn {
    struct vec3 corner[4];
    uint32_t count;
};

// The range of pixels it may cover along one axis; false: none. What lies behind the
// plane z = near is cut off.
static bool bounds(const struct drawn *d, int axis, int resolution, int *begin, int *end)
{
    static const double near = 1e-3;
    double low = 2, high = -2;
    for (uint32_t i = 0; i < d->count; i++) {
        const struct vec3 a = d->corner[i], b = d->corner[i + 1 == d->count ? 0 : i + 1];
        const double size = vec3_max_abs(a) + vec3_max_abs(b);
        const double cut = near * size;
        if (a.z > cut) {
            const double x = vec3_axis(a, axis) / a.z;
            low = fmin(low, x);
            high = fmax(high, x);
        }
        if ((a.z > cut) != (b.z > cut)) {
            const double t = (cut - a.z) / (b.z - a.z);
            const double x =
                (vec3_axis(a, axis) + t * (vec3_axis(b, axis) - vec3_axis(a, axis))) /
                cut;
            low = fmin(low, x);
            high = fmax(high, x);
        }
    }
    if (low > 1 || high < -1)
        return false;
    *begin = (int)floor((fmax(low, -1) + 1) / 2 * resolution - 0.5);
    *end = (int)ceil((fmin(high, 1) + 1) / 2 * resolution + 0.5);
    *begin = *begin < 0 ? 0 : *begin;
    *end = *end > resolution ? resolution : *end;
    return *begin < *end;
}

static void draw(struct hemicube *h, const struct drawn *d, uint32_t item)
{
    int x0, x1, y0, y1;
    if (!bounds(d, 0, h->resolution, &x0, &x1) || !bounds(d, 1, h->resolution, &y0, &y1))
        return;
    struct vec3 edge[4], normal = {0, 0, 0};
    for (uint32_t i = 0; i < d->count; i++) {
        // Its front is towards us: corners go clockwise, edges' planes face inwards.
        const uint32_t j = i + 1 == d->count ? 0 : i + 1;
        edge[i] = vec3_cross(d->corner[j], d->corner[i]);
        normal = vec3_add(normal, edge[i]);
    }
    const double offset = vec3_dot(normal, d->corner[0]);
    for (int y = y0; y < y1; y++) {
        for (int x = x0; x < x1; x++) {
            const struct vec3 at = vec3((2.0 * x + 1) / h->resolution - 1,
                                        (2.0 * y + 1) / h->resolution - 1, 1);
            bool within = true;
            for (uint32_t i = 0; i < d->count && within; i++)
                within = vec3_dot(edge[i], at) >= 0;
            const float depth = (float)(offset / vec3_dot(normal, at));
            const size_t p = (size_t)y * (size_t)h->resolution + (size_t)x;
            if (within && depth > 0 && depth < h->depth[p]) {
                h->depth[p] = depth;
                h->item[p] = item;
            }
        }
    }
}

static struct drawn in_face(const struct element *e, struct vec3 eye,
                            const struct face *f)
{
    struct drawn d = {.count = e->corner_count};
    for (uint32_t i = 0; i < e->corner_count; i++) {
        const struct vec3 r = vec3_sub(e->corner[i], eye);
        d.corner[i] =
            vec3(vec3_dot(r, f->right), vec3_dot(r, f->up), vec3_dot(r, f->forward));
    }
    return d;
}

static void face_row(struct factor_state *s, uint32_t i, const struct face *f,
                     const double *delta, float *row)
{
    const struct enclosure *e = s->enclosure;
    struct hemicube *h = s->hemicube;
    const size_t pixels = (size_t)h->resolution * (size_t)h->resolution;
    for (size_t p = 0; p < pixels; p++) {
        h->depth[p] = INFINITY;
        h->item[p] = ELEMENT_NONE;
    }
    const struct vec3 eye = e->element[i].centre;
    for (uint32_t j = 0; j < e->count; j++) {
        const struct element *other = &e->element[j];
        if (j == i || vec3_dot(vec3_sub(eye, other->centre), other->normal) <= 0)
            continue;
        const struct drawn d = in_face(other, eye, f);
        draw(h, &d, j);
    }
    for (size_t p = 0; p < pixels; p++)
        if (h->item[p] != ELEMENT_NONE)
            row[h->item[p]] += (float)delta[p];
}

void row_hemicube(struct factor_state *s, uint32_t i, float *row)
{
    const struct element *e = &s->enclosure->element[i];
    if (!s->hemicube)
        s->hemicube = hemicube_new(s->settings->resolution);
    const size_t pixels =
        (size_t)s->hemicube->resolution * (size_t)s->hemicube->resolution;
    for (uint32_t j = 0; j < s->enclosure->count; j++)
        row[j] = 0;
    // Turned at random, so that the errors of pixels do not line up.
    const double turn = 2 * PI * sequence_seed(i, s->settings->seed) / 4294967296.0;
    const struct vec3 n = e->normal;
    const struct vec3 aside = fabs(n.x) < 0.5 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const struct vec3 a = vec3_normalize(vec3_cross(n, aside)), b = vec3_cross(n, a);
    const struct vec3 x = vec3_mad(vec3_scale(det_cos(turn), a), det_sin(turn), b);
    const struct vec3 y = vec3_cross(n, x);
    const struct face faces[5] = {{x, y, n},
                                  {y, n, x},
                                  {vec3_neg(y), n, vec3_neg(x)},
                                  {vec3_neg(x), n, y},
                                  {x, n, vec3_neg(y)}};
    for (int f = 0; f < 5; f++)
        face_row(s, i, &faces[f], s->hemicube->delta + (f ? pixels : 0), row);
}
