// Random nested CSG on a coarse grid, so that faces often coincide, against the state of
// the expression between the crossings, worked out in long double; and packets against one
// ray at a time. LAMBERT_SEED and LAMBERT_ROUNDS in the environment search on.
#include "test.h"

#include <stdlib.h>

#include "loaded.h"

enum kind { BOX, BALL, ROD, PLANE, MERGE, INTERSECTION, DIFFERENCE, INVERSE };

struct node {
    enum kind kind;
    int a[6];   // halves: corners; centre, radius; x, y, low, high, radius; axis, place
    int form;   // leaves: which of several ways to write it
    int wobble; // leaves: degrees turned forth and back, which leaves only rounding
    int child, next;
};

enum { NODES_MAX = 64, TEXT_MAX = 1 << 15 };

struct tree {
    struct node node[NODES_MAX];
    int count;
};

static uint32_t next_random(uint64_t *s)
{
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*s >> 33);
}

static int between(uint64_t *s, int lo, int hi)
{
    return lo + (int)(next_random(s) % (uint32_t)(hi - lo + 1));
}

static double unit(uint64_t *s) { return (next_random(s) + .5) / 2147483648.; }

static void random_leaf(struct node *n, uint64_t *s)
{
    n->form = between(s, 0, 2);
    n->wobble = between(s, -60, 60);
    n->wobble = n->wobble < 20 ? 0 : n->wobble;
    const int kinds[] = {BOX, BOX, BOX, BALL, ROD, PLANE};
    n->kind = kinds[between(s, 0, 5)];
    for (int i = 0; i < 3; i++) {
        n->a[i] = between(s, -3, 2);
        n->a[i + 3] = between(s, n->a[i] + 1, 4);
    }
    if (n->kind == BALL)
        n->a[3] = between(s, 1, 3);
    if (n->kind == ROD) {
        n->a[2] = between(s, -3, 1);
        n->a[3] = between(s, n->a[2] + 1, 4);
        n->a[4] = between(s, 1, 3);
    }
    if (n->kind == PLANE)
        n->a[0] = between(s, 0, 2);
}

static int random_tree(struct tree *t, uint64_t *s, int depth)
{
    const int at = t->count++;
    struct node *n = &t->node[at];
    *n = (struct node){.child = -1, .next = -1};
    if (depth == 0 || t->count > NODES_MAX - 8) {
        random_leaf(n, s);
        return at;
    }
    n->kind = (enum kind)between(s, MERGE, INVERSE);
    int *link = &n->child;
    const int children = n->kind == INVERSE ? 1 : between(s, 2, 3);
    for (int i = 0; i < children; i++) {
        const int c = random_tree(t, s, depth - between(s, 1, depth));
        *link = c;
        link = &t->node[c].next;
    }
    return at;
}

