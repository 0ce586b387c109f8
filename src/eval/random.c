// The streams of seed() and rand() (spec/language 2.11).

#include <string.h>

#include "base/arena.h"
#include "eval/expr.h"

double number_to_int(double v)
{
    return v > -2147483649.0 && v < 2147483648.0 ? (double)(int32_t)v : -2147483648.0;
}

double random_seed(struct eval *e, double seed)
{
    if (e->random_count == e->random_capacity) {
        uint32_t capacity = 2 * e->random_capacity + 8;
        uint32_t *grown = arena_new_array(e->parse, uint32_t, capacity);
        if (e->random_count)
            memcpy(grown, e->random, e->random_count * sizeof *grown);
        e->random = grown;
        e->random_capacity = capacity;
    }
    e->random[e->random_count] = (uint32_t)(int32_t)number_to_int(seed);
    return e->random_count++;
}

double random_next(struct eval *e, double stream, struct span where, bool *ok)
{
    double i = number_to_int(stream);
    *ok = i >= 0 && i < e->random_count;
    if (!*ok) {
        diag_at(e->diags, DIAG_DOMAIN, where, "rand", "no such random stream");
        return 0;
    }
    uint32_t *state = &e->random[(uint32_t)i];
    *state = 1812433253u * *state + 12345u;
    return *state / 4294967295.0;
}
