// For pthread_getattr_np.
#define _GNU_SOURCE

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

struct call {
    void (*fn)(void *user);
    void *user;
};

static void *start(void *user)
{
    const struct call *call = user;
    call->fn(call->user);
    return NULL;
}

// Whether this thread has such a stack and has used little of it: not known but of the GNU
// C library's threads. Stacks may grow up or down.
static bool is_deep(void)
{
    bool deep = false;
#ifdef __GLIBC__
    pthread_attr_t attributes;
    void *low;
    size_t size;
    if (pthread_getattr_np(pthread_self(), &attributes) != 0)
        return false;
    if (pthread_attr_getstack(&attributes, &low, &size) == 0) {
        const uintptr_t at = (uintptr_t)__builtin_frame_address(0) - (uintptr_t)low;
        const size_t used = at < size - at ? at : size - at;
        deep = size >= stack_size_least && at < size && used <= stack_used_most;
    }
    pthread_attr_destroy(&attributes);
#endif
    return deep;
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
