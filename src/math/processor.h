#ifndef MATH_PROCESSOR_H
#define MATH_PROCESSOR_H

#include <stdbool.h>

// Whether this processor has what is compiled for "avx512", "avx2" or "base" (math/isa.h).
bool processor_has(const char *isa);

#endif