// The same solids in other words: coincident faces then come from different formulas.
static void write_leaf(const struct node *n, char *end, size_t room)
{
    static const char *const axis[] = {"x", "y", "z"};
    const int *a = n->a;
    char turns[96] = "";
    if (n->wobble)
        snprintf(turns, sizeof turns,
                 "rotate <%d, %d, 0> rotate <0, %d, 0> rotate <%d, 0, 0> ", n->wobble,
                 3 * n->wobble, -3 * n->wobble, -n->wobble);
    if (n->kind == BOX && n->form == 0)
        snprintf(end, room, "box { <%d,%d,%d>/2, <%d,%d,%d>/2 %s}\n", a[0], a[1], a[2],
                 a[3], a[4], a[5], turns);
    else if (n->kind == BOX && n->form == 1)
        snprintf(end, room,
                 "prism { %d/2, %d/2, 5, <%d,%d>/2, <%d,%d>/2, <%d,%d>/2, <%d,%d>/2, "
                 "<%d,%d>/2 %s}\n",
                 a[1], a[4], a[0], a[2], a[3], a[2], a[3], a[5], a[0], a[5], a[0], a[2],
                 turns);
    else if (n->kind == BOX)
        snprintf(end, room,
                 "intersection { plane { x, %d/2 } plane { -x, -%d/2 } plane { y, %d/2 } "
                 "plane { -y, -%d/2 } plane { z, %d/2 } plane { -z, -%d/2 } %s}\n",
                 a[3], a[0], a[4], a[1], a[5], a[2], turns);
    else if (n->kind == BALL && n->form == 0)
        snprintf(end, room, "sphere { <%d,%d,%d>/2, %d/2 %s}\n", a[0], a[1], a[2], a[3],
                 turns);
    else if (n->kind == BALL)
        snprintf(end, room, "%s %s translate <%d,%d,%d>/2 %s}\n",
                 n->form == 1 ? "quadric { 1, 0, 0, -1" : "sphere { 0, 1",
                 a[3] == 1   ? "scale 1/2"
                 : a[3] == 2 ? ""
                             : "scale <1, 1, 3> scale 1/2 scale <3, 3, 1>",
                 a[0], a[1], a[2], turns);
    else if (n->kind == ROD && n->form == 0)
        snprintf(end, room, "cylinder { <%d,%d,%d>/2, <%d,%d,%d>/2, %d/2 %s}\n", a[0],
                 a[1], a[2], a[0], a[1], a[3], a[4], turns);
    else if (n->kind == ROD && n->form == 1)
        snprintf(end, room, "cone { <%d,%d,%d>/2, %d/2, <%d,%d,%d>/2, %d/2 %s}\n", a[0],
                 a[1], a[2], a[4], a[0], a[1], a[3], a[4], turns);
    else if (n->kind == ROD)
        snprintf(end, room,
                 "intersection { quadric { <1,1,0>, 0, 0, -%d/4 translate <%d,%d,0>/2 } "
                 "plane { z, %d/2 } plane { -z, -%d/2 } %s}\n",
                 a[4] * a[4], a[0], a[1], a[3], a[2], turns);
    else
        snprintf(end, room, "plane { %s, %d/2 %s}\n", axis[a[0]], a[1], turns);
}

static void write_tree(const struct tree *t, int at, char *out)
{
    const struct node *n = &t->node[at];
    if (n->kind < MERGE) {
        write_leaf(n, out + strlen(out), TEXT_MAX - strlen(out));
        return;
    }
    static const char *const word[] = {"merge {\n", "intersection {\n", "difference {\n",
                                       "merge {\n"};
    strcat(out, word[n->kind - MERGE]);
    if (n->kind == INVERSE) // a second child that is nowhere
        strcat(out, "intersection { box { 90, 91 } box { 92, 93 } }\n");
    for (int c = n->child; c >= 0; c = t->node[c].next)
        write_tree(t, c, out);
    strcat(out, n->kind == INVERSE ? "inverse }\n" : "}\n");
}

static bool inside(const struct tree *t, int at, const long double p[3])
{
    const struct node *n = &t->node[at];
    const int *a = n->a;
    bool in = n->kind == INTERSECTION;
    switch (n->kind) {
    case BOX:
        for (int i = 0; i < 3; i++)
            if (2 * p[i] < a[i] || 2 * p[i] > a[i + 3])
                return false;
        return true;
    case BALL:
    case ROD: {
        long double d2 = 0;
        for (int i = 0; i < (n->kind == BALL ? 3 : 2); i++)
            d2 += (2 * p[i] - a[i]) * (2 * p[i] - a[i]);
        if (n->kind == BALL)
            return d2 <= a[3] * a[3];
        return d2 <= a[4] * a[4] && 2 * p[2] >= a[2] && 2 * p[2] <= a[3];
    }
    case PLANE: return 2 * p[a[0]] <= a[1];
    case MERGE:
    case INTERSECTION:
        for (int c = n->child; c >= 0; c = t->node[c].next)
            in = n->kind == MERGE ? in || inside(t, c, p) : in && inside(t, c, p);
        return in;
    case DIFFERENCE:
        in = inside(t, n->child, p);
        for (int c = t->node[n->child].next; c >= 0; c = t->node[c].next)
            in = in && !inside(t, c, p);
        return in;
    default: return !inside(t, n->child, p);
    }
}

