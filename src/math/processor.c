#include "math/processor.h"

#include <string.h>

// What the C library found out when the program started. Asking the processor again takes
// longer than making some pages: in a virtual machine each question goes to its host.
#if defined LAMBERT_X86 && defined __has_include
#if __has_include(<sys/platform/x86.h>)
#include <sys/platform/x86.h>
// Its own x86_cpu_active shifts a signed 1 into the sign (AVX512VL).
static bool active(unsigned index)
{
    enum { WORD = 32, LEAF = 128 };
    const unsigned bit = index % LEAF;
    return __x86_get_cpuid_feature_leaf(index / LEAF)->active_array[bit / WORD] >>
               bit % WORD &
           1;
}
#define ISA_HAS(name, word) active(x86_cpu_##name)
#endif
#endif
#ifndef ISA_HAS
#define ISA_HAS(name, word) __builtin_cpu_supports(word)
#endif

bool processor_has(const char *isa)
{
#ifdef LAMBERT_X86
    if (strcmp(isa, "avx512") == 0)
        return ISA_HAS(AVX512F, "avx512f") && ISA_HAS(AVX512DQ, "avx512dq") &&
               ISA_HAS(AVX512VL, "avx512vl") && ISA_HAS(AVX512BW, "avx512bw") &&
               ISA_HAS(AVX2, "avx2");
    if (strcmp(isa, "avx2") == 0)
        return ISA_HAS(AVX2, "avx2") && ISA_HAS(BMI2, "bmi2");
#endif
    return strcmp(isa, "base") == 0;
}
