// Pigments and normals at eight points: the bits must be those of one point after the other,
// with every instruction set that the machine has.

#include "test.h"

#include "base/arena.h"
#include "scene/noise_kernel.h"
#include "scene/pigment_tape.h"

static uint64_t state_of_random = 88172645463325252u;

static uint32_t random_below(uint32_t n)
{
    state_of_random ^= state_of_random << 13;
    state_of_random ^= state_of_random >> 7;
    state_of_random ^= state_of_random << 17;
    return (uint32_t)(state_of_random >> 33) % n;
}

static double random_unit(void) { return random_below(1u << 30) * 0x1p-30; }
static float random_float(void) { return (float)random_unit(); }

static const struct pattern_ops *const kinds[] = {
    &granite_pattern_ops, &marble_pattern_ops, &wood_pattern_ops,
    &checker_pattern_ops, &agate_pattern_ops,  &gradient_pattern_ops,
    &onion_pattern_ops,   &slope_pattern_ops,  &bumps_pattern_ops,
    &crackle_pattern_ops, &spiral1_pattern_ops};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static struct transform random_transform(void)
{
    const struct transform turn = transform_rotate(
        vec3(90 * random_unit(), 360 * random_unit(), random_below(2) * 90));
    const struct transform move =
        transform_translate(vec3(random_unit(), random_unit(), -random_unit()));
    return random_below(4) ? transform_then(&turn, &move) : transform_identity;
}

// Warps of several kinds; the first, written last, is tried first.
static void random_warps(struct arena *a, struct pattern *p)
{
    static const struct turbulence moved = {{0.6, 0.4, 0.9}, 4, 2.2f, 0.6f};
    for (uint32_t n = random_below(4); n; n--) {
        const struct transform t = random_transform();
        struct warp w = {.kind = WARP_REPEAT, .repeat = {1.5, 0, 0}, .flip = {1, 0, 0}};
        switch (random_below(4)) {
        case 0: w = (struct warp){.kind = WARP_TURBULENCE, .turbulence = moved}; break;
        case 1:
            w = (struct warp){.kind = WARP_SPHERICAL, .orientation = {0, 0, 1}};
            break;
        case 2: pattern_add_transform(a, p, &t); continue;
        default: break;
        }
        pattern_add_warp(a, p, &w);
    }
    p->turbulence = random_below(3) ? NULL : &moved;
}

static void random_pattern(struct arena *a, struct pattern *p)
{
    const struct pattern_ops *ops = kinds[random_below(KINDS)];
    pattern_set_kind(p, ops);
    p->vector = ops == &gradient_pattern_ops ? vec3(1, 0.5, 0) : p->vector;
    p->vector = ops == &slope_pattern_ops ? vec3(0, 1, 0) : p->vector;
    p->integer[0] = 3;
    p->noise_generator = 1 + (int)random_below(3);
    p->wave = random_below(2) ? p->wave : (enum wave)random_below(6);
    p->exponent = 1.5f;
    if (p->frequency != 0 && random_below(2)) {
        p->frequency = random_below(3) ? 7.5f * random_float() : 1e8f;
        p->phase = random_float();
    }
    random_warps(a, p);
}

static float *random_keys(struct arena *a, uint32_t count, bool ascending)
{
    float *key = arena_new_array(a, float, count);
    for (uint32_t i = 0; i < count; i++)
        key[i] = ascending ? (float)(i + random_below(2)) / (float)count : random_float();
    return key;
}

static struct rgbft random_color(bool clear)
{
    return (struct rgbft){random_float(), random_float(), random_float(),
                          clear ? random_float() : 0, clear ? random_float() : 0};
}

static const struct pigment *random_pigment(struct arena *a, int depth, bool clear)
{
    struct pigment *p = arena_new_struct(a, struct pigment);
    struct pattern *pattern = arena_new_struct(a, struct pattern);
    *p = (struct pigment){.color = random_color(clear), .pattern = pattern};
    *pattern = (struct pattern){0};
    random_pattern(a, pattern);
    const uint32_t count = 1 + random_below(depth ? 4 : random_below(6) ? 12 : 90);
    const float *key = random_keys(a, count, random_below(4) != 0);
    p->kind = depth ? (enum pigment_kind)random_below(7) : PIGMENT_COLORS;
    if (p->kind == PIGMENT_IMAGE || (p->kind == PIGMENT_COLORS && random_below(8) == 0))
        p->kind = PIGMENT_SOLID;
    if (p->kind == PIGMENT_COLORS) {
        struct rgbft *color = arena_new_array(a, struct rgbft, count);
        struct color_map *m = arena_new_struct(a, struct color_map);
        for (uint32_t i = 0; i < count; i++)
            color[i] = i && random_below(3) == 0 ? color[i - 1] : random_color(clear);
        *m = (struct color_map){count, key, color};
        p->colors = m;
    } else if (p->kind != PIGMENT_SOLID && p->kind != PIGMENT_NONE) {
        const struct pigment **entry = arena_new_array(a, const struct pigment *, count);
        struct pigment_map *m = arena_new_struct(a, struct pigment_map);
        for (uint32_t i = 0; i < count; i++)
            entry[i] = i && random_below(3) == 0 ? entry[i - 1]
                                                 : random_pigment(a, depth - 1, clear);
        *m = (struct pigment_map){count, key, entry};
        p->map = m;
        if (p->kind == PIGMENT_AVERAGE)
            *pattern = (struct pattern){.warps = pattern->warps};
    }
    return p;
}

