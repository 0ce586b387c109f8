#include "test.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/arena.h"
#include "math/bvh8.h"

// Trees of boxes of all kinds: every item once, no item missed, and the same tree again.

static uint32_t next(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*state >> 33);
}

static double unit(uint64_t *state) { return next(state) * 0x1p-31; }

enum kind { SCATTERED, SAME, IN_LINE, FLAT, NESTED, FAR_APART, KINDS };

static struct aabb random_box(enum kind kind, uint32_t i, uint64_t *random)
{
    struct vec3 p = vec3(unit(random), unit(random), unit(random)),
                size = vec3(0.01, 0.02, 0.01);
    switch (kind) {
    case SAME: p = vec3(1, 2, 3); break;
    case IN_LINE: p = vec3(i, 0, 0); break;
    case FLAT: p.y = size.y = 0; break;
    case NESTED:
        p = vec3(-(double)i, -(double)i, -(double)i);
        size = vec3(2.0 * i + 1, 2.0 * i + 1, 2.0 * i + 1);
        break;
    case FAR_APART: p = vec3_scale(pow(10, next(random) % 20), p); break;
    default: break;
    }
    return (struct aabb){p, vec3_add(p, size)};
}

static bool holds(const struct aabb *b, struct vec3 p)
{
    for (int axis = 0; axis < 3; axis++)
        if (!(vec3_axis(p, axis) >= vec3_axis(b->min, axis) &&
              vec3_axis(p, axis) <= vec3_axis(b->max, axis)))
            return false;
    return true;
}

static void check_point(const struct bvh8 *t, const struct aabb *box, uint32_t count,
                        struct vec3 p, unsigned char *met)
{
    const struct vec3 o = vec3_sub(p, t->origin);
    const float at[3] = {(float)o.x, (float)o.y, (float)o.z};
    struct bvh8_walk walk;
    memset(met, 0, count);
    bvh8_walk_begin(&walk, t);
    for (uint32_t first, n; bvh8_walk_point(&walk, t, at, &first, &n);)
        for (uint32_t k = first; k < first + n; k++)
            met[t->item[k] - 7] = 1;
    for (uint32_t i = 0; i < count; i++)
        assert_true(met[i] || !holds(&box[i], p));
}

// What a ray meets, with the walk's own limits to spare.
static void check_ray(const struct bvh8 *t, const struct aabb *box, uint32_t count,
                      uint64_t *random, unsigned char *met)
{
    const struct aabb *aim = &box[next(random) % count];
    const struct vec3 to = vec3_scale(0.5, vec3_add(aim->min, aim->max));
    const struct vec3 way_off = vec3(unit(random) - 0.5, 3, unit(random) + 1);
    const struct vec3 from = vec3_add(to, vec3_scale(fmax(1, vec3_max_abs(to)), way_off));
    const struct ray ray = {.o = from, .d = vec3_sub(to, from)};
    struct bvh8_ray way;
    struct bvh8_walk walk;
    memset(met, 0, count);
    assert_true(bvh8_ray_begin(t, &ray, 0, 2, &way));
    bvh8_walk_begin(&walk, t);
    for (uint32_t first, n; bvh8_walk_next(&walk, t, &way, &first, &n);)
        for (uint32_t k = first; k < first + n; k++)
            met[t->item[k] - 7] = 1;
    assert_true(met[aim - box]);
}

static void one_tree(struct arena *a, enum kind kind, uint32_t count, uint32_t leaf,
                     uint64_t *random)
{
    struct aabb *box = calloc(count, sizeof *box);
    uint32_t *index = calloc(count, sizeof *index);
    unsigned char *met = calloc(count, 1);
    for (uint32_t i = 0; i < count; i++) {
        box[i] = random_box(kind, i, random);
        index[i] = i + 7;
    }
    const struct bvh8 t = bvh8_build(a, box, index, count, leaf),
                      again = bvh8_build(a, box, index, count, leaf);
    assert_int_equal(t.item_count, count);
    for (uint32_t i = 0; i < count; i++) {
        assert_in_range(t.item[i], 7, count + 6);
        assert_false(met[t.item[i] - 7]++);
    }
    assert_int_equal(t.node_count, again.node_count);
    assert_memory_equal(t.item, again.item, count * sizeof *t.item);
    assert_memory_equal(t.node, again.node, t.node_count * sizeof *t.node);
    for (int k = 0; k < 50; k++) {
        const struct aabb *b = &box[next(random) % count];
        check_point(&t, box, count, k % 2 ? b->min : b->max, met);
        check_ray(&t, box, count, random, met);
    }
    free(box);
    free(index);
    free(met);
}

static void trees(void **state)
{
    (void)state;
    static const uint32_t counts[] = {1, 2, 4, 5, 8, 9, 31, 33, 200, 3000};
    uint64_t random = 3;
    struct arena *a = arena_new(1 << 16);
    for (int kind = 0; kind < KINDS; kind++)
        for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
            one_tree(a, (enum kind)kind, counts[i], BVH8_CHEAP_ITEMS, &random);
            one_tree(a, (enum kind)kind, counts[i], BVH8_DEAR_ITEMS, &random);
        }
    assert_null(bvh8_build(a, NULL, NULL, 0, BVH8_CHEAP_ITEMS).node);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(trees)};
    return cmocka_run_group_tests_name("bvh8", tests, NULL, NULL);
}
