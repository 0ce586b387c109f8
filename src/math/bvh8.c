#include "math/bvh8.h"

#include <float.h>

#include "math/gamma.h"
#include "math/larger.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

bool bvh8_ray_begin(const struct bvh8 *b, const struct ray *ray, double t_min,
                    double t_max, struct bvh8_ray *out)
{
    if (!b->node)
        return false;
    double largest = vec3_max_abs(ray->d), d[3];
    if (!(largest > 0))
        return false;
    for (int a = 0; a < 3; a++) {
        double o = vec3_axis(ray->o, a);
        double lo = vec3_axis(b->bounds.min, a), hi = vec3_axis(b->bounds.max, a);
        d[a] = vec3_axis(ray->d, a) / largest;
        out->negative[a] = d[a] < 0 ? 3 : 0;
        // Less than the tree's padding while the ray crosses it.
        if (RUNS_ALONG(d[a], 1)) {
            if (!(o >= lo && o <= hi))
                return false;
            d[a] = d[a] < 0 ? -0x1p-60 : 0x1p-60;
            continue;
        }
        double t0 = (lo - o) / vec3_axis(ray->d, a), t1 = (hi - o) / vec3_axis(ray->d, a);
        t_min = larger(smaller(t0, t1), t_min);
        t_max = smaller(larger(t0, t1), t_max);
    }
    if (!(t_min <= t_max))
        return false;
    struct vec3 o = vec3_sub(vec3_mad(ray->o, t_min, ray->d), b->origin);
    for (int a = 0; a < 3; a++) {
        out->o[a] = (float)vec3_axis(o, a);
        out->inverse[a] = (float)(1 / d[a]);
        // No box is out of reach of a ray from nowhere, not even one that is not there.
        if (!(fabsf(out->o[a]) <= FLT_MAX && fabsf(out->inverse[a]) <= FLT_MAX))
            return false;
    }
    out->t_begin = t_min;
    out->scale = largest;
    bvh8_ray_limit(out, t_max);
    return true;
}

void bvh8_ray_limit(struct bvh8_ray *r, double t)
{
    double far = (t - r->t_begin) * r->scale;
    r->t_far = far < 1e30 ? (float)far * BVH8_SLACK : 1e30f;
}

void bvh8_walk_begin(struct bvh8_walk *w, const struct bvh8 *b)
{
    w->depth = 0;
    w->visits = 0;
    if (b->node)
        w->stack[w->depth++] = (struct bvh8_entry){0, 0};
}

// Which boxes the ray meets between 0 and t_far, and where it enters them.
static unsigned node_hits(const struct bvh8_node *n, const struct bvh8_ray *r,
                          float near_t[8])
{
    unsigned bits = 0;
#ifdef __SSE2__
    const __m128 slack = _mm_set1_ps(BVH8_SLACK);
    for (int half = 0; half < 8; half += 4) {
        __m128 near = _mm_setzero_ps(), far = _mm_set1_ps(r->t_far);
        for (int a = 0; a < 3; a++) {
            __m128 o = _mm_set1_ps(r->o[a]), i = _mm_set1_ps(r->inverse[a]);
            __m128 p = _mm_loadu_ps(&n->box[a + r->negative[a]][half]);
            __m128 q = _mm_loadu_ps(&n->box[a + 3 - r->negative[a]][half]);
            near = _mm_max_ps(near, _mm_mul_ps(_mm_sub_ps(p, o), i));
            far = _mm_min_ps(far, _mm_mul_ps(_mm_sub_ps(q, o), i));
        }
        _mm_storeu_ps(near_t + half, near);
        __m128 met = _mm_cmple_ps(near, _mm_mul_ps(far, slack));
        bits |= (unsigned)_mm_movemask_ps(met) << half;
    }
#else
    for (int k = 0; k < 8; k++) {
        float near = 0, far = r->t_far;
        for (int a = 0; a < 3; a++) {
            float p = (n->box[a + r->negative[a]][k] - r->o[a]) * r->inverse[a];
            float q = (n->box[a + 3 - r->negative[a]][k] - r->o[a]) * r->inverse[a];
            near = p > near ? p : near;
            far = q < far ? q : far;
        }
        near_t[k] = near;
        bits |= (unsigned)(near <= far * BVH8_SLACK) << k;
    }
#endif
    return bits;
}

