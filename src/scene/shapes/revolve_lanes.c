// Eight rays and a profile that is turned, compiled once per instruction set.
//
// The polynomial of a segment (revolve.h), q (h - y)^2 + dy^2 (p - r^2), is above zero outside.
// Its Bernstein coefficients have as many sign changes as it has roots, or more by an even
// number (Farouki & Rajan 1987): pieces with one are left to Newton's method, those with more
// are halved. Pieces of all rays wait in one row, so that eight are always taken together. Where
// a sign is not clear of rounding a lane is left to the one line's form.
#include "scene/shapes/lanes.h"
#include "scene/shapes/revolve.h"

enum {
    LIVE = 32,  // pieces of a lane that wait at a time
    FOUND = 24, // crossings of a lane
    STEPS = 8,  // of Newton's method
};

static const double SMALLEST = 0x1p-20; // piece of a segment that is halved

// How far beyond its piece rounding may take a root.
static const double BEYOND = 0x1p-40;

// A line may pass the axis this many times the coordinates above or below where it begins: its
// heights, as a share of them, are then as exact as its distances.
static const double FAR_RISE = 64;

// In rows of four, as r8_load_rows takes them.
enum { FROM = 7, WIDTH, NOISE, MOST2, CHANGES, PIECE };
struct piece {
    double v[PIECE]; // first the Bernstein coefficients
    uint32_t segment, lane;
};

// A line as struct line of revolve.c has it, from its point nearest to the axis.
enum {
    LINE_Q,
    LINE_Y,
    LINE_DY,
    LINE_O_Y,
    LINE_NEAREST,
    LINE_NEAREST2,
    LINE_SIZE,
    LINE = 8
};

struct found {
    double t, dt, w;
    bool along; // the profile's normal goes along with the line
    uint32_t part;
};

struct search {
    const struct revolve *s;
    const struct shape_rays *rays;
    bool any;
    unsigned lanes; // that are looked at
    unsigned odd;   // of which the signs do not tell
    unsigned met;   // any: in range
    double line[8][LINE];
    uint32_t live[8], founds[8];
    struct found found[8][FOUND];
    uint32_t waiting;
    struct piece piece[8 * LIVE];
};

// The same in lanes.
struct turn8 {
    struct real8 q, y, dy, p; // |D_xz|^2; y and the squared distance there
    struct real8 doubt;       // about heights and distances
};

struct signs {
    struct real8 changes;
    unsigned clear; // lanes where all coefficients have a sign
    unsigned some;  // with changes
    unsigned outside;
};

static struct signs signs_of(const struct real8 *b, int degree, struct real8 noise)
{
    const struct real8 zero = r8_set(0), one = r8_set(1);
    struct signs s = {.changes = zero};
    struct mask8 clear = r8_lt(noise, r8_abs(b[0]));
    for (int i = 1; i <= degree; i++) {
        const struct mask8 turns = r8_lt(r8_mul(b[i], b[i - 1]), zero);
        clear = m8_and(clear, r8_lt(noise, r8_abs(b[i])));
        s.changes = r8_add(s.changes, r8_select(turns, one, zero));
    }
    s.clear = m8_bits(clear);
    s.some = s.clear & m8_bits(r8_lt(zero, s.changes));
    s.outside = s.clear & ~s.some & m8_bits(r8_lt(zero, b[0]));
    return s;
}

// The polynomial's value, or a Bernstein coefficient of it.
static struct real8 side8(const struct turn8 *l, double h, double h2, double r2)
{
    const struct real8 two_y = r8_add(l->y, l->y), dy2 = r8_mul(l->dy, l->dy);
    const struct real8 rest = r8_add(r8_mul(l->q, r8_mul(l->y, l->y)), r8_mul(dy2, l->p));
    const struct real8 heights = r8_sub(r8_set(h2), r8_mul(two_y, r8_set(h)));
    return r8_add(r8_sub(r8_mul(l->q, heights), r8_mul(dy2, r8_set(r2))), rest);
}

// What of it is rounding, given the largest |h|, h^2 and r^2.
static struct real8 rounding8(const struct turn8 *l, double h, double h2, double r2)
{
    const struct real8 y = r8_abs(l->y), dy2 = r8_mul(l->dy, l->dy);
    const struct real8 heights = r8_add(r8_set(h2), r8_mul(y, r8_add(r8_set(2 * h), y)));
    const struct real8 size =
        r8_add(r8_mul(l->q, heights), r8_mul(dy2, r8_add(r8_set(r2), l->p)));
    return r8_mul(r8_set(GAMMA(64)), size);
}

