#include "base/parallel.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

#include "base/stack.h"

struct run {
    const struct parallel *p;
    uint32_t count;
    atomic_uint_fast64_t next;
};

struct worker {
    struct run *run;
    bool first; // the thread that asked
};

static void work(void *user)
{
    const struct worker *worker = user;
    struct run *r = worker->run;
    const struct parallel *p = r->p;
    void *state = p->begin ? p->begin(p->user) : NULL;
    while (!watch_cancelled(p->watch)) {
        const uint64_t begin = atomic_fetch_add(&r->next, p->piece);
        if (begin >= r->count)
            break;
        const uint64_t end = begin + p->piece < r->count ? begin + p->piece : r->count;
        p->work(p->user, state, (uint32_t)begin, (uint32_t)end);
        if (worker->first && p->tells)
            watch_tell(p->watch, (double)end / r->count);
    }
    if (p->end)
        p->end(p->user, state);
}

static void *work_deep(void *user)
{
    stack_run(work, user);
    return NULL;
}

void parallel_run(const struct parallel *p, uint32_t count)
{
    enum { MOST = 256 };
    pthread_t thread[MOST];
    struct run r = {.p = p, .count = count};
    long n = p->threads > 0 ? p->threads : sysconf(_SC_NPROCESSORS_ONLN);
    const uint32_t pieces = count / p->piece + (count % p->piece != 0);
    if (n > MOST)
        n = MOST;
    if (n > (long)pieces)
        n = (long)pieces;
    struct worker others = {&r, false}, own = {&r, true};
    int started = 0;
    // If the system refuses a thread, the others do its share.
    while (started + 1 < n &&
           pthread_create(&thread[started], NULL, work_deep, &others) == 0)
        started++;
    work_deep(&own);
    for (int i = 0; i < started; i++)
        pthread_join(thread[i], NULL);
}
