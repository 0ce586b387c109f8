// The table of internal functions.

#include "eval/internal.h"

#include "eval/formula.h"

#define CUSHION                                                                          \
    C *A - C *C - 2 * z *A + 2 * C *z + A - C - square(A - z) - B *B - 2 * A *B - B *C + \
        2 * B *z + B
#define LOBES                                                                            \
    "e = exp(-p[1] * (p[0] * A + p[0] * B + C));"                                        \
    "f = exp(-p[1] * (p[0] * A + B + p[0] * C));"                                        \
    "g = exp(-p[1] * (A + p[0] * B + p[0] * C));"
#define HEXAGON                                                                          \
    "h = sqrt(3) / 2; k = fabs(mod(fabs(x), sqrt(3)) - h);"                              \
    "m = fabs(mod(fabs(y), 3) - 1.5); c = h - k; e = 1.5 - m;"                           \
    "s = less(c * c + e * e, k * k + m * m); a = where(s, c, k); b = where(s, e, m);"

static const struct internal_function functions[] = {
#define TEXT(...)                         #__VA_ARGS__
#define INTERNAL(name, n, ...)            {#name, n, -1, NULL, TEXT(__VA_ARGS__), NULL},
#define LIMITED(name, n, ...)             {#name, n, -1, "10", TEXT(__VA_ARGS__), NULL},
#define BOUNDED(name, n, ...)             {#name, n, 2, "p[1]", TEXT(__VA_ARGS__), NULL},
#define REVOLVED(name, n, at, ...)        {#name, n, at, "10", TEXT(__VA_ARGS__), NULL},
#define STEPS(name, n, text)              {#name, n, -1, NULL, text, NULL},
#define REVOLVED_STEPS(name, n, at, text) {#name, n, at, NULL, text, NULL},
#define NOISE(name, n)                    {#name, n, -1, NULL, NULL, &internal_##name},
#include "eval/internal.def"
};

const struct internal_function *internal_function(double number)
{
    const double count = sizeof functions / sizeof functions[0];
    return number >= 0 && number < count ? &functions[(int)number] : NULL;
}

// Turns the point about the y axis into the plane of the curve, moved by p[1] and
// turned by p[2] degrees; p[0] switches it on.
static void revolve(struct tape_builder *b, uint32_t at[3], const uint32_t *p)
{
    static const char *const radius = "sqrt(A + C) - p[1]";
    static const char *const x = "r = sqrt(A + C) - p[1]; t = p[2] * pi / 180;"
                                 "where(equal(p[2], 0), r, r * cos(t) - y * sin(t))";
    static const char *const y = "r = sqrt(A + C) - p[1]; t = p[2] * pi / 180;"
                                 "where(equal(p[2], 0), y, r * sin(t) + y * cos(t))";
    const uint32_t on = tape_binary(b, TAPE_GREATER, p[0], tape_constant(b, 0));
    double turn;
    const bool straight = tape_is_constant(b, p[2], &turn) && turn == 0;
    const uint32_t u = formula_build(b, straight ? radius : x, at, p);
    const uint32_t v = straight ? at[1] : formula_build(b, y, at, p);
    at[0] = tape_where(b, on, u, at[0]);
    at[1] = tape_where(b, on, v, at[1]);
}

uint32_t internal_build(struct tape_builder *b, const struct internal_function *f,
                        const uint32_t *in, const struct pattern_defaults *d)
{
    const uint32_t *p = in + 3;
    uint32_t at[3] = {in[0], in[1], in[2]}, v;
    if (f->noise) {
        tape_call_extern(b, f->noise, d, in, &v);
        return v;
    }
    if (f->revolved >= 0)
        revolve(b, at, p + f->revolved);
    v = formula_build(b, f->formula, at, p);
    if (!f->limit)
        return v;
    return formula_bounded(b, tape_binary(b, TAPE_MULTIPLY, p[0], v),
                           formula_build(b, f->limit, at, p));
}
