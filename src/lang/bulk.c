#include "lang/bulk.h"

#include "base/arena.h"
#include "lang/number.h"

struct scan {
    const char *at, *end;
};

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static char next(const struct scan *s) { return s->at < s->end ? *s->at : 0; }

static void blanks(struct scan *s)
{
    while (s->at < s->end &&
           (*s->at == ' ' || *s->at == '\n' || *s->at == '\t' || *s->at == '\r'))
        s->at++;
}

// Past a mark with the blanks around it.
static bool mark(struct scan *s, char c)
{
    blanks(s);
    if (next(s) != c)
        return false;
    s->at++;
    blanks(s);
    return true;
}

// Nothing that would make the number before it another token.
static bool number_ends(const struct scan *s)
{
    switch (next(s)) {
    case ',': case '>': case '<': case ' ': case '\n': case '\t': case '\r': case '}':
        return true;
    default: return false;
    }
}

// The digits at s->at, added to *mantissa, which may overflow: then there are too many.
static uint32_t digits(struct scan *s, uint64_t *mantissa)
{
    const char *from = s->at;
    uint64_t m = *mantissa;
    for (; is_digit(next(s)); s->at++)
        m = 10 * m + (uint64_t)(*s->at - '0');
    *mantissa = m;
    return (uint32_t)(s->at - from);
}

static bool number(struct scan *s, double *out)
{
    const bool minus = next(s) == '-';
    s->at += minus;
    const char *from = s->at;
    uint64_t mantissa = 0;
    uint32_t count = digits(s, &mantissa), places = 0;
    if (next(s) == '.') {
        s->at++;
        places = digits(s, &mantissa);
    }
    if (!count && !places)
        return false;
    bool plain = count + places <= NUMBER_DIGITS;
    if (next(s) == 'e' || next(s) == 'E') {
        plain = false;
        s->at++;
        s->at += next(s) == '-' || next(s) == '+';
        if (!digits(s, &mantissa))
            return false;
    }
    *out = plain ? number_scaled(mantissa, places) : number_parse(from, (size_t)(s->at - from));
    if (minus)
        *out = -*out;
    return number_ends(s);
}

static bool whole(struct scan *s, uint32_t *out)
{
    const char *from = s->at;
    uint32_t v = 0;
    for (; is_digit(next(s)); s->at++)
        v = 10 * v + (uint32_t)(*s->at - '0');
    *out = v;
    return s->at > from && s->at - from <= 9 && number_ends(s);
}

static bool vectors(struct scan *s, const struct bulk *b, double *numbers,
                    uint32_t *indices)
{
    for (uint32_t i = 0; i < b->count; i++) {
        if (!mark(s, '<'))
            return false;
        for (uint32_t k = 0; k < b->width; k++)
            if ((k && !mark(s, ',')) ||
                !(numbers ? number(s, numbers++) : whole(s, indices++)))
                return false;
        if (!mark(s, '>'))
            return false;
        mark(s, ',');
    }
    return next(s) == '}';
}

// The components of a block's vectors; 0: no such block.
static uint32_t width_of(enum word w, bool *is_index)
{
    *is_index = w == WORD_face_indices || w == WORD_normal_indices || w == WORD_uv_indices;
    if (*is_index || w == WORD_vertex_vectors || w == WORD_normal_vectors)
        return 3;
    return w == WORD_uv_vectors ? 2 : 0;
}

size_t bulk_scan(struct arena *a, enum word w, const char *text, size_t len,
                 struct bulk *out)
{
    enum { SHORTEST = 5 }; // "<0,0>"
    bool is_index;
    struct scan s = {text, text + len};
    struct arena_mark before = arena_mark(a);
    *out = (struct bulk){.width = width_of(w, &is_index)};
    if (!out->width)
        return 0;
    blanks(&s);
    if (!whole(&s, &out->count) || !out->count || out->count > len / SHORTEST)
        return 0;
    mark(&s, ',');
    const size_t n = (size_t)out->count * out->width;
    double *numbers = is_index ? NULL : arena_new_array(a, double, n);
    uint32_t *indices = is_index ? arena_new_array(a, uint32_t, n) : NULL;
    out->number = numbers;
    out->index = indices;
    if (vectors(&s, out, numbers, indices)) {
        out->len = (uint32_t)(s.at - text);
        return out->len;
    }
    arena_rewind(a, before);
    return 0;
}

size_t bulk_vector(const char *text, size_t len, double out[3])
{
    struct scan s = {text, text + len};
    for (int i = 0; i < 3; i++) {
        blanks(&s);
        if (!number(&s, &out[i]))
            return 0;
        blanks(&s);
        if (next(&s) != (i < 2 ? ',' : '>'))
            return 0;
        s.at++;
    }
    return next(&s) == '=' ? 0 : (size_t)(s.at - text); // `>=` is one token
}
