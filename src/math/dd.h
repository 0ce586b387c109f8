#ifndef MATH_DD_H
#define MATH_DD_H

// Double-double arithmetic: hi + lo with |lo| <= ulp(hi)/2, about 106 bits.
// Dekker 1971; Shewchuk 1997. No fma, so that every CPU gives the same bits.
struct dd {
    double hi, lo;
};

// |a| >= |b| or a == 0.
static inline struct dd dd_fast_sum(double a, double b)
{
    double s = a + b;
    return (struct dd){s, b - (s - a)};
}
static inline struct dd dd_two_sum(double a, double b)
{
    double s = a + b, t = s - a;
    return (struct dd){s, (a - (s - t)) + (b - t)};
}
// Exact unless |a| or |b| is above 2^995 or the product's low part underflows.
static inline struct dd dd_two_prod(double a, double b)
{
    const double split = 134217729.0; // 2^27 + 1
    double ca = split * a, ah = ca - (ca - a), al = a - ah;
    double cb = split * b, bh = cb - (cb - b), bl = b - bh;
    double p = a * b;
    return (struct dd){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}
static inline struct dd dd_add(struct dd a, struct dd b)
{
    struct dd s = dd_two_sum(a.hi, b.hi);
    return dd_fast_sum(s.hi, s.lo + (a.lo + b.lo));
}
static inline struct dd dd_mul(struct dd a, struct dd b)
{
    struct dd p = dd_two_prod(a.hi, b.hi);
    return dd_fast_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}
static inline struct dd dd_scale(double s, struct dd a)
{
    struct dd p = dd_two_prod(s, a.hi);
    return dd_fast_sum(p.hi, p.lo + s * a.lo);
}
static inline struct dd dd_div(struct dd a, struct dd b)
{
    double q = a.hi / b.hi;
    struct dd p = dd_two_prod(q, b.hi);
    double rest = ((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo);
    return dd_fast_sum(q, rest / b.hi);
}

#endif
