#ifndef MATH_COLOR_H
#define MATH_COLOR_H

// Linear working-space colour. Single precision, as images are.
struct rgb {
    float r, g, b;
};

// A pigment's colour: how much passes coloured (filter) and plain (transmit).
struct rgbft {
    float r, g, b, filter, transmit;
};

static inline struct rgb rgb(float r, float g, float b) { return (struct rgb){r, g, b}; }
// The same in all channels.
static inline struct rgb rgb_even(float v) { return (struct rgb){v, v, v}; }
static inline struct rgb rgb_add(struct rgb a, struct rgb b)
{
    return rgb(a.r + b.r, a.g + b.g, a.b + b.b);
}
static inline struct rgb rgb_mul(struct rgb a, struct rgb b)
{
    return rgb(a.r * b.r, a.g * b.g, a.b * b.b);
}
static inline struct rgb rgb_scale(float s, struct rgb a)
{
    return rgb(s * a.r, s * a.g, s * a.b);
}
static inline float rgb_max(struct rgb c)
{
    float m = c.r > c.g ? c.r : c.g;
    return m > c.b ? m : c.b;
}
// Luminance as the scene language defines it, its `gray` (spec/lighting.md 0).
#define LUMINANCE_RED   0.297
#define LUMINANCE_GREEN 0.589
#define LUMINANCE_BLUE  0.114
static inline double luminance(double r, double g, double b)
{
    return LUMINANCE_RED * r + LUMINANCE_GREEN * g + LUMINANCE_BLUE * b;
}
// In single precision, which need not be the rounded one of the same colour.
static inline float rgb_luminance(struct rgb c)
{
    return (float)LUMINANCE_RED * c.r + (float)LUMINANCE_GREEN * c.g +
           (float)LUMINANCE_BLUE * c.b;
}
static inline struct rgb rgbft_rgb(struct rgbft c) { return rgb(c.r, c.g, c.b); }
// The factor a surface of this colour applies to light going through it.
static inline struct rgb rgbft_pass(struct rgbft c)
{
    return rgb(c.r * c.filter + c.transmit, c.g * c.filter + c.transmit,
               c.b * c.filter + c.transmit);
}
static inline float rgbft_opacity(struct rgbft c) { return 1 - c.filter - c.transmit; }

#endif
