#include "base/stack.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

// Address space, not memory. Half of it is tried when a limit forbids the whole.
static const size_t stack_size = (size_t)512 << 20;
static const size_t stack_size_least = (size_t)16 << 20;

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

void stack_run(void (*fn)(void *user), void *user)
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
    if (started)
        pthread_join(thread, NULL);
    else
        fn(user);
}