// Lets pieces of `lanes` wait; lane i's is of the ray of[i] and its segment[i].
static void wait8(struct search *x, unsigned lanes, const uint32_t of[8],
                  const uint32_t segment[8], const struct real8 *v)
{
    double part[PIECE][8];
    for (int k = 0; k < PIECE; k++)
        r8_store(part[k], v[k]);
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        if (x->live[of[i]] == LIVE) {
            x->odd |= 1u << of[i];
            continue;
        }
        x->live[of[i]]++;
        struct piece *p = &x->piece[x->waiting++];
        for (int k = 0; k < PIECE; k++)
            p->v[k] = part[k][i];
        p->segment = segment[i];
        p->lane = of[i];
    }
}

static void add_segment(struct search *x, const struct turn8 *l, unsigned lanes,
                        uint32_t i)
{
    static const uint32_t each[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    const struct revolve_segment *s = &x->s->segment[i];
    struct real8 v[PIECE];
    if (s->most2 == 0)
        return;
    for (int k = 0; k <= s->degree; k++)
        v[k] = side8(l, s->hull[0][k], s->hull[1][k], s->hull[2][k]);
    for (int k = s->degree + 1; k < FROM; k++)
        v[k] = r8_set(0);
    v[NOISE] = rounding8(l, s->most[0], s->most[1], s->most[2]);
    const struct signs g = signs_of(v, s->degree, v[NOISE]);
    lanes &= ~g.outside;
    x->odd |= lanes & ~g.clear;
    if (!(lanes & g.some))
        return;
    const uint32_t segment[8] = {i, i, i, i, i, i, i, i};
    v[FROM] = r8_set(0);
    v[WIDTH] = r8_set(1);
    v[MOST2] = r8_set(s->most2);
    v[CHANGES] = g.changes;
    wait8(x, lanes & g.some, each, segment, v);
}

// The lanes that come near the cylinder around a block.
static unsigned near_block(const struct search *x, const struct turn8 *l,
                           const struct revolve_block *b)
{
    const struct real8 zero = r8_set(0), per = r8_div(r8_set(1), l->dy);
    const struct real8 slack = r8_mul(r8_abs(per), l->doubt);
    const struct real8 p = r8_mul(r8_sub(r8_set(b->low), l->y), per);
    const struct real8 q = r8_mul(r8_sub(r8_set(b->high), l->y), per);
    const struct real8 from = r8_sub(r8_min(p, q), slack);
    const struct real8 to = r8_add(r8_max(p, q), slack);
    const struct real8 off = r8_max(from, r8_min(to, zero)); // nearest to the axis
    const struct real8 rho2 = r8_add(l->p, r8_mul(l->q, r8_mul(off, off)));
    const struct real8 reach = r8_add(r8_set(sqrt(b->most2)), l->doubt);
    const struct real8 most = r8_mul(r8_set(1 + 0x1p-40), r8_mul(reach, reach));
    return x->lanes & m8_bits(r8_le(rho2, most));
}

static void add_segments(struct search *x, const struct turn8 *l)
{
    const struct revolve *s = x->s;
    for (uint32_t i = 0; i < s->blocks; i++) {
        const uint32_t first = i * REVOLVE_BLOCK, end = first + REVOLVE_BLOCK;
        const unsigned near = s->blocks > 1 ? near_block(x, l, &s->block[i]) : x->lanes;
        for (uint32_t k = first; near && k < end && k < s->count; k++)
            add_segment(x, l, near, k);
    }
}

// Eight pieces, with their lines and their segments' polynomials.
struct taken {
    int degree, h_degree, r2_degree;
    unsigned lanes;
    uint32_t lane[8], segment[8];
    struct real8 v[PIECE], line[LINE], h[4], r2[8];
};

static void take8(struct search *x, struct taken *k)
{
    const double *v[8], *line[8], *h[8], *r2[8];
    const uint32_t n = x->waiting < 8 ? x->waiting : 8;
    const struct revolve_segment *const all = x->s->segment;
    for (uint32_t i = 0; i < 8; i++) {
        const struct piece *p = &x->piece[x->waiting - 1 - (i < n ? i : 0)];
        k->lane[i] = p->lane;
        k->segment[i] = p->segment;
        v[i] = p->v;
        line[i] = x->line[p->lane];
        h[i] = all[p->segment].h;
        r2[i] = all[p->segment].r2;
        x->live[p->lane] -= i < n;
    }
    x->waiting -= n;
    k->lanes = (1u << n) - 1;
    k->degree = all->degree;
    k->h_degree = all->h_degree;
    k->r2_degree = all->r2_degree;
    for (int i = 0; i < PIECE; i += 4)
        r8_load_rows(v, i, k->v + i);
    for (int i = 0; i < LINE; i += 4)
        r8_load_rows(line, i, k->line + i);
    r8_load_rows(h, 0, k->h);
    for (int i = 0; i <= k->r2_degree; i += 4)
        r8_load_rows(r2, i, k->r2 + i);
}

static void value_and_slope8(const struct real8 *c, int degree, struct real8 w,
                             struct real8 *value, struct real8 *slope)
{
    struct real8 v = c[degree], d = r8_set(0);
    for (int i = degree - 1; i >= 0; i--) {
        d = r8_add(r8_mul(d, w), v);
        v = r8_add(r8_mul(v, w), c[i]);
    }
    *value = v;
    *slope = d;
}

// Where the Bernstein polygon first crosses zero, as a share of the piece.
static struct real8 guess8(const struct taken *k)
{
    const struct real8 zero = r8_set(0), one = r8_set(1);
    struct real8 from = one, to = r8_set(-1), index = zero;
    for (int i = k->degree; i > 0; i--) {
        const struct mask8 turns = r8_lt(r8_mul(k->v[i], k->v[i - 1]), zero);
        from = r8_select(turns, k->v[i - 1], from);
        to = r8_select(turns, k->v[i], to);
        index = r8_select(turns, r8_set(i - 1), index);
    }
    return r8_mul(r8_add(index, r8_div(from, r8_sub(from, to))), r8_set(1. / k->degree));
}

struct root8 {
    struct real8 t, w, noise, det;
};

// Newton's method on y(t) = h(w), rho^2(t) = r^2(w), as sharpen of revolve.c, within the pieces;
// returns the lanes where it ends in theirs.
static unsigned newton8(const struct taken *k, unsigned lanes, struct root8 *r)
{
    const struct real8 q = k->line[LINE_Q], dy = k->line[LINE_DY],
                       size = k->line[LINE_SIZE];
    const struct real8 lo = k->v[FROM], hi = r8_add(lo, k->v[WIDTH]);
    struct real8 w = r8_add(lo, r8_mul(k->v[WIDTH], guess8(k))), h, dh, r2, dr2;
    unsigned done = 0;
    value_and_slope8(k->h, k->h_degree, w, &h, &dh);
    struct real8 t =
        r8_add(k->line[LINE_NEAREST], r8_div(r8_sub(h, k->line[LINE_Y]), dy));
    for (int i = 0; i < STEPS && lanes; i++) {
        const struct real8 off = r8_sub(t, k->line[LINE_NEAREST]);
        const struct real8 along = r8_mul(q, off);
        const struct real8 rho2 = r8_add(k->line[LINE_NEAREST2], r8_mul(along, off));
        const struct real8 drho2 = r8_add(along, along);
        value_and_slope8(k->h, k->h_degree, w, &h, &dh);
        value_and_slope8(k->r2, k->r2_degree, w, &r2, &dr2);
        const struct real8 g = r8_sub(r8_add(k->line[LINE_O_Y], r8_mul(t, dy)), h);
        const struct real8 f = r8_sub(rho2, r2);
        const struct real8 det = r8_sub(r8_mul(drho2, dh), r8_mul(dy, dr2));
        const struct real8 per = r8_div(r8_set(1), det);
        const struct real8 by_t = r8_mul(r8_sub(r8_mul(g, dr2), r8_mul(f, dh)), per);
        const struct real8 by_w = r8_mul(r8_sub(r8_mul(drho2, g), r8_mul(dy, f)), per);
        const struct real8 sizes = r8_add(r8_mul(size, r8_sqrt(rho2)), k->v[MOST2]);
        const struct real8 noise =
            r8_mul(r8_add(r8_mul(r8_mul(r8_set(GAMMA(16)), size), r8_abs(dr2)),
                          r8_mul(r8_mul(r8_set(GAMMA(32)), sizes), r8_abs(dh))),
                   r8_abs(per));
        const struct real8 next = r8_add(w, by_w), kept = r8_max(lo, r8_min(hi, next));
        const struct mask8 in = r8_le(r8_abs(r8_sub(next, kept)), r8_set(BEYOND));
        const unsigned ends = lanes & m8_bits(m8_and(in, r8_le(r8_abs(by_t), noise)));
        const struct mask8 on = m8_of(lanes);
        t = r8_select(on, r8_add(t, by_t), t);
        w = r8_select(on, kept, w);
        r->noise = r8_select(on, noise, r->noise);
        r->det = r8_select(on, det, r->det);
        done |= ends;
        lanes &= ~ends;
    }
    r->t = t;
    r->w = w;
    return done;
}

static void add_found(struct search *x, uint32_t lane, struct found f)
{
    if (x->founds[lane] == FOUND) {
        x->odd |= 1u << lane;
        return;
    }
    x->found[lane][x->founds[lane]++] = f;
    if (x->any && f.t > x->rays->t_min[lane] && f.t <= x->rays->t_max[lane])
        x->met |= 1u << lane;
}

static void put_roots(struct search *x, const struct taken *k, unsigned lanes,
                      const struct root8 *r)
{
    double t[8], dt[8], w[8];
    const struct mask8 vague =
        r8_lt(r8_mul(r8_set(0x1p-40), k->line[LINE_SIZE]), r->noise);
    const struct real8 four = r8_mul(r8_set(4), r->noise); // not of first order alone
    const unsigned along = m8_bits(r8_lt(r8_set(0), r->det));
    r8_store(t, r->t);
    r8_store(dt, r8_select(vague, four, r->noise));
    r8_store(w, r->w);
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        add_found(x, k->lane[i],
                  (struct found){t[i], dt[i], w[i], along >> i & 1,
                                 REVOLVE_SEGMENT + k->segment[i]});
    }
}

