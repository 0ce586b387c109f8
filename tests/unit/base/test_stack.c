// Deep stacks: when a thread of its own is made, and who waits.
#include "test.h"

#include <pthread.h>

#include "base/stack.h"

struct seen {
    pthread_t outer, inner;
    int depth, ran, waited;
};

static void inner(void *user)
{
    struct seen *s = user;
    s->inner = pthread_self();
    s->ran++;
}

// Calls itself, 64 KiB deeper each time, and then stack_run.
static void descend(struct seen *s, int levels)
{
    volatile char room[64 * 1024]; // all of which is used, whatever the compiler sees
    for (size_t i = 0; i < sizeof room; i += 64)
        room[i] = (char)levels;
    if (levels)
        descend(s, levels - 1);
    else
        stack_run(inner, s);
    s->depth += room[0] == levels;
}

static void outer(void *user)
{
    struct seen *s = user;
    s->outer = pthread_self();
    descend(s, s->depth);
}

static void count(void *user) { ((struct seen *)user)->waited++; }

static void test_nested(void **state)
{
    (void)state;
    struct seen s = {.depth = 0};
    stack_run(outer, &s);
    assert_int_equal(s.ran, 1);
    assert_false(pthread_equal(s.outer, pthread_self()));
    assert_true(pthread_equal(s.outer, s.inner));
}

// Where much of the stack is used, what is run next has a whole one again.
static void test_used(void **state)
{
    (void)state;
    struct seen s = {.depth = 32};
    stack_run(outer, &s);
    assert_int_equal(s.ran, 1);
    assert_false(pthread_equal(s.outer, s.inner));
}

static void test_beside(void **state)
{
    (void)state;
    struct seen s = {.depth = 0};
    stack_run_beside(outer, count, &s);
    assert_int_equal(s.ran, 1);
    assert_int_equal(s.waited, 1);
    stack_run_beside(outer, NULL, &s);
    assert_int_equal(s.ran, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nested),
        cmocka_unit_test(test_used),
        cmocka_unit_test(test_beside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