static const struct normal *random_normal(struct arena *a, int depth)
{
    struct normal *n = arena_new_struct(a, struct normal);
    *n = (struct normal){.amount = random_float(), .delta = 0.02f};
    n->no_bump_scale = random_below(3) == 0;
    random_pattern(a, &n->pattern);
    const uint32_t count = 1 + random_below(4);
    const float *key = random_keys(a, count, true);
    n->kind = depth ? (enum normal_kind)random_below(6) : NORMAL_PATTERN;
    if (n->kind == NORMAL_SLOPES) {
        struct vec2 *entry = arena_new_array(a, struct vec2, count);
        struct slope_map *m = arena_new_struct(a, struct slope_map);
        for (uint32_t i = 0; i < count; i++)
            entry[i] = (struct vec2){random_unit(), random_unit()};
        *m = (struct slope_map){count, key, entry};
        n->slopes = m;
    } else if (n->kind != NORMAL_PATTERN && n->kind != NORMAL_BUMP_MAP) {
        const struct normal **entry = arena_new_array(a, const struct normal *, count);
        struct normal_map *m = arena_new_struct(a, struct normal_map);
        for (uint32_t i = 0; i < count; i++)
            entry[i] = random_normal(a, depth - 1);
        *m = (struct normal_map){count, key, entry};
        n->map = m;
    }
    return n;
}

// Eight points, close together or not, with all that is known of them.
struct points {
    double p[3][8], normal[3][8], ray[3][8], uv[2][8];
};

static void random_points(struct points *x)
{
    const double spread = random_below(2) ? 0.05 : 4;
    for (int a = 0; a < 3; a++) {
        const double middle = 10 * random_unit() - 5;
        for (int i = 0; i < 8; i++) {
            x->p[a][i] = middle + spread * random_unit();
            x->normal[a][i] = random_unit() - 0.5;
            x->ray[a][i] = random_unit() - 0.5;
            if (a < 2)
                x->uv[a][i] = random_unit();
        }
    }
}

static struct vec3 lane(double v[3][8], int i) { return vec3(v[0][i], v[1][i], v[2][i]); }

static struct texture_point point_of(struct points *x, int i)
{
    return (struct texture_point){.p = lane(x->p, i),
                                  .uv = {x->uv[0][i], x->uv[1][i]},
                                  .normal = lane(x->normal, i),
                                  .ray_d = lane(x->ray, i),
                                  .p_world = lane(x->p, i),
                                  .normal_seen = lane(x->normal, i)};
}

static struct pattern_packet packet_of(const struct points *x)
{
    return (struct pattern_packet){(const double(*)[8])x->p,
                                   (const double(*)[8])x->normal,
                                   (const double(*)[8])x->ray, (const double(*)[8])x->uv};
}

static void check_pigment(const struct surface_kernels *k, const struct pigment_tape *t,
                          const struct pigment *p, struct points *x, unsigned live)
{
    const struct pattern_packet packet = packet_of(x);
    float out[5][8] = {{0}};
    const unsigned found = k->colors(t, &packet, (const double(*)[8])x->p, live, out);
    assert_int_equal(found, live);
    for (int i = 0; i < 8; i++) {
        const struct texture_point at = point_of(x, i);
        struct rgbft c;
        if (!(live >> i & 1))
            continue;
        assert_true(pigment_color(p, &at, &c));
        const float want[5] = {c.r, c.g, c.b, c.filter, c.transmit};
        for (int j = 0; j < 5; j++)
            if (memcmp(&want[j], &out[j][i], sizeof want[j]) != 0)
                fail_msg("%s, channel %d: %.9g, one by one %.9g", k->name, j,
                         (double)out[j][i], (double)want[j]);
    }
}

static void check_normal(const struct surface_kernels *k, const struct normal *n,
                         struct points *x, unsigned live)
{
    const struct pattern_packet packet = packet_of(x);
    double v[3][8];
    memcpy(v, x->normal, sizeof v);
    k->perturb(n, &packet, (const double(*)[8])x->p, live, v);
    for (int i = 0; i < 8; i++) {
        const struct texture_point at = point_of(x, i);
        if (!(live >> i & 1))
            continue;
        const struct vec3 want = normal_perturb(n, &at), got = lane(v, i);
        if (memcmp(&want, &got, sizeof want) != 0)
            fail_msg("%s: normal <%.17g, %.17g, %.17g>, one by one <%.17g, %.17g, %.17g>",
                     k->name, got.x, got.y, got.z, want.x, want.y, want.z);
    }
}

