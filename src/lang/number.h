#ifndef LANG_NUMBER_H
#define LANG_NUMBER_H

#include <stddef.h>
#include <stdint.h>

// The double nearest to a decimal number, in any locale. An exponent letter
// without digits is dropped.
double number_parse(const char *text, size_t len);

// Digits of so many are a double without error, and so is 10 to as many (Clinger, PLDI 1990,
// section 3): mantissa/10^places is then rounded once.
enum { NUMBER_DIGITS = 15 };
extern const double number_power[]; // of ten, up to 22
static inline double number_scaled(uint64_t mantissa, uint32_t places)
{
    return (double)mantissa / number_power[places];
}

#endif