// Where the line meets the quadric sum over axes 0..last of (2 p_i - c_i)^2 = r^2.
static int meet_round(const int *c, int last, int r, const double *o, const double *d,
                      long double *t)
{
    long double A = 0, B = 0, C = -(long double)r * r;
    for (int i = 0; i <= last; i++) {
        const long double q = 2 * (long double)o[i] - c[i], v = 2 * (long double)d[i];
        A += v * v;
        B += v * q;
        C += q * q;
    }
    const long double disc = B * B - A * C;
    if (disc <= 0)
        return 0;
    t[0] = (-B - sqrtl(disc)) / A;
    t[1] = (-B + sqrtl(disc)) / A;
    return 2;
}

static int all_events(const struct tree *t, const double *o, const double *d,
                      long double *out)
{
    int n = 0;
    for (int i = 0; i < t->count; i++) {
        const struct node *k = &t->node[i];
        const int *a = k->a;
        if (k->kind == BOX)
            for (int j = 0; j < 6; j++)
                out[n++] = ((long double)a[j] / 2 - o[j % 3]) / d[j % 3];
        if (k->kind == BALL)
            n += meet_round(a, 2, a[3], o, d, out + n);
        if (k->kind == ROD) {
            n += meet_round(a, 1, a[4], o, d, out + n);
            out[n++] = ((long double)a[2] / 2 - o[2]) / d[2];
            out[n++] = ((long double)a[3] / 2 - o[2]) / d[2];
        }
        if (k->kind == PLANE)
            out[n++] = ((long double)a[1] / 2 - o[a[0]]) / d[a[0]];
    }
    return n;
}

static int by_value(const void *a, const void *b)
{
    const long double x = *(const long double *)a, y = *(const long double *)b;
    return x < y ? -1 : x > y;
}

enum verdict { SURFACE, NOTHING, UNCLEAR };

// The first t > 0 at which the state of the whole changes. Unclear: events too close to
// be told from coincident ones, or too close to the origin.
static enum verdict truth(const struct tree *t, const double *o, const double *d,
                          double *out)
{
    long double at[6 * NODES_MAX];
    int n = all_events(t, o, d, at);
    qsort(at, (size_t)n, sizeof *at, by_value);
    for (int i = 0; i < n; i++) {
        int j = i;
        while (j + 1 < n && at[j + 1] - at[i] < 1e-12L)
            j++;
        const long double gap = j + 1 < n ? at[j + 1] - at[j] : 1;
        if (fabsl(at[i]) < 1e-6L || gap < 1e-6L)
            return UNCLEAR;
        const long double before = i > 0 ? (at[i - 1] + at[i]) / 2 : at[i] - 1;
        const long double after = at[j] + gap / 2;
        long double p[3], q[3];
        for (int k = 0; k < 3; k++) {
            p[k] = o[k] + before * d[k];
            q[k] = o[k] + after * d[k];
        }
        if (at[i] > 0 && inside(t, 0, p) != inside(t, 0, q)) {
            *out = (double)at[i];
            return SURFACE;
        }
        i = j;
    }
    return NOTHING;
}

struct placing {
    double size;
    struct vec3 turn, move;
};
static const struct placing placings[] = {
    {1, {0, 0, 0}, {0, 0, 0}},
    {1, {10, 20, 30}, {0, 0, 0}},
    {1e-5, {-71, 12, 143}, {0, 0, 0}},
    {1e5, {0, 45, 0}, {0, 0, 0}},
    {1, {33, -21, 64}, {1000, -2000, 500}},
};

enum { RAYS = 24 };

