#ifndef BASE_PARALLEL_H
#define BASE_PARALLEL_H

#include <stdint.h>

#include "base/watch.h"

// Runs work(user, state, begin, end) for consecutive pieces of [0, count), on `threads`
// threads (0: all cores) with large stacks. Each thread gets a state from begin(user) and
// gives it back to end; both may be NULL. What a piece does must not depend on the order.
// After a cancel of the watch no further piece is begun.
struct parallel {
    int threads;
    uint32_t piece; // items at once
    struct watch *watch;
    bool tells; // the watch how many pieces are done
    void *user;
    void *(*begin)(void *user);
    void (*end)(void *user, void *state);
    void (*work)(void *user, void *state, uint32_t begin, uint32_t end);
};
void parallel_run(const struct parallel *p, uint32_t count);

#endif
