// sin, cos, tan and their inverses; see elementary.h for the promise.
#include <float.h>
#include <math.h>
#include <stdint.h>

#include "math/dd.h"
#include "math/elementary.h"
#include "math/trig.h"

static const double TWO_OVER_PI = 0x1.45f306dc9c883p-1;
const struct dd trig_half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

// pi/2 in parts of 33 bits (k * part is exact for k < 2^20) and a rest.
static const double PI_2_PART[] = {0x1.921fb54400000p+0, 0x1.0b4611a600000p-34,
                                   0x1.3198a2e000000p-69, 0x1.b839a252049c1p-104};

// The first 1280 bits of 2/pi after the binary point.
static const uint64_t TWO_OVER_PI_BITS[] = {
    0xa2f9836e4e441529u, 0xfc2757d1f534ddc0u, 0xdb6295993c439041u, 0xfe5163abdebbc561u,
    0xb7246e3a424dd2e0u, 0x06492eea09d1921cu, 0xfe1deb1cb129a73eu, 0xe88235f52ebb4484u,
    0xe99c7026b45f7e41u, 0x3991d639835339f4u, 0x9c845f8bbdf9283bu, 0x1ff897ffde05980fu,
    0xef2f118b5a0a6d1fu, 0x6d367ecf27cb09b7u, 0x4f463f669e5fea2du, 0x7527bac7ebe5f17bu,
    0x3d0739f78a5292eau, 0x6bfb5fb11f8d5d08u, 0x56033046fc7b6babu, 0xf0cfbc209af4361du};
enum { TWO_OVER_PI_WORDS = sizeof TWO_OVER_PI_BITS / sizeof TWO_OVER_PI_BITS[0] };

static uint64_t bits_at(int position) // 64 bits of 2/pi; zeros before the point
{
    int word = position >= 0 ? position / 64 : -((63 - position) / 64);
    int shift = position - 64 * word;
    uint64_t a = word >= 0 && word < TWO_OVER_PI_WORDS ? TWO_OVER_PI_BITS[word] : 0;
    uint64_t b =
        word + 1 >= 0 && word + 1 < TWO_OVER_PI_WORDS ? TWO_OVER_PI_BITS[word + 1] : 0;
    return shift ? a << shift | b >> (64 - shift) : a;
}

// Payne & Hanek 1983: x = m * 2^e; m times the 256 bits of 2/pi that matter,
// modulo 2^256, is x * 2/pi modulo 4 with 254 fraction bits.
static struct dd reduce_large(double x, unsigned *quadrant)
{
    int e;
    uint64_t m = (uint64_t)ldexp(frexp(fabs(x), &e), 53);
    e -= 53;
    uint64_t p[8] = {0}; // 32-bit digits, most significant first
    uint64_t carry = 0;
    for (int i = 7; i >= 0; i--) {
        uint64_t w = bits_at(e - 2 + 32 * i) >> 32;
        uint64_t low = w * (m & 0xffffffffu) + carry;
        p[i] += low & 0xffffffffu;
        uint64_t high = w * (m >> 32);
        carry = (low >> 32) + (p[i] >> 32);
        p[i] &= 0xffffffffu;
        if (i > 0)
            p[i - 1] += high & 0xffffffffu;
        if (i > 1)
            p[i - 2] += high >> 32;
    }
    unsigned n = (unsigned)((p[0] + 0x20000000u) >> 30);
    *quadrant = n & 3;
    double fraction[8];
    fraction[0] = (double)p[0] - (double)n * 0x1p30;
    for (int i = 1; i < 8; i++)
        fraction[i] = (double)p[i];
    struct dd f = {0, 0};
    for (int i = 7; i >= 0; i--)
        f = dd_add(dd_two_sum(ldexp(fraction[i], 2 - 32 * (i + 1)), 0), f);
    return dd_mul(f, trig_half_pi);
}

// |x| = quadrant * pi/2 + result (mod 2 pi), |result| <= pi/4 and a little.
static struct dd reduce(double x, unsigned *quadrant)
{
    double ax = fabs(x);
    if (ax > 0x1p20)
        return reduce_large(ax, quadrant);
    double k = floor(ax * TWO_OVER_PI + 0.5);
    *quadrant = (unsigned)k & 3;
    if (k == 0)
        return (struct dd){ax, 0};
    struct dd r = dd_two_sum(ax - k * PI_2_PART[0], -(k * PI_2_PART[1]));
    r = dd_add(r, (struct dd){-(k * PI_2_PART[2]), 0});
    return dd_add(r, (struct dd){-(k * PI_2_PART[3]), 0});
}

// Taylor series with the leading terms exact: relative error below 2^-58 as a
// pair on |r| <= pi/4.
static struct dd sin_kernel(struct dd r)
{
    double r2 = r.hi * r.hi, p = 0;
    for (int i = 7; i >= 0; i--)
        p = p * r2 + TRIG_SIN[i];
    return dd_fast_sum(r.hi, r.hi * r2 * p + r.lo * (1 - 0.5 * r2));
}

static struct dd cos_kernel(struct dd r)
{
    double r2 = r.hi * r.hi, p = 0;
    for (int i = 7; i >= 0; i--)
        p = p * r2 + TRIG_COS[i];
    struct dd h = dd_two_prod(r.hi, r.hi);
    struct dd s = dd_fast_sum(1, -0.5 * h.hi);
    return dd_fast_sum(s.hi, s.lo + (r2 * r2 * p - r.hi * r.lo - 0.5 * h.lo));
}