static void compare_rays(struct loaded *l, const struct tree *t, const struct placing *g,
                         uint64_t seed, uint64_t *s, int *clear)
{
    struct ray_batch *batch = ray_batch_new(RAYS);
    struct hit packet[RAYS];
    double want[RAYS] = {0};
    enum verdict verdict[RAYS];
    const struct transform turn = transform_rotate(g->turn);
    batch->count = RAYS;
    for (int i = 0; i < RAYS; i++) {
        double o[3], d[3];
        for (int k = 0; k < 3; k++) {
            o[k] = 12 * unit(s) - 6;
            d[k] = 3 * unit(s) - 1.5 - .5 * o[k];
        }
        const bool straight = i % 8 == 7; // along an axis, in the grid's planes
        if (straight)
            for (int k = 0; k < 3; k++) {
                o[k] = k == i / 8 ? -6 : between(s, -4, 4) / 2.;
                d[k] = k == i / 8;
            }
        const struct vec3 p = vec3(o[0], o[1], o[2]);
        const struct vec3 u = vec3_normalize(vec3(d[0], d[1], d[2]));
        const double v[3] = {u.x, u.y, u.z};
        verdict[i] = straight ? UNCLEAR : truth(t, o, v, &want[i]);
        const struct vec3 at =
            vec3_add(vec3_scale(g->size, transform_vector(&turn, p)), g->move);
        const struct vec3 along = transform_vector(&turn, u);
        for (int k = 0; k < 3; k++) {
            batch->o[k][i] = vec3_axis(at, k);
            batch->d[k][i] = vec3_axis(along, k);
        }
        batch->t_min[i] = 0;
        batch->t_max[i] = HUGE_VAL;
        batch->hidden_by[i] = 0;
    }
    struct hit_batch *hits = hit_batch_new(RAYS);
    trace_closest(l->world, l->scratch, batch, hits);
    for (uint32_t i = 0; i < RAYS; i++)
        packet[i] = hit_batch_at(hits, i);
    hit_batch_free(hits);
    for (int i = 0; i < RAYS; i++) {
        const struct ray_query q = {
            .ray = {vec3(batch->o[0][i], batch->o[1][i], batch->o[2][i]),
                    vec3(batch->d[0][i], batch->d[1][i], batch->d[2][i]), 0, HUGE_VAL}};
        const struct hit h = trace_closest_1(l->world, l->scratch, &q);
        const double t1 = h.b.t, t8 = packet[i].b.t;
        if (t1 != t8 || (isfinite(t1) &&
                         (h.b.leaf != packet[i].b.leaf || h.b.part != packet[i].b.part)))
            fail_msg("seed %llu ray %d: packet %.17g, alone %.17g",
                     (unsigned long long)seed, i, t8, t1);
        assert_true(trace_occluded_1(l->world, l->scratch, &q) == isfinite(t1));
        *clear += verdict[i] != UNCLEAR;
        // A plane met at a flat angle, far away, magnifies the rounding of the direction.
        const double tolerance =
            1e-9 + 1e-12 * vec3_max_abs(g->move) + 1e-14 * want[i] * want[i];
        if (verdict[i] == SURFACE && !(fabs(t1 / g->size - want[i]) <= tolerance))
            fail_msg("seed %llu ray %d: t = %.17g, want %.17g", (unsigned long long)seed,
                     i, t1 / g->size, want[i]);
        if (verdict[i] == NOTHING && isfinite(t1))
            fail_msg("seed %llu ray %d: t = %.17g, want none", (unsigned long long)seed,
                     i, t1 / g->size);
    }
    ray_batch_free(batch);
}

static int run_seed(uint64_t seed)
{
    uint64_t s = seed * 2654435761u + 17;
    struct tree t = {.count = 0};
    char text[TEXT_MAX] = "";
    int clear = 0;
    do {
        t.count = 0;
        random_tree(&t, &s, between(&s, 1, 4));
    } while (t.node[0].kind < MERGE);
    write_tree(&t, 0, text);
    const struct placing *g = &placings[seed % (sizeof placings / sizeof placings[0])];
    struct loaded l;
    load(&l,
         "#declare Thing = %s\nobject { Thing scale %.17g rotate <%g, %g, %g> "
         "translate <%g, %g, %g> }",
         text, g->size, g->turn.x, g->turn.y, g->turn.z, g->move.x, g->move.y, g->move.z);
    compare_rays(&l, &t, g, seed, &s, &clear);
    unload(&l);
    return clear;
}

static uint64_t setting(const char *name, uint64_t otherwise)
{
    const char *v = getenv(name);
    return v ? strtoull(v, NULL, 10) : otherwise;
}

static void states_between_the_crossings_agree(void **state)
{
    (void)state;
    const uint64_t first = setting("LAMBERT_SEED", 1),
                   rounds = setting("LAMBERT_ROUNDS", 600);
    int clear = 0;
    for (uint64_t seed = first; seed < first + rounds; seed++)
        clear += run_seed(seed);
    assert_true((uint64_t)clear > rounds * 15); // most rays do tell something
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(states_between_the_crossings_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
