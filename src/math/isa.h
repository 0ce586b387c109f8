#ifndef MATH_ISA_H
#define MATH_ISA_H

#include <string.h>

// Names of what is compiled once per instruction set. The build defines ISA; where a header
// is read alone it is the portable one.
#ifndef ISA
#define ISA base
#endif

// Which of KERNELS_base, _avx2 and _avx512 has the name of an instruction set.
#ifdef LAMBERT_X86
#define ISA_NAMED(isa, kernels)                                                          \
    (!strcmp(isa, "avx512") ? &kernels##_avx512                                          \
     : !strcmp(isa, "avx2") ? &kernels##_avx2                                            \
                            : &kernels##_base)
#else
#define ISA_NAMED(isa, kernels) ((void)(isa), &kernels##_base)
#endif

#define ISA_PASTE_(a, b) a##b
#define ISA_PASTE(a, b)  ISA_PASTE_(a, b)
#define OF_ISA(name)     ISA_PASTE(name, ISA) // OF_ISA(kernels_): kernels_avx2
#define ISA_TEXT_(a)     #a
#define ISA_TEXT_OF(a)   ISA_TEXT_(a)
#define ISA_TEXT         ISA_TEXT_OF(ISA) // "avx2"

#endif
