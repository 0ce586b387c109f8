#ifndef MATH_TRIG_H
#define MATH_TRIG_H

#include "math/dd.h"

// The numbers of math/trig.c, for those who compute in lanes with the same bits.
extern const struct dd trig_half_pi;
extern const struct dd trig_atan_eighth[9]; // atan(k / 8)

#endif
