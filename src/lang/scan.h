#ifndef LANG_SCAN_H
#define LANG_SCAN_H

#include <stdbool.h>
#include <stdint.h>

#include "lang/number.h"

// What the scanners of texts that programs write share (lang/bulk.c, lang/literal.c). They take
// what is plain and leave all else to the lexer.
struct scan {
    const char *at, *end;
};

static inline bool scan_is_digit(char c) { return c >= '0' && c <= '9'; }

static inline char scan_next(const struct scan *s) { return s->at < s->end ? *s->at : 0; }

static inline void scan_blanks(struct scan *s)
{
    while (s->at < s->end &&
           (*s->at == ' ' || *s->at == '\n' || *s->at == '\t' || *s->at == '\r'))
        s->at++;
}

// Past a mark with the blanks around it.
static inline bool scan_mark(struct scan *s, char c)
{
    scan_blanks(s);
    if (scan_next(s) != c)
        return false;
    s->at++;
    scan_blanks(s);
    return true;
}

// Nothing that would make the number before it another token.
static inline bool scan_number_ends(const struct scan *s)
{
    switch (scan_next(s)) {
    case ',':
    case '>':
    case '<':
    case ' ':
    case '\n':
    case '\t':
    case '\r':
    case '}': return true;
    default: return false;
    }
}

// The digits at s->at, added to *mantissa, which may overflow: then there are too many.
static inline uint32_t scan_digits(struct scan *s, uint64_t *mantissa)
{
    const char *from = s->at;
    uint64_t m = *mantissa;
    for (; scan_is_digit(scan_next(s)); s->at++)
        m = 10 * m + (uint64_t)(*s->at - '0');
    *mantissa = m;
    return (uint32_t)(s->at - from);
}

// A number with or without a '-': the double nearest to it, or no more than that it is one
// (out NULL).
static inline bool scan_number(struct scan *s, double *out)
{
    const bool minus = scan_next(s) == '-';
    s->at += minus;
    const char *from = s->at;
    uint64_t mantissa = 0;
    uint32_t count = scan_digits(s, &mantissa), places = 0;
    if (scan_next(s) == '.') {
        s->at++;
        places = scan_digits(s, &mantissa);
    }
    if (!count && !places)
        return false;
    bool plain = count + places <= NUMBER_DIGITS;
    if (scan_next(s) == 'e' || scan_next(s) == 'E') {
        plain = false;
        s->at++;
        s->at += scan_next(s) == '-' || scan_next(s) == '+';
        if (!scan_digits(s, &mantissa))
            return false;
    }
    if (!out)
        return scan_number_ends(s);
    *out = plain ? number_scaled(mantissa, places)
                 : number_parse(from, (size_t)(s->at - from));
    if (minus)
        *out = -*out;
    return scan_number_ends(s);
}

// `a, b, c>`, what follows a '<'; out: as of scan_number.
static inline bool scan_vector3(struct scan *s, double *out)
{
    for (int i = 0; i < 3; i++) {
        scan_blanks(s);
        if (!scan_number(s, out ? &out[i] : NULL))
            return false;
        scan_blanks(s);
        if (scan_next(s) != (i < 2 ? ',' : '>'))
            return false;
        s->at++;
    }
    return scan_next(s) != '='; // `>=` is one token
}

#endif
