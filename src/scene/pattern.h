#ifndef SCENE_PATTERN_H
#define SCENE_PATTERN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "math/transform.h"
#include "math/vec.h"

struct arena;
struct object;
struct pigment;
struct pigment_tape;
struct image_map;
struct density_grid;
struct pattern;
struct noise_kernels;
struct formula;

enum wave { WAVE_RAMP, WAVE_TRIANGLE, WAVE_SINE, WAVE_SCALLOP, WAVE_CUBIC, WAVE_POLY };

struct turbulence {
    struct vec3 amount;
    int octaves;         // 6
    float lambda, omega; // 2, 0.5
};

enum warp_kind {
    WARP_TRANSFORM,
    WARP_TURBULENCE,
    WARP_REPEAT,
    WARP_BLACK_HOLE,
    WARP_PLANAR,
    WARP_CYLINDRICAL,
    WARP_SPHERICAL,
    WARP_TOROIDAL,
    WARP_CUBIC,
};

// One step from the point outside towards the pattern's own space (spec/textures
// 3.4, 4); applied in list order.
struct warp {
    enum warp_kind kind;
    const struct warp *next;
    struct transform transform; // WARP_TRANSFORM: applied inverse
    struct turbulence turbulence;
    struct vec3 repeat, offset, flip;        // repeat; black_hole: repeat
    struct vec3 centre;                      // black_hole
    double radius, strength, falloff;        // black_hole
    bool inverse;                            // black_hole
    int type;                                // black_hole
    struct vec3 uncertainty;                 // black_hole: turbulence vector
    struct vec3 orientation;                 // planar..toroidal
    double dist_exp, major_radius, distance; // distance: planar
};

// What a pattern may ask about the place it is evaluated at, beyond the point. All in
// world space, whatever transforms the texture is under.
struct pattern_context {
    struct vec3 p_world; // the intersection point
    struct vec3 normal;  // the layer's perturbed unit normal; zero: no surface
    struct vec3 ray_d;   // unit direction of the ray; zero: none
    struct vec2 uv;      // for pigments inside patterns (pigment_pattern)
};

// The contexts of eight points that patterns are evaluated at together, in lanes.
struct pattern_packet {
    const double (*p_world)[8], (*normal)[8], (*ray_d)[8];
    const double (*uv)[8]; // NULL: all 0
};

// Those that are a few operations, which scene/plain_lanes.h has at eight points.
enum pattern_plain {
    PLAIN_NONE,
    PLAIN_GRADIENT,
    PLAIN_CHECKER,
    PLAIN_BRICK,
    PLAIN_ONION,
    PLAIN_SPHERICAL,
    PLAIN_CYLINDRICAL,
    PLAIN_PLANAR,
    PLAIN_BOXED,
    PLAIN_SQUARE,
    PLAIN_HEXAGON,
    PLAIN_TRIANGULAR,
    PLAIN_CUBIC,
    PLAIN_QUILTED,
};

// A kind of pattern; patterns/NAME.c defines NAME_pattern_ops, patterns.def lists
// it. value is the raw value of spec/textures 5.1, before frequency, phase, wave.
struct pattern_ops {
    const char *keyword;
    enum wave wave;      // wave type that the keyword sets
    float frequency;     // 1, or 0 for list and bitmap patterns
    int list;            // >0: takes that many list entries (checker 2)
    bool own_turbulence; // the classic turbulence acts inside value, not as a warp
    void (*init)(struct pattern *p); // defaults of its parameters; NULL: all zero
    double (*value)(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c);
    enum pattern_plain plain;
    // The same at eight points, to the bit. NULL: as `plain`, or by value, one after the other.
    void (*values)(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8]);
    // The value as steps of a tape, for bounds (scene/pattern_formula.h). NULL: nothing
    // useful is known of it.
    uint32_t (*formula)(struct formula *f, const struct pattern *p, const uint32_t at[3]);
    // Told when all parameters are read: settles them, or says what is wrong. NULL: none.
    const char *(*finish)(struct pattern *p, struct arena *a);
    // As a normal: n changed by this pattern's own rule (spec/textures 11.3). NULL:
    // by differences of the value (11.2).
    struct vec3 (*perturb)(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at);
    // The same at eight points: n is changed. NULL: one after the other.
    void (*perturbs)(const struct pattern *p, const struct noise_kernels *k, float amount,
                     const double at[3][8], double n[3][8]);
};