double det_sin(double x)
{
    if (!(fabs(x) <= DBL_MAX))
        return (x - x) / 0.0;
    unsigned q;
    struct dd r = reduce(x, &q);
    double s = q & 1 ? cos_kernel(r).hi : sin_kernel(r).hi;
    return (q & 2) ^ (signbit(x) ? 2u : 0u) ? -s : s;
}

double det_cos(double x)
{
    if (!(fabs(x) <= DBL_MAX))
        return (x - x) / 0.0;
    unsigned q;
    struct dd r = reduce(x, &q);
    double c = q & 1 ? sin_kernel(r).hi : cos_kernel(r).hi;
    return (q + 1) & 2 ? -c : c;
}

double det_tan(double x)
{
    if (!(fabs(x) <= DBL_MAX))
        return (x - x) / 0.0;
    unsigned q;
    struct dd r = reduce(x, &q), s = sin_kernel(r), c = cos_kernel(r);
    double t = q & 1 ? -dd_div(c, s).hi : dd_div(s, c).hi;
    return x < 0 ? -t : t;
}

// atan(k/8), k = 0..8.
const struct dd trig_atan_eighth[9] = {
    {0, 0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};

// atan(num/den), 0 <= num <= den, den > 0, both scaled away from the ends of the
// range: atan(k/8) + atan of the difference, |difference| <= 1/16.
static struct dd atan_ratio(struct dd num, struct dd den)
{
    int k = (int)(8 * (num.hi / den.hi) + 0.5);
    double c = k / 8.;
    struct dd cd = dd_two_prod(c, den.hi);
    // Both as pairs: where k = 0 the quotient is the result, and its low part counts.
    struct dd top = dd_two_sum((num.hi - cd.hi) - cd.lo, num.lo - c * den.lo);
    struct dd bottom = dd_two_sum(den.hi, c * num.hi);
    double t = top.hi / bottom.hi;
    struct dd q = dd_two_prod(t, bottom.hi);
    double t_low =
        (((top.hi - q.hi) - q.lo) + (top.lo - t * (bottom.lo + den.lo + c * num.lo))) /
        bottom.hi;
    double t2 = t * t, p = 0;
    for (int n = 15; n >= 3; n -= 2)
        p = (n & 2 ? -1. : 1.) / n + t2 * p;
    struct dd s = dd_two_sum(trig_atan_eighth[k].hi, t);
    return dd_fast_sum(s.hi, s.lo + (trig_atan_eighth[k].lo + t_low + t * t2 * p));
}

// The angle of (x, y) in the first quadrant.
static struct dd angle(struct dd y, struct dd x)
{
    if (y.hi <= x.hi)
        return atan_ratio(y, x);
    struct dd a = atan_ratio(x, y);
    return dd_add(trig_half_pi, (struct dd){-a.hi, -a.lo});
}

double det_atan2(double y, double x)
{
    if (x != x || y != y)
        return x + y;
    double ax = fabs(x), ay = fabs(y);
    struct dd a;
    if (ay == 0)
        a = (struct dd){0, 0};
    else if (ax == 0 || ay > DBL_MAX)
        a = ax > DBL_MAX ? trig_atan_eighth[8] : trig_half_pi;
    else if (ax > DBL_MAX)
        a = (struct dd){0, 0};
    else {
        int e;
        frexp(ax > ay ? ax : ay, &e);
        double sx = ldexp(ax, -e), sy = ldexp(ay, -e);
        if (sy < 0x1p-500 && !signbit(x)) // tiny: the ratio itself, rounded once
            a = (struct dd){ay / ax, 0};
        else
            a = angle((struct dd){sy, 0}, (struct dd){sx, 0});
    }
    if (signbit(x))
        a = dd_add((struct dd){2 * trig_half_pi.hi, 2 * trig_half_pi.lo},
                   (struct dd){-a.hi, -a.lo});
    return signbit(y) ? -a.hi : a.hi;
}

double det_atan(double x) { return det_atan2(x, 1); }

// sqrt(1 - x^2) as a pair, |x| <= 1.
static struct dd cosine_of(double x)
{
    struct dd w = dd_mul(dd_two_sum(1, -x), dd_two_sum(1, x));
    double s = sqrt(w.hi);
    if (s == 0)
        return (struct dd){0, 0};
    struct dd q = dd_two_prod(s, s);
    return dd_fast_sum(s, ((w.hi - q.hi) - q.lo + w.lo) / (2 * s));
}

double det_asin(double x)
{
    if (!(fabs(x) <= 1))
        return (x - x) / 0.0;
    if (fabs(x) < 0x1p-27)
        return x;
    double a = angle((struct dd){fabs(x), 0}, cosine_of(x)).hi;
    return x < 0 ? -a : a;
}

double det_acos(double x)
{
    if (!(fabs(x) <= 1))
        return (x - x) / 0.0;
    struct dd a = angle(cosine_of(x), (struct dd){fabs(x), 0});
    if (x < 0)
        a = dd_add((struct dd){2 * trig_half_pi.hi, 2 * trig_half_pi.lo},
                   (struct dd){-a.hi, -a.lo});
    return a.hi;
}
