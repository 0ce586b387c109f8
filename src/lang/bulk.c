#include "lang/bulk.h"

#include "base/arena.h"
#include "lang/scan.h"

static bool whole(struct scan *s, uint32_t *out)
{
    const char *from = s->at;
    uint32_t v = 0;
    for (; scan_is_digit(scan_next(s)); s->at++)
        v = 10 * v + (uint32_t)(*s->at - '0');
    *out = v;
    return s->at > from && s->at - from <= 9 && scan_number_ends(s);
}

static bool vectors(struct scan *s, const struct bulk *b, double *numbers,
                    uint32_t *indices)
{
    for (uint32_t i = 0; i < b->count; i++) {
        if (!scan_mark(s, '<'))
            return false;
        for (uint32_t k = 0; k < b->width; k++)
            if ((k && !scan_mark(s, ',')) ||
                !(numbers ? scan_number(s, numbers++) : whole(s, indices++)))
                return false;
        if (!scan_mark(s, '>'))
            return false;
        scan_mark(s, ',');
    }
    return scan_next(s) == '}';
}

// The components of a block's vectors; 0: no such block.
static uint32_t width_of(enum word w, bool *is_index)
{
    *is_index =
        w == WORD_face_indices || w == WORD_normal_indices || w == WORD_uv_indices;
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
    scan_blanks(&s);
    if (!whole(&s, &out->count) || !out->count || out->count > len / SHORTEST)
        return 0;
    scan_mark(&s, ',');
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

// The elements of an array as they come; what is known of all is found with the first.
struct elements {
    struct scan s;
    struct bulk *b;
    double *number; // the next one; NULL: they are only counted
};

static bool element(struct elements *e)
{
    struct bulk *b = e->b;
    const bool vector = scan_mark(&e->s, '<');
    uint32_t width = 0;
    do {
        if (!scan_number(&e->s, e->number))
            return false;
        e->number += e->number != NULL;
        width++;
    } while (vector && scan_mark(&e->s, ','));
    const bool whole = !vector || (width > 1 && width <= 5 && scan_mark(&e->s, '>'));
    if (!b->width)
        b->width = width;
    b->count++;
    return whole && width == b->width;
}

// The elements of one pair of braces, up to the '}'.
static bool row(struct elements *e, uint32_t dimension)
{
    struct bulk *b = e->b;
    uint32_t n = 0;
    for (;; n++) {
        scan_blanks(&e->s);
        const char c = scan_next(&e->s);
        if (c == '}')
            break;
        if (c != '{') {
            if (!b->dimensions)
                b->dimensions = dimension + 1;
            if (b->dimensions != dimension + 1 || !element(e) ||
                (!scan_mark(&e->s, ',') && scan_next(&e->s) != '}'))
                return false;
            continue;
        }
        e->s.at++;
        if (dimension + 1 == BULK_DIMENSIONS_MAX || b->dimensions == dimension + 1 ||
            !row(e, dimension + 1) || !scan_mark(&e->s, '}'))
            return false;
        scan_mark(&e->s, ',');
    }
    if (!b->size[dimension])
        b->size[dimension] = n;
    return n > 0 && n == b->size[dimension];
}

size_t bulk_scan_array(struct arena *a, const char *text, size_t len, struct bulk *out)
{
    struct bulk counted = {.count = 0};
    struct elements e = {.s = {text, text + len}, .b = &counted};
    if (!row(&e, 0) || counted.dimensions == 0)
        return 0;
    *out = (struct bulk){.len = (uint32_t)(e.s.at - text)};
    double *all = arena_new_array(a, double, (size_t)counted.count *counted.width);
    e = (struct elements){.s = {text, text + len}, .b = out, .number = all};
    row(&e, 0);
    out->number = all;
    return out->len;
}

size_t bulk_vector(const char *text, size_t len, double out[3])
{
    struct scan s = {text, text + len};
    return scan_vector3(&s, out) ? (size_t)(s.at - text) : 0;
}

bool bulk_word(enum word w)
{
    bool is_index;
    return width_of(w, &is_index) > 0;
}