// What the whole scene decides, known only at the end of parsing; all patterns of a
// scene point at the same one.
struct pattern_defaults {
    int noise_generator; // 1..3
    int number_of_waves;
};

// A pattern with its parameters. What a kind does not use stays zero.
struct pattern {
    const struct pattern_ops *ops; // NULL: no pattern (plain colour)
    enum wave wave;
    float exponent; // WAVE_POLY
    float frequency, phase;
    int noise_generator;                     // 1..3; 0: as `defaults` say
    const struct pattern_defaults *defaults; // NULL: generator 2, 10 waves
    const struct warp *warps;                // front first
    const struct turbulence *turbulence; // the classic element, always last; NULL: none
    // parameters, by pattern
    struct vec3 vector;  // gradient, slope direction, brick_size, crackle form, julia c
    struct vec3 vector2; // slope altitude
    double low, high, low2, high2; // slope
    bool point_at;                 // slope
    float value[4];       // mortar; agate_turb; quilted controls; facets size, coords
    float metric, offset; // crackle
    bool solid;           // crackle
    int integer[4];       // iterations, spiral arms, magnet type, tiling number,
                          // pavement sides tiles pattern form
    int exterior_type, interior_type; // fractals; pavement exterior, interior
    double exterior_factor, interior_factor;
    int fractal_exponent;
    const struct object *object;     // object pattern
    const struct pigment *pigment;   // pigment_pattern
    const struct pigment_tape *tape; // the same, compiled; NULL: its maps nest too deeply
    const struct image_map *image;   // image_pattern
    const struct paving_map *paving; // pavement, once it is finished
    const struct density_grid *density; // density_file; interpolation in integer[0]
    // function pattern: evaluates user code at a point
    double (*function)(const void *data, struct vec3 p);
    const void *function_data;
};

// The value after warps, frequency, phase and wave (spec/textures 3.2), 0..1 for
// most patterns; list patterns give the entry's index.
double pattern_value(const struct pattern *p, struct vec3 at,
                     const struct pattern_context *c);
struct vec3 pattern_warp(const struct pattern *p, struct vec3 at);
// The same at a point that pattern_warp gave.
double pattern_value_at(const struct pattern *p, struct vec3 warped,
                        const struct pattern_context *c);
// A normal on its way to the pattern's space and back: through its transforms alone,
// normalised as the language does (spec/textures 11.1).
struct vec3 pattern_normal_in(const struct pattern *p, struct vec3 n, bool keep_length);
struct vec3 pattern_normal_out(const struct pattern *p, struct vec3 n, bool keep_length);
static inline int pattern_noise_generator(const struct pattern *p)
{
    return p->noise_generator ? p->noise_generator
           : p->defaults      ? p->defaults->noise_generator
                              : 2;
}

// Patterns are shared: `p` kept in the arena, or `known` if that is the same; a copy of p
// (NULL: pattern_none) moved by t.
extern const struct pattern pattern_none;
const struct pattern *pattern_keep(struct arena *a, const struct pattern *p,
                                   const struct pattern *known);
const struct pattern *pattern_moved(struct arena *a, const struct pattern *p,
                                    const struct transform *t);

const struct pattern_ops *pattern_find(const char *keyword, size_t len);
// As a pattern keyword does (spec/textures 3.1): the kind and its parameters change,
// wave type and frequency where the kind says so; warps and the rest stay. A pattern
// that had no kind gets frequency 1.
void pattern_set_kind(struct pattern *p, const struct pattern_ops *ops);
// Adds what was written next; lists are shared with copies and never modified.
void pattern_add_transform(struct arena *a, struct pattern *p, const struct transform *t);
void pattern_add_warp(struct arena *a, struct pattern *p, const struct warp *w);

#define PATTERN(name) extern const struct pattern_ops name##_pattern_ops;
#include "scene/patterns.def"
#undef PATTERN
extern const struct pattern_ops *const pattern_table[];
extern const size_t pattern_count;

#endif