static unsigned of_rays(const struct taken *k, unsigned lanes)
{
    unsigned rays = 0;
    for (; lanes; lanes &= lanes - 1)
        rays |= 1u << k->lane[__builtin_ctz(lanes)];
    return rays;
}

// By de Casteljau's scheme.
static void halve8(struct search *x, struct taken *k, unsigned lanes)
{
    const struct real8 half = r8_set(.5);
    const unsigned small = lanes & m8_bits(r8_le(k->v[WIDTH], r8_set(SMALLEST)));
    struct real8 left[PIECE], *right = k->v;
    x->odd |= of_rays(k, small);
    lanes &= ~small;
    if (!lanes)
        return;
    right[WIDTH] = r8_mul(half, right[WIDTH]);
    for (int i = 0; i < PIECE; i++)
        left[i] = right[i];
    for (int i = 1; i <= k->degree; i++) {
        for (int j = 0; j <= k->degree - i; j++)
            right[j] = r8_mul(half, r8_add(right[j], right[j + 1]));
        left[i] = right[0];
    }
    right[FROM] = r8_add(right[FROM], right[WIDTH]);
    for (int i = 0; i < 2; i++) {
        struct real8 *v = i ? right : left;
        const struct signs g = signs_of(v, k->degree, v[NOISE]);
        v[CHANGES] = g.changes;
        x->odd |= of_rays(k, lanes & ~g.clear);
        wait8(x, lanes & g.some, k->lane, k->segment, v);
    }
}

