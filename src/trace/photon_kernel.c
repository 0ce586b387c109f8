// The search for the nearest photons, compiled once per instruction set. Nearer boxes come
// first, and what is found waits unsorted until there is too much of it: then the nearest
// are told from the others by bisecting the distance. All instruction sets find the same
// photons in the same order.
#include <float.h>

#include "math/isa.h"
#include "math/lanes_vec.h"
#include "trace/photon_search.h"

static const double flatness = 16;

LANES_INLINE struct real8 load(const float *p) { return r8_of_floats(f8_load(p)); }

LANES_INLINE unsigned first_bits(uint32_t n) { return n >= 8 ? 255 : (1u << n) - 1; }

// ---- the nearest so far --------------------------------------------------------------

// Appends the lanes of `bits`, in their order; eight places behind the last are written.
LANES_INLINE uint32_t append(double *distance2, uint32_t *photon, uint32_t count,
                             unsigned bits, const double *d, const uint32_t *id)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    const __mmask8 m = (__mmask8)bits;
    _mm512_storeu_pd(distance2 + count, _mm512_maskz_compress_pd(m, _mm512_loadu_pd(d)));
    _mm256_storeu_si256(
        (void *)(photon + count),
        _mm256_maskz_compress_epi32(m, _mm256_loadu_si256((const void *)id)));
    return count + (uint32_t)__builtin_popcount(bits);
#else
    for (; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        distance2[count] = d[i];
        photon[count++] = id[i];
    }
    return count;
#endif
}

static uint32_t within(const struct photon_search *s, double d)
{
    const struct real8 limit = r8_set(d);
    uint32_t n = 0;
    for (uint32_t i = 0; i < s->count; i += 8)
        n += (uint32_t)__builtin_popcount(
            m8_bits(r8_le(r8_load(s->distance2 + i), limit)));
    return n;
}

// The last places of the last eight are INFINITY, which no photon is.
static void pad(struct photon_search *s)
{
    for (uint32_t i = s->count; i % 8; i++)
        s->distance2[i] = INFINITY;
}

static double farthest(const struct photon_search *s)
{
    struct real8 far = r8_set(0);
    double d[8];
    for (uint32_t i = 0; i < s->count; i += 8) {
        const struct real8 v = r8_load(s->distance2 + i);
        far = r8_max(r8_select(r8_lt(v, r8_set(INFINITY)), v, far), far);
    }
    r8_store(d, far);
    for (int i = 1; i < 8; i++)
        d[0] = d[i] > d[0] ? d[i] : d[0];
    return d[0];
}

// Keeps those not beyond d, but of those at d only the first `equal`.
static void keep(struct photon_search *s, double d, uint32_t equal)
{
    const struct real8 limit = r8_set(d);
    const uint32_t count = s->count;
    s->count = 0;
    for (uint32_t i = 0; i < count; i += 8) {
        const struct real8 v = r8_load(s->distance2 + i);
        unsigned in = m8_bits(r8_le(v, limit)) & first_bits(count - i);
        double own[8];
        uint32_t id[8];
        r8_store(own, v);
        for (int k = 0; k < 8; k++)
            id[k] = s->photon[i + (uint32_t)k];
        for (unsigned same = in & m8_bits(r8_eq(v, limit)); same; same &= same - 1) {
            if (equal)
                equal--;
            else
                in &= ~(same & -same);
        }
        s->count = append(s->distance2, s->photon, s->count, in, own, id);
    }
}

// A distance between two, where `wanted` of `count` photons may be expected on its near side.
// Photons on a surface lie evenly in the square of the distance; every fourth step halves, in
// case they do not. `low`: no number between is left.
static double guess(double low, double high, uint32_t wanted, uint32_t count,
                    uint32_t step)
{
    const double from = low > 0 ? low : 0;
    const double even = from + (high - from) * ((wanted + 0.5) / (count + 1));
    if (step % 4 != 3 && even > low && even < high)
        return even;
    const double middle = low + (high - low) / 2;
    return middle < high ? middle : low;
}

// Leaves the nearest where there are more than wanted.
static void nearest(struct photon_search *s)
{
    pad(s);
    double high = farthest(s), low = -high; // not below what is wanted, and below it
    uint32_t below = 0, n = s->count;       // how many are within these
    for (uint32_t step = 0; n > s->most; step++) {
        const double d = guess(low, high, s->most - below, n - below, step);
        if (!(d > low))
            break; // what lies between is at `high`
        const uint32_t k = within(s, d);
        if (k < s->most) {
            low = d;
            below = k;
        } else {
            high = d;
            n = k;
        }
    }
    if (n < s->count || n > s->most) {
        keep(s, high, n > s->most ? s->most - below : UINT32_MAX);
        pad(s);
    }
    s->limit2 = farthest(s);
}

// ---- the tree ------------------------------------------------------------------------

static void leaf(struct photon_search *s, uint32_t at)
{
    const struct photon_leaf *l = &s->tree->leaf[at];
    const struct real8 x = r8_sub(load(l->p[0]), r8_set(s->p[0])),
                       y = r8_sub(load(l->p[1]), r8_set(s->p[1])),
                       z = r8_sub(load(l->p[2]), r8_set(s->p[2]));
    struct real8 d2 = r8_add(r8_add(r8_mul(x, x), r8_mul(y, y)), r8_mul(z, z));
    if (s->flat) {
        // A disc rather than a ball: what lies off the plane is farther, the more the
        // farther (spec/lighting.md 11.5).
        const struct real8 off =
            r8_abs(r8_add(r8_add(r8_mul(x, r8_set(s->n[0])), r8_mul(y, r8_set(s->n[1]))),
                          r8_mul(z, r8_set(s->n[2]))));
        d2 = r8_mul(d2, r8_add(r8_set(1), r8_mul(r8_set(flatness), off)));
    }
    const unsigned in = m8_bits(r8_le(d2, r8_set(s->limit2)));
    if (!in)
        return;
    double d[8];
    uint32_t id[8];
    r8_store(d, d2);
    for (uint32_t i = 0; i < 8; i++)
        id[i] = 8 * at + i;
    const bool full = s->count >= s->most;
    s->count = append(s->distance2, s->photon, s->count, in, d, id);
    if (s->count >= (full ? 2 * s->most : s->most))
        nearest(s);
}

