#ifndef SCENE_PATTERN_FORMULA_H
#define SCENE_PATTERN_FORMULA_H

#include "scene/noise_kernel.h"
#include "scene/pattern.h"
#include "scene/tape_build.h"
#include "scene/texture.h"

// Patterns and pigments written as steps of a tape, for bounds over boxes of points alone:
// values are those of pattern_value and pigment_color, from which the real values of the
// formula differ by roundings. What is not made of plain steps is an extern with bounds
// (scene/pattern_bounds.c), and an opaque one where nothing useful is known.
struct formula {
    struct tape_builder *b;
    struct arena *arena;
    uint32_t outside[3]; // the point that the whole function is of
};

// A tape of x, y, z with these bounds: of one result, or of the five of a colour. NULL:
// it would be too large. Nodes live in `work` meanwhile.
const struct tape *pattern_formula(struct arena *a, struct arena *work,
                                   const struct pattern *p);
const struct tape *pigment_formula(struct arena *a, struct arena *work,
                                   const struct pigment *p);
// The grey of a pigment at a place of its outer space (pigment_pattern).
uint32_t formula_grey(struct formula *f, const struct pigment *p, const uint32_t at[3]);

static inline uint32_t formula_constant(struct formula *f, double v)
{
    return tape_constant(f->b, v);
}
static inline uint32_t formula_add(struct formula *f, uint32_t x, uint32_t y)
{
    return tape_binary(f->b, TAPE_ADD, x, y);
}
static inline uint32_t formula_subtract(struct formula *f, uint32_t x, uint32_t y)
{
    return tape_binary(f->b, TAPE_SUBTRACT, x, y);
}
static inline uint32_t formula_multiply(struct formula *f, uint32_t x, uint32_t y)
{
    return tape_binary(f->b, TAPE_MULTIPLY, x, y);
}
static inline uint32_t formula_scale(struct formula *f, uint32_t x, double by)
{
    return tape_binary(f->b, TAPE_MULTIPLY, x, tape_constant(f->b, by));
}
static inline uint32_t formula_offset(struct formula *f, uint32_t x, double by)
{
    return tape_binary(f->b, TAPE_ADD, x, tape_constant(f->b, by));
}
static inline uint32_t formula_floor(struct formula *f, uint32_t x)
{
    return tape_unary(f->b, TAPE_FLOOR, x);
}
static inline uint32_t formula_abs(struct formula *f, uint32_t x)
{
    return tape_unary(f->b, TAPE_ABS, x);
}
static inline uint32_t formula_less(struct formula *f, uint32_t x, uint32_t y)
{
    return tape_binary(f->b, TAPE_LESS, x, y);
}
static inline uint32_t formula_both(struct formula *f, uint32_t x, uint32_t y)
{
    return tape_binary(f->b, TAPE_AND, x, y);
}
static inline uint32_t formula_where(struct formula *f, uint32_t whether, uint32_t x,
                                     uint32_t y)
{
    return tape_where(f->b, whether, x, y);
}
// v - floor(v); whether a whole number is odd, exactly.
uint32_t formula_fraction(struct formula *f, uint32_t v);
uint32_t formula_odd(struct formula *f, uint32_t v);
// sqrt(x^2 + y^2), and of three.
uint32_t formula_length(struct formula *f, uint32_t x, uint32_t y);
uint32_t formula_length3(struct formula *f, const uint32_t at[3]);
// The small functions of scene/pattern_math.h.
uint32_t formula_fade_out(struct formula *f, uint32_t v);
uint32_t formula_wrap(struct formula *f, uint32_t v);
uint32_t formula_triangle(struct formula *f, uint32_t v);

// ---- externs (scene/pattern_bounds.c) ---------------------------------------------------
// Anything between these, wherever the box is: opaque.
uint32_t formula_unknown(struct formula *f, double lo, double hi, const uint32_t at[3]);
uint32_t formula_noise(struct formula *f, const struct pattern *p, const uint32_t at[3]);
// What is made of octaves of noise: unknown. Each octave counts as much for the slope, so
// that bounds are of use only in boxes smaller than the cells of the finest, which cost
// more than samples do.
static inline uint32_t formula_octaves(struct formula *f, const uint32_t at[3])
{
    return formula_unknown(f, -INFINITY, INFINITY, at);
}
// From the raw value to that of the pattern: frequency, phase and wave.
uint32_t formula_finished(struct formula *f, const struct pattern *p, uint32_t v);
void formula_colors(struct formula *f, const struct color_map *m, uint32_t v,
                    uint32_t out[5]);
// v, and what rounding to single precision makes of numbers as large as `size`.
uint32_t formula_single(struct formula *f, double size, uint32_t v);
// An extern of a pattern of x, y and z with one result.
uint32_t formula_extern(struct formula *f, const struct tape_extern *e, const void *data,
                        const uint32_t at[3]);

#endif
