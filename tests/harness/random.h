#ifndef TESTS_RANDOM_H
#define TESTS_RANDOM_H

#include <stdint.h>

// Marsaglia's xorshift: the same numbers in every run.
static uint64_t state_of_random = 88172645463325252u;

static double random_unit(void)
{
    state_of_random ^= state_of_random << 13;
    state_of_random ^= state_of_random >> 7;
    state_of_random ^= state_of_random << 17;
    return (double)(state_of_random >> 11) * 0x1p-53;
}

#endif