static void look_at_pieces(struct search *x)
{
    while (x->waiting && x->met != x->lanes) {
        struct taken k;
        struct root8 r = {.noise = r8_set(0), .det = r8_set(0)};
        take8(x, &k);
        const unsigned one = k.lanes & m8_bits(r8_eq(k.v[CHANGES], r8_set(1)));
        const unsigned done = one ? newton8(&k, one, &r) : 0;
        put_roots(x, &k, done, &r);
        if (k.lanes & ~done)
            halve8(x, &k, k.lanes & ~done);
    }
}

// The disc that closes an end, where the line is below its rim by the function of the walls.
static void add_cap(struct search *x, const struct turn8 *l, uint32_t part, double h,
                    double r2)
{
    if (r2 == 0 || (x->any && !x->s->caps_drawn))
        return;
    double t[8], dt[8];
    const struct real8 f = side8(l, h, h * h, r2);
    const struct real8 noise = rounding8(l, fabs(h), h * h, r2);
    x->odd |= x->lanes & ~m8_bits(r8_lt(noise, r8_abs(f)));
    const unsigned in = x->lanes & m8_bits(r8_lt(f, r8_set(0)));
    for (unsigned left = in; left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        const double *line = x->line[i], dy = line[LINE_DY];
        t[i] = (h - line[LINE_O_Y]) / dy;
        dt[i] = GAMMA(64) * line[LINE_SIZE] / (sqrt(line[LINE_Q] + dy * dy) * fabs(dy));
        add_found(x, (uint32_t)i, (struct found){t[i], dt[i], 0, false, part});
    }
}

static void add_caps(struct search *x, const struct turn8 *l)
{
    const struct revolve *s = x->s;
    if (s->closed || !s->count)
        return;
    const struct revolve_segment *first = s->segment, *last = first + s->count - 1;
    add_cap(x, l, REVOLVE_FIRST_CAP, first->h_end[0], first->r2_end[0]);
    add_cap(x, l, REVOLVE_LAST_CAP, last->h_end[1], last->r2_end[1]);
}

