#ifndef LANG_NUMBER_H
#define LANG_NUMBER_H

#include <stddef.h>

// The double nearest to a decimal number, in any locale. An exponent letter
// without digits is dropped.
double number_parse(const char *text, size_t len);

#endif
