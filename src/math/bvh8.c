#include "math/bvh8.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "base/arena.h"

enum {
    BINS = 16,
    LEAF_ITEMS = 4,   // a leaf may be split below this only if that pays
    DEPTH_BINNED = 24 // below, halve by count: the depth stays within BVH8_STACK
};

// The error of a test in units of the half extent of the tree: rounding the moved
// origin, subtracting and multiplying cost at most 4 half-ulps of it (2^-24 each).
static const double PAD = 0x1p-21;

struct range {
    uint32_t first, count;
    struct aabb box;
    bool whole; // a leaf: not to be split any more
};

struct builder {
    const struct aabb *box;
    uint32_t *order;
    struct bvh8_node *node;
    uint32_t node_count, node_capacity;
    struct vec3 origin;
    double pad;
};

static struct vec3 middle(struct aabb b)
{
    return vec3(0.5 * b.min.x + 0.5 * b.max.x, 0.5 * b.min.y + 0.5 * b.max.y,
                0.5 * b.min.z + 0.5 * b.max.z);
}

static double lesser(double a, double b) { return b < a ? b : a; }
static double greater(double a, double b) { return b > a ? b : a; }

// aabb_join of boxes that are not empty, in place: most of the work of a build.
static inline void widen(struct aabb *a, const struct aabb *b)
{
    a->min.x = lesser(a->min.x, b->min.x);
    a->min.y = lesser(a->min.y, b->min.y);
    a->min.z = lesser(a->min.z, b->min.z);
    a->max.x = greater(a->max.x, b->max.x);
    a->max.y = greater(a->max.y, b->max.y);
    a->max.z = greater(a->max.z, b->max.z);
}

static struct aabb range_box(const struct builder *b, uint32_t first, uint32_t count)
{
    struct aabb box = aabb_empty();
    for (uint32_t i = 0; i < count; i++)
        widen(&box, &b->box[b->order[first + i]]);
    return box;
}

struct cut {
    int axis, bin;
    double cost, from, width;
    struct aabb near, far; // of the items on either side
};

// The items of a range whose centres are in the same part of an axis. Boxes of bins
// without items are not set.
struct bins {
    double from, width; // of all centres
    uint32_t count[BINS];
    struct aabb box[BINS];
};

static inline int bin_at(double middle, double from, double width)
{
    int k = (int)((middle - from) / width * BINS);
    return k < 0 ? 0 : k >= BINS ? BINS - 1 : k;
}

static inline void put_in_bin(struct bins *bins, double middle, const struct aabb *box)
{
    int k = bin_at(middle, bins->from, bins->width);
    if (bins->count[k]++)
        widen(&bins->box[k], box);
    else
        bins->box[k] = *box;
}

static int bin_of(const struct builder *b, uint32_t item, const struct cut *c)
{
    return bin_at(vec3_axis(middle(b->box[item]), c->axis), c->from, c->width);
}

static inline double half_area(const struct aabb *a)
{
    const double x = a->max.x - a->min.x, y = a->max.y - a->min.y, z = a->max.z - a->min.z;
    return x * y + y * z + z * x;
}

static inline void add_bin(struct aabb *sum, uint32_t *n, const struct bins *bins, int i)
{
    if (!bins->count[i])
        return;
    if (*n)
        widen(sum, &bins->box[i]);
    else
        *sum = bins->box[i];
    *n += bins->count[i];
}

// The surface area heuristic over BINS equal bins of the centres along one axis.
static void try_axis(const struct bins *bins, int axis, struct cut *best)
{
    double area[BINS]; // behind each bin, itself included
    uint32_t behind[BINS], n = 0;
    struct aabb sum;
    for (int i = BINS - 1; i > 0; i--) {
        add_bin(&sum, &n, bins, i);
        behind[i] = n;
        area[i] = n ? half_area(&sum) : 0;
    }
    n = 0;
    for (int i = 0; i < BINS - 1 && behind[i + 1]; i++) {
        if (!bins->count[i]) // the cut before it is the same
            continue;
        add_bin(&sum, &n, bins, i);
        const double cost = half_area(&sum) * n + area[i + 1] * behind[i + 1];
        if (cost < best->cost) {
            best->cost = cost;
            best->axis = axis;
            best->bin = i;
        }
    }
}

