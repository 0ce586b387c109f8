// Arrays that grow, and what is told when there is no memory.
#include "test.h"

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/memory.h"

static void test_grow(void **state)
{
    (void)state;
    enum { ITEMS = 1000 };
    struct arena *a = arena_new(64);
    uint32_t *heap = NULL, *held = NULL, heap_capacity = 0, held_capacity = 0;
    for (uint32_t i = 1; i < ITEMS; i++) { // 0 stands for none, as in source maps
        heap = must_grow(heap, i, &heap_capacity, sizeof *heap);
        held = arena_grow(a, held, i, &held_capacity, sizeof *held);
        heap[i] = held[i] = i;
        assert_true(i < heap_capacity && i < held_capacity);
    }
    for (uint32_t i = 1; i < ITEMS; i++)
        assert_true(heap[i] == i && held[i] == i);
    free(heap);
    arena_free(a);
}

static void test_nothing(void **state)
{
    (void)state;
    unsigned char *none = must_malloc(0, 8), *also = must_calloc(0, 8);
    assert_non_null(none);
    assert_non_null(also);
    none = must_realloc(none, 0, 8);
    assert_non_null(none);
    free(none);
    free(also);
    void *aligned = must_align(64, 3, 7);
    assert_int_equal((uintptr_t)aligned % 64, 0);
    free(aligned);
}

static void too_many(void) { must_malloc(SIZE_MAX / 4, 8); }
static void too_many_zeroed(void) { must_calloc(SIZE_MAX / 4, 8); }
static void too_many_again(void) { must_realloc(NULL, SIZE_MAX / 4, 8); }
static void too_many_aligned(void) { must_align(64, SIZE_MAX - 8, 1); }
static void too_many_in_arena(void) { arena_alloc_array(arena_new(64), SIZE_MAX / 4, 8); }
static void too_many_to_count(void)
{
    uint32_t capacity = UINT32_MAX / 2 + 1;
    must_grow(NULL, capacity, &capacity, 1);
}

// Sizes that would wrap around to a few bytes end the process, and it says why.
static void test_overflow(void **state)
{
    (void)state;
    void (*const asks[])(void) = {too_many,         too_many_zeroed,   too_many_again,
                                  too_many_aligned, too_many_in_arena, too_many_to_count};
    for (size_t i = 0; i < sizeof asks / sizeof *asks; i++) {
        char said[64] = "";
        int ends[2], status;
        assert_int_equal(pipe(ends), 0);
        const pid_t child = fork();
        if (child == 0) {
            dup2(ends[1], STDERR_FILENO);
            signal(SIGABRT, SIG_DFL);
            asks[i]();
            _exit(0);
        }
        close(ends[1]);
        assert_true(read(ends[0], said, sizeof said - 1) > 0);
        close(ends[0]);
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
        assert_string_equal(said, "lambert: out of memory\n");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grow),
        cmocka_unit_test(test_nothing),
        cmocka_unit_test(test_overflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
