#ifndef TESTS_TEST_H
#define TESTS_TEST_H

// cmocka's own order of includes, once.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// Fails with both values at full precision.
#define assert_near(got, want, tolerance)                                                \
    do {                                                                                 \
        double got_ = (got), want_ = (want);                                             \
        if (!(fabs(got_ - want_) <= (tolerance)))                                        \
            fail_msg("%s: got %.17g, want %.17g", #got, got_, want_);                    \
    } while (0)

#endif