static void settle(struct cut *c, const struct bins *bins)
{
    uint32_t n = 0;
    c->from = bins->from;
    c->width = bins->width;
    for (int i = 0; i <= c->bin; i++)
        add_bin(&c->near, &n, bins, i);
    n = 0;
    for (int i = c->bin + 1; i < BINS; i++)
        add_bin(&c->far, &n, bins, i);
}

static bool find_cut(const struct builder *b, const struct range *r, struct cut *best)
{
    const uint32_t *item = b->order + r->first;
    struct aabb centres = aabb_empty();
    struct bins bins[3];
    for (uint32_t i = 0; i < r->count; i++) {
        const struct vec3 m = middle(b->box[item[i]]);
        widen(&centres, &(struct aabb){m, m});
    }
    for (int axis = 0; axis < 3; axis++) {
        bins[axis].from = vec3_axis(centres.min, axis);
        bins[axis].width = vec3_axis(centres.max, axis) - bins[axis].from;
        memset(bins[axis].count, 0, sizeof bins[axis].count);
    }
    for (uint32_t i = 0; i < r->count; i++) {
        const struct aabb *box = &b->box[item[i]];
        const struct vec3 m = middle(*box);
        if (bins[0].width > 0)
            put_in_bin(&bins[0], m.x, box);
        if (bins[1].width > 0)
            put_in_bin(&bins[1], m.y, box);
        if (bins[2].width > 0)
            put_in_bin(&bins[2], m.z, box);
    }
    best->axis = -1;
    best->cost = DBL_MAX;
    for (int axis = 0; axis < 3; axis++)
        try_axis(&bins[axis], axis, best);
    if (best->axis >= 0)
        settle(best, &bins[best->axis]);
    return best->axis >= 0;
}

// A stable partition, so that the tree depends on the order of the scene alone.
static uint32_t partition(struct builder *b, const struct range *r, const struct cut *c)
{
    uint32_t *far = malloc(r->count * sizeof *far), n = r->first, m = 0;
    if (!far)
        abort();
    for (uint32_t i = 0; i < r->count; i++) {
        uint32_t item = b->order[r->first + i];
        if (bin_of(b, item, c) <= c->bin)
            b->order[n++] = item;
        else
            far[m++] = item;
    }
    for (uint32_t i = 0; i < m; i++)
        b->order[n + i] = far[i];
    free(far);
    return n - r->first;
}

static bool split(struct builder *b, struct range *r, uint32_t depth, struct range *rest)
{
    if (r->count <= 1)
        return false;
    uint32_t left = r->count / 2;
    struct cut c;
    const bool cut = depth < DEPTH_BINNED && find_cut(b, r, &c);
    if (cut) {
        // A test of a box costs about as much as half a test of an object.
        double area = aabb_half_area(r->box);
        if (r->count <= LEAF_ITEMS && c.cost + 0.5 * area >= area * r->count)
            return false;
        left = partition(b, r, &c);
    } else if (r->count <= LEAF_ITEMS) {
        return false;
    }
    *rest = (struct range){.first = r->first + left, .count = r->count - left};
    rest->box = cut ? c.far : range_box(b, rest->first, rest->count);
    r->count = left;
    r->box = cut ? c.near : range_box(b, r->first, r->count);
    return true;
}

static float round_down(double v)
{
    float f = (float)v;
    return (double)f > v ? nextafterf(f, -INFINITY) : f;
}

static void set_box(const struct builder *b, struct bvh8_node *n, int i, struct aabb box)
{
    for (int axis = 0; axis < 3; axis++) {
        double o = vec3_axis(b->origin, axis);
        n->box[axis][i] = round_down(vec3_axis(box.min, axis) - o - b->pad);
        n->box[3 + axis][i] = -round_down(-(vec3_axis(box.max, axis) - o + b->pad));
    }
}

