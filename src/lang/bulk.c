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
