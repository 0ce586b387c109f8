#include "base/stack.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Address space, not memory. Half of it is tried when a limit forbids the whole.
static const size_t stack_size = (size_t)512 << 20;
static const size_t stack_size_least = (size_t)16 << 20;
// Below this much use of such a stack there is no need for another.
static const size_t stack_used_most = (size_t)1 << 20;

// Where the stack of a thread that was started here begins; 0: any other thread.
static _Thread_local uintptr_t stack_begin;

struct call {
    void (*fn)(void *user);
    void *user;
};

static uintptr_t here(void) { return (uintptr_t)__builtin_frame_address(0); }

static void *start(void *user)
{
    const struct call *call = user;
    stack_begin = here();
    call->fn(call->user);
    return NULL;
}

// Stacks may grow up or down.
static bool is_deep(void)
{
    const uintptr_t at = here();
    const uintptr_t used = at > stack_begin ? at - stack_begin : stack_begin - at;
    return stack_begin && used <= stack_used_most;
}

void stack_run(void (*fn)(void *user), void *user)
{
    if (is_deep())
        fn(user);
    else
        stack_run_beside(fn, NULL, user);
}

void stack_run_beside(void (*fn)(void *user), void (*meanwhile)(void *user), void *user)
{
    struct call call = {fn, user};
    pthread_attr_t attributes;
    pthread_t thread;
    bool started = false;
    if (pthread_attr_init(&attributes) == 0) {
        for (size_t size = stack_size; !started && size >= stack_size_least; size /= 2)
            started = pthread_attr_setstacksize(&attributes, size) == 0 &&
                      pthread_create(&thread, &attributes, start, &call) == 0;
        pthread_attr_destroy(&attributes);
    }
    if (!started) {
        fn(user);
        return;
    }
    if (meanwhile)
        meanwhile(user);
    pthread_join(thread, NULL);
}