typedef void check_function(const struct surface_kernels *k);

static void with_all_kernels(check_function *check)
{
    static const char *const names[] = {"base", "avx2", "avx512"};
    for (int i = 0; i < 3; i++) {
        const struct surface_kernels *k = surface_kernels_find(names[i]);
        if (k)
            check(k);
        else
            assert_true(i > 0);
    }
}

static void check_pigments(const struct surface_kernels *k)
{
    unsigned opaque = 0;
    for (int turn = 0; turn < 1500; turn++) {
        struct arena *a = arena_new(0);
        struct pigment_compiler compiler = {.arena = a};
        const struct pigment *p = random_pigment(a, turn % 4, turn % 2);
        const struct pigment_tape *t = pigment_compile(&compiler, p);
        struct points x;
        random_points(&x);
        assert_non_null(t);
        opaque += t->channels == 3;
        check_pigment(k, t, p, &x, turn % 3 ? 255 : 1 + random_below(255));
        arena_free(a);
    }
    assert_true(opaque >= 700);
}

static void pigments(void **state)
{
    (void)state;
    with_all_kernels(check_pigments);
}

static void check_normals(const struct surface_kernels *k)
{
    for (int turn = 0; turn < 1500; turn++) {
        struct arena *a = arena_new(0);
        struct points x;
        random_points(&x);
        check_normal(k, random_normal(a, turn % 4), &x,
                     turn % 3 ? 255 : 1 + random_below(255));
        arena_free(a);
    }
}

static void normals(void **state)
{
    (void)state;
    with_all_kernels(check_normals);
}

// Keys that come again, and values below, between, on and above all of them.
static void search_finds_what_the_walk_finds(void **state)
{
    (void)state;
    for (int turn = 0; turn < 20000; turn++) {
        float key[16];
        const uint32_t count = 1 + random_below(16);
        for (uint32_t i = 0; i < count; i++)
            key[i] = (float)(i ? key[i - 1] + (float)random_below(3) / 16 : -0.25f);
        const double v = turn % 7 == 0 ? NAN
                         : turn % 2    ? (double)key[random_below(count)]
                                       : 3 * random_unit() - 1;
        uint32_t a, b;
        double f;
        map_find(key, count, v, &a, &b, &f);
        assert_int_equal(map_search(key, count, v), b);
    }
}

// What all colours have in common needs no pattern; what goes the same way no steps.
static void constants_are_folded(void **state)
{
    (void)state;
    struct arena *a = arena_new(0);
    struct pigment_compiler compiler = {.arena = a};
    static const float key[2] = {0, 1};
    const struct rgbft same[2] = {{0.5f, 0.25f, 1, 0, 0}, {0.5f, 0.25f, 1, 0, 0}};
    const struct color_map even = {2, key, same};
    struct pattern pattern = {0};
    pattern_set_kind(&pattern, &granite_pattern_ops);
    struct pigment p = {.kind = PIGMENT_COLORS, .pattern = &pattern, .colors = &even};
    const struct pigment_tape *t = pigment_compile(&compiler, &p);
    assert_int_equal(t->count, 1);
    assert_int_equal(t->step[0].op, PIGMENT_COLOR);
    const struct pigment *entry[1] = {&p};
    const struct pigment_map one = {1, key, entry};
    const struct pigment map = {.kind = PIGMENT_MAP, .pattern = &pattern, .map = &one};
    t = pigment_compile(&compiler, &map);
    for (uint32_t i = 0; i < t->count; i++)
        assert_int_not_equal(t->step[i].op, PIGMENT_VALUE);
    const struct pigment *deep = &map;
    for (int i = 0; i < PIGMENT_LEVELS; i++) {
        struct pigment *outer = arena_new_struct(a, struct pigment);
        const struct pigment **two = arena_new_array(a, const struct pigment *, 2);
        struct pigment_map *m = arena_new_struct(a, struct pigment_map);
        two[0] = two[1] = deep;
        *m = (struct pigment_map){2, key, two};
        *outer = (struct pigment){.kind = PIGMENT_MAP, .pattern = &pattern, .map = m};
        deep = outer;
    }
    assert_null(pigment_compile(&compiler, deep));
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pigments),
        cmocka_unit_test(normals),
        cmocka_unit_test(search_finds_what_the_walk_finds),
        cmocka_unit_test(constants_are_folded),
    };
    return cmocka_run_group_tests_name("pigment_tapes", tests, NULL, NULL);
}