// Pushes the children so that the nearest is on top.
static void push_children(struct bvh8_walk *w, const struct bvh8_node *n, unsigned bits,
                          const float t[8])
{
    uint32_t base = w->depth;
    for (; bits; bits &= bits - 1) {
        int k = __builtin_ctz(bits);
        uint32_t at = w->depth++;
        for (; at > base && w->stack[at - 1].t < t[k]; at--)
            w->stack[at] = w->stack[at - 1];
        w->stack[at] = (struct bvh8_entry){n->child[k], t[k]};
    }
}

bool bvh8_walk_next(struct bvh8_walk *w, const struct bvh8 *b, const struct bvh8_ray *r,
                    uint32_t *first, uint32_t *count)
{
    while (w->depth) {
        struct bvh8_entry e = w->stack[--w->depth];
        if (e.t > r->t_far * BVH8_SLACK)
            continue;
        if (e.child < 0) {
            *first = bvh8_leaf_first(e.child);
            *count = bvh8_leaf_count(e.child);
            return true;
        }
        float t[8];
        const struct bvh8_node *n = &b->node[e.child];
        w->visits++;
        push_children(w, n, node_hits(n, r, t), t);
    }
    return false;
}

// Which boxes meet the box lo..hi.
static unsigned node_touches(const struct bvh8_node *n, const float lo[3],
                             const float hi[3])
{
    unsigned bits = 0;
#ifdef __SSE2__
    for (int half = 0; half < 8; half += 4) {
        __m128 in = _mm_cmple_ps(_mm_loadu_ps(&n->box[0][half]), _mm_set1_ps(hi[0]));
        in = _mm_and_ps(in,
                        _mm_cmpge_ps(_mm_loadu_ps(&n->box[3][half]), _mm_set1_ps(lo[0])));
        for (int a = 1; a < 3; a++) {
            __m128 from = _mm_loadu_ps(&n->box[a][half]);
            __m128 to = _mm_loadu_ps(&n->box[3 + a][half]);
            in = _mm_and_ps(in, _mm_cmple_ps(from, _mm_set1_ps(hi[a])));
            in = _mm_and_ps(in, _mm_cmpge_ps(to, _mm_set1_ps(lo[a])));
        }
        bits |= (unsigned)_mm_movemask_ps(in) << half;
    }
#else
    for (int k = 0; k < 8; k++) {
        bool in = true;
        for (int a = 0; a < 3; a++)
            in = in && n->box[a][k] <= hi[a] && n->box[3 + a][k] >= lo[a];
        bits |= (unsigned)in << k;
    }
#endif
    return bits;
}

bool bvh8_walk_box(struct bvh8_walk *w, const struct bvh8 *b, const float lo[3],
                   const float hi[3], uint32_t *first, uint32_t *count)
{
    while (w->depth) {
        const int32_t child = w->stack[--w->depth].child;
        if (child == BVH8_EMPTY) // a box that holds all numbers touches these as well
            continue;
        if (child < 0) {
            *first = bvh8_leaf_first(child);
            *count = bvh8_leaf_count(child);
            return true;
        }
        const struct bvh8_node *n = &b->node[child];
        w->visits++;
        for (unsigned bits = node_touches(n, lo, hi); bits; bits &= bits - 1)
            w->stack[w->depth++] = (struct bvh8_entry){n->child[__builtin_ctz(bits)], 0};
    }
    return false;
}

bool bvh8_walk_point(struct bvh8_walk *w, const struct bvh8 *b, const float p[3],
                     uint32_t *first, uint32_t *count)
{
    return bvh8_walk_box(w, b, p, p, first, count);
}
