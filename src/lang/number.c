#include "lang/number.h"

#include <locale.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

const double number_power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Numbers of up to 15 digits with a small power of ten are exact in one operation:
// both factors are doubles without error (Clinger, PLDI 1990, section 3).
static bool parse_short(const char *text, size_t len, double *out)
{
    uint64_t mantissa = 0;
    int digits = 0, scale = 0;
    bool point = false;
    size_t i = 0;
    for (; i < len && text[i] != 'e' && text[i] != 'E'; i++) {
        if (text[i] == '.') {
            point = true;
            continue;
        }
        mantissa = 10 * mantissa + (uint64_t)(text[i] - '0');
        digits += mantissa != 0;
        scale -= point;
        if (digits > NUMBER_DIGITS)
            return false;
    }
    if (i + 1 < len) {
        int exponent = 0;
        bool minus = text[++i] == '-';
        if (text[i] == '-' || text[i] == '+')
            i++;
        for (; i < len && exponent < 1000; i++)
            exponent = 10 * exponent + (text[i] - '0');
        scale += minus ? -exponent : exponent;
    }
    if (scale < -22 || scale > 22)
        return false;
    *out = scale < 0 ? (double)mantissa / number_power[-scale]
                     : (double)mantissa * number_power[scale];
    return true;
}

double number_parse(const char *text, size_t len)
{
    double value;
    if (len && (text[len - 1] == 'e' || text[len - 1] == 'E'))
        len--;
    if (parse_short(text, len, &value))
        return value;
    const char *point = localeconv()->decimal_point;
    size_t point_len = strlen(point);
    char *copy = must_malloc(len + point_len + 1, 1);
    size_t n = 0;
    for (size_t i = 0; i < len; i++) {
        if (text[i] == '.') {
            memcpy(copy + n, point, point_len);
            n += point_len;
        } else {
            copy[n++] = text[i];
        }
    }
    copy[n] = 0;
    value = strtod(copy, NULL);
    free(copy);
    return value;
}