// What tests of boxes read of a search: single precision, which errs on the near side.
struct box_search {
    struct float8 p[3], slack[3]; // of coordinates, for the rounding of p
    struct float8 n[3], across[3];
    struct float8 off; // what is lost of distances off the plane, of p's rounding
    bool flat;
};

// More than the operations on floats here lose, of what they are made of.
static const float box_rounding = 0x1p-20f;

LANES_INLINE struct box_search box_search_of(const struct photon_search *s)
{
    struct box_search b = {.flat = s->flat};
    float off = 0;
    for (int a = 0; a < 3; a++) {
        const float p = (float)s->p[a], n = (float)s->n[a];
        const float slack = box_rounding * fabsf(p);
        b.p[a] = f8_set(p);
        b.slack[a] = f8_set(slack);
        b.n[a] = f8_set(0.5f * n);
        b.across[a] = f8_set(0.5f * fabsf(n));
        off += slack;
    }
    b.off = f8_set(off);
    return b;
}

// No photon of a box is nearer than this.
LANES_INLINE struct float8 box_distance2(const struct box_search *s,
                                         const struct photon_node *b)
{
    const struct float8 zero = f8_set(0), one = f8_set(1);
    struct float8 d2 = zero, middle = zero, across = zero, size = zero;
    for (int a = 0; a < 3; a++) {
        const struct float8 low = f8_sub(f8_load(b->low[a]), s->p[a]),
                            high = f8_sub(f8_load(b->high[a]), s->p[a]),
                            under = f8_sub(zero, high);
        const struct float8 far = f8_max(low, under);
        const struct float8 out = f8_max(f8_sub(far, s->slack[a]), zero);
        d2 = f8_add(d2, f8_mul(out, out));
        if (s->flat) {
            middle = f8_add(middle, f8_mul(s->n[a], f8_add(low, high)));
            across = f8_add(across, f8_mul(s->across[a], f8_sub(high, low)));
            size = f8_add(size, f8_max(far, f8_max(high, f8_sub(zero, low))));
        }
    }
    d2 = f8_mul(d2, f8_set(1 - box_rounding));
    if (!s->flat)
        return d2;
    const struct float8 lost = f8_add(f8_mul(f8_set(box_rounding), size), s->off);
    const struct float8 off =
        f8_sub(f8_sub(f8_max(middle, f8_sub(zero, middle)), across), lost);
    return f8_mul(d2, f8_add(one, f8_mul(f8_set((float)flatness), f8_max(off, zero))));
}

struct entry {
    float d2;
    uint32_t level, at; // a leaf's is UINT32_MAX
};

// Where what lies behind an entry begins.
LANES_INLINE void fetch(const struct photon_tree *t, uint32_t level, uint32_t at)
{
    const char *p = level == UINT32_MAX ? (const char *)&t->leaf[at]
                                        : (const char *)&t->level[level][at];
    __builtin_prefetch(p);
    __builtin_prefetch(p + 64);
}

// The children of a node that may hold photons within the limit. Numbers beyond floats are
// taken as the largest: what is near is left to doubles.
LANES_INLINE unsigned in_limit(const struct photon_search *s, const struct photon_node *n,
                               struct float8 d2)
{
    static const double slack = 1 + 0x1p-20, most = FLT_MAX;
    const double limit = s->limit2 * slack + (double)FLT_MIN;
    const unsigned any = f8_le(f8_load(n->low[0]), f8_load(n->high[0]));
    return limit < most ? f8_le(d2, f8_set((float)limit)) & any : any;
}

// Puts the children of a node on the stack, the nearest on top.
static int children(const struct photon_search *s, const struct box_search *b,
                    struct entry e, struct entry *stack, int top)
{
    const struct photon_node *n = &s->tree->level[e.level][e.at];
    const struct float8 d2 = box_distance2(b, n);
    const unsigned all = in_limit(s, n, d2);
    float d[8];
    f8_store(d, f8_min(d2, f8_set(FLT_MAX)));
    for (unsigned in = all; in; in &= in - 1) {
        // Below it are those that are farther, and of those as far the ones before it.
        const int i = __builtin_ctz(in);
        const struct float8 own = f8_set(d[i]);
        const unsigned far = f8_le(own, d2), farther = ~f8_le(d2, own);
        const unsigned below = ((far & farther) | (far & ((1u << i) - 1))) & all;
        const uint32_t at = 8 * e.at + (uint32_t)i;
        stack[top + __builtin_popcount(below)] = (struct entry){d[i], e.level - 1, at};
        fetch(s->tree, e.level - 1, at);
    }
    return top + __builtin_popcount(all);
}

void OF_ISA(photon_search_)(struct photon_search *s)
{
    const struct box_search b = box_search_of(s);
    struct entry stack[8 * PHOTON_LEVELS];
    int top = 0;
    s->count = 0;
    if (s->tree->levels)
        stack[top++] = (struct entry){0, s->tree->levels - 1, 0};
    while (top) {
        const struct entry e = stack[--top];
        if ((double)e.d2 > s->limit2)
            continue;
        if (e.level == UINT32_MAX)
            leaf(s, e.at);
        else
            top = children(s, &b, e, stack, top);
    }
    if (s->count > s->most)
        nearest(s);
}
