#ifndef BASE_CLOCK_H
#define BASE_CLOCK_H

#include <time.h>

// Seconds of a clock of the system's (CLOCK_MONOTONIC, CLOCK_PROCESS_CPUTIME_ID), to be
// subtracted.
static inline double clock_seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