// The first that is drawn, entered or left by the number of those before it.
static void choose(struct search *x, int lane, struct shape_hits *out)
{
    const struct found *f = x->found[lane], *best = NULL;
    const double t_min = x->rays->t_min[lane], t_max = x->rays->t_max[lane];
    if (!x->any && x->founds[lane] % 2) { // one was lost to rounding
        x->odd |= 1u << lane;
        return;
    }
    uint32_t before = 0;
    for (uint32_t i = 0; i < x->founds[lane]; i++) {
        const bool drawn = f[i].part >= REVOLVE_SEGMENT || x->s->caps_drawn;
        if (drawn && f[i].t > t_min && f[i].t <= t_max && (!best || f[i].t < best->t))
            best = &f[i];
    }
    if (!best)
        return;
    for (uint32_t i = 0; i < x->founds[lane]; i++)
        before += f[i].t < best->t;
    const bool leaves = before % 2;
    // A cap's normal is vertical, against the ray at an entry; the profile's is turned out.
    const bool up = best->part >= REVOLVE_SEGMENT
                        ? best->along == leaves
                        : (x->line[lane][LINE_DY] < 0) != leaves;
    const struct boundary b = {.t = best->t,
                               .dt = best->dt,
                               .u = up ? 1 : -1,
                               .v = best->w,
                               .part = best->part,
                               .crossing = leaves ? CROSS_EXIT : CROSS_ENTER,
                               .drawn = 1};
    shape_hits_put(out, lane, &b);
    x->met |= 1u << lane;
}

static void set_up(struct search *x, struct turn8 *l, unsigned lanes)
{
    const struct revolve *s = x->s;
    const struct vec8 o = v8_load(x->rays->o), d = v8_load(x->rays->d);
    const struct real8 zero = r8_set(0);
    l->dy = d.y;
    l->q = r8_add(r8_mul(d.x, d.x), r8_mul(d.z, d.z));
    const struct real8 m = r8_add(r8_mul(d.x, o.x), r8_mul(d.z, o.z));
    const struct real8 nearest = r8_div(r8_sub(zero, m), l->q);
    const struct real8 x0 = r8_add(o.x, r8_mul(nearest, d.x));
    const struct real8 z0 = r8_add(o.z, r8_mul(nearest, d.z));
    const double extent = fmax(s->r_max, fmax(fabs(s->h_min), fabs(s->h_max)));
    const struct real8 size = r8_max(v8_max_abs(o), r8_set(extent));
    const struct real8 rise = r8_mul(nearest, d.y);
    l->doubt = r8_mul(r8_set(0x1p-40), size);
    l->p = r8_add(r8_mul(x0, x0), r8_mul(z0, z0));
    l->y = r8_add(o.y, rise);
    // Nearly flat lines, and those along the axis, are not for these sums.
    const struct mask8 steep =
        r8_lt(r8_mul(r8_set(REVOLVE_NEARLY_FLAT), r8_sqrt(l->q)), r8_abs(d.y));
    const struct mask8 near = r8_le(r8_abs(rise), r8_mul(r8_set(FAR_RISE), size));
    const unsigned odd = lanes & ~m8_bits(m8_and(steep, near));
    x->odd = odd;
    x->lanes = lanes & ~odd;
    const struct real8 of[LINE] = {l->q, l->y, d.y, o.y, nearest, l->p, size, zero};
    for (int k = 0; k < LINE; k++) {
        double each[8];
        r8_store(each, of[k]);
        for (int i = 0; i < 8; i++)
            x->line[i][k] = each[i];
    }
}

unsigned OF_ISA(revolve_closest8_)(const struct revolve *s, const struct shape_rays *rays,
                                   unsigned lanes, bool any, struct shape_hits *out,
                                   unsigned *odd)
{
    struct search x;
    struct turn8 l;
    x.s = s;
    x.rays = rays;
    x.any = any;
    x.met = x.waiting = 0;
    for (int i = 0; i < 8; i++)
        x.live[i] = x.founds[i] = 0;
    set_up(&x, &l, lanes);
    add_segments(&x, &l);
    add_caps(&x, &l);
    look_at_pieces(&x);
    const unsigned sure = any ? x.met : x.lanes & ~x.odd;
    x.met = 0;
    for (unsigned left = sure; left; left &= left - 1)
        choose(&x, __builtin_ctz(left), out);
    *odd = x.odd & ~x.met;
    return x.met;
}