static uint32_t new_node(struct builder *b)
{
    if (b->node_count == b->node_capacity) {
        b->node_capacity = b->node_capacity ? 2 * b->node_capacity : 64;
        b->node = realloc(b->node, b->node_capacity * sizeof *b->node);
        if (!b->node)
            abort();
    }
    struct bvh8_node *n = &b->node[b->node_count];
    for (int i = 0; i < 8; i++) {
        n->child[i] = BVH8_EMPTY;
        for (int axis = 0; axis < 3; axis++) {
            n->box[axis][i] = 1e30f;
            n->box[3 + axis][i] = -1e30f;
        }
    }
    return b->node_count++;
}

// The range with the largest box that may still be split; -1: none.
static int widest(const struct range *r, int count)
{
    int best = -1;
    for (int i = 0; i < count; i++)
        if (!r[i].whole &&
            (best < 0 || aabb_half_area(r[i].box) > aabb_half_area(r[best].box)))
            best = i;
    return best;
}

// The depth of the recursion is bounded: see DEPTH_BINNED.
static uint32_t make_node(struct builder *b, struct range all, uint32_t depth)
{
    struct range r[8] = {all};
    int n = 1;
    for (int i; n < 8 && (i = widest(r, n)) >= 0;) {
        if (split(b, &r[i], depth, &r[n]))
            n++;
        else
            r[i].whole = true;
    }
    uint32_t id = new_node(b);
    for (int i = 0; i < n; i++) {
        set_box(b, &b->node[id], i, r[i].box);
        int32_t child = r[i].count <= LEAF_ITEMS ? bvh8_leaf(r[i].first, r[i].count)
                                                 : (int32_t)make_node(b, r[i], depth + 1);
        b->node[id].child[i] = child;
    }
    return id;
}

struct bvh8 bvh8_build(struct arena *a, const struct aabb *box, const uint32_t *index,
                       uint32_t count)
{
    struct bvh8 t = {.bounds = aabb_empty(), .item_count = count};
    if (!count)
        return t;
    struct builder b = {.box = box};
    b.order = malloc(count * sizeof *b.order);
    if (!b.order)
        abort();
    for (uint32_t i = 0; i < count; i++) {
        b.order[i] = i;
        t.bounds = aabb_join(t.bounds, box[i]);
    }
    t.origin = b.origin = middle(t.bounds);
    b.pad = PAD * vec3_max_abs(vec3_sub(t.bounds.max, t.origin)) + FLT_MIN;
    make_node(&b, (struct range){0, count, t.bounds, false}, 0);
    t.node_count = b.node_count;
    t.node = arena_alloc_aligned(a, b.node_count * sizeof *t.node, 64);
    for (uint32_t i = 0; i < b.node_count; i++)
        t.node[i] = b.node[i];
    t.item = arena_new_array(a, uint32_t, count);
    for (uint32_t i = 0; i < count; i++)
        t.item[i] = index[b.order[i]];
    struct vec3 pad = vec3(b.pad, b.pad, b.pad);
    t.bounds = (struct aabb){vec3_sub(t.bounds.min, pad), vec3_add(t.bounds.max, pad)};
    free(b.node);
    free(b.order);
    return t;
}

// ---- rays -------------------------------------------------------------------

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
        // Less than this moves the ray by nothing while it crosses the tree.
        if (fabs(d[a]) < 0x1p-60) {
            if (!(o >= lo && o <= hi))
                return false;
            d[a] = d[a] < 0 ? -0x1p-60 : 0x1p-60;
            continue;
        }
        double t0 = (lo - o) / vec3_axis(ray->d, a), t1 = (hi - o) / vec3_axis(ray->d, a);
        t_min = fmax(t_min, fmin(t0, t1));
        t_max = fmin(t_max, fmax(t0, t1));
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
        in = _mm_and_ps(in, _mm_cmpge_ps(_mm_loadu_ps(&n->box[3][half]),
                                         _mm_set1_ps(lo[0])));
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
